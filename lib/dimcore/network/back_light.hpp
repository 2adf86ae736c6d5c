#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "base/error.hpp"
#include "hemisphere/patches.hpp"
#include "network/cells.hpp"

namespace dim {

/// Gathers what the backs of surfaces swallow of the light that the zone's bounding surfaces send out, all of them
/// alike bright. Boxes and panels may stand outside the zone and send nothing that counts.
class BackLight {
 public:
  BackLight(const Zone& zone, const Cells& cells, const PatchGrid& patches);

  /// A ray of a cell met the back of a surface. From any thread: the sums are whole numbers, in any order the same.
  void add(std::size_t cell, std::size_t patch, std::size_t surface);

  /// [n_surfaces] shares of the light sent out.
  std::vector<double> shares() const;

 private:
  const Zone& zone_;
  const Cells& cells_;
  const PatchGrid& patches_;
  double per_m2_;
  std::vector<std::atomic<std::uint64_t>> sums_;
};

/// One warning that names the one-sided surfaces whose backs are seen from inside the zone, with what they swallow.
Warnings back_warnings(const std::vector<double>& back_share, const Zone& zone);

}  // namespace dim
