#pragma once

#include <cmath>
#include <cstdlib>
#include <string_view>

#include "photometry/photometry_file.hpp"
#include "photometry/photometry_writer.hpp"

namespace dim {

/// Stops the fuzzer where a file is read wrongly.
template <class Read>
void check_reading(Read&& read) {
  Warnings warnings;
  Photometry photometry;
  try {
    photometry = read(warnings);
  } catch (const InputError& error) {
    for (const auto& problem : error.problems())
      if (problem.what.empty() || problem.what.find('\n') != std::string::npos) std::abort();
    return;
  }
  const auto sane = [](const Photometry& p) {
    return std::isfinite(p.flux_lm) && p.flux_lm >= 0.0 && std::isfinite(p.max_cd);
  };
  if (!sane(photometry)) std::abort();
  try {
    const Photometry again = read_photometry(ies_text(photometry), "again.ies", warnings);
    // Angles closer than the ten digits written may fall together; those files are refused above.
    if (!sane(again)) std::abort();
    if (std::abs(again.flux_lm - photometry.flux_lm) > 1e-4 * photometry.flux_lm + 1e-9) std::abort();
  } catch (const InputError&) {
  }
  try {
    eulumdat_text(photometry, warnings);
  } catch (const InputError&) {
  }
}

}  // namespace dim
