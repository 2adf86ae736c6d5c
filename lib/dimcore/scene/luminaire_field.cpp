#include "scene/luminaire_field.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace dim {
namespace {

bool too_many(const TomlTable& table, std::string_view key, const std::string& words, std::size_t n,
              std::size_t most) {
  if (n <= most) return false;
  table.problem(key,
                fmt::format("{} makes {} luminaires; a file has at most {}", words, kMaxLuminaires - most + n,
                            kMaxLuminaires),
                "use fewer, or one luminaire of the same total flux for several");
  return true;
}

// The two directions of a field, of unit length.
std::optional<std::pair<Vec3, Vec3>> directions(const TomlTable& table, const Luminaire& luminaire) {
  const auto* node = table.node("along");
  if (!node) return std::pair{Vec3(1, 0, 0), Vec3(0, 1, 0)};
  if (node->is_string()) {
    if (!table.word("along", {"own", "zone"})) return std::nullopt;
    if (table.text("along") == "zone") return std::pair{Vec3(1, 0, 0), Vec3(0, 1, 0)};
    return std::pair{luminaire.c0, luminaire.c90};
  }
  const auto rows = table.rows("along", 3, kCoordinate);
  if (!rows) return std::nullopt;
  if (rows->size() != 2) {
    table.problem("along", fmt::format("along must be two directions, not {}", rows->size()),
                  "write [[x, y, z], [x, y, z]], or \"own\"");
    return std::nullopt;
  }
  Vec3 axes[2];
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& row = (*rows)[i];
    axes[i] = {row[0], row[1], row[2]};
    if (!(glm::length(axes[i]) > 0.0)) {
      table.problem("along", "along: a direction has zero length");
      return std::nullopt;
    }
    axes[i] = glm::normalize(axes[i]);
  }
  return std::pair{axes[0], axes[1]};
}

std::vector<FieldPlace> grid(const TomlTable& table, const Luminaire& luminaire, const Vec3& at,
                             std::size_t most) {
  const auto count = table.integers2("count", 1, kMaxCount);
  const auto pitch = table.numbers("pitch", 2, kCoordinate);
  if (table.has("count") != table.has("pitch"))
    table.problem(table.has("count") ? "count" : "pitch", "an array of luminaires needs both count and pitch",
                  "write pitch = [step along x, step along y]");
  const auto axes = directions(table, luminaire);
  if (!count || !pitch || !axes) return {};
  const auto n = static_cast<std::size_t>(count->first) * static_cast<std::size_t>(count->second);
  if (too_many(table, "count", fmt::format("count = [{}, {}]", count->first, count->second), n, most))
    return {};
  std::vector<FieldPlace> places;
  for (int j = 0; j < count->second; ++j)
    for (int i = 0; i < count->first; ++i)
      places.push_back({fmt::format("[{},{}]", i, j),
                        at + i * (*pitch)[0] * axes->first + j * (*pitch)[1] * axes->second, 0.0});
  return places;
}

std::vector<FieldPlace> line(const TomlTable& given, std::size_t most) {
  const auto table = given.table("line", given.label() + ": line");
  if (!table) return {};
  const bool complete =
      int(table->require("from")) & int(table->require("to")) & int(table->require("count"));
  const auto from = table->vec3("from"), to = table->vec3("to");
  const auto count = table->integer("count", 2, kMaxCount);
  table->refuse_unknown();
  if (!complete || !from || !to || !count) return {};
  if (too_many(*table, "count", fmt::format("count = {}", *count), static_cast<std::size_t>(*count), most))
    return {};
  std::vector<FieldPlace> places;
  for (int i = 0; i < *count; ++i)
    places.push_back(
        {fmt::format("[{}]", i), *from + (*to - *from) * (static_cast<double>(i) / (*count - 1)), 0.0});
  return places;
}

std::vector<FieldPlace> ring(const TomlTable& given, const Vec3& centre, std::size_t most) {
  const auto table = given.table("ring", given.label() + ": ring");
  if (!table) return {};
  const bool complete = int(table->require("radius")) & int(table->require("count"));
  const auto radius = table->number("radius", kLength);
  const auto count = table->integer("count", 1, kMaxCount);
  const double start_rad = radians(table->number_or("start", kAnyNumber, 0.0));
  table->refuse_unknown();
  if (!complete || !radius || !count) return {};
  if (too_many(*table, "count", fmt::format("count = {}", *count), static_cast<std::size_t>(*count), most))
    return {};
  std::vector<FieldPlace> places;
  for (int i = 0; i < *count; ++i) {
    const double angle = start_rad + 2.0 * kPi * i / *count;
    places.push_back(
        {fmt::format("[{}]", i), centre + *radius * turned_about_vertical({1, 0, 0}, angle), angle});
  }
  return places;
}

}  // namespace

Vec3 turned_about_vertical(const Vec3& v, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
}

std::vector<FieldPlace> read_field(const TomlTable& table, const Luminaire& luminaire, std::size_t most) {
  const bool as_grid = table.has("count") || table.has("pitch") || table.has("along");
  const bool as_line = table.has("line"), as_ring = table.has("ring");
  if (int(as_grid) + int(as_line) + int(as_ring) > 1) {
    table.problem(as_line ? "line" : "ring", "only one of count and pitch, line, and ring can be given",
                  "write an entry for each");
    for (const char* key : {"at", "count", "pitch", "along", "line", "ring"}) table.has(key);
    return {};
  }
  if (as_line) {
    if (table.has("at")) {
      table.problem("at", "a line of luminaires has no place of its own",
                    "leave out at: line says from and to");
      return {};
    }
    return line(table, most);
  }
  table.require("at");
  const auto at = table.vec3("at");
  // Read even without a place, so that what is wrong with it is said as well.
  const Vec3 centre = at.value_or(Vec3(0.0));
  std::vector<FieldPlace> places;
  if (as_ring)
    places = ring(table, centre, most);
  else if (as_grid)
    places = grid(table, luminaire, centre, most);
  else
    places.push_back({"", centre, 0.0});
  return at ? places : std::vector<FieldPlace>{};
}

}  // namespace dim
