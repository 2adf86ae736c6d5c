#include "result/content.hpp"

#include <algorithm>

namespace dim {
namespace {

double shown_c_rad(std::size_t plane) { return 2.0 * kPi * static_cast<double>(plane) / (kShownPlanes - 1); }
double shown_gamma_rad(std::size_t i) { return kPi * static_cast<double>(i) / (kShownGammas - 1); }

MeanIntensity mean_intensity(const IntensityTable& table) {
  constexpr int kPlanes = 24;
  MeanIntensity mean;
  for (std::size_t i = 0; i < kShownGammas; ++i) {
    double sum = 0.0;
    for (int c = 0; c < kPlanes; ++c) sum += table.at_c_gamma(2.0 * kPi * c / kPlanes, shown_gamma_rad(i));
    mean.push_back(sum / kPlanes);
  }
  return mean;
}

std::vector<float> intensities_shown(const IntensityTable& intensity) {
  std::vector<float> cd;
  cd.reserve(kShownPlanes * kShownGammas);
  for (std::size_t c = 0; c < kShownPlanes; ++c) {
    for (std::size_t g = 0; g < kShownGammas; ++g)
      cd.push_back(static_cast<float>(intensity.at_c_gamma(shown_c_rad(c), shown_gamma_rad(g))));
  }
  return cd;
}

std::size_t source_of(const Solution& solution, const std::string& luminaire) {
  for (std::size_t s = 0; s < solution.sources.size(); ++s) {
    const auto& names = solution.sources[s].luminaires;
    if (std::find(names.begin(), names.end(), luminaire) != names.end()) return s;
  }
  throw InternalError("luminaire '" + luminaire + "' belongs to no source");
}

ShownLuminaire shown(const Luminaire& luminaire, std::size_t source, int mirror_depth) {
  return {luminaire.name, source,           luminaire.at,
          luminaire.c0,   luminaire.c90,    luminaire.aim,
          luminaire.opening, static_cast<std::size_t>(luminaire.fitting), luminaire.factor,
          luminaire.body, mirror_depth};
}

}  // namespace

IntensityTable shown_intensity(const std::vector<float>& intensity_cd) {
  IntensityDistribution grid;
  for (std::size_t c = 0; c < kShownPlanes; ++c) grid.c_rad.push_back(shown_c_rad(c));
  for (std::size_t g = 0; g < kShownGammas; ++g) grid.gamma_rad.push_back(shown_gamma_rad(g));
  grid.intensity_cd.assign(intensity_cd.begin(), intensity_cd.end());
  return IntensityTable(grid);
}

ResultContent content_of(const Zone& zone, const Cells& cells, const Lights& lights,
                         const Solution& solution) {
  ResultContent content;
  content.cells = cells;
  content.zone = zone;
  content.bands = solution.bands;
  content.classes = solution.classes;
  // Finishes of luminaires' bodies come after the zone's own and are not part of it.
  for (auto& finishes : content.classes.of_finish) finishes.resize(zone.finishes.size());
  content.sources = solution.sources;
  content.spectra.assign(solution.sources.size(), {SpectralCurve(1.0), true});
  for (std::size_t l = 0; l < lights.luminaires.size(); ++l) {
    const auto& luminaire = lights.luminaires[l];
    const auto& fitting = lights.fitting_of(luminaire);
    const std::size_t source = source_of(solution, luminaire.name);
    auto& spectrum = content.spectra[source];
    spectrum = {fitting.spectrum, spectrum.known && fitting.has_spectrum};
    content.luminaires.push_back(shown(luminaire, source, l < solution.mirrors.depth.size() ? solution.mirrors.depth[l] : 0));
  }
  content.sky = solution.sky;
  for (std::size_t s = 0; s < solution.sources.size() && lights.sky; ++s) {
    if (const auto& daylight = solution.sources[s].daylight)
      content.spectra[s].curve =
          daylight->part == DaylightPart::sun ? lights.sky->sun_spectrum : lights.sky->sky_spectrum;
  }
  for (const auto& fitting : lights.fittings) {
    content.photometry.push_back({fitting.name, fitting.intensity.flux_lm(), fitting.watts,
                                  mean_intensity(fitting.intensity), intensities_shown(fitting.intensity)});
    content.intensities.push_back(shown_intensity(content.photometry.back().intensity_cd));
  }
  content.off_specular = solution.directional.cells;
  content.directional_grid = solution.directional.grid;
  content.n_direct_classes = solution.n_direct_classes;
  return content;
}

}  // namespace dim
