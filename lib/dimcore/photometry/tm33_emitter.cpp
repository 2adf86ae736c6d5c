#include "photometry/tm33_emitter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "photometry/carried_on.hpp"
#include "photometry/symmetry.hpp"
#include "photometry/text_scanner.hpp"
#include "spectrum/bands.hpp"
#include "spectrum/curve_check.hpp"

namespace dim {
namespace {

constexpr Limits kFactor = {1e-12, 1e12};
constexpr Limits kMagnitude = {0, 1e12};
constexpr double kMaxIntensity_cd = 1e18;
constexpr std::size_t kMaxIntensities = 8'000'000;

struct Sample {
  double h_deg, v_deg, intensity;
  pugi::xml_node node;
};

// "Symm _ None", "CIE_C" and "Type C" in one form.
std::string squeezed(std::string_view words) {
  std::string out;
  for (const char c : in_capitals(words))
    if (c != ' ' && c != '_') out += c;
  return out;
}

bool is_true(std::string_view word) { return in_capitals(word) == "TRUE" || word == "1"; }

std::vector<double> distinct(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::size_t index_of(const std::vector<double>& values, double value) {
  return static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), value) - values.begin());
}

/// Where the intensities stand: LuminousData/LuminousIntensity, or a block that lists them itself.
pugi::xml_node intensity_block(const XmlDocument& xml, pugi::xml_node emitter) {
  const auto data = child_of(emitter, {"LuminousData", "IntensityDistribution"});
  const auto block = child_of(data, {"LuminousIntensity"});
  const auto metric = squeezed(text_of(data, {"Metric"}));
  if (data && (metric.empty() || metric == "LUMINOUS")) return block ? block : data;
  const bool other = child_of(emitter, {"RadiantData", "PhotonData"}) || data;
  throw InputError({xml.place(emitter),
                    other ? "the emitter has radiant or photon intensities alone"
                          : "the emitter has no luminous intensities (LuminousData)",
                    "DIM needs luminous intensities in cd"});
}

void refuse_other_types(const XmlDocument& xml, pugi::xml_node emitter, pugi::xml_node block) {
  const auto meter = child_of(child_of(emitter.parent(), {"Equipment"}), {"Gonioradiometer", "Goniometer"});
  for (const auto& word : {text_of(block, {"PhotometryType"}), text_of(meter, {"Type", "GoniometerType"})}) {
    const std::string type = squeezed(word);
    if (type.empty() || type.back() == 'C') continue;
    // Programs that make type C files write CIE_A here: angles beyond those of type A tell.
    for (const auto node : children_of(block, {"IntData", "IntensityData"})) {
      double v = 0.0, h = 0.0;
      parse_number(attribute_of(node, {"v", "vert"}), v);
      parse_number(attribute_of(node, {"h", "horz"}), h);
      if (v > 90.0 || h > 180.0) return;
    }
    throw InputError({xml.place(block), "photometric type " + quoted(word) + " is not read from TM-33",
                      "ask for type C, or for an LM-63 file"});
  }
}

std::vector<Sample> read_samples(const XmlDocument& xml, pugi::xml_node block) {
  std::vector<Sample> samples;
  for (const auto node : children_of(block, {"IntData", "IntensityData"})) {
    if (samples.size() == kMaxIntensities)
      throw InputError({xml.place(node), fmt::format("more than {} intensities", kMaxIntensities),
                        "resample the file to coarser angles"});
    Sample sample{0.0, 0.0, 0.0, node};
    sample.h_deg =
        xml.number_in(node, attribute_of(node, {"h", "horz", "horizontal"}), "horizontal angle", {-180, 360});
    sample.v_deg =
        xml.number_in(node, attribute_of(node, {"v", "vert", "vertical"}), "vertical angle", {0, 180});
    sample.intensity = xml.number_in(node, trimmed(node.text().get()), "intensity", {0, kMaxIntensity_cd});
    samples.push_back(sample);
  }
  if (samples.empty()) throw InputError({xml.place(block), "no intensities (IntData) are listed", ""});
  return samples;
}

