#pragma once

#include <vector>

#include "base/error.hpp"
#include "scene/surface_cut.hpp"

/// Surfaces of one plane, facing the same way, that claim the same place: one of them lies on top.
namespace dim {

struct SurfaceOverlap {
  std::size_t below = 0;
  std::size_t on_top = 0;
};

/// All such pairs. The smaller surface lies on top, of two alike the later one; a feature counts as smaller
/// than what it was cut out of. Sizes are those before anything is cut, so that any number of overlaps have
/// one order.
/// @param whole  surfaces before features were cut out of their parents
/// @param cut    the same, cut: what a feature covers anyway is no overlap
/// @param warnings  added to: one line for overlapping [[surface]]s, one for faces of boxes and panels that
/// lie in a surface, with the first places and what lies on top
std::vector<SurfaceOverlap> find_overlaps(const std::vector<Surface>& whole, const std::vector<Surface>& cut,
                                          const std::vector<SurfaceLink>& links, double touch_m,
                                          Warnings& warnings);

/// Takes what lies on top out of what lies below it. Where one of the two is a panel, its back lies against
/// the other from behind and loses what they share. What is covered wholly keeps an empty polygon.
/// @param whole  as above: nothing that is itself cut leaves a gap
void cut_overlaps(std::vector<Surface>& surfaces, const std::vector<Surface>& whole,
                  const std::vector<SurfaceOverlap>& overlaps, double touch_m);

/// Those between bounding surfaces alone: they shape the shell.
std::vector<SurfaceOverlap> of_bounding(const std::vector<SurfaceOverlap>& overlaps,
                                        const std::vector<Surface>& surfaces);

}  // namespace dim
