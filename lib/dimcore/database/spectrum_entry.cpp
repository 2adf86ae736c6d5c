#include "database/spectrum_entry.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/input_file.hpp"
#include "database/entry_text.hpp"
#include "database/spectrum_csv.hpp"
#include "database/toml_reader.hpp"
#include "photometry/text_scanner.hpp"
#include "photometry/tm33.hpp"
#include "photometry/xml_document.hpp"
#include "spectrum/bands.hpp"
#include "spectrum/curve_check.hpp"
#include "spectrum/named_spectra.hpp"

namespace dim {
namespace {

bool has_light(const SpectralCurve& curve) { return curve.integral(kVisibleLow_nm, kVisibleHigh_nm) > 0.0; }

// A curve is constant beyond its ends; a light source that is not listed there has no light there.
SpectralCurve ended(std::vector<std::pair<double, double>> points) {
  constexpr double kStep_nm = 1e-3;
  if (points.front().second > 0.0) points.insert(points.begin(), {points.front().first - kStep_nm, 0.0});
  if (points.back().second > 0.0) points.emplace_back(points.back().first + kStep_nm, 0.0);
  return SpectralCurve(std::move(points));
}

SpectralCurve tm27_power(const XmlDocument& xml, const std::string& file) {
  const auto block = child_of(xml.root(), {"SpectralDistribution"});
  std::vector<std::pair<double, double>> points;
  for (const auto node : children_of(block, {"SpectralData"})) {
    const double nm = xml.number_in(node, attribute_of(node, {"wavelength"}), "wavelength", {1, 1e5});
    points.emplace_back(
        nm, std::max(0.0, xml.number_in(node, trimmed(node.text().get()), "spectral power", {-1e30, 1e30})));
  }
  std::sort(points.begin(), points.end());
  if (points.empty())
    throw InputError(
        {xml.place(xml.root()), "no SpectralData is listed in " + file, "the file is incomplete"});
  if (const auto fault = find_fault(points)) throw InputError({xml.place(block), fault->what, fault->cure});
  return ended(std::move(points));
}

SpectrumEntry of_xml(std::string_view text, const std::string& file) {
  const XmlDocument xml(photometric_text(text, file), file);
  SpectrumEntry entry;
  if (local_name(xml.root()).starts_with("IESTM27")) {
    const auto header = child_of(xml.root(), {"Header"});
    entry.title = text_of(header, {"Description"});
    entry.source = text_of(header, {"Manufacturer"});
    entry.power = tm27_power(xml, file);
    return entry;
  }
  Warnings warnings;
  const Photometry photometry = read_tm33(text, file, warnings);
  if (!photometry.spectrum)
    throw InputError({xml.place(xml.root()), "the file has no spectrum that can be used",
                      warnings.empty() ? "" : warnings.front().what});
  entry.title = photometry.keyword("LUMINAIRE");
  entry.source = photometry.keyword("MANUFAC");
  entry.power = *photometry.spectrum;
  return entry;
}

SpectrumEntry of_columns(std::string_view text, const std::string& file, std::size_t column) {
  const SpectrumTable table = read_spectrum_csv(text, file, WavelengthUnit::found, ValueUnit::relative);
  if (column >= table.curves.size())
    throw InputError(
        {{file, 0, 0},
         fmt::format("{} columns of values where {} are needed", table.curves.size(), column + 1),
         "see --column"});
  SpectrumEntry entry;
  entry.title = table.names[column];
  const auto& points = table.curves[column].points();
  if (const auto fault = find_fault(points)) throw InputError({{file, 0, 0}, fault->what, fault->cure});
  entry.power = ended(points);
  return entry;
}

}  // namespace

SpectrumEntry read_spectrum_entry(std::string_view text, const std::string& file, const std::string& name) {
  const toml::table root = parse_toml(text, file, {"spectrum", 1, false, {}});
  Problems problems;
  TomlContext context{file, problems};
  const TomlTable table(root, "", context);
  SpectrumEntry entry;
  entry.name = name;
  table.require("power");
  if (auto curve = table.curve("power", kNotNegative)) {
    if (has_light(*curve))
      entry.power = std::move(*curve);
    else
      table.problem("power", "power is zero at every visible wavelength (380..780 nm)");
  }
  entry.title = table.text("title").value_or("");
  entry.source = table.text("source").value_or("");
  entry.licence = table.text("licence").value_or("");
  entry.note = table.text("note").value_or("");
  table.text("dim");
  table.refuse_unknown();
  problems.throw_if_any();
  return entry;
}

std::string spectrum_entry_text(const SpectrumEntry& entry) {
  std::string text = "dim = \"spectrum/1\"\n";
  const auto append = [&](const char* key, const std::string& value) {
    if (!value.empty()) text += fmt::format("{} = {}\n", key, toml_quoted(value));
  };
  append("title", entry.title);
  text += "power = " + toml_curve(entry.power) + "\n";
  append("source", entry.source);
  append("licence", entry.licence);
  append("note", entry.note);
  return text;
}

SpectrumEntry read_lamp_spectrum(std::string_view text, const std::string& file, std::size_t column) {
  SpectrumEntry entry = is_xml(text) ? of_xml(text, file) : of_columns(text, file, column);
  if (!has_light(entry.power))
    throw InputError({{file, 0, 0}, "the spectrum has no visible light (380..780 nm)", ""});
  return entry;
}

SpectrumFinder built_in_spectra() {
  return [](const std::string& name) { return find_spectrum(name); };
}

SpectrumFinder spectrum_finder(const DatabaseSearch& search) {
  return [&search](const std::string& name) {
    try {
      return find_spectrum(name);
    } catch (const InputError& unknown) {
      if (const auto path = search.find(kSpectra, name))
        return read_spectrum_entry(read_text_file(*path, kMaxTomlBytes), *path, name).power;
      auto problem = unknown.problems().front();
      const std::string near = did_you_mean(name, search.names(kSpectra));
      if (!near.empty()) problem.cure = near;
      throw InputError(std::move(problem));
    }
  };
}

}  // namespace dim
