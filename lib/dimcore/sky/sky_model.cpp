#include "sky/sky_model.hpp"

#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "sky/sky_integral.hpp"

namespace dim {
namespace {

// CIE S 011:2003, table 1: a, b of the gradation, c, d, e of the indicatrix.
constexpr std::array<std::array<double, 5>, 15> kCie = {{{4.0, -0.70, 0, -1.0, 0.00},
                                                         {4.0, -0.70, 2, -1.5, 0.15},
                                                         {1.1, -0.80, 0, -1.0, 0.00},
                                                         {1.1, -0.80, 2, -1.5, 0.15},
                                                         {0.0, -1.00, 0, -1.0, 0.00},
                                                         {0.0, -1.00, 2, -1.5, 0.15},
                                                         {0.0, -1.00, 5, -2.5, 0.30},
                                                         {0.0, -1.00, 10, -3.0, 0.45},
                                                         {-1.0, -0.55, 2, -1.5, 0.15},
                                                         {-1.0, -0.55, 5, -2.5, 0.30},
                                                         {-1.0, -0.55, 10, -3.0, 0.45},
                                                         {-1.0, -0.32, 10, -3.0, 0.45},
                                                         {-1.0, -0.32, 16, -3.0, 0.30},
                                                         {-1.0, -0.15, 16, -3.0, 0.30},
                                                         {-1.0, -0.15, 24, -2.8, 0.15}}};

// Perez, Seals & Michalsky 1993 ("All-weather model for sky luminance distribution", Solar Energy 50), table
// 1, as in Radiance's gendaylit: x1..x4 of a, b, c, d, e by clearness bin.
constexpr std::array<std::array<double, 20>, 8> kPerez = {
    {{1.3525, -0.2576, -0.269, -1.4366, -0.767, 0.0007, 1.2734, -0.1233, 2.8,     0.6004,
      1.2375, 1,       1.8734, 0.6297,  0.9738, 0.2809, 0.0356, -0.1246, -0.5718, 0.9938},
     {-1.2219, -0.773,  1.4148,  1.1016,  -0.2054, 0.0367, -3.9128, 0.9156, 6.975,  0.1774,
      6.4477,  -0.1239, -1.5798, -0.5081, -1.7812, 0.108,  0.2624,  0.0672, -0.219, -0.4285},
     {-1.1,  -0.2515, 0.8952, 0.0156, 0.2782, -0.1812, -4.5,    1.1766, 24.7219, -13.0812,
      -37.7, 34.8438, -5,     1.5218, 3.9229, -2.6204, -0.0156, 0.1597, 0.4199,  -0.5562},
     {-0.5484, -0.6654, -0.2672, 0.7117, 0.7234, -0.6219, -5.6812, 2.6297,  33.3389, -18.3,
      -62.25,  52.0781, -3.5,    0.0016, 1.1477, 0.1062,  0.4659,  -0.3296, -0.0876, -0.0329},
     {-0.6,     -0.3566, -2.5, 2.325,   0.2937, 0.0496, -5.6812, 1.8415, 21,      -4.7656,
      -21.5906, 7.2492,  -3.5, -0.1554, 1.4062, 0.3988, 0.0032,  0.0766, -0.0656, -0.1294},
     {-1.0156, -0.367, 1.0078, 1.4051,  0.2875, -0.5328, -3.85,   3.375,  14,     -0.9999,
      -7.1406, 7.5469, -3.4,   -0.1078, -1.075, 1.5702,  -0.0672, 0.4016, 0.3017, -0.4844},
     {-1,     0.0211,  0.5025, -0.5119, -0.3,   0.1922, 0.7023, -1.6317, 19,      -5,
      1.2438, -1.9094, -4,     0.025,   0.3844, 0.2656, 1.0468, -0.3788, -2.4517, 1.4656},
     {-1.05,    0.0289, 0.426,   0.359, -0.325, 0.1156, 0.7781, 0.0025,  31.0625, -14.5,
      -46.1148, 55.375, -7.2312, 0.405, 13.35,  0.6234, 1.5,    -0.6426, 1.8564,  0.5636}}};

}  // namespace

SkyModel SkyModel::uniform() { return {}; }

SkyModel SkyModel::overcast() {
  SkyModel model;
  model.form_ = Form::overcast;
  return model;
}

SkyModel SkyModel::cie(int type) {
  if (type < 1 || type > 15) throw InternalError("CIE skies are numbered 1..15");
  const auto& k = kCie[static_cast<std::size_t>(type - 1)];
  SkyModel model;
  model.a_ = k[0];
  model.b_ = k[1];
  model.c_ = k[2];
  model.d_ = k[3];
  model.e_ = k[4];
  model.k_ = 1.0 - k[2] * std::exp(0.5 * kPi * k[3]);
  return model;
}

SkyModel SkyModel::perez(const SkyClearness& state, double sun_zenith_rad) {
  const int bin = clearness_bin(state.clearness);
  const auto& k = kPerez[static_cast<std::size_t>(bin)];
  // Of b in bins 2 to 5 the source says nothing below 0.2; the horizon would go dark.
  const double delta = bin >= 1 && bin <= 4 ? std::max(0.2, state.brightness) : state.brightness;
  const auto law = [&](std::size_t i) {
    return k[i] + k[i + 1] * sun_zenith_rad + delta * (k[i + 2] + k[i + 3] * sun_zenith_rad);
  };
  SkyModel model;
  model.a_ = law(0);
  model.b_ = law(4);
  model.c_ = law(8);
  model.d_ = law(12);
  model.e_ = law(16);
  if (bin == 0) {
    model.c_ = std::exp(std::pow(delta * (k[8] + k[9] * sun_zenith_rad), k[10])) - k[11];
    model.d_ = -std::exp(delta * (k[12] + k[13] * sun_zenith_rad)) + k[14] + delta * k[15];
  }
  model.least_sine_ = 0.01;
  return model;
}

SkyModel SkyModel::table(std::vector<double> luminances) {
  if (luminances.size() != SkyPatches().size()) throw InternalError("a sky table holds 145 luminances");
  SkyModel model;
  model.form_ = Form::table;
  model.table_ = std::move(luminances);
  return model;
}

double SkyModel::operator()(const Vec3& direction, const Vec3& sun) const {
  if (form_ == Form::overcast) return (1.0 + 2.0 * direction.z) / 3.0;
  if (form_ == Form::table) {
    static const SkyPatches tregenza;
    const std::size_t patch = tregenza.patch_of(direction);
    return patch < table_.size() ? table_[patch] : 0.0;
  }
  const double gradation = a_ == 0.0 ? 1.0 : 1.0 + a_ * std::exp(b_ / std::max(direction.z, least_sine_));
  if (!follows_sun()) return std::max(0.0, gradation);
  const double cosine = std::clamp(glm::dot(direction, sun), -1.0, 1.0);
  // From the chord where it is short: acos is coarse there.
  const double chi = cosine > 0.9 ? 2.0 * std::asin(0.5 * glm::length(direction - sun)) : std::acos(cosine);
  return std::max(0.0, gradation * (k_ + c_ * std::exp(d_ * chi) + e_ * cosine * cosine));
}

double sky_scale(double horizontal_lx, double relative_horizontal_sr) {
  if (horizontal_lx == 0.0) return 0.0;
  if (!(relative_horizontal_sr > 0.0)) throw InternalError("a sky without light cannot be scaled");
  return horizontal_lx / relative_horizontal_sr;
}

Sky::Sky(SkyModel model, const Vec3& sun, double horizontal_lx)
    : model_(std::move(model)), sun_(sun), horizontal_lx_(horizontal_lx) {
  // By patches, in which a table is constant.
  const SkyPatches patches;
  double sum = 0.0;
  for (std::size_t p = 0; p < patches.size(); ++p)
    sum += integrate_sky<FineSky>(patches.box(p), sun_, [&](const Vec3& d) {
             return model_(d, sun_);
           }).horizontal_sr;
  scale_ = sky_scale(horizontal_lx, sum);
}

}  // namespace dim
