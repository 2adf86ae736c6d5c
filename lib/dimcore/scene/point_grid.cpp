#include "scene/point_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "database/toml_reader.hpp"
#include "scene/face_source.hpp"

namespace dim {
namespace {

int divisions(double size, double spacing) {
  constexpr double kRounding = 1e-9;  // 6.2 / 0.1 is 62 squares, not 63
  const double n = std::ceil(size / spacing * (1.0 - kRounding));
  return n < 1.0 ? 1 : n > kMaxGrid ? kMaxGrid + 1 : static_cast<int>(n);
}

void lay_out_points(const MeasuringPlane& plane, const Response& response, std::vector<MeasuringPoint>& points) {
  const Vec2 size = plane.polygon.size_m();
  for (int j = 0; j < plane.nv; ++j) {
    for (int i = 0; i < plane.nu; ++i) {
      const Vec2 middle(size.x * (i + 0.5) / plane.nu, size.y * (j + 0.5) / plane.nv);
      if (plane.polygon.contains(middle))
        points.push_back({plane.polygon.frame().to_world(middle), response.normal, true, response.quantity});
    }
  }
}

}  // namespace

double spacing_en12464_m(const Vec2& size_m) {
  constexpr double kMost_m = 10.0;
  const double longer = std::max(size_m.x, size_m.y), shorter = std::min(size_m.x, size_m.y);
  const double d = longer >= 2.0 * shorter ? shorter : longer;
  return std::min(kMost_m, 0.2 * std::pow(5.0, std::log10(d)));
}

bool divide(const TomlTable& table, const char* key, double spacing_m, MeasuringPlane& plane) {
  plane.nu = divisions(plane.polygon.size_m().x, spacing_m);
  plane.nv = divisions(plane.polygon.size_m().y, spacing_m);
  if (plane.nu <= kMaxGrid && plane.nv <= kMaxGrid) return true;
  table.problem(key, fmt::format("more than {} points along one side", kMaxGrid), "give a larger spacing");
  return false;
}

void add_plane(const TomlTable& table, MeasuringPlane plane, const std::vector<Facing>& facings, Zone& zone) {
  const auto n = static_cast<std::size_t>(plane.nu) * static_cast<std::size_t>(plane.nv);
  if (n > kMaxPoints)
    return table.problem("name", fmt::format("{} points, at most {} are accepted", n, kMaxPoints),
                         "give a larger spacing");
  const std::string name = plane.name;
  for (const Facing& facing : facings) {
    plane.name = name + facing.suffix;
    const std::size_t first = zone.points.size();
    lay_out_points(plane, facing.response, zone.points);
    zone.point_sets.push_back({plane.name, first, zone.points.size() - first, plane.place});
    zone.planes.push_back(plane);
  }
  if (!facings.empty() && zone.point_sets.back().count == 0)
    table.problem("name", "no point of its grid lies inside it", "give a finer spacing or grid");
}

}  // namespace dim
