#include "spectrum/rendering.hpp"

#include <cmath>
#include <limits>

#include "spectrum/bands.hpp"
#include "spectrum/colour.hpp"
#include "spectrum/observer.hpp"
#include "spectrum/tables/cie_observers.hpp"
#include "spectrum/tables/illuminants.hpp"
#include "spectrum/white.hpp"

namespace dim {
namespace {

constexpr double kDaylightFrom_K = 5000.0;

struct CieUcs {
  double c, d;
};

CieUcs ucs_of(const Vec2& uv) {
  return {(4.0 - uv.x - 10.0 * uv.y) / uv.y, (1.708 * uv.y + 0.404 - 1.481 * uv.x) / uv.y};
}

// CIE 1964 U*, V*, W* of a sample of Y percent beside a white.
Vec3 uvw_of(const Vec2& uv, const Vec2& white, double y_percent) {
  const double w = 25.0 * std::cbrt(y_percent) - 17.0;
  return {13.0 * w * (uv.x - white.x), 13.0 * w * (uv.y - white.y), w};
}

}  // namespace

void LightResponses::add(const LightResponses& other, double factor) {
  power += factor * other.power;
  xyz += factor * other.xyz;
  for (std::size_t i = 0; i < kColourSamples; ++i) samples[i] += factor * other.samples[i];
  melanopic += factor * other.melanopic;
}

LightResponses light_responses(const SpectralCurve& spd, double low_nm, double high_nm) {
  const ObserverTables& eye = cie_1931_tables();
  const auto& samples = cie_colour_samples();
  const FiveNanometreTable melanopic = melanopic_table();
  const LatticeValues power = on_lattice(spd);
  LightResponses sum;
  for (std::size_t i = 0; i < kTableSize; ++i) {
    const double part = power[i] * cell_overlap_nm(i, low_nm, high_nm);
    if (part == 0.0) continue;
    const Vec3 response(eye.x[i], eye.y[i], eye.z[i]);
    sum.power += part;
    sum.xyz += part * response;
    for (std::size_t k = 0; k < kColourSamples; ++k) sum.samples[k] += part * samples[k][i] * response;
    sum.melanopic += part * melanopic[i];
  }
  return sum;
}

LightResponses light_responses(const SpectralCurve& spd) {
  return light_responses(spd, kVisibleLow_nm, kVisibleHigh_nm);
}

ColourRendering colour_rendering(const LightResponses& light) {
  return colour_rendering(light, white_point(light.xyz).cct_K);
}

ColourRendering colour_rendering(const LightResponses& light, double cct_K) {
  ColourRendering result;
  if (!(cct_K <= kHottestDaylight_K)) {
    result.ra = std::numeric_limits<double>::quiet_NaN();
    result.r.fill(result.ra);
    return result;
  }
  const LightResponses reference =
      light_responses(cct_K < kDaylightFrom_K ? blackbody(cct_K) : cie_daylight(cct_K));
  const Vec2 white = uv_1960_of(reference.xyz);
  const CieUcs from = ucs_of(uv_1960_of(light.xyz)), to = ucs_of(white);
  constexpr std::size_t kInRa = 8;
  for (std::size_t i = 0; i < kColourSamples; ++i) {
    const CieUcs sample = ucs_of(uv_1960_of(light.samples[i]));
    // CIE 13.3 eq. 7: von Kries adaptation to the reference.
    const double c = to.c / from.c * sample.c, d = to.d / from.d * sample.d;
    const double scale = 16.518 + 1.481 * c - d;
    const Vec2 adapted((10.872 + 0.404 * c - 4.0 * d) / scale, 5.520 / scale);
    const Vec3 seen = uvw_of(adapted, white, 100.0 * light.samples[i].y / light.xyz.y);
    const Vec3 wanted =
        uvw_of(uv_1960_of(reference.samples[i]), white, 100.0 * reference.samples[i].y / reference.xyz.y);
    result.r[i] = 100.0 - 4.6 * glm::length(seen - wanted);
    if (i < kInRa) result.ra += result.r[i] / kInRa;
  }
  return result;
}

double melanopic_efficacy_of_daylight_W_lm() {
  static const double efficacy = [] {
    const LightResponses d65 = light_responses(curve_of(standard_illuminants()[4].values));
    return d65.melanopic / (kMaxEfficacy_lm_W * d65.xyz.y);
  }();
  return efficacy;
}

}  // namespace dim
