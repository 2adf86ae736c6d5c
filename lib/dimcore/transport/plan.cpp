#include "transport/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/corner_behind.hpp"
#include "transport/auto_bands.hpp"

namespace dim {
namespace {

void check_finishes(const Zone& zone, const Bands& bands, const ReflectanceClasses& classes) {
  Problems problems;
  for (std::size_t f = 0; f < zone.finishes.size(); ++f) {
    const auto& finish = zone.finishes[f];
    for (std::size_t b = 0; b < bands.size(); ++b) {
      const double rho = classes.at(classes.of_band[b], static_cast<int>(f)).diffuse;
      if (!(rho < 1.0))
        problems.add(
            {},
            fmt::format("finish '{}': reflectance {} at {:.0f}-{:.0f} nm; inter-reflection needs less "
                        "than 1",
                        finish.name, rho, bands.low_nm(b), bands.high_nm(b)),
            "a real surface absorbs something: write for example 0.99");
    }
  }
  problems.throw_if_any();
}

// As many as keep the error along the edges of shadows near the request: it falls a little faster than the
// number of lines rises, from 0.3 % rms of the unobstructed light at 128.
int shadow_lines(double tolerance) {
  constexpr double kLeast = 16.0, kMost = 1024.0, kUsual = 128.0;
  return static_cast<int>(std::clamp(kUsual * GatherOptions{}.tolerance / tolerance, kLeast, kMost));
}

// The finishes of surfaces, by how they shine, each named once.
void name_finishes(ModelPlan& plan, const Zone& zone) {
  std::vector<bool> named(zone.finishes.size(), false);
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
    const auto finish = static_cast<std::size_t>(zone.surfaces[s].finish);
    if (named[finish] || zone.surfaces[s].outside) continue;
    named[finish] = true;
    auto& list = plan.of_surface[s] == Shininess::diffusing
                     ? plan.diffusing
                     : (plan.of_surface[s] == Shininess::mirror ? plan.mirrors : plan.off_specular);
    list.push_back(zone.finishes[finish].name);
  }
}

void count_spectra(ModelPlan& plan, const Lights& lights) {
  std::vector<const SpectralCurve*> spectra;
  for (const auto& fitting : lights.fittings) {
    if (!fitting.has_spectrum) plan.without_spectrum.push_back(fitting.name);
    if (std::none_of(spectra.begin(), spectra.end(), [&](const SpectralCurve* known) {
          return known->points() == fitting.spectrum.points();
        }))
      spectra.push_back(&fitting.spectrum);
  }
  plan.n_spectra = spectra.size();
}

void count_cells(ModelPlan& plan, const Room& room) {
  for (std::size_t i = 0; i < room.cells.size(); ++i) {
    const Shininess kind = plan.of_surface[room.cells.surface_of(i)];
    plan.n_off_specular_cells += kind == Shininess::off_specular;
    bool black = kind == Shininess::diffusing;
    for (std::size_t q = 0; q < plan.n_classes() && black; ++q)
      black = plan.classes.at(q, room.surface_of(i).finish).diffuse == 0.0;
    plan.n_black_cells += black;
  }
}

}  // namespace

bool is_convex_and_empty(const Zone& zone, const Lights& lights) {
  if (!zone.closed) return false;
  const double tolerance_m = 1e-9 * zone.diameter_m;
  for (const auto& surface : zone.surfaces) {
    const Frame& frame = surface.polygon.frame();
    const bool shell = surface.bounding || surface.parent >= 0;
    if (!shell || surface.outside || any_corner_behind(zone, frame, tolerance_m)) return false;
    const auto outside = [&](const Luminaire& luminaire) {
      const double reach_m = std::abs(glm::dot(luminaire.c0, frame.n)) * luminaire.opening.length_m / 2.0 +
                             std::abs(glm::dot(luminaire.c90, frame.n)) * luminaire.opening.width_m / 2.0 +
                             std::abs(glm::dot(luminaire.aim, frame.n)) * luminaire.opening.height_m / 2.0;
      return luminaire.body || frame.height(luminaire.at) < reach_m - tolerance_m;
    };
    const auto beyond = [&](const MeasuringPoint& point) {
      return frame.height(point.position) < -tolerance_m;
    };
    if (std::any_of(lights.luminaires.begin(), lights.luminaires.end(), outside) ||
        std::any_of(zone.points.begin(), zone.points.end(), beyond))
      return false;
  }
  return true;
}

ModelPlan make_plan(const Room& room, const SimulationOptions& options) {
  ModelPlan plan;
  const LampSpectra lamps = lamp_spectra(room.lights);
  const LatticeValues seen = luminous_weights(lamps.spectra, lamps.flux_lm);
  plan.classes = classify(room.zone, options.bands, options.solve_every_band, &seen);
  check_finishes(room.zone, options.bands, plan.classes);
  auto combined = combine(room.lights, options.bands, options.combine);
  plan.sources = std::move(combined.sources);
  plan.source_of = std::move(combined.of_luminaire);
  plan.lobe_grid = lobe_grid(room.network.patches);
  plan.of_surface = shininess_of_surfaces(room.zone, plan.classes, plan.lobe_grid);
  plan.has_mirrors = std::count(plan.of_surface.begin(), plan.of_surface.end(), Shininess::mirror) > 0;
  plan.tests_visibility = options.always_test_visibility || !is_convex_and_empty(room.zone, room.lights);
  plan.shadow_lines = shadow_lines(options.gather.tolerance);
  name_finishes(plan, room.zone);
  count_spectra(plan, room.lights);
  count_cells(plan, room);
  plan.n_luminaires = room.n_luminaires();
  plan.n_bodies = room.n_bodies;
  plan.n_body_cells = room.cells.size() - room.n_zone_cells;
  plan.bytes_per_sink = room.network.sinks.wide() ? 4 : 2;
  return plan;
}

}  // namespace dim
