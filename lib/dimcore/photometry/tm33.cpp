#include "photometry/tm33.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "photometry/text_scanner.hpp"
#include "photometry/tm33_emitter.hpp"
#include "spectrum/observer.hpp"

namespace dim {
namespace {

constexpr double kLargestOpening_m = 20.0;
constexpr Limits kDimension = {0, 1e6};

std::string format_of(std::string_view root) {
  if (root == "IESTM33") return "TM-33-18";
  if (root.starts_with("IESTM33-")) return "TM-33-23";
  if (root == "UNI11733") return "UNI 11733";
  if (root == "LuminaireOpticalData") return "ATLA S001";
  return {};
}

void take_header(pugi::xml_node header, Photometry& photometry) {
  const auto keep = [&](const char* keyword, std::initializer_list<const char*> names) {
    if (const std::string value = text_of(header, names); !value.empty())
      photometry.keywords.emplace_back(keyword, value);
  };
  keep("MANUFAC", {"Manufacturer"});
  keep("LUMCAT", {"CatalogNumber"});
  keep("LUMINAIRE", {"Description"});
  keep("TESTLAB", {"Laboratory"});
  keep("TEST", {"ReportNumber"});
  keep("ISSUEDATE", {"ReportDate", "TestDate", "IssueDate"});
}

struct Extent {
  double length = 0.0;  ///< along C90-C270
  double width = 0.0;   ///< along C0-C180
  bool circular = false;
};

/// The rectangle round a face's areas, whose offsets are from the luminaire's middle.
Extent extent_of(const XmlDocument& xml, pugi::xml_node face, const char* area_name) {
  double low_l = 0.0, high_l = 0.0, low_w = 0.0, high_w = 0.0;
  Extent extent;
  const auto areas = children_of(face, {area_name});
  for (const auto area : areas) {
    const auto number = [&](const char* name, const Limits& limits) {
      return xml.number(area, {name}, limits).value_or(0.0);
    };
    const double length = number("Length", kDimension), width = number("Width", kDimension);
    const double at_l = number("LengthOffset", {-1e6, 1e6}), at_w = number("WidthOffset", {-1e6, 1e6});
    const std::string circular = in_capitals(text_of(area, {"Circular"}));
    extent.circular = areas.size() == 1 && (circular == "TRUE" || circular == "1");
    const double across = extent.circular && width == 0.0 ? length : width;
    const bool first = area == areas.front();
    low_l = first ? at_l - length / 2 : std::min(low_l, at_l - length / 2);
    high_l = first ? at_l + length / 2 : std::max(high_l, at_l + length / 2);
    low_w = first ? at_w - across / 2 : std::min(low_w, at_w - across / 2);
    high_w = first ? at_w + across / 2 : std::max(high_w, at_w + across / 2);
  }
  extent.length = high_l - low_l;
  extent.width = high_w - low_w;
  return extent;
}

Extent emission_of(const XmlDocument& xml, const std::vector<pugi::xml_node>& emitters) {
  Extent largest;
  for (const auto emitter : emitters) {
    const auto areas = child_of(emitter, {"EmissionAreas"});
    Extent extent = extent_of(xml, child_of(areas, {"BottomFace"}), "BottomArea");
    if (!(extent.length > 0.0)) extent = extent_of(xml, child_of(areas, {"TopFace"}), "TopArea");
    if (extent.length * extent.width > largest.length * largest.width) largest = extent;
  }
  return largest;
}

void take_opening(const XmlDocument& xml, pugi::xml_node root, const std::vector<pugi::xml_node>& emitters,
                  Photometry& photometry, Warnings& warnings) {
  Extent extent = emission_of(xml, emitters);
  const auto luminaire = child_of(root, {"Luminaire"});
  const auto size = child_of(luminaire, {"Dimensions"});
  if (!(extent.length > 0.0) && size) {
    extent.length = xml.number(size, {"Length"}, kDimension).value_or(0.0);
    extent.width = xml.number(size, {"Width"}, kDimension).value_or(0.0);
    const std::string shape = text_of(luminaire, {"Shape"});
    extent.circular = !shape.empty() && shape.back() == 'Z';
    if (extent.length > 0.0)
      warnings.push_back({xml.place(size),
                          "no emission areas: the luminous opening is taken to be as large as "
                          "the luminaire",
                          "say otherwise by opening = [...] in the lights file"});
  }
  if (std::max(extent.length, extent.width) > kLargestOpening_m) {
    warnings.push_back(
        {xml.place(size ? size : root),
         fmt::format("an opening of {:g} x {:g} m: read as millimetres", extent.length, extent.width),
         "TM-33 states sizes in metres"});
    extent.length /= 1000.0;
    extent.width /= 1000.0;
  }
  if (extent.circular && extent.width == 0.0) extent.width = extent.length;
  auto& opening = photometry.opening;
  opening.length_m = extent.width;
  opening.width_m = extent.length;
  const bool length = opening.length_m > 0.0, width = opening.width_m > 0.0;
  opening.shape = length && width   ? (extent.circular ? OpeningShape::kEllipse : OpeningShape::kRectangle)
                  : length || width ? OpeningShape::kLine
                                    : OpeningShape::kPoint;
}

/// Sum of distributions on all their angles; exact where the angles are the same.
IntensityDistribution sum_of(const std::vector<Tm33Emitter>& emitters) {
  if (emitters.size() == 1) return emitters.front().distribution;
  IntensityDistribution sum;
  const auto merge = [](std::vector<double>& all, const std::vector<double>& more) {
    all.insert(all.end(), more.begin(), more.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end(), [](double a, double b) { return b - a < 1e-9; }),
              all.end());
  };
  for (const auto& emitter : emitters) {
    merge(sum.c_rad, emitter.distribution.c_rad);
    merge(sum.gamma_rad, emitter.distribution.gamma_rad);
  }
  sum.intensity_cd.assign(sum.c_rad.size() * sum.gamma_rad.size(), 0.0);
  for (const auto& emitter : emitters) {
    const IntensityTable table(emitter.distribution);
    for (std::size_t c = 0; c < sum.c_rad.size(); ++c)
      for (std::size_t g = 0; g < sum.gamma_rad.size(); ++g)
        sum.intensity_cd[c * sum.gamma_rad.size() + g] += table.at_c_gamma(sum.c_rad[c], sum.gamma_rad[g]);
  }
  return sum;
}

Symmetry common_symmetry(const std::vector<Tm33Emitter>& emitters) {
  const Symmetry first = emitters.front().symmetry;
  const auto same = [&](const Tm33Emitter& emitter) { return emitter.symmetry == first; };
  return std::all_of(emitters.begin(), emitters.end(), same) ? first : Symmetry::kNone;
}

double luminous_integral(const SpectralCurve& spectrum) {
  double sum = 0.0;
  for (double nm = 380.0; nm <= 780.0; nm += 1.0) sum += spectrum.at(nm) * photopic_efficiency().at(nm);
  return sum;
}

/// Spectrum of all emitters together, each by its share of the flux; nothing where one is not known.
std::optional<SpectralCurve> mixed_spectrum(const std::vector<Tm33Emitter>& emitters) {
  std::vector<double> wavelengths;
  for (const auto& emitter : emitters) {
    if (!emitter.spectrum) return std::nullopt;
    for (const auto& [nm, power] : emitter.spectrum->points()) wavelengths.push_back(nm);
  }
  if (emitters.size() == 1) return emitters.front().spectrum;
  std::sort(wavelengths.begin(), wavelengths.end());
  wavelengths.erase(std::unique(wavelengths.begin(), wavelengths.end()), wavelengths.end());
  std::vector<std::pair<double, double>> points;
  for (const double nm : wavelengths) points.emplace_back(nm, 0.0);
  for (const auto& emitter : emitters) {
    const double luminous = luminous_integral(*emitter.spectrum);
    if (!(luminous > 0.0)) continue;
    for (auto& [nm, power] : points) power += emitter.flux_lm / luminous * emitter.spectrum->at(nm);
  }
  return SpectralCurve(std::move(points));
}

void take_lamps(const std::vector<Tm33Emitter>& emitters, Photometry& photometry) {
  double declared_lm = 0.0, rated_lm = 0.0, watts = 0.0;
  bool all_declared = true, relative = true;
  int n_lamps = 0;
  for (const auto& emitter : emitters) {
    photometry.lamp_sets.push_back(emitter.lamps);
    all_declared = all_declared && emitter.declared_flux_lm && *emitter.declared_flux_lm > 0.0;
    declared_lm += emitter.declared_flux_lm.value_or(0.0);
    relative = relative && !emitter.absolute && emitter.lamps.flux_lm > 0.0;
    rated_lm += emitter.lamps.flux_lm;
    watts += emitter.lamps.watts;
    n_lamps += emitter.lamps.n_lamps;
  }
  photometry.n_lamps = n_lamps;
  if (all_declared) photometry.declared_flux_lm = declared_lm;
  if (relative) {
    photometry.lumens_per_lamp = rated_lm / n_lamps;
    photometry.declared_lamp_flux_lm = rated_lm;
  }
  if (watts > 0.0) photometry.watts = watts;
  if (const auto& lamp = emitters.front().lamps.type; !lamp.empty())
    photometry.keywords.emplace_back("LAMP", lamp);
}

}  // namespace

