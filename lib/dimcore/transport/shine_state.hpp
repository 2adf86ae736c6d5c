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
  /// @param first, n  columns of the whole problem that the block holds; @param width  of the arrays that it
  ///                  is given, >= n
  ShineState(const Shine& shine, const Zone& zone, const Network& network, const Cells& cells,
             const DirectShine& direct, const std::vector<std::size_t>& class_of_column,
             std::size_t n_columns, std::size_t first, std::size_t n, std::size_t width);

  /// Adds what mirrors and lobes bring to the gathered irradiances of cells, which are still to be multiplied
  /// with the network's row scale. [n_cells, width]
  /// @param exitance  [n_cells + 1, width], column scales included; the last row zero
  void add_to_cells(const std::vector<double>& exitance, std::vector<double>& gathered) const;
  /// The same for measuring points. [n_points, width]
  /// @param exitance  without column scales
  void add_to_points(const std::vector<double>& exitance, std::vector<double>& sums) const;

  /// Flux per area that comes in through each lobe patch of off-specular cell `g` (index into
  /// Shine::off_specular), direct light left out: all that is gathered there, taken apart by direction.
  /// @param phi  [lobe patches, n] written
  void incoming(std::size_t g, const std::vector<double>& exitance, std::vector<double>& phi) const;

  /// New lobes from what comes in now.
  /// @returns [width] the sum of absolute changes of the flux that cells reflect into each patch
  std::vector<double> reflect(const std::vector<double>& exitance);

  /// Flux of each column, W per W/m2 of exitance.
  struct Power {
    std::vector<double> reflected;  ///< taken up again by lobes and mirrors
    std::vector<double> escaped;    ///< of that, what leaves the zone
    std::vector<double> in_flight;  ///< of that, what has not arrived: the last change, and what is cut off
    std::vector<double> cut;        ///< of that, cut off after many mirrors
  };
  /// After reflect() with the exitances before these.
  Power power(const std::vector<double>& exitance) const;

  /// Largest share that a surface's lobe reflects of light from any patch; 0 for others, mirrors too (which
  /// hold no light).
  double largest_albedo(std::size_t surface, std::size_t column) const;

  /// [n_states, n_columns] of the whole problem, those of this block's columns written that are wanted.
  void copy_psi(std::vector<float>& psi, const std::vector<bool>& wanted) const;
  void set_psi(const std::vector<float>& psi);

 private:
  // Columns of one class, neighbours in every array.
  struct Run {
    std::size_t klass, first, last;
  };

  template <class F>
  void for_seen_in_mirrors(std::size_t receiver, F&& f) const;
  template <class F>
  void for_lobes_by_mirrors(std::size_t receiver, F&& f) const;
  template <class F>
  void for_off_specular(F&& f) const;
  void reflect_cell(std::size_t g, const std::vector<double>& phi, std::vector<double>& scratch,
                    double* change);
  void add_power_of_lobe(std::size_t g, double* reflected, double* escaped, double* change) const;
  void add_power_of_mirrors(const std::vector<double>& exitance, Power& power) const;
  std::vector<double> landed_by_mirrors(const std::vector<double>& exitance,
                                        const std::vector<double>& psi) const;
  const float* direct_psi(std::size_t state) const { return &direct_.psi[state * n_columns_ + first_]; }

  const Shine& shine_;
  const ShineLinks& links_;
  const Zone& zone_;
  const Network& network_;
  const Cells& cells_;
  const DirectShine& direct_;
  std::size_t n_columns_, first_, n_, width_;
  std::vector<Run> runs_;
  std::vector<double> psi_, before_;  // [n_states, n] now, and before the last reflect()
  std::vector<double> landed_;        // [n] by mirrors, of the exitances of the last reflect()
};

}  // namespace dim
