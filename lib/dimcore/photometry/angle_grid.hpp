#pragma once

#include <cstddef>
#include <vector>

namespace dim {

/// Ascending angles with a fast way from an angle to its interval: by one multiplication where the angles are
/// evenly spaced, else through a table of buckets.
class AngleGrid {
 public:
  struct Spot {
    std::size_t index;  ///< interval: nodes index and index + 1
    double fraction;    ///< 0 at the lower node, 1 at the upper
  };

  AngleGrid() = default;
  /// @param nodes_rad  at least two angles, strictly ascending, finite
  /// @throws InternalError otherwise
  explicit AngleGrid(std::vector<double> nodes_rad);

  const std::vector<double>& nodes_rad() const { return nodes_; }
  std::size_t n_nodes() const { return nodes_.size(); }
  double front_rad() const { return front_; }
  double back_rad() const { return back_; }
  bool contains(double angle_rad) const { return angle_rad >= front_ && angle_rad <= back_; }
  bool uniform() const { return bucket_.empty(); }

  /// @param angle_rad  within front..back, rounding errors aside
  Spot locate(double angle_rad) const {
    const double along = (angle_rad - front_) * inverse_bucket_;
    // By way of int: converting to an unsigned long takes a branch.
    const int cut = static_cast<int>(along);
    const int i = cut < last_bucket_ ? cut : last_bucket_;
    if (bucket_.empty()) return {static_cast<std::size_t>(i), along - i};
    return locate_from(bucket_[static_cast<std::size_t>(i)], angle_rad);
  }

 private:
  // A bucket may hold several nodes, and rounding may leave the guess one node off.
  Spot locate_from(std::size_t i, double angle_rad) const {
    while (i + 2 < nodes_.size() && angle_rad >= nodes_[i + 1]) ++i;
    while (i > 0 && angle_rad < nodes_[i]) --i;
    return {i, (angle_rad - nodes_[i]) * inverse_width_[i]};
  }

  std::vector<double> nodes_;
  std::vector<double> inverse_width_;  // [n_nodes - 1]
  std::vector<std::size_t> bucket_;    // interval at each bucket's start; empty where uniform
  double front_ = 0.0;
  double back_ = 0.0;
  double inverse_bucket_ = 0.0;
  int last_bucket_ = 0;
};

}  // namespace dim
