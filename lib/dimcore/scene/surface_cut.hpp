#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "scene/zone.hpp"

/// What surfaces in one plane that are meant to share it do to each other: features are cut out of their
/// parents, faces that touch back to back lose what they share. See surface_overlap for those that are not.
namespace dim {

/// What the file said of a surface beyond the model: its parent's name and whether it is a face of a box.
struct SurfaceLink {
  std::string on;
  Place on_place;
  bool of_box = false;
};

/// Distance below which two faces count as touching, metres: 1e-6 of the zone without its external
/// obstructions.
double touch_tolerance_m(const std::vector<Surface>& surfaces);

/// Whether `descendant` was cut, in however many steps, out of `ancestor`. A surface may be found to be its
/// own.
bool is_ancestor(const std::vector<Surface>& surfaces, std::size_t ancestor, std::size_t descendant);

/// Finds each feature's parent, and checks that the feature lies in the parent's plane, faces the same way
/// and stays within its outline. Features inherit `bounding` and `outside` from the parent.
/// @param links  one for each surface
void join_features(std::vector<Surface>& surfaces, const std::vector<SurfaceLink>& links, double touch_m,
                   Problems& problems);

/// Cuts every feature out of its parent. A parent covered wholly keeps an empty polygon (area 0) until
/// `remove_contacts` takes it out.
void cut_features(std::vector<Surface>& surfaces, double touch_m);

/// Takes the common area of faces that touch back to back away from both, then surfaces without area out of
/// the list. Two [[surface]] of the same outline back to back are a thin partition: kept, as each other's
/// twins. Where two [[surface]] touch in part, a warning says so, because a partition is written `sides = 2`.
/// Sets `fills_rectangle`.
void remove_contacts(std::vector<Surface>& surfaces, const std::vector<SurfaceLink>& links, double touch_m,
                     Warnings& warnings);

}  // namespace dim
