#pragma once

#include <optional>
#include <vector>

#include "photometry/photometry.hpp"

namespace dim {

/// The symmetry that a list of C planes implies, or nothing if it implies none.
///
/// One plane: axial. 0-90: quadrilateral. 0-180 (or 180-360, -180-0): bilateral. 90-270 (or -90-90):
/// bilateral about C90-C270. More than 180 and up to 360 degrees: none.
///
/// @param c_deg  at least one angle, strictly ascending, degrees
std::optional<Symmetry> symmetry_of(const std::vector<double>& c_deg);

/// The whole turn from the planes of a file.
///
/// Reflections follow the symmetry; a turn that stops short of 360 degrees (0-355) is closed by interpolating
/// from its last plane to its first.
///
/// @param c_deg         planes of the file, strictly ascending, degrees
/// @param gamma_deg     strictly ascending within 0..180
/// @param intensity_cd  [n_c * n_gamma], gamma fastest
IntensityDistribution expand(Symmetry symmetry, const std::vector<double>& c_deg,
                             const std::vector<double>& gamma_deg, const std::vector<double>& intensity_cd);

/// The same for types A and B; `h_deg` from 0 upwards means that the half turn below 0 is its reflection.
///
/// @param type          kA or kB
/// @param h_deg, v_deg  strictly ascending, at least two of each
/// @param intensity_cd  [n_h * n_v], V fastest
IntensityDistribution expand_about_aim(PhotometricType type, const std::vector<double>& h_deg,
                                       const std::vector<double>& v_deg,
                                       const std::vector<double>& intensity_cd);

}  // namespace dim
