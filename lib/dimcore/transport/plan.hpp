#pragma once

#include <string>
#include <vector>

#include "scene/lights.hpp"
#include "scene/zone.hpp"
#include "transport/direct_columns.hpp"

namespace dim {

/// What the model leaves out because the scene does not require it, physics.md section 7. Each saving can be
/// turned off (see SimulationOptions); the answer stays.
struct ModelPlan {
  std::vector<std::string> diffusing, off_specular, mirrors;  ///< finishes of surfaces, by class
  std::size_t n_luminaires = 0, n_sources = 0, n_spectra = 0;
  std::vector<std::string> without_spectrum;  ///< fittings that count as equal-energy white
  std::size_t n_bands = 0, n_classes = 0;
  std::size_t n_off_specular_cells = 0, n_lobe_patches = 0;
  std::size_t n_bodies = 0, n_body_cells = 0;  ///< of luminaires, among the zone's surfaces
  std::size_t n_images = 0;        ///< of luminaires in mirrors
  int mirror_depth = 0;            ///< most mirrors one after the other that cells have images in
  std::size_t n_mirror_rays = 0;   ///< followed from the last images on,
  double mirror_rays_share = 0.0;  ///< with this share of the light of the source of which most was
  double images_uncertain = 0.0;   ///< how far images not made can take a point, see `DirectColumns`
  double mirror_rays_cut_off =
      0.0;  ///< share of the light rays collect that had met too many mirrors to go on
  bool tests_visibility = true;
  std::size_t bytes_per_sink = 2;
  std::vector<std::string> daylight;  ///< what is modelled of the outside, in words; empty without it
  std::size_t n_black_cells = 0;  ///< reflect nothing: nothing is sent from them
};

/// Whether no surface can come between two points of the zone, luminaires included: closed, bounding surfaces
/// only, none with a corner behind another's plane, no body of a luminaire, no luminaire outside.
bool is_convex_and_empty(const Zone& zone, const Lights& lights);

/// @param in_the_way  whether visibility is tested
ModelPlan make_plan(const Zone& zone, const Cells& cells, const Network& network, const Lights& lights,
                    const ReflectanceClasses& classes, const Shine& shine, std::size_t n_sources,
                    const DirectColumns& direct, bool in_the_way);

}  // namespace dim
