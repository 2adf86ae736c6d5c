#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "database/fitting_entry.hpp"
#include "database/search.hpp"
#include "scene/lights.hpp"

namespace dim {

/// Gives the bytes of a file. May throw any Error.
using FileLoader = std::function<std::string(const std::string& path)>;

FileLoader load_from_disk();

/// The fittings that a lights file uses, each read once.
class FittingShelf {
 public:
  /// @param folder  that paths of photometric files are relative to
  FittingShelf(std::string folder, const DatabaseSearch& search, const FileLoader& load, Problems& problems,
               Warnings& warnings);

  /// Index of a database entry, or of a path ending in .ies or .ldt; -1 where it cannot be had, which is
  /// reported the first time it is asked for.
  /// @param asker  "luminaire 'A1'" for messages
  int find(const std::string& name, const std::string& asker, const Place& place);

  /// Index of the ideal source "isotropic" or "lambertian" of 1 cd.
  int ideal(const std::string& kind);

  /// Index of the same fitting with another spectrum; `key` tells spectra apart.
  int with_spectrum(int fitting, const std::string& key, const SpectralCurve& spectrum,
                    const std::string& spectrum_name);

  /// Finds the spectra of names, as the fittings' entries do.
  const SpectrumFinder& spectra() const { return spectra_; }

  const Fitting& operator[](int i) const { return fittings_[static_cast<std::size_t>(i)]; }
  std::vector<Fitting> take() { return std::move(fittings_); }

 private:
  int add(const std::string& key, Fitting fitting);
  std::optional<Fitting> read(const std::string& name, const std::string& asker, const Place& place);
  std::optional<Fitting> read_entry(const std::string& name, const std::string& path);
  std::optional<Fitting> read_file(const std::string& name, const std::string& path,
                                   const FittingEntry* entry, const std::string& asker, const Place& place);
  void pass_on(const InputError& error);

  std::string folder_;
  const DatabaseSearch& search_;
  const FileLoader& load_;
  SpectrumFinder spectra_;
  Problems& problems_;
  Warnings& warnings_;
  std::vector<Fitting> fittings_;
  std::map<std::string, int> index_;
};

}  // namespace dim
