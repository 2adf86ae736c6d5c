#pragma once

#include <string>
#include <vector>

#include "light/pair_integrator.hpp"
#include "transport/optics.hpp"
#include "transport/room.hpp"
#include "transport/source.hpp"

namespace dim {

/// What will be solved, and what is left out because the scene does not require it: made before anything is
/// calculated, then obeyed. Each saving can be turned off (see `SimulationOptions`); the answer stays.
/// physics.md section 7.
struct ModelPlan {
  ReflectanceClasses classes;  ///< bands in which every finish reflects alike are solved once
  std::vector<Source> sources;
  std::vector<std::size_t> source_of;  ///< [n_luminaires] the source that each is part of
  std::vector<Shininess> of_surface;   ///< [n_surfaces] how much of the reflection model each needs
  PatchGrid lobe_grid;                 ///< of light by direction
  bool has_mirrors = false;
  bool tests_visibility = true;        ///< something can stand in light's way
  int shadow_lines = 128;              ///< see `PairOptions`; more for a smaller tolerance

  /// As it is told: finishes of surfaces by class, and counts.
  std::vector<std::string> diffusing, off_specular, mirrors;
  std::vector<std::string> without_spectrum;  ///< fittings that count as equal-energy white
  std::size_t n_luminaires = 0, n_spectra = 0;
  std::size_t n_off_specular_cells = 0;
  std::size_t n_black_cells = 0;               ///< reflect nothing: nothing is sent from them
  std::size_t n_bodies = 0, n_body_cells = 0;  ///< of luminaires, among the zone's surfaces
  std::size_t bytes_per_sink = 2;
  std::vector<std::string> daylight;  ///< what is modelled of the outside, in words; empty without it

  std::size_t n_sources() const { return sources.size(); }
  std::size_t n_classes() const { return classes.size(); }
  /// Columns that are solved: column = class * n_sources + source.
  std::size_t n_columns() const { return n_sources() * n_classes(); }
  /// Columns of direct light: where no mirror colours it every class has the same.
  std::size_t n_direct_columns() const { return has_mirrors ? n_columns() : n_sources(); }
  std::size_t column(std::size_t source, std::size_t klass) const { return klass * n_sources() + source; }
  PairOptions pairs() const { return {.shadow_lines = shadow_lines, .in_the_way = tests_visibility}; }
};

/// Whether no surface can come between two points of the zone, luminaires included: closed, bounding surfaces
/// only, none with a corner behind another's plane, no body of a luminaire, no luminaire outside.
bool is_convex_and_empty(const Zone& zone, const Lights& lights);

/// @throws InputError  diffuse reflectance >= 1
ModelPlan make_plan(const Room& room, const SimulationOptions& options);

}  // namespace dim
