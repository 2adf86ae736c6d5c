#pragma once

#include <vector>

#include "scene/inside_test.hpp"
#include "scene/surface_cut.hpp"

/// Boxes and panels that go through the zone's shell end at it: what lies outside is cut off.
namespace dim {

/// The surfaces of one solid: six faces of a box, or one panel (its back is its twin).
struct BodyFaces {
  std::size_t first = 0;
  std::size_t n = 1;
};

struct ShellCut {
  BodyFaces body;
  std::size_t wall = 0;  ///< the bounding surface that it goes through
};

/// Where a body goes through a bounding surface within that surface's outline, and all of it behind lies
/// outside the zone. Nothing where it cannot be cut so: through an edge of the room, or into another part of it.
/// @param surfaces  whole still: no feature cut out
/// @param extremes  points of the body, a little within its outline
std::vector<ShellCut> find_shell_cuts(const std::vector<Surface>& surfaces, const BodyFaces& body,
                                      const std::vector<Vec3>& extremes, const InsideTest& test, double touch_m);

/// Cuts bodies and the features on them off behind the walls. A box is closed by a face against the wall,
/// which `remove_contacts` then takes out of both.
/// @param surfaces  to be cut; a face may be added at the end
/// @param whole     the same before features were cut out
void cut_at_shell(std::vector<Surface>& surfaces, std::vector<SurfaceLink>& links, const std::vector<Surface>& whole,
                  const std::vector<ShellCut>& cuts, double touch_m);

}  // namespace dim
