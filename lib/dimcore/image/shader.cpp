#include "image/shader.hpp"

#include <algorithm>
#include <cmath>

namespace dim {
namespace {

constexpr double kUnseen = 1e-3;      // of what a line of sight shows, left after mirrors: it ends there,
constexpr int kMostMirrors = 1000;    // and where nothing is taken by any
constexpr int kShadowLines = 64;      // from each luminaire to a pixel, over all its samples
constexpr int kHighlightPaths = 144;  // the same for lobes

// Outline of a luminous opening in space, empty where it has no horizontal area.
Ring3 outline_of(const ShownLuminaire& luminaire) {
  if (luminaire.opening.shape == OpeningShape::kVerticalEllipse) return {};
  Ring3 ring = outline(luminaire.opening);
  for (auto& p : ring) p = luminaire.at + p.x * luminaire.c0 + p.y * luminaire.c90;
  return ring;
}

Lights lights_of(const LuminanceDatabase& database) {
  Lights lights;
  for (const auto& intensity : database.intensities()) {
    lights.fittings.push_back({"", intensity, LuminousOpening{}, intensity.flux_lm(), SpectralCurve(1.0),
                               false, "", 0.0, std::nullopt});
  }
  for (const auto& shown : database.luminaires()) {
    Luminaire luminaire;
    luminaire.name = shown.name;
    luminaire.fitting = static_cast<int>(shown.photometry);
    luminaire.at = shown.at;
    luminaire.c0 = shown.c0;
    luminaire.c90 = shown.c90;
    luminaire.aim = shown.aim;
    luminaire.factor = shown.factor;
    luminaire.opening = shown.opening;
    luminaire.body = shown.body;
    lights.luminaires.push_back(std::move(luminaire));
  }
  return lights;
}

}  // namespace

Shader::Shader(const LuminanceDatabase& database, const Cells& cells, const Mix& mix, Shading shading,
               int n_samples)
    : database_(database),
      zone_(database.zone()),
      shading_(shading),
      n_samples_(n_samples),
      channels_(database, mix),
      field_(database, cells, mix, channels_, shading != Shading::cell, shading == Shading::gather),
      mirror_(zone_.finishes.size(), false) {
  for (std::size_t f = 0; f < zone_.finishes.size(); ++f) {
    reflection_.emplace_back();
    for (const std::size_t klass : database.classes().of_band)
      reflection_.back().push_back(database.classes().at(klass, static_cast<int>(f)));
    mirror_[f] = zone_.finishes[f].specular > 0.0;
  }
  facets_.resize(zone_.finishes.size());
  for (const auto cell : database.off_specular_cells()) {
    const auto finish = static_cast<std::size_t>(zone_.surfaces[cells.surface_of(cell)].finish);
    mirror_[finish] = false;
    if (!facets_[finish])
      facets_[finish] = std::make_unique<Facets>(facet_distribution(zone_.finishes[finish]),
                                                 zone_.finishes[finish].roughness);
  }
  for (const auto& luminaire : database.luminaires()) {
    const Ring3 ring = outline_of(luminaire);
    if (!ring.empty()) openings_.push_back({&luminaire, Polygon(ring)});
  }
  auto plates = plates_of(zone_);
  for (const auto& opening : openings_) plates.push_back({&opening.polygon});
  lights_ = lights_of(database_);
  obstructions_ = std::make_unique<Obstructions>(zone_, lights_);
  for (const auto& plate : plates_of(obstructions_->bodies())) plates.push_back(plate);
  caster_ = std::make_unique<RayCaster>(std::move(plates), zone_.diameter_m);
  make_lamps(mix);
}

void Shader::make_lamps(const Mix& mix) {
  std::vector<int> mirrors;
  for (std::size_t s = 0; s < zone_.surfaces.size(); ++s) {
    if (!zone_.surfaces[s].outside && mirror_[static_cast<std::size_t>(zone_.surfaces[s].finish)])
      mirrors.push_back(static_cast<int>(s));
  }
  // As deep as the solution went: what it brought deeper is in the interpolated part.
  std::vector<int> depth;
  for (const auto& luminaire : database_.luminaires()) depth.push_back(luminaire.mirror_depth);
  for (auto& source : sources_with_images(zone_, lights_, mirrors, depth)) {
    if (mix[database_.luminaires()[source.original].source] > 0.0) sources_.push_back(std::move(source));
  }
  for (const auto& luminaire : database_.luminaires())
    factor_.push_back(mix[luminaire.source] * luminaire.factor);
  PairOptions options;
  options.shadow_lines = std::max(4, kShadowLines / n_samples_);
  for (const auto& source : sources_)
    integrators_.emplace_back(zone_, obstructions_->caster(), obstructions_->shadows(), source, options);
}

// An opening shows the luminance that its intensity gives in that direction.
void Shader::add_opening(std::size_t index, const Vec3& direction, const Light& tint, Light& light) const {
  const auto& luminaire = *openings_[index].luminaire;
  const double factor = factor_[static_cast<std::size_t>(&luminaire - database_.luminaires().data())];
  const Vec3 out = -direction;
  const double cosine = glm::dot(out, luminaire.aim);
  const double cd = database_.intensities()[luminaire.photometry].at(
      {glm::dot(out, luminaire.c0), glm::dot(out, luminaire.c90), cosine});
  // Towards grazing both intensity and projected area vanish; their quotient is not to.
  const double cd_m2 = factor * cd / (area_m2(luminaire.opening) * std::max(std::abs(cosine), 0.02));
  const std::size_t first = channels_.first_of(luminaire.source);
  for (std::size_t c = first; c < first + channels_.n_bands(); ++c)
    light[c] += tint[c] * cd_m2 * channels_.watts_per_lumen(c);
}

void Shader::add_direct(std::size_t surface, const Vec2& local, std::uint64_t chance, const Vec3* towards,
                        Light& irradiance, Light& lobe) const {
  const Polygon& polygon = zone_.surfaces[surface].polygon;
  const auto finish = static_cast<std::size_t>(zone_.surfaces[surface].finish);
  Frame frame = polygon.frame();
  frame.origin = frame.to_world(local);
  const Receiver receiver = point_receiver(frame, static_cast<int>(surface), chance);
  const int n_paths = std::max(1, kHighlightPaths / n_samples_);
  for (std::size_t e = 0; e < sources_.size(); ++e) {
    const auto& source = sources_[e];
    if (source.beam.misses({&frame.origin, 1}, obstructions_->caster().tolerance_m())) continue;
    const double factor = factor_[source.original];
    const std::size_t first = channels_.first_of(database_.luminaires()[source.original].source);
    Light tint(channels_.n_bands(), factor);
    tint_by_mirrors(zone_, source, glm::normalize(source.luminaire.at - frame.origin), tint,
                    [&](std::size_t b, int of) -> const BandReflection& {
                      return reflection_[static_cast<std::size_t>(of)][b];
                    });
    if (shading_ == Shading::gather) {
      const double lx = integrators_[e].mean(receiver).lx;
      for (std::size_t b = 0; b < tint.size() && lx > 0.0; ++b)
        irradiance[first + b] += lx * tint[b] * channels_.watts_per_lumen(first + b);
    }
    if (!towards) continue;
    const LowDiscrepancy4 points(chance ^ mix(e));
    for (int i = 0; i < n_paths; ++i) {
      const auto path = integrators_[e].path(receiver, points(static_cast<std::uint64_t>(i)));
      if (!(path.lx > 0.0)) continue;
      const Vec3 in = frame.direction_to_local(path.towards);
      const LobeValue seen = lobe_value(*facets_[finish], in, *towards);
      if (!(seen.value > 0.0)) continue;
      double share = 0.0;
      for (std::size_t b = 0; b < tint.size(); ++b) {
        const BandReflection& reflection = reflection_[finish][b];
        if (b == 0 || !(reflection == reflection_[finish][b - 1])) share = reflection.fresnel(seen.facing);
        lobe[first + b] +=
            path.lx / n_paths * tint[b] * channels_.watts_per_lumen(first + b) * seen.value * share;
      }
    }
  }
}

void Shader::add_surface(std::size_t surface, const Vec2& local, const Vec3& direction, std::uint64_t chance,
                         const Light& tint, Light& light, double& illuminance_lx) const {
  const auto finish = static_cast<std::size_t>(zone_.surfaces[surface].finish);
  Light irradiance(channels_.size(), 0.0), lobe(channels_.size(), 0.0);
  field_.add_irradiance(surface, local, irradiance);
  Vec3 towards = -zone_.surfaces[surface].polygon.frame().direction_to_local(direction);
  towards.z = std::max(towards.z, 1e-6);
  const bool glossy = facets_[finish] != nullptr;
  if (glossy) field_.add_lobe(surface, local, towards, lobe);
  if (glossy || shading_ == Shading::gather)
    add_direct(surface, local, chance, glossy ? &towards : nullptr, irradiance, lobe);
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    light[c] += tint[c] * (reflection_[finish][channels_.band(c)].diffuse * irradiance[c] / kPi + lobe[c]);
    illuminance_lx += channels_.xyz(c).y * irradiance[c];
  }
}

