#include "scene/zone.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/cell_grid.hpp"

namespace dim {

bool is_window(const Zone& zone, const Surface& surface) {
  return zone.finishes[static_cast<std::size_t>(surface.finish)].kind == FinishKind::glazing && surface.bounding;
}

bool any_bodies_measure(const Zone& zone) {
  return std::any_of(zone.points.begin(), zone.points.end(),
                     [](const MeasuringPoint& point) { return point.quantity != Quantity::planar; });
}

const View& find_view(const Zone& zone, const std::string& name) {
  if (zone.views.empty())
    throw InputError({{}, "zone '" + zone.name + "' has no [[view]]", "add one to the zone file"});
  if (name.empty()) return zone.views.front();
  std::vector<std::string> names;
  for (const auto& view : zone.views) {
    if (view.name == name) return view;
    names.push_back(view.name);
  }
  throw InputError({{}, "no view '" + name + "' in zone '" + zone.name + "'", name_cure(name, names)});
}

void check_cells_fit(const Zone& zone, std::size_t memory_limit_bytes) {
  constexpr double kPerCell = 2.0 * sizeof(GridCell) + sizeof(std::int64_t);  // a list that grows holds twice
  constexpr double kGiB = 1024.0 * 1024.0 * 1024.0;
  double sum = 0.0, most = -1.0;
  const Surface* largest = nullptr;
  for (const auto& surface : zone.surfaces) {
    const double n = n_squares(surface.polygon, surface.cell_m, surface.grid);
    sum += n;
    if (n > most) most = n, largest = &surface;
  }
  if (sum * kPerCell <= static_cast<double>(memory_limit_bytes) && most <= kMaxSquares) return;
  throw LimitError(fmt::format(
      "{:.3g} cells, {:.3g} of them on surface '{}', need {:.3g} GiB before any ray is cast, "
      "{:.3g} GiB are free; use a larger --cell",
      sum, most, largest->name, sum * kPerCell / kGiB, static_cast<double>(memory_limit_bytes) / kGiB));
}

}  // namespace dim
