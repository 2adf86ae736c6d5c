#include "result/light_colour.hpp"

#include <limits>

#include "spectrum/colour.hpp"

namespace dim {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

LightResponses response_per_W(const SpectralCurve& spd, double low_nm, double high_nm) {
  const LightResponses whole = light_responses(spd, low_nm, high_nm);
  LightResponses one;
  if (whole.power > 0.0) one.add(whole, 1.0 / whole.power);
  return one;
}

}  // namespace

LightColours::LightColours(const LuminanceDatabase& database)
    : database_(database), has_spectra_(!database.spectra().empty()) {
  const Bands& bands = database.bands();
  for (std::size_t s = 0; s < database.sources().size(); ++s) {
    const BandWeights& weights = database.sources()[s].weights;
    for (std::size_t b = 0; b < bands.size(); ++b) {
      LightResponses one;
      if (has_spectra_) one = response_per_W(database.spectra()[s], bands.low_nm(b), bands.high_nm(b));
      one.xyz = {weights.x[b], weights.y[b], weights.z[b]};
      per_W_.push_back(one);
    }
  }
}

LightColour LightColours::figures(const LightResponses& light) const {
  LightColour colour;
  colour.illuminance_lx = kMaxEfficacy_lm_W * light.xyz.y;
  colour.xy = xy_of(light.xyz);
  colour.uv = uv_1976_of(light.xyz);
  colour.white = white_point(light.xyz);
  colour.ra = has_spectra_ ? colour_rendering(light, colour.white.cct_K).ra : kNaN;
  colour.melanopic_edi_lx = has_spectra_ ? melanopic_edi_lx(light.melanopic) : kNaN;
  return colour;
}

template <typename Read>
std::vector<LightColour> LightColours::mixed(std::size_t n, const Mix& mix, const Read& read) const {
  const std::size_t n_bands = database_.bands().size();
  std::vector<LightResponses> light(n);
  for (std::size_t s = 0; s < mix.size(); ++s) {
    if (mix[s] == 0.0) continue;
    const auto irradiance = read(s);
    for (std::size_t b = 0; b < n_bands; ++b) {
      for (std::size_t i = 0; i < n; ++i)
        light[i].add(per_W_[s * n_bands + b], mix[s] * static_cast<double>(irradiance[b * n + i]));
    }
  }
  std::vector<LightColour> colours;
  for (const auto& one : light) colours.push_back(figures(one));
  return colours;
}

std::vector<LightColour> LightColours::at_points(const Mix& mix) const {
  return mixed(database_.zone().points.size(), mix,
               [&](std::size_t s) { return database_.point_irradiance(s); });
}

std::vector<LightColour> LightColours::on_surfaces(const Cells& cells, const Mix& mix) const {
  const std::size_t n_surfaces = cells.n_surfaces(), n_cells = cells.size();
  return mixed(n_surfaces, mix, [&](std::size_t s) {
    const auto irradiance = database_.cell_irradiance(s);
    std::vector<double> mean(database_.bands().size() * n_surfaces, 0.0);
    for (std::size_t surface = 0; surface < n_surfaces; ++surface) {
      double area_m2 = 0.0;
      for (std::size_t i = cells.first(surface); i < cells.first(surface + 1); ++i)
        area_m2 += cells.area_m2(i);
      for (std::size_t b = 0; b < database_.bands().size(); ++b) {
        for (std::size_t i = cells.first(surface); i < cells.first(surface + 1); ++i)
          mean[b * n_surfaces + surface] +=
              cells.area_m2(i) / area_m2 * static_cast<double>(irradiance[b * n_cells + i]);
      }
    }
    return mean;
  });
}

}  // namespace dim
