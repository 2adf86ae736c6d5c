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

/// One plane at which a body ends.
struct ShellCut {
  BodyFaces body;
  Frame plane;  ///< of the walls that it goes through; in front of it lies the zone
  Ring3 end;    ///< what closes a box there, counter-clockwise seen from behind
};

/// Whether a bounding surface goes through a body, more than ten times `touch_m` deep.
bool goes_through_shell(const std::vector<Surface>& surfaces, const BodyFaces& body, double touch_m);

/// Where a body is to end at the bounding surfaces that it goes through: one wall, an edge or a corner of the room,
/// or opposite walls. Nothing unless that leaves exactly what lies in the zone: where a wall stands into the body
/// (a corner that points into the room), it goes on into another part of the zone, the wall has a gap there, or no
/// face of it would be seen.
/// @param surfaces  whole still: no feature cut out
std::vector<ShellCut> find_shell_cuts(const std::vector<Surface>& surfaces, const BodyFaces& body,
                                      const InsideTest& test, double touch_m);

/// Cuts bodies and the features on them off behind the walls. A box is closed by a face against each wall,
/// which `remove_contacts` then takes out of both.
/// @param surfaces  to be cut; faces may be added at the end
void cut_at_shell(std::vector<Surface>& surfaces, std::vector<SurfaceLink>& links, const std::vector<ShellCut>& cuts,
                  double touch_m);

}  // namespace dim
