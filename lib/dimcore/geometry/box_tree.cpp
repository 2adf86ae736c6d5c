#include "geometry/box_tree.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

namespace dim {

BoxTree::BoxTree(std::vector<Box3> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), std::uint32_t{0});
  if (order_.empty()) return;
  nodes_.resize(2 * std::bit_ceil(order_.size()));
  build(0, order_.size(), 1);
}

void BoxTree::build(std::size_t first, std::size_t last, std::size_t node) {
  Box3 all;
  for (std::size_t k = first; k < last; ++k) all.add(boxes_[order_[k]]);
  nodes_[node] = all;
  if (last - first <= kLeaf) return;
  const Vec3 size = all.high - all.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::size_t middle = (first + last) / 2;
  const auto at = [this](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
  const auto place = [&](std::uint32_t i) { return boxes_[i].low[axis] + boxes_[i].high[axis]; };
  std::nth_element(at(first), at(middle), at(last), [&](std::uint32_t i, std::uint32_t j) {
    return place(i) != place(j) ? place(i) < place(j) : i < j;
  });
  build(first, middle, 2 * node);
  build(middle, last, 2 * node + 1);
}

}  // namespace dim