Shader::Seen Shader::seen(const Vec3& eye, const Vec3& direction, std::uint64_t chance, Light& light) const {
  Seen seen;
  Light tint(channels_.size(), 1.0);
  Vec3 from = eye, along = direction;
  int skip = -1;
  for (int met = 0; met <= kMostMirrors; ++met) {
    const Hit hit = caster_->nearest(from, along, skip);
    if (hit.plate < 0) return seen;
    const auto plate = static_cast<std::size_t>(hit.plate);
    seen.anything = true;
    if (plate >= zone_.surfaces.size()) {
      // A body's light is not stored: it is shown black.
      const std::size_t opening = plate - zone_.surfaces.size();
      if (opening < openings_.size()) add_opening(opening, along, tint, light);
      return seen;
    }
    const Surface& surface = zone_.surfaces[plate];
    if (hit.back || surface.outside) return seen;
    double illuminance_lx = 0.0;
    add_surface(plate, hit.local, along, chance ^ mix(static_cast<std::uint64_t>(met)), tint, light,
                illuminance_lx);
    if (met == 0) {
      seen.surface = true;
      seen.illuminance_lx = illuminance_lx;
    }
    const auto finish = static_cast<std::size_t>(surface.finish);
    if (!mirror_[finish]) return seen;
    from += hit.t * along;
    const double left = meet_mirror(
        surface.polygon.frame().n, along, tint,
        [&](std::size_t c) -> const BandReflection& { return reflection_[finish][channels_.band(c)]; });
    if (left < kUnseen) return seen;
    skip = hit.plate;
  }
  return seen;
}

}  // namespace dim
