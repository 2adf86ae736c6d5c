#include "database/spectrum_text.hpp"

#include "database/toml_reader.hpp"
#include "spectrum/lattice.hpp"

namespace dim {

SpectralCurve read_spectrum_text(const std::string& text) {
  const toml::table root = parse_toml("spectrum = " + text, "", {"fitting", 1, false, {}});
  Problems problems;
  TomlContext context{"", problems};
  const TomlTable table(root, "", context);
  const auto curve = table.curve("spectrum", kNotNegative);
  table.refuse_unknown();
  if (curve && !(curve->integral(kVisibleLow_nm, kVisibleHigh_nm) > 0.0))
    table.problem("spectrum", "spectrum is zero at every visible wavelength (380..780 nm)");
  problems.throw_if_any();
  return *curve;
}

}  // namespace dim