void warn_of_count(const XmlDocument& xml, pugi::xml_node block, const char* name, std::size_t n,
                   Warnings& warnings) {
  const auto said = xml.number(block, {name}, {0, 1e9});
  if (said && *said != static_cast<double>(n))
    warnings.push_back(
        {xml.place(block), fmt::format("{} says {:g}, {} are listed", name, *said, n), "the list is used"});
}

/// Every pair of angles once.
void take_grid(const XmlDocument& xml, pugi::xml_node block, Tm33Emitter& emitter, Warnings& warnings) {
  const auto samples = read_samples(xml, block);
  std::vector<double> h_deg, v_deg;
  for (const auto& sample : samples) h_deg.push_back(sample.h_deg), v_deg.push_back(sample.v_deg);
  h_deg = distinct(std::move(h_deg));
  v_deg = distinct(std::move(v_deg));
  if (v_deg.size() < 2) throw InputError({xml.place(block), "a single vertical angle is too few", ""});
  warn_of_count(xml, block, "NumberHorz", h_deg.size(), warnings);
  warn_of_count(xml, block, "NumberVert", v_deg.size(), warnings);
  if (h_deg.size() * v_deg.size() > kMaxIntensities)
    throw InputError(
        {xml.place(block), "the intensities are not on a grid of horizontal and vertical angles", ""});
  std::vector<double> candelas(h_deg.size() * v_deg.size(), std::numeric_limits<double>::quiet_NaN());
  for (const auto& sample : samples) {
    double& cd = candelas[index_of(h_deg, sample.h_deg) * v_deg.size() + index_of(v_deg, sample.v_deg)];
    if (!std::isnan(cd))
      throw InputError({xml.place(sample.node),
                        fmt::format("the intensity at h {} v {} is given twice", sample.h_deg, sample.v_deg),
                        ""});
    cd = sample.intensity * emitter.factor;
  }
  const auto hole = std::find_if(candelas.begin(), candelas.end(), [](double cd) { return std::isnan(cd); });
  if (hole != candelas.end()) {
    const auto at = static_cast<std::size_t>(hole - candelas.begin());
    throw InputError({xml.place(block),
                      fmt::format("no intensity at h {} v {}: each horizontal angle needs all {} "
                                  "vertical ones",
                                  h_deg[at / v_deg.size()], v_deg[at % v_deg.size()], v_deg.size()),
                      "the file is incomplete"});
  }
  const auto symmetry = symmetry_of(h_deg);
  if (!symmetry)
    throw InputError(
        {xml.place(block),
         fmt::format("horizontal angles run from {} to {}; allowed are one plane, 0..90, 0..180, "
                     "90..270 and 0..360",
                     h_deg.front(), h_deg.back()),
         ""});
  emitter.symmetry = *symmetry;
  carry_on_to_hemispheres(v_deg, candelas, xml.place(block), warnings);
  emitter.distribution = expand(*symmetry, h_deg, v_deg, candelas);
}

std::vector<std::pair<double, double>> listed_spectrum(const XmlDocument& xml, pugi::xml_node spectral) {
  constexpr Limits kAny = {-1e30, 1e30};
  std::vector<std::pair<double, double>> points;
  for (const auto node : children_of(spectral, {"PwrData", "SpectralData"}))
    points.emplace_back(xml.number_in(node, attribute_of(node, {"w"}), "wavelength", {1, 1e5}),
                        xml.number_in(node, trimmed(node.text().get()), "spectral power", kAny));
  if (!points.empty()) return points;
  const auto wavelengths = child_of(spectral, {"Wavelengths"}), values = child_of(spectral, {"Values"});
  TextScanner nm(wavelengths.text().get(), ""), power(values.text().get(), "");
  for (auto word = nm.take_word(); !word.empty(); word = nm.take_word())
    points.emplace_back(xml.number_in(wavelengths, word, "wavelength", {1, 1e5}),
                        xml.number_in(values, power.take_word(), "spectral power", kAny));
  return points;
}

