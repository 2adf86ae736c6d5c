#include "photometry/angle_grid.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace dim {
namespace {

constexpr std::size_t kMaxBuckets = 4096;

void check_ascending(const std::vector<double>& nodes) {
  if (nodes.size() < 2) throw InternalError("angle grid: fewer than two angles");
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (!std::isfinite(nodes[i]) || (i > 0 && nodes[i] <= nodes[i - 1]))
      throw InternalError("angle grid: angles are not strictly ascending");
}

}  // namespace

AngleGrid::AngleGrid(std::vector<double> nodes_rad) : nodes_(std::move(nodes_rad)) {
  check_ascending(nodes_);
  front_ = nodes_.front();
  back_ = nodes_.back();
  const double span = back_ - front_;
  const std::size_t n_intervals = nodes_.size() - 1;
  double least = span;
  double greatest = 0.0;
  for (std::size_t i = 0; i < n_intervals; ++i) {
    const double width = nodes_[i + 1] - nodes_[i];
    least = std::min(least, width);
    greatest = std::max(greatest, width);
    inverse_width_.push_back(1.0 / width);
  }
  const bool even = greatest - least <= 1e-12 * span;
  const double wanted = std::ceil(span / least);
  const std::size_t n_buckets =
      even ? n_intervals
           : static_cast<std::size_t>(std::clamp(wanted, 1.0, static_cast<double>(kMaxBuckets)));
  inverse_bucket_ = static_cast<double>(n_buckets) / span;
  last_bucket_ = static_cast<int>(n_buckets) - 1;
  if (even) return;
  bucket_.resize(n_buckets);
  std::size_t interval = 0;
  for (std::size_t b = 0; b < n_buckets; ++b) {
    const double start = front_ + static_cast<double>(b) / inverse_bucket_;
    while (interval + 1 < n_intervals && start >= nodes_[interval + 1]) ++interval;
    bucket_[b] = interval;
  }
}

}  // namespace dim
