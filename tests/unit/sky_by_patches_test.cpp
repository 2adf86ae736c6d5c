#include "sky/sky_by_patches.hpp"

#include "catch.hpp"
#include "sky/direction.hpp"

using namespace dim;

namespace {

/// Luminance of a sky put together from patches and ramps.
double luminance_cd_m2(const SkyByPatches& sky, const SkyPatches& patches, const Vec3& direction) {
  const std::size_t p = patches.patch_of(direction), band = patches.band_of(p);
  if (band == patches.n_ramps()) return sky.mean_cd_m2[p];
  return sky.mean_cd_m2[p] + sky.rise_cd_m2[band] * (patches.ramp_cd_m2(band, direction.z) - 0.5);
}

/// Illuminance of a surface, by midpoints in every patch. @param luminance  Vec3 -> cd/m2
template <typename Luminance>
double illuminance_lx(const SkyPatches& patches, const Vec3& normal, const Luminance& luminance) {
  constexpr int kSide = 24;
  double sum = 0.0;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    for (int k = 0; k < kSide * kSide; ++k) {
      const Vec3 d = patches.direction(p, (k / kSide + 0.5) / kSide, (k % kSide + 0.5) / kSide);
      sum += std::max(0.0, glm::dot(d, normal)) * patches.solid_angle_sr(p) / (kSide * kSide) * luminance(d);
    }
  }
  return sum;
}

std::vector<SkyModel> skies(double sun_altitude_deg) {
  return {SkyModel::cie(1), SkyModel::cie(12), SkyModel::cie(15),
          SkyModel::perez({6.0, 0.1}, radians(90.0 - sun_altitude_deg)),
          SkyModel::perez({1.3, 0.3}, radians(90.0 - sun_altitude_deg))};
}

}  // namespace

TEST_CASE("Patches and ramps of a sky add up to its horizontal illuminance", "[sky][unit]") {
  const SkyPatches patches(GENERATE(1, 2));
  const Vec3 sun = sky_direction(radians(12.0), 2.0);
  for (const auto& model : skies(12.0)) {
    const auto sky = sky_by_patches(Sky(model, sun, 5000.0), patches);
    double sum = 0.0;
    for (std::size_t p = 0; p < patches.size(); ++p) {
      const std::size_t band = patches.band_of(p);
      sum += sky.mean_cd_m2[p] * patches.horizontal_sr(p);
      if (band < patches.n_ramps()) sum += sky.rise_cd_m2[band] * patches.ramp_horizontal_sr(band);
    }
    CHECK(sum == Approx(5000.0).epsilon(1e-6));
  }
}

TEST_CASE("An overcast sky is met in every direction but the cap's", "[sky][unit]") {
  const SkyPatches patches(GENERATE(1, 4));
  const Sky overcast(SkyModel::overcast(), {0, 0, 1}, 10000.0);
  const auto sky = sky_by_patches(overcast, patches);
  for (const double altitude : {0.5, 11.9, 12.1, 33.0, 61.0, 83.0})
    for (const double azimuth : {0.0, 77.0, 200.0}) {
      const Vec3 d = sky_direction(radians(altitude), radians(azimuth));
      CHECK(luminance_cd_m2(sky, patches, d) == Approx(overcast.luminance_cd_m2(d)).epsilon(1e-6));
    }
}

TEST_CASE("Patches of a sky light walls as the sky does, to one per cent", "[sky][unit]") {
  const SkyPatches patches;
  const Vec3 sun = sky_direction(radians(15.0), radians(137.0));
  for (const auto& model : skies(15.0)) {
    const Sky sky(model, sun, 1000.0);
    const auto by_patches = sky_by_patches(sky, patches);
    for (int side = 0; side < 8; ++side) {
      const Vec3 normal = sky_direction(0.0, radians(45.0 * side));
      CHECK(illuminance_lx(patches, normal, [&](const Vec3& d) { return luminance_cd_m2(by_patches, patches, d); }) ==
            Approx(illuminance_lx(patches, normal, [&](const Vec3& d) { return sky.luminance_cd_m2(d); })).epsilon(0.011));
    }
  }
}

TEST_CASE("No direction of a sky by patches is darker than black", "[sky][unit]") {
  const SkyPatches patches;
  for (const double altitude : {3.0, 30.0, 75.0}) {
    const Vec3 sun = sky_direction(radians(altitude), 1.0);
    for (const auto& model : skies(altitude)) {
      const auto sky = sky_by_patches(Sky(model, sun, 1000.0), patches);
      for (std::size_t p = 0; p + 1 < patches.size(); ++p)
        CHECK(sky.mean_cd_m2[p] >= 0.49 * std::abs(sky.rise_cd_m2[patches.band_of(p)]));
    }
  }
}

TEST_CASE("A table of luminances is its own patches", "[sky][unit]") {
  const SkyPatches patches;
  std::vector<double> table(145);
  double sum = 0.0;
  for (std::size_t p = 0; p < 145; ++p) {
    table[p] = 100.0 + static_cast<double>(p * p % 77);
    sum += table[p] * patches.horizontal_sr(p);
  }
  const auto sky = sky_by_patches(Sky(SkyModel::table(table), {0, 0, 1}, 1000.0), patches);
  for (std::size_t p = 0; p < 145; ++p) CHECK(sky.mean_cd_m2[p] == Approx(table[p] * 1000.0 / sum).epsilon(1e-9));
  for (const double rise : sky.rise_cd_m2) CHECK(rise == 0.0);
}

TEST_CASE("Columns are the patches at their lower edges, the ground and the rises", "[sky][unit]") {
  const SkyPatches patches;
  const auto sky = sky_by_patches(Sky(SkyModel::overcast(), {0, 0, 1}, 7.0 * kPi / 9.0), patches);
  const auto columns = sky.columns_cd_m2(patches, 0.25);
  REQUIRE(columns.size() == 145 + 1 + 7);
  // (1 + 2 sin h)/3 from the horizon to 12 degrees.
  CHECK(columns[0] == Approx(1.0 / 3.0).epsilon(1e-6));
  CHECK(columns[144] == sky.mean_cd_m2[144]);
  CHECK(columns[145] == 0.25);
  CHECK(columns[146] == Approx(2.0 / 3.0 * std::sin(radians(12.0))).epsilon(1e-6));
}

TEST_CASE("Quick patches of a sky are those of the fine quadrature", "[sky][unit]") {
  const SkyPatches patches;
  for (const double altitude : {2.0, 20.0, 50.0}) {
    const Vec3 sun = sky_direction(radians(altitude), 1.0);
    for (const auto& model : skies(altitude)) {
      const auto fine = sky_by_patches(Sky(model, sun, 1000.0), patches);
      const auto quick = quick_sky_by_patches(model, sun, 1000.0, patches);
      for (std::size_t p = 0; p < patches.size(); ++p)
        CHECK(quick.mean_cd_m2[p] == Approx(fine.mean_cd_m2[p]).epsilon(p == patches.patch_of(sun) ? 1e-2 : 1e-3));
      for (std::size_t band = 0; band < patches.n_ramps(); ++band)
        CHECK(quick.rise_cd_m2[band] ==
              Approx(fine.rise_cd_m2[band]).margin(1e-3 * fine.mean_cd_m2[patches.first_of_band(band)]));
    }
  }
}
