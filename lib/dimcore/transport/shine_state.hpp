#pragma once

#include <vector>

#include "network/cells.hpp"
#include "network/network.hpp"
#include "transport/shine.hpp"

namespace dim {

/// What direct light does at shiny cells, for all columns.
struct DirectShine {
  std::vector<float> psi;  ///< [n_states, n_columns] flux by lobes into patches, per area
  std::vector<double>
      point_lobe;  ///< [n_points, n_columns] from lobes seen without a mirror between, exact angles
  std::vector<double> mirrored;      ///< [n_columns] flux that mirrors reflect and images bring
  std::vector<double> escaped;       ///< [n_columns] of that, what leaves the zone
  std::vector<double> not_followed;  ///< [n_columns] flux that mirrors reflect beyond the last image
};

/// The light by direction of a block of columns while it is being gathered.
class ShineState {
 public:
  /// @param first, n  columns of the whole problem that the block holds; @param width  of its arrays, >= n
  ShineState(const Shine& shine, const Zone& zone, const Network& network, const Cells& cells,
             const DirectShine& direct, const std::vector<std::size_t>& class_of_column,
             std::size_t n_columns, std::size_t first, std::size_t n, std::size_t width);

  /// Adds what mirrors and lobes bring to the gathered irradiances of cells. [n_cells, width]
  /// @param exitance  [n_cells + 1, width], column scales included
  void add_to_cells(const std::vector<double>& exitance, std::vector<double>& gathered) const;
  /// The same for measuring points. [n_points, width]
  void add_to_points(const std::vector<double>& exitance, std::vector<double>& sums) const;

  /// New lobes from what comes in now. @returns the sum of absolute changes of the flux that cells reflect into
  /// each patch, by column
  std::vector<double> reflect(const std::vector<double>& exitance);

  /// Flux of each column that lobes and mirrors take up again, that leaves the zone, and of the last change.
  struct Power {
    std::vector<double> reflected, escaped, in_flight;
  };
  Power power(const std::vector<double>& exitance) const;

  /// Largest share that a surface's lobe reflects of light from any patch; 0 for others, mirrors too (which
  /// hold no light).
  double largest_albedo(std::size_t surface, std::size_t column) const;

  /// [n_states, n_columns] of the whole problem, those of this block's columns written that are wanted.
  void copy_psi(std::vector<float>& psi, const std::vector<bool>& wanted) const;
  void set_psi(const std::vector<float>& psi);

 private:
  void incoming(std::size_t cell, const std::vector<double>& exitance, std::vector<double>& phi) const;
  template <class F>
  void for_off_specular(F&& f) const;

  const Shine& shine_;
  const Zone& zone_;
  const Network& network_;
  const Cells& cells_;
  const DirectShine& direct_;
  std::vector<std::size_t> class_;  // of each column of the block
  std::size_t n_columns_, first_, n_, width_;
  std::vector<double> psi_, change_;  // [n_states, width]; [n_off_specular, width] of the last round
};

}  // namespace dim
