#include "database/fitting_entry.hpp"

#include <filesystem>

#include "database/toml_reader.hpp"
#include "spectrum/bands.hpp"
#include "spectrum/named_spectra.hpp"

namespace dim {
namespace {

constexpr NumberRange kFactor{0.0, 1e6, true, false};
constexpr NumberRange kMaintenance{0.0, 1.0, true, false};

}  // namespace

void apply_factors(const FittingEntry& entry, Photometry& photometry) {
  double factor = entry.lamp_factor * entry.maintenance_factor;
  if (entry.lumens && photometry.flux_lm > 0.0) factor *= *entry.lumens / photometry.flux_lm;
  if (factor == 1.0) return;
  for (double& cd : photometry.distribution.intensity_cd) cd *= factor;
  photometry.flux_lm *= factor;
  photometry.max_cd *= factor;
}

void read_spectrum_key(const TomlTable& table, std::optional<SpectralCurve>& spectrum,
                       std::string& spectrum_name, SpectrumNames names) {
  const auto* node = table.node("spectrum");
  if (!node) return;
  if (node->is_string()) {
    const auto name = table.name("spectrum");
    if (!name) return;
    try {
      if (names == SpectrumNames::find) spectrum = find_spectrum(*name);
      spectrum_name = *name;
    } catch (const InputError& error) {
      for (const auto& problem : error.problems()) table.problem("spectrum", problem.what, problem.cure);
    }
    return;
  }
  auto curve = table.curve("spectrum", kNotNegative);
  if (!curve) return;
  if (curve->integral(kVisibleLow_nm, kVisibleHigh_nm) > 0.0)
    spectrum = std::move(curve);
  else
    table.problem("spectrum", "spectrum is zero at every visible wavelength (380..780 nm)");
}

FittingEntry read_fitting_entry(std::string_view text, const std::string& file, const std::string& name,
                                SpectrumNames names) {
  const toml::table root = parse_toml(text, file, {"fitting", 1, false, {}});
  Problems problems;
  TomlContext context{file, problems};
  const TomlTable table(root, "", context);
  FittingEntry entry;
  entry.name = name;
  table.require("file");
  if (const auto named = table.name("file"))
    entry.file = (std::filesystem::path(file).parent_path() / *named).string();
  entry.file_place = table.place("file");
  entry.watts = table.number("watts", kPositive);
  entry.lumens = table.number("lumens", kPositive);
  entry.lamp_factor = table.number_or("lamp_factor", kFactor, 1.0);
  entry.maintenance_factor = table.number_or("maintenance_factor", kMaintenance, 1.0);
  read_spectrum_key(table, entry.spectrum, entry.spectrum_name, names);
  entry.title = table.text("title").value_or("");
  entry.source = table.text("source").value_or("");
  entry.licence = table.text("licence").value_or("");
  for (const char* key : {"dim", "note"}) table.text(key);
  table.refuse_unknown();
  problems.throw_if_any();
  return entry;
}

}  // namespace dim
