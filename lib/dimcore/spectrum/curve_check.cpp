#include "spectrum/curve_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "spectrum/lattice.hpp"

namespace dim {
namespace {

using Points = std::vector<std::pair<double, double>>;

std::optional<CurveFault> unit_fault(const Points& points) {
  const auto [low, high] = std::minmax_element(points.begin(), points.end());
  if (!(low->first > 0.0))
    return CurveFault{static_cast<std::size_t>(low - points.begin()),
                      fmt::format("wavelengths must be greater than 0 nm, not {:.6g}", low->first), ""};
  constexpr double kLargestMicrometres = 20.0, kLeastAngstroms = 2500.0;
  const std::string range = fmt::format("wavelengths run from {:.6g} to {:.6g} nm", low->first, high->first);
  if (high->first < kLargestMicrometres)
    return CurveFault{0, range + ", which no eye sees", "in micrometres? multiply them by 1000"};
  if (low->first > kLeastAngstroms)
    return CurveFault{0, range + ", which no eye sees", "in angstroms? divide them by 10"};
  if (high->first < kVisibleLow_nm || low->first > kVisibleHigh_nm)
    return CurveFault{0,
                      fmt::format("{}, outside the visible range of {:.0f} to {:.0f} nm", range,
                                  kVisibleLow_nm, kVisibleHigh_nm),
                      "give values for visible light"};
  return std::nullopt;
}

std::optional<CurveFault> order_fault(const Points& points) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (points[i + 1].first > points[i].first) continue;
    return CurveFault{i + 1,
                      fmt::format("wavelengths must ascend, {:.6g} nm follows {:.6g} nm", points[i + 1].first,
                                  points[i].first),
                      "sort the points, each wavelength once"};
  }
  return std::nullopt;
}

std::optional<CurveFault> gap_fault(const Points& points) {
  constexpr std::size_t kEnough = 8;
  constexpr double kWide_nm = 20.0, kTimesUsual = 4.0, kNoticeable = 0.02;
  std::vector<double> steps;
  double largest = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    largest = std::max(largest, std::abs(points[i].second));
    if (points[i].first >= kVisibleLow_nm && points[i + 1].first <= kVisibleHigh_nm)
      steps.push_back(points[i + 1].first - points[i].first);
  }
  if (steps.size() + 1 < kEnough) return std::nullopt;
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2), steps.end());
  const double usual_nm = steps[steps.size() / 2];
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const auto& [from, before] = points[i];
    const auto& [to, after] = points[i + 1];
    const bool visible = from >= kVisibleLow_nm && to <= kVisibleHigh_nm;
    if (!visible || to - from <= std::max(kWide_nm, kTimesUsual * usual_nm) ||
        std::abs(after - before) <= kNoticeable * largest)
      continue;
    return CurveFault{
        i,
        fmt::format("no value between {:.6g} and {:.6g} nm, where the points are otherwise {:.6g} "
                    "nm apart",
                    from, to, usual_nm),
        "fill the gap with measured or interpolated values"};
  }
  return std::nullopt;
}

}  // namespace

std::optional<CurveFault> find_fault(const Points& points) {
  if (points.empty()) return CurveFault{0, "there are no points", "write a number or [[nm, value], ...]"};
  if (auto fault = unit_fault(points)) return fault;
  if (points.size() == 1)
    return CurveFault{
        0, "a single point is no spectrum",
        fmt::format("write {:.6g} alone for the same at every wavelength, or more points", points[0].second)};
  if (auto fault = order_fault(points)) return fault;
  return gap_fault(points);
}

}  // namespace dim
