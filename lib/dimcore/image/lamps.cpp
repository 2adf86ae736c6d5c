#include "image/lamps.hpp"

namespace dim {
namespace {

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

Lamps::Lamps(const LuminanceDatabase& database, const Mix& mix, const LightChannels& channels,
             const std::vector<int>& mirrors)
    : database_(database), channels_(channels), lights_(lights_of(database)) {
  obstructions_ = std::make_unique<Obstructions>(database.zone(), lights_);
  // As deep as the solution went: what it brought deeper is in the interpolated part.
  std::vector<int> depth;
  for (const auto& luminaire : database.luminaires()) {
    depth.push_back(luminaire.mirror_depth);
    factor_.push_back(mix[luminaire.source] * luminaire.factor);
  }
  for (auto& emitter : sources_with_images(database.zone(), lights_, mirrors, depth))
    if (mix[database.luminaires()[emitter.original].source] > 0.0) emitters_.push_back(std::move(emitter));
}

std::vector<PairIntegrator> Lamps::integrators(int shadow_lines) const {
  PairOptions options;
  options.shadow_lines = shadow_lines;
  options.in_the_way = shadow_lines > 0;
  std::vector<PairIntegrator> integrators;
  integrators.reserve(emitters_.size());
  for (const auto& emitter : emitters_)
    integrators.emplace_back(database_.zone(), obstructions_->caster(), obstructions_->shadows(), emitter,
                             options);
  return integrators;
}

void Lamps::tint(std::size_t e, const Vec3& at, std::vector<double>& tint) const {
  const auto& emitter = emitters_[e];
  tint.assign(channels_.n_bands(), factor_of(e));
  if (emitter.mirrors.empty()) return;
  const auto& classes = database_.classes();
  tint_by_mirrors(database_.zone(), emitter, glm::normalize(emitter.luminaire.at - at), tint,
                  [&](std::size_t b, int finish) -> const BandReflection& {
                    return classes.at(classes.of_band[b], finish);
                  });
}

void Lamps::add(std::size_t e, double lx, const Vec3& at, Light& irradiance) const {
  if (!(lx > 0.0)) return;
  const std::size_t first = channels_.first_of(database_.luminaires()[emitters_[e].original].source);
  if (emitters_[e].mirrors.empty()) {
    for (std::size_t b = first; b < first + channels_.n_bands(); ++b)
      irradiance[b] += lx * factor_of(e) * channels_.watts_per_lumen(b);
    return;
  }
  std::vector<double> left;
  tint(e, at, left);
  for (std::size_t b = 0; b < left.size(); ++b)
    irradiance[first + b] += lx * left[b] * channels_.watts_per_lumen(first + b);
}

}  // namespace dim
