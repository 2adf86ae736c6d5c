#pragma once

#include "network/network.hpp"

namespace dim {

/// The paper's family members: every cell that cell i sees but none of i's rays ends on is back-projected to
/// i's hemisphere and joins the ray of the patch it falls in. That patch's flux is shared over sink and
/// family in proportion to area, so that all of them receive the same illuminance from it and flux is
/// conserved.
///
/// Seeing is judged between cell centroids. A ray that ends nowhere takes no family. Work grows with the
/// square of the number of cells.
ExtraLinks find_families(const Zone& zone, const Cells& cells, const Network& network, const Job& job);

/// The extra links of a row in their order, with the patches that they belong to: for light by direction.
struct FamilyLink {
  std::uint32_t patch;
  std::uint32_t cell;
  double weight;  ///< share of the hemisphere; negative: taken back from the patch's sink
};
std::vector<FamilyLink> family_links(const Zone& zone, const Cells& cells, const Network& network,
                                     std::size_t row);

}  // namespace dim