bool is_xml(std::string_view bytes) {
  if (bytes.substr(0, 3) == "\xEF\xBB\xBF") bytes.remove_prefix(3);
  const auto begin = bytes.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && bytes[begin] == '<';
}

Photometry read_tm33(std::string_view bytes, const std::string& file_name, Warnings& warnings) {
  const XmlDocument xml(photometric_text(bytes, file_name), file_name);
  const auto root = xml.root();
  Photometry photometry;
  photometry.format_year = 0;
  photometry.format = format_of(local_name(root));
  if (photometry.format.empty())
    throw InputError({xml.place(root),
                      "XML, but not TM-33: its outermost element is " + quoted(local_name(root)),
                      "TM-33 files begin with <IESTM33> or <IESTM33-22>"});
  take_header(child_of(root, {"Header"}), photometry);
  const auto nodes = children_of(root, {"Emitter"});
  if (nodes.empty()) throw InputError({xml.place(root), "the file has no Emitter", "it is incomplete"});
  std::vector<Tm33Emitter> emitters;
  for (const auto node : nodes) emitters.push_back(read_tm33_emitter(xml, node, warnings));
  take_opening(xml, root, nodes, photometry, warnings);
  take_lamps(emitters, photometry);
  photometry.distribution = sum_of(emitters);
  photometry.symmetry = common_symmetry(emitters);
  photometry.spectrum = mixed_spectrum(emitters);

  const IntensityTable table(photometry.distribution);
  photometry.flux_lm = table.flux_lm();
  photometry.max_cd = table.max_cd();
  if (photometry.flux_lm <= 0.0) warnings.push_back({{file_name, 0, 0}, "the luminaire emits no light", ""});
  if (const auto declared = photometry.declared_flux_lm;
      declared && std::abs(photometry.flux_lm / *declared - 1.0) > 0.02)
    warnings.push_back(
        {{file_name, 0, 0},
         fmt::format("intensity integrates to {:.6g} lm but the file declares {:.6g} lm ({:+.1f} %)",
                     photometry.flux_lm, *declared, 100.0 * (photometry.flux_lm / *declared - 1.0)),
         fmt::format("using {:.6g} lm", photometry.flux_lm)});
  return photometry;
}

}  // namespace dim
