#include "scene/zone_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "database/toml_reader.hpp"
#include "scene/face_source.hpp"
#include "scene/finish_reader.hpp"
#include "scene/outline_check.hpp"
#include "scene/placement_check.hpp"
#include "scene/receiver_reader.hpp"
#include "scene/surface_overlap.hpp"
#include "scene/zone_frame.hpp"
#include "scene/zone_shell.hpp"

namespace dim {
namespace {

double unit_of(const TomlTable& root) {
  const auto unit = root.word("unit", {"m", "mm", "cm", "in", "ft"});
  static const std::map<std::string, double> kMetres = {
      {"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}, {"in", 0.0254}, {"ft", 0.3048}};
  return unit ? kMetres.at(*unit) : 1.0;
}

struct Bounds {
  Vec3 low{std::numeric_limits<double>::max()};
  Vec3 high{std::numeric_limits<double>::lowest()};
};

Bounds bounds_of(const std::vector<FaceSource>& faces) {
  Bounds bounds;
  for (const auto& face : faces) {
    for (const auto& p : face.outline) {
      bounds.low = glm::min(bounds.low, p);
      bounds.high = glm::max(bounds.high, p);
    }
  }
  return bounds;
}

std::vector<std::string> keys(const std::map<std::string, int>& map) {
  std::vector<std::string> result;
  for (const auto& [key, value] : map) result.push_back(key);
  return result;
}

class ZoneReader {
 public:
  ZoneReader(const TomlTable& root, const DatabaseSearch& search, Warnings& warnings)
      : root_(root), problems_(root.context().problems), search_(search), warnings_(warnings) {}

  Zone read(double cell_override_m) {
    zone_.name = root_.text("name").value_or("");
    root_.has("dim");
    frame_.unit_m = zone_.unit_m = unit_of(root_);
    unit_place_ = root_.has("unit") ? root_.place("unit") : Place{root_.context().file, 1, 1};
    const auto cell = root_.number("cell", kLength);
    zone_.finishes = read_finishes(root_, search_);
    const auto faces = read_faces(root_);
    if (faces.empty() && problems_.empty())
      problems_.add({root_.context().file, 1, 1}, "the zone has no surface",
                    "write at least one [[surface]]");
    place_zone(faces);
    cell_m_ = cell_override_m > 0.0 ? cell_override_m
              : cell                ? *cell * frame_.unit_m
                                    : std::min(kDefaultCell_m, zone_.diameter_m / 20.0);
    check_parents(faces);
    for (const auto& face : faces) add_surface(face);
    read_receivers(root_, frame_, cell_m_, zone_);
    root_.refuse_unknown();
    problems_.throw_if_any();
    shape_zone();
    problems_.throw_if_any();
    return std::move(zone_);
  }

 private:
  void place_zone(const std::vector<FaceSource>& faces) {
    if (faces.empty()) return;
    const Bounds bounds = bounds_of(faces);
    if (bounds.low.x > bounds.high.x) return;  // nothing but empty outlines, reported one by one
    frame_.centre = bounds.low + (bounds.high - bounds.low) / 2.0;
    zone_.origin_m = frame_.centre * frame_.unit_m;
    zone_.diameter_m = glm::length((bounds.high - bounds.low) * frame_.unit_m);
  }

  void check_parents(const std::vector<FaceSource>& faces) {
    std::map<std::string, int> names;
    for (const auto& face : faces) {
      names.emplace(face.name, 0);
      if (face.two_sided) names.emplace(face.name + ".back", 0);
    }
    for (const auto& face : faces) {
      if (!face.on.empty() && !names.contains(face.on))
        problems_.add(face.on_place,
                      fmt::format("surface '{}': no surface '{}' to lie on", face.name, face.on),
                      did_you_mean(face.on, keys(names)));
    }
  }

  int finish_of(const FaceSource& face) {
    if (finish_index_.empty()) {
      for (std::size_t i = 0; i < zone_.finishes.size(); ++i)
        finish_index_.emplace(zone_.finishes[i].name, static_cast<int>(i));
    }
    const auto found = finish_index_.find(face.finish);
    if (found != finish_index_.end()) return found->second;
    // The six faces of a box share one place.
    if (!reported_finishes_.emplace(face.finish_place.line, face.finish_place.column).second) return -1;
    auto cure = did_you_mean(face.finish, keys(finish_index_));
    if (cure.empty()) cure = fmt::format("write it in [finishes]: {} = 0.5", face.finish);
    problems_.add(face.finish_place, fmt::format("surface '{}': no finish '{}'", face.name, face.finish),
                  cure);
    return -1;
  }

  void add_surface(const FaceSource& face) {
    const int finish = finish_of(face);
    Ring3 outline = face.outline;
    auto holes = face.holes;
    for (auto& p : outline) p = frame_.to_zone(p);
    for (auto& hole : holes)
      for (auto& p : hole) p = frame_.to_zone(p);
    if (!check_outline(outline, holes, fmt::format("surface '{}'", face.name), face.vertices_place,
                       problems_) ||
        finish < 0)
      return;
    Surface surface;
    surface.name = face.name;
    surface.polygon = Polygon(outline, holes);
    surface.finish = finish;
    surface.cell_m = face.cell ? *face.cell * frame_.unit_m : cell_m_;
    surface.grid = face.grid;
    surface.outside = face.outside;
    surface.bounding = !face.of_box && !face.two_sided && !face.outside;
    surface.place = face.vertices_place;
    planarity_m_ = std::max(planarity_m_, planarity_error_m(outline));
    links_.push_back({face.on, face.on_place, face.of_box});
    zone_.surfaces.push_back(std::move(surface));
    if (face.two_sided) add_back();
  }

  void add_back() {
    Surface back = zone_.surfaces.back();
    const int front = static_cast<int>(zone_.surfaces.size()) - 1;
    back.name += ".back";
    back.polygon = back.polygon.reversed();
    back.twin = front;
    zone_.surfaces.back().twin = front + 1;
    links_.push_back({"", {}, false});
    zone_.surfaces.push_back(std::move(back));
  }

  // What needs every surface: cutting, overlaps, closedness. Only reached when each is sound by itself.
  void shape_zone() {
    const double touch_m = touch_tolerance_m(zone_.surfaces);
    join_features(zone_.surfaces, links_, touch_m, problems_);
    problems_.throw_if_any();
    auto cut = zone_.surfaces;
    cut_features(cut, touch_m);
    const auto overlaps = find_overlaps(zone_.surfaces, cut, links_, touch_m, warnings_);
    cut_overlaps(cut, zone_.surfaces, overlaps, touch_m);
    check_whole(overlaps, touch_m);
    problems_.throw_if_any();
    zone_.surfaces = std::move(cut);
    remove_contacts(zone_.surfaces, links_, touch_m, warnings_);
  }

  // Closedness and volume, size, and what stands where; features are still part of their parents.
  void check_whole(const std::vector<SurfaceOverlap>& overlaps, double touch_m) {
    auto shell = zone_.surfaces;
    cut_overlaps(shell, zone_.surfaces, of_bounding(overlaps, zone_.surfaces), touch_m);
    const auto check =
        check_shell(shell, frame_, std::max(touch_m, 2.0 * planarity_m_), problems_, warnings_);
    zone_.volume_m3 = check.volume_m3;
    zone_.closed = check.closed;
    warn_of_size(zone_, unit_place_, warnings_);
    warn_of_placement(zone_, links_, eyes(), frame_, touch_m, warnings_);
  }

  std::vector<Place> eyes() const {
    std::vector<Place> places;
    for (const auto& view : root_.tables("view")) places.push_back(view.place("eye"));
    return places;
  }

  const TomlTable& root_;
  Problems& problems_;
  const DatabaseSearch& search_;
  Warnings& warnings_;
  ZoneFrame frame_;
  double cell_m_ = kDefaultCell_m;
  double planarity_m_ = 0.0;
  std::map<std::string, int> finish_index_;
  std::set<std::pair<int, int>> reported_finishes_;
  std::vector<SurfaceLink> links_;
  Place unit_place_;
  Zone zone_;
};

}  // namespace

Zone read_zone(std::string_view text, const std::string& file_name, const std::vector<std::string>& overrides,
               double cell_override_m, const DatabaseSearch& search, Warnings& warnings) {
  const toml::table table = parse_toml(text, file_name, {"zone", 1, true, {"finishes"}}, overrides);
  Problems problems;
  TomlContext context{file_name, problems};
  const TomlTable root(table, "", context);
  return ZoneReader(root, search, warnings).read(cell_override_m);
}

}  // namespace dim
