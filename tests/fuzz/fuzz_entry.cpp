// TOML entries: any bytes are read as a fitting and as a surface, or refused with InputError.
#include <cmath>
#include <cstdlib>

#include "database/finish_figures.hpp"
#include "database/fitting_entry.hpp"
#include "database/surface_entry.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    dim::read_fitting_entry(text, "db/fittings/fuzz.toml", "fuzz");
  } catch (const dim::InputError&) {
  }
  try {
    const auto finish = dim::read_surface_entry(text, "db/surfaces/fuzz.toml", "fuzz");
    if (!std::isfinite(dim::finish_xyz(finish, dim::SpectralCurve(1.0)).y)) std::abort();
  } catch (const dim::InputError&) {
  }
  return 0;
}
