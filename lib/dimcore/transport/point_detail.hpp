#pragma once

#include <vector>

#include "geometry/ray_caster.hpp"
#include "network/network.hpp"

namespace dim {

/// Further rays of measuring points, where neighbouring rays of the network bring so different light that the edge
/// between them matters: a small bright patch, what is seen past an obstruction, the corner beside a point.
///
/// Such patches are cut into quarters, with a ray each, again and again, until what one part may be wrong by is small
/// beside the point's light. Which patches these are depends on a column's own light alone, so that no column changes
/// another.
class PointDetail {
 public:
  /// All must outlive the object. @param caster  of the zone's plates
  /// @param tolerance  of the solution: what one part changes of a point's light is not looked at below a tenth of it
  PointDetail(const Zone& zone, const Cells& cells, const Network& network, const RayCaster& caster, double tolerance)
      : zone_(zone), cells_(cells), network_(network), caster_(caster), tolerance_(tolerance) {}

  /// What the further rays change, [n_points, width]: of the light of all rays, and of that of every other ray less all
  /// (`Propagation::to_points_by_half`), in which the finest parts stand for the patches that are cut.
  struct Changes {
    std::vector<double> of_all, of_half;
  };

  /// @param exitance  [n_cells + 1, width], the last row zero
  /// @param light     [n_points, width] what the points have without further rays, lx as exitances are: direct light too
  /// @param wanted    [width] columns to be looked at; of the others nothing changes
  Changes changes(const std::vector<double>& exitance, const std::vector<double>& light,
                  const std::vector<bool>& wanted) const;

 private:
  const Zone& zone_;
  const Cells& cells_;
  const Network& network_;
  const RayCaster& caster_;
  double tolerance_;
};

}  // namespace dim
