#pragma once

#include <string>
#include <vector>

#include "base/vec.hpp"

namespace dim {

/// Coordinates as text: the nearest multiple of a step, with as few digits as that takes.
class ZoneNumbers {
 public:
  /// @param single_precision_m  size of a model whose coordinates are single-precision numbers: the step is
  /// the power of
  ///                            ten above their spacing there; 0: a nanometre
  explicit ZoneNumbers(double single_precision_m);

  std::string values(const Vec3& p) const;  ///< "1, 2, 3"
  std::string point(const Vec3& p) const { return "[" + values(p) + "]"; }

 private:
  double per_m_ = 1e9;
};

/// "'a', 'b', 'c' and 7 more", the first 8 in full, each once.
std::string list_of(const std::vector<std::string>& names);

}  // namespace dim
