#include "transport/cell_smoothing.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace dim {

CellSmoothing::CellSmoothing(const Cells& cells) : first_(cells.size() + 1, 0) {
  constexpr double kShare = 0.25;
  std::vector<std::vector<Neighbour>> next_to(cells.size());
  for (std::size_t s = 0; s < cells.n_surfaces(); ++s) {
    const CellGrid& grid = cells.grid(s);
    const std::size_t first = cells.first(s);
    if (first == cells.first(s + 1)) continue;
    for (int square = 0; square < grid.nu() * grid.nv(); ++square) {
      const int own = grid.middle_cell(square, 0, 0);
      for (int axis = 0; axis < 2 && own >= 0; ++axis) {
        const int other = grid.middle_cell(square, axis == 0, axis == 1);
        if (other < 0 || other == own) continue;
        const std::size_t i = first + static_cast<std::size_t>(own), j = first + static_cast<std::size_t>(other);
        if (cells.covered(i) || cells.covered(j)) continue;
        const double shared_m2 = kShare * std::min(cells.area_m2(i), cells.area_m2(j));
        next_to[i].push_back({static_cast<std::uint32_t>(j), shared_m2 / cells.area_m2(i)});
        next_to[j].push_back({static_cast<std::uint32_t>(i), shared_m2 / cells.area_m2(j)});
      }
    }
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    neighbours_.insert(neighbours_.end(), next_to[i].begin(), next_to[i].end());
    first_[i + 1] = neighbours_.size();
  }
}

void CellSmoothing::change(const std::vector<double>& values, std::size_t width, std::vector<double>& change) const {
  change.assign(values.size(), 0.0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, first_.size() - 1, 64), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const double* own = &values[i * width];
      double* to = &change[i * width];
      for (std::size_t k = first_[i]; k < first_[i + 1]; ++k) {
        const double* other = &values[neighbours_[k].cell * width];
        for (std::size_t c = 0; c < width; ++c) to[c] += neighbours_[k].share * (other[c] - own[c]);
      }
    }
  });
}

}  // namespace dim
