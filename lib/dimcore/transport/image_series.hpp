#pragma once

#include <span>

namespace dim {

/// What the images of a luminaire deeper than those made would bring to a point.
struct ImageTail {
  double lx = 0.0;            ///< to be added; 0 where there are too few orders to tell
  double uncertain_lx = 0.0;  ///< how far off that can be
};

/// Continues the sums of images in one mirror, two, three ... mirrors.
///
/// Orders fall as F^n n^-a: each mirror leaves the share F, distance the rest. The exponent a follows from
/// the last two of three blocks of orders (blocks, because sums alternate between mirrors). The ends of what
/// can be are a geometric series with the blocks' own ratio, which is too steep, and one with F alone, which
/// is too flat; where the first block agrees with the law of the others, less is uncertain.
///
/// @param by_order     sums of order 1, 2, ..., >= 0
/// @param reflectance  F, 0..1: the largest share that one mirror left, of the latest images
ImageTail tail_of_images(std::span<const double> by_order, double reflectance);

}  // namespace dim
