#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "network/cells.hpp"
#include "network/network.hpp"
#include "transport/cell_sums.hpp"
#include "transport/shine.hpp"
#include "transport/shine_state.hpp"

namespace dim {

/// Diffuse reflectances of the problem's columns. Columns of one class are neighbours.
struct Reflectances {
  std::size_t n_classes = 1;
  std::vector<double> of_surface;            ///< [n_surfaces, n_classes], each in [0, 1)
  std::vector<std::size_t> class_of_column;  ///< [n_columns]

  std::size_t n_columns() const { return class_of_column.size(); }
};

/// Shiny surfaces of the problem.
struct GatherShine {
  const Shine& shine;
  const Zone& zone;
  const DirectShine& direct;
};

/// One reflection of a block of columns: from irradiances of cells to what all cells send to each.
///
/// Arrays of the block are [n_cells, width] with `width` the block's columns rounded up to a multiple of
/// eight; those beyond its own stay zero.
class Propagation {
 public:
  /// @param first, n  columns of the problem, at most kMaxColumns
  /// @param shine     null where every surface is diffusing
  Propagation(const Network& network, const Cells& cells, const Reflectances& reflectances, std::size_t first,
              std::size_t n, const GatherShine* shine);

  std::size_t n_columns() const { return n_; }
  std::size_t width() const { return width_; }
  const Network& network() const { return network_; }
  const CellSums& sums() const { return sums_; }
  double area_m2(std::size_t cell) const { return area_m2_[cell]; }
  /// [width]
  const double* reflectance(std::size_t cell) const { return &rho_[surface_[cell] * width_]; }
  /// [n_cells]; [n_surfaces, width]
  const std::vector<std::uint32_t>& surfaces() const { return surface_; }
  const std::vector<double>& reflectances() const { return rho_; }
  ShineState* shine() { return shine_ ? &*shine_ : nullptr; }
  bool has_mirrors() const { return has_mirrors_; }
  bool has_lobes() const { return has_lobes_; }

  /// What cells of these irradiances send by diffuse reflection: rho * irradiance with the network's column
  /// scales, [n_cells + 1, width]. Stays until the next call of a function that is not const.
  const std::vector<double>& emit(const std::vector<double>& irradiance);

  /// What arrives at each cell: along the network's rows, by mirrors and from lobes as they are now.
  void reflect(const std::vector<double>& irradiance, std::vector<double>& arriving);

  /// What arrives, before row scales, of exitances [n_cells + 1, width] that hold the column scales; lobes as
  /// they are now are added.
  void send(const std::vector<float>& exitance, std::vector<double>& arriving);

  /// What measuring points receive. [n_points, width]
  std::vector<double> to_points(const std::vector<double>& irradiance);
  /// The same along every other ray of the points alone, less what all rays bring.
  std::vector<double> to_points_by_half(const std::vector<double>& irradiance);
  /// What arrives at each cell along every other of its rays alone; by mirrors and from lobes as always.
  void reflect_by_half(const std::vector<double>& irradiance, std::vector<double>& arriving);

 private:
  void send(std::vector<double>& arriving);
  void scale_rows(std::vector<double>& arriving) const;
  void emit_to_points(const std::vector<double>& irradiance);
  std::vector<double> along(const SinkTable& sinks, const PatchGrid& patches) const;

  const Network& network_;
  std::size_t n_, width_;
  CellSums sums_;
  std::vector<double> area_m2_;
  std::vector<std::uint32_t> surface_;
  std::vector<double> rho_;       // [n_surfaces, width]
  std::vector<double> exitance_;  // [n_cells + 1, width]
  std::optional<ShineState> shine_;
  bool has_mirrors_ = false, has_lobes_ = false;
};

}  // namespace dim
