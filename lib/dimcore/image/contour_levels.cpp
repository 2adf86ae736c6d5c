#include "image/contour_levels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace dim {
namespace {

constexpr std::size_t kFewest = 4, kMost = 12;
constexpr double kRounding = 1e-9;
constexpr double kDecades = 0.01;  // what is darker than that part of the greatest is deep shadow: no lines

std::vector<double> series_between(std::span<const double> mantissas, double least, double greatest) {
  std::vector<double> levels;
  const double low = std::max(least, kDecades * greatest);
  const int first = static_cast<int>(std::floor(std::log10(low))),
            last = static_cast<int>(std::floor(std::log10(greatest)));
  for (int decade = first; decade <= last; ++decade) {
    for (const double mantissa : mantissas) {
      const double level =
          decade < 0 ? mantissa / std::pow(10.0, -decade) : mantissa * std::pow(10.0, decade);
      if (level > low && level < greatest) levels.push_back(level);
    }
  }
  return levels;
}

// Multiples of 1, 2 or 5 times a power of ten.
std::vector<double> steps_between(double least, double greatest) {
  const double span = greatest - least, power = std::pow(10.0, std::floor(std::log10(span)));
  constexpr double kWanted = 8.0;
  double step = power;
  for (const double factor : {0.1, 0.2, 0.5, 1.0}) {
    step = factor * power;
    if (span / step <= kWanted) break;
  }
  std::vector<double> levels;
  for (double i = std::floor(least / step); i * step < greatest; ++i) {
    const double level = step < 1.0 ? i / std::round(1.0 / step) : i * step;
    if (level > least && level < greatest) levels.push_back(level);
  }
  return levels;
}

}  // namespace

std::vector<double> customary_levels(double least, double greatest) {
  if (!(greatest - least > kRounding * std::max(std::abs(least), std::abs(greatest)))) return {};
  if (greatest <= 0.0) return steps_between(least, greatest);
  constexpr std::array<double, 6> kAll = {1.0, 1.5, 2.0, 3.0, 5.0, 7.5};
  constexpr std::array<double, 3> kSome = {1.0, 2.0, 5.0};
  auto levels = series_between(kAll, least, greatest);
  if (levels.size() < kFewest) return steps_between(least, greatest);
  if (levels.size() > kMost) levels = series_between(kSome, least, greatest);
  return levels;
}

std::vector<Rgb8> band_colours(std::size_t n_levels) {
  constexpr double kPaperShare = 0.42;
  std::vector<Rgb8> colours;
  for (std::size_t band = 0; band <= n_levels; ++band) {
    Rgb8 colour = colour_map(n_levels == 0 ? 0.5 : static_cast<double>(band) / static_cast<double>(n_levels));
    for (auto& c : colour) c = static_cast<std::uint8_t>(std::lround(c + kPaperShare * (255 - c)));
    colours.push_back(colour);
  }
  return colours;
}

}  // namespace dim
