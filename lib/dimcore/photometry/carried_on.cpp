#include "photometry/carried_on.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dim {
namespace {

constexpr double kSame_deg = 1e-6;

bool lit(const std::vector<double>& intensity_cd, std::size_t n_gamma, std::size_t at) {
  for (std::size_t i = at; i < intensity_cd.size(); i += n_gamma)
    if (intensity_cd[i] > 0.0) return true;
  return false;
}

// Repeats the value at `from` of every plane, before or behind it.
void repeat(std::vector<double>& intensity_cd, std::size_t n_gamma, std::size_t from, bool behind) {
  std::vector<double> wider;
  wider.reserve(intensity_cd.size() / n_gamma * (n_gamma + 1));
  for (auto row = intensity_cd.begin(); row != intensity_cd.end();
       row += static_cast<std::ptrdiff_t>(n_gamma)) {
    if (!behind) wider.push_back(row[static_cast<std::ptrdiff_t>(from)]);
    wider.insert(wider.end(), row, row + static_cast<std::ptrdiff_t>(n_gamma));
    if (behind) wider.push_back(row[static_cast<std::ptrdiff_t>(from)]);
  }
  intensity_cd = std::move(wider);
}

}  // namespace

void carry_on_to_hemispheres(std::vector<double>& gamma_deg, std::vector<double>& intensity_cd,
                             const Place& place, Warnings& warnings) {
  const double first = gamma_deg.front(), last = gamma_deg.back();
  const double begin = first < 90.0 - kSame_deg ? 0.0 : 90.0;
  const double end = last > 90.0 + kSame_deg ? 180.0 : 90.0;
  const auto warn = [&](const char* what, double angle, double to) {
    warnings.push_back(
        {place,
         fmt::format(
             "vertical angles {} at {:g} with light left: nothing is known from there to {:g} degrees", what,
             angle, to),
         "the nearest values are carried on"});
  };
  if (first > begin + kSame_deg && lit(intensity_cd, gamma_deg.size(), 0)) {
    warn("begin", first, begin);
    repeat(intensity_cd, gamma_deg.size(), 0, false);
    gamma_deg.insert(gamma_deg.begin(), begin);
  }
  if (last < end - kSame_deg && lit(intensity_cd, gamma_deg.size(), gamma_deg.size() - 1)) {
    warn("end", last, end);
    repeat(intensity_cd, gamma_deg.size(), gamma_deg.size() - 1, true);
    gamma_deg.push_back(end);
  }
}

}  // namespace dim
