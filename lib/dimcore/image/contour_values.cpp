#include "image/contour_values.hpp"

#include <algorithm>
#include <limits>

namespace dim {
namespace {

ValueGrid empty_grid(int nu, int nv, const Vec2& size_m) {
  const std::size_t n = static_cast<std::size_t>(nu) * static_cast<std::size_t>(nv);
  return {nu, nv, size_m, std::vector<double>(n, std::numeric_limits<double>::quiet_NaN())};
}

}  // namespace

ValueGrid values_on_plane(const Zone& zone, std::size_t plane, const std::vector<double>& values) {
  const MeasuringPlane& its = zone.planes[plane];
  const PointSet& set = zone.point_sets[plane];
  ValueGrid grid = empty_grid(its.nu, its.nv, its.polygon.size_m());
  for (std::size_t p = set.first; p < set.first + set.count; ++p) {
    if (!zone.points[p].valid) continue;
    const Vec2 local = its.polygon.frame().to_local(zone.points[p].position);
    const int i = std::clamp(static_cast<int>(local.x / grid.size_m.x * grid.nu), 0, grid.nu - 1);
    const int j = std::clamp(static_cast<int>(local.y / grid.size_m.y * grid.nv), 0, grid.nv - 1);
    grid.values[static_cast<std::size_t>(j * grid.nu + i)] = values[p];
  }
  return grid;
}

ValueGrid values_on_surface(const Cells& cells, const Polygon& polygon, std::size_t surface,
                            const std::vector<double>& values) {
  const CellGrid& squares = cells.grid(surface);
  ValueGrid grid = empty_grid(squares.nu(), squares.nv(), polygon.size_m());
  std::vector<double> area_m2(grid.values.size(), 0.0), sum(grid.values.size(), 0.0);
  for (std::size_t i = cells.first(surface); i < cells.first(surface + 1); ++i) {
    const auto square = static_cast<std::size_t>(squares.square_at(cells[i].centroid));
    area_m2[square] += cells.area_m2(i);
    sum[square] += cells.area_m2(i) * values[i];
  }
  for (std::size_t k = 0; k < sum.size(); ++k)
    if (area_m2[k] > 0.0) grid.values[k] = sum[k] / area_m2[k];
  return grid;
}

}  // namespace dim
