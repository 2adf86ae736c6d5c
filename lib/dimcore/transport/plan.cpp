#include "transport/plan.hpp"

#include <algorithm>
#include <cmath>

namespace dim {
namespace {

bool any_corner_behind(const Zone& zone, const Frame& frame) {
  const double tolerance_m = 1e-9 * zone.diameter_m;
  return std::any_of(zone.surfaces.begin(), zone.surfaces.end(), [&](const Surface& surface) {
    const auto& ring = surface.polygon.rings().front();
    return std::any_of(ring.begin(), ring.end(), [&](const Vec2& p) {
      return frame.height(surface.polygon.frame().to_world(p)) < -tolerance_m;
    });
  });
}

}  // namespace

bool is_convex_and_empty(const Zone& zone, const Lights& lights) {
  if (!zone.closed) return false;
  const double tolerance_m = 1e-9 * zone.diameter_m;
  for (const auto& surface : zone.surfaces) {
    const Frame& frame = surface.polygon.frame();
    const bool shell = surface.bounding || surface.parent >= 0;
    if (!shell || surface.outside || any_corner_behind(zone, frame)) return false;
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

ModelPlan make_plan(const Zone& zone, const Cells& cells, const Network& network, const Lights& lights,
                    const ReflectanceClasses& classes, const Shine& shine, std::size_t n_sources,
                    const DirectColumns& direct, bool in_the_way) {
  ModelPlan plan;
  std::vector<bool> named(zone.finishes.size(), false);
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
    const auto finish = static_cast<std::size_t>(zone.surfaces[s].finish);
    if (named[finish] || zone.surfaces[s].outside) continue;
    named[finish] = true;
    auto& list = shine.of_surface(s) == Shininess::diffusing
                     ? plan.diffusing
                     : (shine.of_surface(s) == Shininess::mirror ? plan.mirrors : plan.off_specular);
    list.push_back(zone.finishes[finish].name);
  }
  std::vector<const SpectralCurve*> spectra;
  for (const auto& fitting : lights.fittings) {
    if (!fitting.has_spectrum) plan.without_spectrum.push_back(fitting.name);
    if (std::none_of(spectra.begin(), spectra.end(), [&](const SpectralCurve* known) {
          return known->points() == fitting.spectrum.points();
        }))
      spectra.push_back(&fitting.spectrum);
  }
  plan.n_luminaires = lights.luminaires.size();
  plan.n_sources = n_sources;
  plan.n_spectra = spectra.size();
  plan.n_bands = classes.of_band.size();
  plan.n_classes = classes.size();
  plan.n_off_specular_cells = shine.n_off_specular();
  plan.n_lobe_patches = shine.grid().n_patches();
  plan.n_images = direct.n_images;
  for (const int depth : direct.mirror_depth) plan.mirror_depth = std::max(plan.mirror_depth, depth);
  plan.n_mirror_rays = direct.n_rays;
  plan.mirror_rays_share = direct.followed_share;
  for (const double uncertain : direct.uncertain)
    plan.images_uncertain = std::max(plan.images_uncertain, uncertain);
  plan.mirror_rays_cut_off = shine.cut_off();
  plan.tests_visibility = in_the_way;
  plan.bytes_per_sink = network.sinks.wide() ? 4 : 2;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    bool black = shine.of_cell(i) == Shininess::diffusing;
    for (std::size_t q = 0; q < classes.size() && black; ++q)
      black = classes.at(q, zone.surfaces[cells.surface_of(i)].finish).diffuse == 0.0;
    plan.n_black_cells += black;
  }
  return plan;
}

}  // namespace dim
