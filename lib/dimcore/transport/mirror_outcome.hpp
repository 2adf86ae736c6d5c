#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dim {

/// What luminaires' images in mirrors, and rays on from the last of them, came to.
struct MirrorOutcome {
  std::vector<int> depth;     ///< [n_luminaires] mirrors one after the other that cells have images in; empty: none
  std::size_t n_images = 0;   ///< for cells and for points
  std::size_t n_rays = 0;     ///< followed from the last images on,
  double rays_share = 0.0;    ///< with this share of the light of the source of which most was
  double rays_cut_off = 0.0;  ///< share of the light that rays collect which had met too many mirrors to go on
  double uncertain = 0.0;     ///< how far images not made can take a point, see `DirectColumns`

  int deepest() const { return depth.empty() ? 0 : *std::max_element(depth.begin(), depth.end()); }
};

}  // namespace dim
