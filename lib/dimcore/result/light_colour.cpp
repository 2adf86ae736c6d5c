#include "result/light_colour.hpp"

#include <fmt/format.h>

#include <limits>

#include "spectrum/colour.hpp"
#include "transport/auto_bands.hpp"

namespace dim {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Colour difference up to which bands tell the colour of reflected light: twice what --bands auto allows.
constexpr double kMostDeltaE = 2.0 * BandAccuracy{}.delta_e_2000;

LampSpectra spectra_of(const LuminanceDatabase& database) {
  LampSpectra lamps;
  for (std::size_t s = 0; s < database.sources().size(); ++s) {
    lamps.spectra.push_back(database.spectra()[s].curve);
    lamps.flux_lm.push_back(database.sources()[s].flux_lm);
  }
  return lamps;
}

LightResponses response_per_W(const SpectralCurve& spd, double low_nm, double high_nm) {
  const LightResponses whole = light_responses(spd, low_nm, high_nm);
  LightResponses one;
  if (whole.power > 0.0) one.add(whole, 1.0 / whole.power);
  return one;
}

}  // namespace

LightColours::LightColours(const LuminanceDatabase& database)
    : database_(database), bands_(judged_bands(database.zone(), spectra_of(database), database.bands())) {
  const Bands& bands = database.bands();
  const auto& classes = database.classes();
  const std::size_t n_classes = classes.size();
  per_lm_.resize(database.sources().size() * n_classes);
  for (std::size_t s = 0; s < database.sources().size(); ++s) {
    const Source& source = database.sources()[s];
    for (std::size_t b = 0; b < bands.size(); ++b) {
      LightResponses one = response_per_W(database.spectra()[s].curve, bands.low_nm(b), bands.high_nm(b));
      one.xyz = {source.weights.x[b], source.weights.y[b], source.weights.z[b]};
      per_lm_[s * n_classes + classes.of_band[b]].add(one, source.watts_per_lumen(b));
    }
  }
}

bool LightColours::unknown(const Mix& mix, std::size_t source) const {
  return mix[source] > 0.0 && database_.sources()[source].flux_lm > 0.0 && !database_.spectra()[source].known;
}

Warnings LightColours::left_out(const Mix& mix) const {
  constexpr const char* kWhat = "colour temperature, Ra and melanopic EDI";
  std::vector<std::string> names;
  for (std::size_t s = 0; s < mix.size(); ++s)
    if (unknown(mix, s)) names.push_back("'" + database_.sources()[s].name + "'");
  Warnings warnings;
  if (!names.empty())
    warnings.push_back({{},
                        fmt::format("source{} {}: no spectrum is stated; {} of {} light are left empty",
                                    names.size() == 1 ? "" : "s", fmt::join(names, ", "), kWhat,
                                    names.size() == 1 ? "its" : "their"),
                        fmt::format("--spectrum {}=led-4000 says it", names.front().substr(1, names.front().size() - 2))});
  if (bands_.delta_e_2000 > kMostDeltaE)
    warnings.push_back({{},
                        fmt::format("{}: too few for {} of light that these finishes reflect; left empty",
                                    in_words(bands_), kWhat),
                        "make the file again with dimray --bands auto"});
  return warnings;
}

LightColour LightColours::figures(const LightResponses& light, bool known) const {
  LightColour colour;
  colour.illuminance_lx = kMaxEfficacy_lm_W * light.xyz.y;
  colour.xy = xy_of(light.xyz);
  colour.uv = uv_1976_of(light.xyz);
  if (!known) {
    colour.white = {kNaN, kNaN};
    colour.ra = colour.melanopic_edi_lx = kNaN;
    return colour;
  }
  colour.white = white_point(light.xyz);
  colour.ra = colour_rendering(light, colour.white.cct_K).ra;
  colour.melanopic_edi_lx = melanopic_edi_lx(light.melanopic);
  return colour;
}

template <typename Read>
std::vector<LightColour> LightColours::mixed(std::size_t n, const Mix& mix, const Read& read) const {
  const std::size_t n_classes = database_.classes().size();
  std::vector<LightResponses> light(n);
  for (std::size_t s = 0; s < mix.size(); ++s) {
    if (mix[s] == 0.0) continue;
    const auto transfer = read(s);
    for (std::size_t q = 0; q < n_classes; ++q) {
      for (std::size_t i = 0; i < n; ++i)
        light[i].add(per_lm_[s * n_classes + q], mix[s] * static_cast<double>(transfer[q * n + i]));
    }
  }
  bool known = !(bands_.delta_e_2000 > kMostDeltaE);
  for (std::size_t s = 0; s < mix.size(); ++s) known = known && !unknown(mix, s);
  std::vector<LightColour> colours;
  for (const auto& one : light) colours.push_back(figures(one, known));
  return colours;
}

std::vector<LightColour> LightColours::at_points(const Mix& mix) const {
  return mixed(database_.zone().points.size(), mix,
               [&](std::size_t s) { return database_.transfer(TransferPart::point_total, s); });
}

std::vector<LightColour> LightColours::on_surfaces(const Cells& cells, const Mix& mix) const {
  const std::size_t n_surfaces = cells.n_surfaces(), n_cells = cells.size();
  return mixed(n_surfaces, mix, [&](std::size_t s) {
    const auto transfer = database_.transfer(TransferPart::cell_total, s);
    std::vector<double> mean(database_.classes().size() * n_surfaces, 0.0);
    for (std::size_t surface = 0; surface < n_surfaces; ++surface) {
      double area_m2 = 0.0;
      for (std::size_t i = cells.first(surface); i < cells.first(surface + 1); ++i)
        area_m2 += cells.area_m2(i);
      for (std::size_t q = 0; q < database_.classes().size(); ++q) {
        for (std::size_t i = cells.first(surface); i < cells.first(surface + 1); ++i)
          mean[q * n_surfaces + surface] +=
              cells.area_m2(i) / area_m2 * static_cast<double>(transfer[q * n_cells + i]);
      }
    }
    return mean;
  });
}

}  // namespace dim
