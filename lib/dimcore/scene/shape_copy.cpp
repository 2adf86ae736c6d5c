#include "scene/shape_copy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dim {
namespace {

bool printable(const std::string& name) {
  return !name.empty() && name.find_first_of("\n\r\t") == std::string::npos;
}

std::optional<std::vector<std::string>> read_of(TomlTable& table, bool& list) {
  const auto* node = table.node("of");
  if (!node) return std::nullopt;
  list = node->is_array();
  if (!list) {
    const auto name = table.name("of");
    if (!name) return std::nullopt;
    table.relabel(fmt::format("copy of '{}'", *name));
    return std::vector<std::string>{*name};
  }
  auto names = table.texts("of");
  if (!names) return std::nullopt;
  if (names->empty()) return table.problem("of", "of is empty"), std::nullopt;
  table.relabel(fmt::format("copy of '{}' and {} more", names->front(), names->size() - 1));
  return names;
}

void read_named(const TomlTable& table, CopyPlan& plan) {
  const bool complete = int(table.require("names", "or give count and pitch")) &
                        int(plan.turn_deg != 0.0 || plan.mirror_axis || table.require("by"));
  const auto names = table.texts("names");
  auto by = table.rows("by", 3, kCoordinate);
  if (!table.has("by")) by.emplace(names ? names->size() : 0, std::vector<double>(3, 0.0));
  if (!complete || !names || !by) return;
  if (names->size() != by->size())
    return table.problem("by", fmt::format("{} names but {} displacements", names->size(), by->size()),
                         "give one [x, y, z] for each name");
  const auto& array = *table.node("names")->as_array();
  for (std::size_t i = 0; i < names->size(); ++i) {
    const Place place = place_of(array[i].source(), table.context().file);
    const auto& d = (*by)[i];
    if (printable((*names)[i]))
      plan.places.push_back({(*names)[i], false, {d[0], d[1], d[2]}, place});
    else
      table.context().problems.add(place, table.label() + ": a name must be printable text");
  }
}

void read_grid(const TomlTable& table, CopyPlan& plan) {
  const bool complete = int(table.require("count")) & int(table.require("pitch"));
  const auto count = table.integers2("count", 1, kMaxGrid);
  const auto pitch = table.numbers("pitch", 2, kCoordinate);
  for (const char* key : {"names", "by"})
    if (table.has(key))
      table.problem(key, fmt::format("{} does not go with count and pitch", key), "leave one out");
  if (!complete || !count || !pitch) return;
  if (static_cast<std::size_t>(count->first) * static_cast<std::size_t>(count->second) > kMaxSurfaces)
    return table.problem("count", fmt::format("count = [{}, {}] makes more than the {} surfaces of a zone",
                                              count->first, count->second, kMaxSurfaces));
  for (int j = 0; j < count->second; ++j)
    for (int i = 0; i < count->first; ++i)
      if (i + j > 0)
        plan.places.push_back({fmt::format("[{},{}]", i, j), true,
                               Vec3(i * (*pitch)[0], j * (*pitch)[1], 0.0), table.place("count")});
}

Vec2 middle_of(const std::vector<const Shape*>& shapes) {
  Vec2 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const auto* shape : shapes)
    for (const auto& face : shape->faces)
      for (const auto& p : face.outline) low = glm::min(low, Vec2(p)), high = glm::max(high, Vec2(p));
  return low + (high - low) / 2.0;
}

/// Mirror, turn and displacement of one place.
class Motion {
 public:
  Motion(const CopyPlan& plan, const Vec2& about, const Vec3& by)
      : mirror_(plan.mirror_axis), about_(about, 0.0), by_(by) {
    // Quarter turns exactly, so that a turned copy meets its neighbours to the last digit.
    const double quarters = plan.turn_deg / 90.0;
    c_ = std::cos(radians(plan.turn_deg)), s_ = std::sin(radians(plan.turn_deg));
    if (quarters == std::floor(quarters)) c_ = std::round(c_), s_ = std::round(s_);
    moves_only_ = !mirror_ && plan.turn_deg == 0.0;
  }

  Ring3 operator()(Ring3 ring) const {
    for (auto& p : ring) p = moved(p);
    if (mirror_) std::reverse(ring.begin(), ring.end());
    return ring;
  }

 private:
  Vec3 moved(const Vec3& p) const {
    if (moves_only_) return p + by_;
    Vec3 d = p - about_;
    if (mirror_) d[*mirror_] = -d[*mirror_];
    return about_ + Vec3(c_ * d.x - s_ * d.y, s_ * d.x + c_ * d.y, d.z) + by_;
  }

  std::optional<int> mirror_;
  Vec3 about_, by_;
  double c_ = 1.0, s_ = 0.0;
  bool moves_only_ = true;
};

std::string name_of(const Shape& original, const CopyPlan& plan, const CopyPlace& place) {
  if (place.suffix) return original.name + place.name;
  return plan.of_list ? place.name + "." + original.name : place.name;
}

}  // namespace

std::optional<CopyPlan> read_copy_plan(TomlTable& table) {
  CopyPlan plan;
  table.require("of");
  const auto of = read_of(table, plan.of_list);
  plan.turn_deg = table.number_or("turn", kAnyNumber, 0.0);
  if (const auto axis = table.word("mirror", {"x", "y"})) plan.mirror_axis = *axis == "x" ? 0 : 1;
  if (const auto about = table.numbers("about", 2, kCoordinate)) plan.about = Vec2((*about)[0], (*about)[1]);
  if (plan.about && plan.turn_deg == 0.0 && !plan.mirror_axis)
    table.problem("about", "about is what turn and mirror go by, and neither is given", "leave it out");
  if (table.has("count") || table.has("pitch"))
    read_grid(table, plan);
  else
    read_named(table, plan);
  table.refuse_unknown();
  if (!of) return std::nullopt;
  plan.of = *of;
  return plan;
}

std::vector<Shape> copied(const std::vector<const Shape*>& originals, const CopyPlan& plan,
                          const CopyPlace& place) {
  const Motion motion(plan, plan.about.value_or(middle_of(originals)), place.by);
  // Old name to new of every face that a feature may lie on.
  std::map<std::string, std::string> renamed;
  std::vector<Shape> copies;
  for (const auto* original : originals) {
    Shape copy = *original;
    copy.name = name_of(*original, plan, place);
    for (auto& face : copy.faces) {
      const std::string before = face.name;
      face.name = copy.name + face.name.substr(original->name.size());
      renamed.emplace(before, face.name);
      if (face.two_sided) renamed.emplace(before + ".back", face.name + ".back");
      face.place = face.vertices_place = place.place;
      face.outline = motion(std::move(face.outline));
      for (auto& hole : face.holes) hole = motion(std::move(hole));
    }
    copies.push_back(std::move(copy));
  }
  for (auto& copy : copies)
    for (auto& face : copy.faces)
      if (const auto parent = renamed.find(face.on); parent != renamed.end()) face.on = parent->second;
  return copies;
}

}  // namespace dim
