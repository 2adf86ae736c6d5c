#pragma once

#include <vector>

#include "photometry/photometry.hpp"

namespace dim {

/// A distribution as a file lists it: only the planes that its symmetry needs, angles in degrees.
struct FilePlanes {
  std::vector<double> horizontal_deg;  ///< C, or H
  std::vector<double> vertical_deg;    ///< gamma, or V
  std::vector<double> intensity_cd;    ///< [n_horizontal * n_vertical], vertical fastest
};

/// The reverse of `expand` and `expand_about_aim`: every intensity is one of the distribution's own.
/// Angles are rounded to 1e-9 degrees.
FilePlanes file_planes(const IntensityDistribution& distribution, Symmetry symmetry);

}  // namespace dim
