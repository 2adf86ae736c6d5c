#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "base/vec.hpp"

namespace dim {

/// A box along the axes; empty until something is added.
struct Box3 {
  Vec3 low{std::numeric_limits<double>::max()};
  Vec3 high{std::numeric_limits<double>::lowest()};

  void add(const Vec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
  void add(const Box3& box) { low = glm::min(low, box.low), high = glm::max(high, box.high); }
  Box3 widened(double by) const { return {low - by, high + by}; }
  bool meets(const Box3& o) const {
    return low.x <= o.high.x && o.low.x <= high.x && low.y <= o.high.y && o.low.y <= high.y &&
           low.z <= o.high.z && o.low.z <= high.z;
  }
};

/// Finds which of many boxes meet a given one: a binary tree, halved at the middle box along the longest
/// axis.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box3> boxes);

  /// Calls f(index) for every box that meets `box`, in an order that depends on the boxes only.
  template <class Function>
  void for_meeting(const Box3& box, Function&& f) const {
    if (!order_.empty()) visit(0, order_.size(), 1, box, f);
  }

 private:
  static constexpr std::size_t kLeaf = 4;

  void build(std::size_t first, std::size_t last, std::size_t node);

  template <class Function>
  void visit(std::size_t first, std::size_t last, std::size_t node, const Box3& box, Function& f) const {
    if (!nodes_[node].meets(box)) return;
    if (last - first <= kLeaf) {
      for (std::size_t k = first; k < last; ++k)
        if (boxes_[order_[k]].meets(box)) f(static_cast<std::size_t>(order_[k]));
      return;
    }
    const std::size_t middle = (first + last) / 2;
    visit(first, middle, 2 * node, box, f);
    visit(middle, last, 2 * node + 1, box, f);
  }

  std::vector<Box3> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Box3> nodes_;  // the root is 1, children of n are 2n and 2n + 1
};

}  // namespace dim
