#pragma once

#include <limits>
#include <string>
#include <vector>

#include "database/fitting_entry.hpp"
#include "database/search.hpp"
#include "dimdbm/entries.hpp"

namespace dim {

struct EntryName {
  std::string kind;  ///< of kKinds
  std::string name;
  std::string path;  ///< empty: a spectrum that DIM knows by itself
};

/// All entries of a kind, or of every one for "all".
/// @param built_in  also the spectra that DIM knows by itself
std::vector<EntryName> entries_of(const DatabaseSearch& search, const std::string& kind_wanted,
                                  bool built_in);

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// What list and check say of an entry; NaN and empty where a figure does not apply.
struct EntryLine {
  std::string kind;  ///< fitting, opaque, glazing, spectrum; surface where it cannot be read
  std::string colour, spectrum_name, source;
  std::string problem;  ///< why it cannot be read, or what check finds
  double flux_lm = kNone, max_cd = kNone, watts = kNone, cct_K = kNone;
  double share = kNone;  ///< luminous reflectance or transmittance
};

/// Reads all entries, several at once; an entry that cannot be read has a problem in place of figures.
/// @param search   where entries' spectra are looked for
/// @param checked  looks for what check looks for
std::vector<EntryLine> read_lines(const std::vector<EntryName>& entries, const DatabaseSearch& search,
                                  bool checked);

/// The name of an entry's spectrum, "table" or "equal energy".
std::string spectrum_words(const FittingEntry& entry);

/// Correlated colour temperature, K; NaN where there is none.
double cct_of(const SpectralCurve& spectrum);

}  // namespace dim
