#include "database/fitting_entry.hpp"

#include <filesystem>

#include "database/toml_reader.hpp"
#include "spectrum/bands.hpp"

namespace dim {
namespace {

constexpr NumberRange kFactor{0.0, 1e6, true, false};
constexpr NumberRange kMaintenance{0.0, 1.0, true, false};

}  // namespace

void scale(Photometry& photometry, double factor) {
  if (factor == 1.0) return;
  for (double& cd : photometry.distribution.intensity_cd) cd *= factor;
  photometry.flux_lm *= factor;
  photometry.max_cd *= factor;
}

void apply_lumens(const FittingEntry& entry, Photometry& photometry) {
  if (entry.lumens && photometry.flux_lm > 0.0) scale(photometry, *entry.lumens / photometry.flux_lm);
}

void apply_factors(const FittingEntry& entry, Photometry& photometry) {
  apply_lumens(entry, photometry);
  scale(photometry, entry.in_use_factor());
}

void read_spectrum_key(const TomlTable& table, std::optional<SpectralCurve>& spectrum,
                       std::string& spectrum_name, const SpectrumFinder& spectra) {
  const auto* node = table.node("spectrum");
  if (!node) return;
  if (node->is_string()) {
    const auto name = table.name("spectrum");
    if (!name) return;
    try {
      if (spectra) spectrum = spectra(*name);
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
                                const SpectrumFinder& spectra) {
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
  read_spectrum_key(table, entry.spectrum, entry.spectrum_name, spectra);
  entry.title = table.text("title").value_or("");
  entry.source = table.text("source").value_or("");
  entry.licence = table.text("licence").value_or("");
  for (const char* key : {"dim", "note"}) table.text(key);
  table.refuse_unknown();
  problems.throw_if_any();
  return entry;
}

}  // namespace dim
