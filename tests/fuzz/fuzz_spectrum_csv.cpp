// Spectra in CSV: what is read lies in 0..1 over ascending wavelengths.
#include <cstdlib>

#include "database/spectrum_csv.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    for (const auto& curve : dim::read_spectrum_csv(text, "fuzz.csv").curves)
      if (!(curve.min() >= 0.0 && curve.max() <= 1.0)) std::abort();
  } catch (const dim::InputError&) {
  }
  return 0;
}
