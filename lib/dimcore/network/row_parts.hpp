#pragma once

#include <vector>

#include "network/family.hpp"
#include "network/ray_pattern.hpp"

namespace dim {

/// A row of a network taken apart: every ray's end with its share of the hemisphere, and with families their
/// members, each with the share that is theirs. The shares add up to 1.
class RowParts {
 public:
  struct Part {
    std::uint32_t patch;
    std::uint32_t cell;  ///< n_cells: nowhere
    double share;
    bool member;  ///< joined by the family: no ray of its own
  };

  /// Of a cell.
  RowParts(const Zone& zone, const Cells& cells, const Network& network, std::size_t cell);
  /// Of a measuring point.
  RowParts(const Zone& zone, const Network& network, std::size_t point);

  const std::vector<Part>& parts() const { return parts_; }
  /// The ray to a part; to a member, from middle to middle.
  Ray ray(const Part& part) const;

 private:
  void add_rays(const PatchGrid& patches, const SinkTable& sinks, std::size_t row);

  const Zone& zone_;
  const Cells* cells_ = nullptr;
  const PatchGrid& patches_;
  RowRays rays_;
  Vec3 middle_{0.0};
  std::vector<Part> parts_;
};

}  // namespace dim
