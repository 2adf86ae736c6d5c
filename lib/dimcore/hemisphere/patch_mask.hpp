#pragma once

#include <cstddef>
#include <vector>

#include "hemisphere/patches.hpp"

namespace dim {

/// Patches of a hemisphere that may hold directions within some cones.
class PatchMask {
 public:
  explicit PatchMask(const PatchGrid& grid) : grid_(grid), marked_(grid.n_patches(), 0) {}

  void clear() {
    std::fill(marked_.begin(), marked_.end(), char{0});
    any_ = false;
  }
  /// Marks every patch with a direction that differs from that of `middle` by at most asin(reach / |middle|);
  /// all patches where reach is at least |middle|. A few neighbours may be marked as well.
  /// @param middle  in the hemisphere's frame (z = normal), of any length
  /// @param reach   >= 0, in the unit of `middle`
  void mark_cone(const Vec3& middle, double reach);

  bool any() const { return any_; }
  bool operator[](std::size_t patch) const { return marked_[patch] != 0; }

 private:
  PatchGrid grid_;
  std::vector<char> marked_;
  bool any_ = false;
};

}  // namespace dim
