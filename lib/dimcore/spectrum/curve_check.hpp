#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dim {

/// What is wrong with the points of a curve as a person or an instrument wrote them.
struct CurveFault {
  std::size_t point = 0;  ///< index of the point at fault
  std::string what;       ///< "wavelengths must ascend, 500 nm follows 510 nm"
  std::string cure;
};

/// The first fault of the wavelengths, none where they make a curve. Faults: no point or a single one; not
/// positive; micrometres or angstroms in place of nanometres; not ascending; none within 380..780 nm; a gap:
/// among at least 8 points within that range, a step of more than 20 nm and 4 times the usual one over which
/// the value changes by more than 2 % of the largest.
/// @param points  {nm, value}, finite
std::optional<CurveFault> find_fault(const std::vector<std::pair<double, double>>& points);

}  // namespace dim
