#include "light/window_flux.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "light/sun_disc.hpp"
#include "network/stream_key.hpp"

namespace dim {
namespace {

// Onto a window before which nothing stands, and onto others.
constexpr std::uint64_t kOpenRays = 1 << 15;
constexpr std::uint64_t kRaysPastEdges = 1 << 17;
constexpr std::uint64_t kSunRays = 1 << 12;
// Into every patch at least, where patches are kept apart, and onto the ground.
constexpr std::uint64_t kLeastRaysOfPatch = 64;
constexpr std::uint64_t kGroundRays = 1 << 12;

}  // namespace

WindowFlux::WindowFlux(const Zone& zone, const Windows& windows, const Panes& panes, const Outside& outside,
                       const RayCaster& caster, const Job& job)
    : zone_(zone), outside_(outside), caster_(caster) {
  const auto& slots = panes.slots();
  const std::size_t n_columns = outside.light().n_columns();
  for (auto* flux : {&flux_lm_, &escaped_lm_, &lost_lm_})
    flux->assign(slots.size(), std::vector<double>(n_columns, 0.0));
  glow_cd_m2_.resize(slots.size());
  tbb::parallel_for(std::size_t{0}, slots.size(), [&](std::size_t s) {
    const auto& members = windows.groups[slots[s].group].windows;
    glow_cd_m2_[s].resize(members.size());
    for (std::size_t k = 0; k < members.size() && !job.stopped(); ++k) {
      const Window& window = windows.windows[members[k]];
      const Pane& pane = slots[s].panes[k];
      const Incident light = incident(window, pane, slots[s].outside_class,
                                      place_key(window.polygon.centroid(), window.frame().n, zone.diameter_m));
      const double area_m2 = window.polygon.area_m2();
      for (std::size_t c = 0; c < n_columns; ++c) {
        escaped_lm_[s][c] += area_m2 * light.passed_lx[escapes][c];
        lost_lm_[s][c] += area_m2 * light.passed_lx[is_lost][c];
        for (const auto& passed : light.passed_lx) flux_lm_[s][c] += area_m2 * passed[c];
      }
      if (!pane.scattering) continue;
      auto& cd_m2 = glow_cd_m2_[s][k] = glow(pane, light);
      const bool evenly = cd_m2.size() == n_columns;
      for (std::size_t out = 0; out < (evenly ? 1 : klems::kPatches); ++out)
        for (std::size_t c = 0; c < n_columns; ++c)
          flux_lm_[s][c] +=
              area_m2 * (evenly ? kPi : klems::projected_solid_angle_sr(out)) * cd_m2[out * n_columns + c];
    }
  });
  job.check();
}

std::vector<double> WindowFlux::glow(const Pane& pane, const Incident& light) const {
  const std::size_t n_columns = outside_.light().n_columns();
  const bool evenly = !pane.scattering->bsdf;
  std::vector<double> cd_m2((evenly ? 1 : klems::kPatches) * n_columns, 0.0);
  for (std::size_t out = 0; out < (evenly ? 1 : klems::kPatches); ++out) {
    for (std::size_t in = 0; in < klems::kPatches; ++in) {
      const double btdf_per_sr = evenly ? pane.diffuse / kPi : pane.scattering->bsdf->btdf_per_sr(out, in);
      if (btdf_per_sr == 0.0) continue;
      for (std::size_t c = 0; c < n_columns; ++c)
        cd_m2[out * n_columns + c] += btdf_per_sr * light.by_patch_lx[in * n_columns + c];
    }
  }
  return cd_m2;
}

WindowFlux::Fate WindowFlux::fate(const Vec3& on_glass, const Vec3& inwards, int plate) const {
  const Hit hit = caster_.nearest(on_glass, inwards, plate);
  if (hit.plate < 0) return escapes;
  if (hit.back) return is_lost;
  const auto surface = static_cast<std::size_t>(hit.plate);
  return surface < zone_.surfaces.size() && zone_.surfaces[surface].outside ? escapes : stays;
}

// Sums paths from outside onto a pane.
class WindowFlux::Gatherer {
 public:
  Gatherer(const Outside& outside, const Pane& pane) : outside_(outside), pane_(pane), n_columns_(outside.light().n_columns()) {
    for (auto& passed : sum_.passed_lx) passed.assign(n_columns_, 0.0);
    for (auto& of_cells : of_cells_) of_cells.assign(outside.n_cells(), 0.0);
    if (!pane.scattering) return;
    sum_.by_patch_lx.assign(klems::kPatches * n_columns_, 0.0);
    of_cells_by_patch_.assign(klems::kPatches * outside.n_cells(), 0.0);
  }