void take_spectrum(const XmlDocument& xml, pugi::xml_node node, Tm33Emitter& emitter, Warnings& warnings) {
  auto spectral = child_of(node, {"SpectralData", "SpectralDistribution"});
  if (const auto inner = child_of(spectral, {"EmitterSpectral"})) spectral = inner;
  if (!spectral) return;
  auto points = listed_spectrum(xml, spectral);
  std::sort(points.begin(), points.end());
  // Instruments write a little noise below zero.
  for (auto& [nm, power] : points) power = std::max(0.0, power);
  const auto warn = [&](const std::string& what) {
    warnings.push_back({xml.place(spectral), "spectrum not used: " + what, "its colour is then unknown"});
  };
  if (points.empty()) return warn("no spectral power (PwrData) is listed");
  if (const auto fault = find_fault(points)) return warn(fault->what);
  // Nothing is known outside what is listed: no light there.
  if (points.front().first > kVisibleLow_nm)
    points.insert(points.begin(), {points.front().first - 1e-3, 0.0});
  if (points.back().first < kVisibleHigh_nm) points.emplace_back(points.back().first + 1e-3, 0.0);
  SpectralCurve curve(std::move(points));
  if (!(curve.integral(kVisibleLow_nm, kVisibleHigh_nm) > 0.0)) return warn("it has no visible light");
  emitter.spectrum = std::move(curve);
}

void take_colour(const XmlDocument& xml, pugi::xml_node node, LampSet& lamps) {
  auto cct = xml.number(child_of(node, {"ColorTemperature"}), {"FixedCCT"}, kMagnitude);
  if (!cct) cct = xml.number(node, {"CCT"}, kMagnitude);
  if (!cct) cct = xml.number(child_of(node, {"LuminousData"}), {"MeasuredCCT"}, kMagnitude);
  if (cct && *cct > 0.0) lamps.colour = fmt::format("{:g} K", *cct);
  const auto rendering = child_of(node, {"ColorRendering"});
  auto ra = xml.number(child_of(rendering, {"CIE_CRI"}), {"Ra"}, {-1000, 100});
  if (!ra) ra = xml.number(rendering, {"Ra"}, {-1000, 100});
  if (ra) lamps.rendering = fmt::format("Ra {:g}", *ra);
}

}  // namespace

Tm33Emitter read_tm33_emitter(const XmlDocument& xml, pugi::xml_node node, Warnings& warnings) {
  Tm33Emitter emitter;
  const auto block = intensity_block(xml, node);
  refuse_other_types(xml, node, block);
  emitter.lamps.n_lamps = static_cast<int>(xml.number(node, {"Quantity"}, {1, 1e6}).value_or(1.0));
  emitter.lamps.type = text_of(node, {"Description"});
  emitter.lamps.flux_lm = xml.number(node, {"RatedLumens"}, kMagnitude).value_or(0.0) * emitter.lamps.n_lamps;
  emitter.lamps.watts = xml.number(node, {"InputWattage", "InputWatts"}, kMagnitude).value_or(0.0);
  take_colour(xml, node, emitter.lamps);
  const std::string absolute = text_of(block, {"AbsolutePhotometry", "Absolute"});
  emitter.absolute = absolute.empty() || is_true(absolute);
  emitter.factor = xml.number(block, {"Multiplier"}, kFactor).value_or(1.0);
  if (!emitter.absolute) emitter.factor *= xml.number(node, {"BallastFactor"}, kFactor).value_or(1.0);
  take_grid(xml, block, emitter, warnings);
  const IntensityTable table(emitter.distribution);
  emitter.flux_lm = table.flux_lm();
  emitter.declared_flux_lm = xml.number(child_of(node, {"LuminousData"}), {"LuminousFlux"}, kMagnitude);
  if (!emitter.declared_flux_lm) emitter.declared_flux_lm = xml.number(node, {"MeasuredLumens"}, kMagnitude);
  take_spectrum(xml, node, emitter, warnings);
  if (child_of(node, {"TiltAngles"}))
    warnings.push_back({xml.place(child_of(node, {"TiltAngles"})), "lamp tilt factors are not applied", ""});
  if (child_of(node, {"AngularColor"}) || child_of(child_of(node, {"SpectralData"}), {"AngularSpectral"}))
    warnings.push_back(
        {xml.place(node), "colour by direction is not used", "one spectrum serves all directions"});
  return emitter;
}

}  // namespace dim
