#include "scene/fitting_shelf.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/input_file.hpp"
#include "database/fitting_entry.hpp"
#include "photometry/photometry_file.hpp"

namespace dim {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFormatCure = "give an IES LM-63 (.ies), EULUMDAT (.ldt) or TM-33 (.xml) file";

}  // namespace

FileLoader load_from_disk() {
  return [](const std::string& path) { return read_text_file(path, kMaxPhotometryBytes); };
}

FittingShelf::FittingShelf(std::string folder, const DatabaseSearch& search, const FileLoader& load,
                           Problems& problems, Warnings& warnings)
    : folder_(std::move(folder)), search_(search), load_(load), spectra_(spectrum_finder(search)), problems_(problems), warnings_(warnings) {}

int FittingShelf::add(const std::string& key, Fitting fitting) {
  fittings_.push_back(std::move(fitting));
  const int i = static_cast<int>(fittings_.size()) - 1;
  index_[key] = i;
  return i;
}

int FittingShelf::find(const std::string& name, const std::string& asker, const Place& place) {
  const auto known = index_.find(name);
  if (known != index_.end()) return known->second;
  auto fitting = read(name, asker, place);
  if (fitting) return add(name, std::move(*fitting));
  return index_[name] = -1;
}

int FittingShelf::ideal(const std::string& kind) {
  const std::string key = "ideal " + kind;
  const auto known = index_.find(key);
  if (known != index_.end()) return known->second;
  auto intensity = kind == "isotropic" ? IntensityTable::isotropic(1.0) : IntensityTable::lambertian(1.0);
  const double flux_lm = intensity.flux_lm();
  return add(key, {kind, std::move(intensity), {}, flux_lm, SpectralCurve(1.0), false, "", 0.0, {}});
}

int FittingShelf::with_spectrum(int fitting, const std::string& key, const SpectralCurve& spectrum,
                                const std::string& spectrum_name) {
  const std::string whole_key = fmt::format("{} spectrum {}", fitting, key);
  const auto known = index_.find(whole_key);
  if (known != index_.end()) return known->second;
  Fitting copy = (*this)[fitting];
  copy.has_spectrum = true;
  copy.spectrum = spectrum;
  copy.spectrum_name = spectrum_name;
  return add(whole_key, std::move(copy));
}

std::optional<Fitting> FittingShelf::read(const std::string& name, const std::string& asker,
                                          const Place& place) {
  if (is_photometric_name(name))
    return read_file(name, (fs::path(folder_) / name).string(), nullptr, asker, place);
  if (const auto path = search_.find_fitting(name)) return read_entry(name, *path);
  if (const auto foreign = foreign_format(name); !foreign.what.empty()) {
    problems_.add(place, fmt::format("{}: '{}' is {}", asker, name, foreign.what), foreign.cure);
    return std::nullopt;
  }
  problems_.add(place, fmt::format("{}: no fitting '{}' in {}", asker, name, search_.places("fittings")),
                did_you_mean(name, search_.names("fittings")));
  return std::nullopt;
}

std::optional<Fitting> FittingShelf::read_entry(const std::string& name, const std::string& path) {
  try {
    const FittingEntry entry = read_fitting_entry(load_(path), path, name, spectra_);
    auto fitting = read_file(name, entry.file, &entry, fmt::format("fitting '{}'", name), entry.file_place);
    if (!fitting) return std::nullopt;
    if (entry.spectrum) {
      fitting->spectrum = *entry.spectrum;
      fitting->has_spectrum = true;
      fitting->spectrum_name = entry.spectrum_name;
    }
    if (entry.watts) fitting->watts = *entry.watts;
    fitting->in_use_factor = entry.in_use_factor();
    fitting->maintenance_factor = entry.maintenance_factor;
    return fitting;
  } catch (const InputError& error) {
    pass_on(error);
  } catch (const IoError& error) {
    problems_.add({path, 0, 0}, error.what());
  }
  return std::nullopt;
}

std::optional<Fitting> FittingShelf::read_file(const std::string& name, const std::string& path,
                                               const FittingEntry* entry, const std::string& asker,
                                               const Place& place) {
  if (!is_photometric_name(path)) {
    const auto foreign = foreign_format(path);
    problems_.add(place,
                  fmt::format("{}: '{}' is {}", asker, path,
                              foreign.what.empty() ? "not an .ies, .ldt or .xml file" : foreign.what),
                  foreign.what.empty() ? kFormatCure : foreign.cure);
    return std::nullopt;
  }
  try {
    const auto beside = [&](const std::string& tilt) {
      return load_((fs::path(path).parent_path() / tilt).string());
    };
    Photometry photometry = read_photometry(load_(path), path, warnings_, beside);
    if (entry) apply_factors(*entry, photometry);
    IntensityTable intensity(photometry.distribution);
    const double flux_lm = intensity.flux_lm();
    return Fitting{name,
                   std::move(intensity),
                   photometry.opening,
                   flux_lm,
                   photometry.spectrum.value_or(SpectralCurve(1.0)),
                   photometry.spectrum.has_value(),
                   "",
                   photometry.watts.value_or(0),
                   photometry.tilt,
                   1.0};
  } catch (const InputError& error) {
    pass_on(error);
  } catch (const IoError& error) {
    problems_.add(place, fmt::format("{}: {}", asker, error.what()));
  }
  return std::nullopt;
}

void FittingShelf::pass_on(const InputError& error) {
  for (const auto& problem : error.problems()) problems_.add(problem.place, problem.what, problem.cure);
}

}  // namespace dim
