#include "image/cell_shade.hpp"

#include <cmath>

namespace dim {

CellShade::Seen CellShade::at(std::size_t surface, const Vec2& local) const {
  const CellGrid& grid = cells_.grid(surface);
  const std::size_t first = cells_.first(surface);
  if (!smooth_) return of_cell(first + static_cast<std::size_t>(grid.cell_at(local)));
  const Vec2 size = zone_.surfaces[surface].polygon.size_m();
  const double u = local.x / size.x * grid.nu() - 0.5, v = local.y / size.y * grid.nv() - 0.5;
  const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
  Seen sum;
  double total = 0.0;
  for (int dj = 0; dj < 2; ++dj) {
    for (int di = 0; di < 2; ++di) {
      const int cell = grid.cell_of_square(i + di, j + dj);
      const double weight = (di ? u - i : 1.0 - (u - i)) * (dj ? v - j : 1.0 - (v - j));
      if (cell < 0 || !(weight > 0.0)) continue;
      const Seen seen = of_cell(first + static_cast<std::size_t>(cell));
      sum.illuminance_lx += weight * seen.illuminance_lx;
      sum.xyz_cd_m2 += weight * seen.xyz_cd_m2;
      total += weight;
    }
  }
  if (!(total > 0.0)) return of_cell(first + static_cast<std::size_t>(grid.cell_at(local)));
  return {sum.illuminance_lx / total, sum.xyz_cd_m2 / total};
}

}  // namespace dim
