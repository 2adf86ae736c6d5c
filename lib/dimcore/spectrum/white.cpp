#include "spectrum/white.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "spectrum/colour.hpp"
#include "spectrum/lattice.hpp"
#include "spectrum/tables/cie_observers.hpp"
#include "spectrum/tables/illuminants.hpp"

namespace dim {
namespace {

constexpr double kReference_nm = 560.0;
constexpr double kLocusStep = 1.01;  // between neighbouring temperatures of the table
constexpr std::size_t kLocusSize = 465;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Planck's law but for its constant: from 1000 K on its exponent stays below 40.
double planck(double nm, double temperature_K) {
  const double m = nm * 1e-9;
  return std::pow(kReference_nm / nm, 5) / std::expm1(kSecondRadiationConstant_m_K / (m * temperature_K));
}

// The 1931 observer divided by the fifth power of each wavelength: what Planck's law is summed with.
struct LocusTerm {
  double c2_over_m_K;
  Vec3 xyz;
};

const std::vector<LocusTerm>& locus_terms() {
  static const std::vector<LocusTerm> terms = [] {
    std::vector<LocusTerm> all;
    const auto add = [&](double nm, const Vec3& xyz) {
      all.push_back({kSecondRadiationConstant_m_K / (nm * 1e-9), xyz * std::pow(kReference_nm / nm, 5)});
    };
    const ObserverTables& eye = cie_1931_tables();
    for (std::size_t i = 0; i < kTableSize; ++i) add(lattice_nm(i), {eye.x[i], eye.y[i], eye.z[i]});
    for (const auto& [nm, x, y, z] : cie_1931_outer()) add(nm, {x, y, z});
    return all;
  }();
  return terms;
}

Vec2 locus_uv(double temperature_K) {
  Vec3 xyz(0.0);
  for (const auto& term : locus_terms()) xyz += term.xyz / std::expm1(term.c2_over_m_K / temperature_K);
  return uv_1960_of(xyz);
}

const std::array<Vec2, kLocusSize>& locus() {
  static const auto table = [] {
    std::array<Vec2, kLocusSize> uv;
    for (std::size_t k = 0; k < kLocusSize; ++k)
      uv[k] = locus_uv(kCoolestWhite_K * std::pow(kLocusStep, static_cast<double>(k)));
    return uv;
  }();
  return table;
}

// Minimum of the distance over ln T by golden section.
double nearest_temperature_K(const Vec2& uv, double low_K, double high_K) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr double kPrecision = 1e-6;
  double a = std::log(low_K), b = std::log(high_K);
  const auto distance = [&](double log_K) { return glm::length(uv - locus_uv(std::exp(log_K))); };
  double c = b - kGolden * (b - a), d = a + kGolden * (b - a);
  double at_c = distance(c), at_d = distance(d);
  while (b - a > kPrecision) {
    if (at_c < at_d) {
      b = d, d = c, at_d = at_c;
      at_c = distance(c = b - kGolden * (b - a));
    } else {
      a = c, c = d, at_c = at_d;
      at_d = distance(d = a + kGolden * (b - a));
    }
  }
  return std::exp((a + b) / 2.0);
}

}  // namespace

SpectralCurve blackbody(double temperature_K) {
  const double reference = planck(kReference_nm, temperature_K);
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < kTableSize; ++i)
    points.emplace_back(lattice_nm(i), planck(lattice_nm(i), temperature_K) / reference);
  return SpectralCurve(std::move(points));
}

SpectralCurve cie_daylight(double cct_K) {
  // CIE 15, section 4.1.2.
  const double t = 1000.0 / cct_K;
  const double x = cct_K <= 7000.0 ? 0.244063 + t * (0.09911 + t * (2.9678 - t * 4.6070))
                                   : 0.237040 + t * (0.24748 + t * (1.9018 - t * 2.0064));
  const double y = -3.000 * x * x + 2.870 * x - 0.275;
  const double m = 0.0241 + 0.2562 * x - 0.7341 * y;
  const double m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / m;
  const double m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / m;
  const DaylightBasis basis = daylight_basis();
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < kTableSize; ++i)
    points.emplace_back(lattice_nm(i), basis.s0[i] + m1 * basis.s1[i] + m2 * basis.s2[i]);
  return SpectralCurve(std::move(points));
}

WhitePoint white_point(const Vec3& xyz) {
  const Vec2 uv = uv_1960_of(xyz);
  if (!std::isfinite(uv.x)) return {kNaN, kNaN};
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::max();
  for (std::size_t k = 0; k < kLocusSize; ++k) {
    const double distance = glm::length(uv - locus()[k]);
    if (distance < least) least = distance, nearest = k;
  }
  const double table_K = kCoolestWhite_K * std::pow(kLocusStep, static_cast<double>(nearest));
  const double cct_K = nearest_temperature_K(uv, std::max(kCoolestWhite_K, table_K / kLocusStep),
                                             std::min(kHottestWhite_K, table_K * kLocusStep));
  const Vec2 foot = locus_uv(cct_K);
  // The locus runs with u falling as it gets hotter, so "above" is decided along its normal; for whites that
  // is the side of greater v.
  const double duv = std::copysign(glm::length(uv - foot), uv.y - foot.y);
  constexpr double kEnd = 1e-4;
  const bool beyond = cct_K < kCoolestWhite_K * (1.0 + kEnd) || cct_K > kHottestWhite_K * (1.0 - kEnd);
  return {beyond || std::abs(duv) > kLargestDuv ? kNaN : cct_K, duv};
}

}  // namespace dim