  // @param travel  of the light, in the window's Klems frame; @param lx  at a luminance of 1 cd/m2
  void add(const OutsideSeen& seen, Fate fate, const Vec3& travel, double lx) {
    const std::size_t in = pane_.scattering ? klems::patch_of(travel) : 0;
    const double passed = pane_.straight_at(travel.z) * lx;
    seen.each_column([&](std::size_t c, double cd_m2) {
      sum_.passed_lx[fate][c] += passed * cd_m2;
      if (pane_.scattering) sum_.by_patch_lx[in * n_columns_ + c] += lx * cd_m2;
    });
    if (seen.cell < 0) return;
    const auto j = static_cast<std::size_t>(seen.cell);
    of_cells_[fate][j] += passed;
    if (pane_.scattering) of_cells_by_patch_[in * outside_.n_cells() + j] += lx;
  }

  Incident finish(std::size_t outside_class) {
    for (std::size_t j = 0; j < outside_.n_cells(); ++j) {
      const double* cd_m2 = outside_.luminance_cd_m2(outside_class, j);
      const auto bring = [&](double weight, double* lx) {
        for (std::size_t c = 0; c < n_columns_ && weight > 0.0; ++c) lx[c] += weight * cd_m2[c];
      };
      for (const Fate fate : {stays, escapes, is_lost}) bring(of_cells_[fate][j], sum_.passed_lx[fate].data());
      for (std::size_t in = 0; in < klems::kPatches && pane_.scattering; ++in)
        bring(of_cells_by_patch_[in * outside_.n_cells() + j], &sum_.by_patch_lx[in * n_columns_]);
    }
    return std::move(sum_);
  }

 private:
  const Outside& outside_;
  const Pane& pane_;
  std::size_t n_columns_;
  Incident sum_;
  ByFate of_cells_;
  std::vector<double> of_cells_by_patch_;
};

WindowFlux::Incident WindowFlux::incident(const Window& window, const Pane& pane, std::size_t outside_class,
                                          std::uint64_t stream) const {
  const OutsideLight& light = outside_.light();
  const Frame frame = klems_frame(window);
  Gatherer gatherer(outside_, pane);
  const LowDiscrepancy4 points(mix(stream));
  const std::uint64_t n_rays = window.open_outside ? kOpenRays : kRaysPastEdges;
  const auto add = [&](const Vec3& travel, const std::array<double, 4>& x, double lx) {
    const Vec3 inwards = frame.direction_to_world(travel);
    const Vec3 on_glass = window.frame().to_world(window.area.point(x[2], x[3]));
    const OutsideSeen seen =
        window.open_outside ? light.open(-inwards) : outside_.seen(on_glass, -inwards, window.plate);
    gatherer.add(seen, fate(on_glass, inwards, window.plate), travel, lx);
  };
  const SkyPatches& patches = light.patches();
  for (std::size_t patch = 0; light.by_patches() && patch <= patches.ground(); ++patch) {
    const std::uint64_t n = patch == patches.ground() ? kGroundRays
                                                      : std::max(kLeastRaysOfPatch, n_rays / patches.size());
    const LowDiscrepancy4 in_patch(mix(stream ^ patch));
    for (std::uint64_t i = 0; i < n; ++i) {
      const auto x = in_patch(i);
      const Vec3 travel = -frame.direction_to_local(light.direction(patch, x[0], x[1]));
      if (travel.z > 0.0) add(travel, x, travel.z * patches.solid_angle_sr(patch) / static_cast<double>(n));
    }
  }
  for (std::uint64_t i = 0; !light.by_patches() && i < n_rays; ++i) {
    const auto x = points(i);
    // The first half of the turns is light on its way up, from the ground: before an upright window the horizon cuts
    // no stratum.
    const double radius = std::sqrt(x[0]), turn = 2.0 * kPi * x[1];
    add({radius * std::cos(turn), radius * std::sin(turn), std::sqrt(1.0 - x[0])}, x,
        kPi / static_cast<double>(n_rays));
  }
  if (!light.sun()) return gatherer.finish(outside_class);
  const SunDisc disc(*light.sun());
  for (std::uint64_t i = 0; i < kSunRays; ++i) {
    const auto x = points(n_rays + i);
    const Vec3 outwards = disc.direction(x[0], x[1]);
    const Vec3 travel = -frame.direction_to_local(outwards);
    if (!(travel.z > 0.0) || !(outwards.z > 0.0)) continue;
    const Vec3 on_glass = window.frame().to_world(window.area.point(x[2], x[3]));
    if (!window.open_outside && caster_.nearest(on_glass, outwards, window.plate).plate >= 0) continue;
    gatherer.add({static_cast<int>(light.sun_column()), light.sun()->normal_lx, -1},
                 fate(on_glass, -outwards, window.plate), travel, travel.z / static_cast<double>(kSunRays));
  }
  return gatherer.finish(outside_class);
}

}  // namespace dim
