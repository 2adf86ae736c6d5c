#include "climate/sky_mix.hpp"

#include "climate/stored_coefficients.hpp"
#include "sky/sky_by_patches.hpp"

namespace dim {

Mix sky_mix(const LuminanceDatabase& database, const Mix& mix, const Daylight& daylight) {
  if (!database.sky() || database.sky()->subdivision == 0)
    throw InputError(Problem{{},
                             database.sky() ? "is solved for one sky and holds no daylight coefficients"
                                            : "holds no daylight",
                             "run dimray with [sky] model = \"tregenza\" or \"reinhart\" in the lights file"});
  const SkyPatches patches(database.sky()->subdivision);
  const double ground_cd_m2 = database.sky()->ground_reflectance * daylight.horizontal_lx() / kPi;
  auto cd_m2 = sky_by_patches(daylight.sky, patches).columns_cd_m2(patches, ground_cd_m2);
  if (daylight.direct_normal_lx > 0.0 && daylight.sun.z > 0.0) {
    for (const auto& [patch, share] : sun_shares(patches, daylight.sun))
      cd_m2[patch] += share * daylight.direct_normal_lx / patches.solid_angle_sr(patch);
  }
  Mix result = mix;
  for (std::size_t s = 0; s < result.size(); ++s) {
    const auto& origin = database.sources()[s].daylight;
    if (origin) result[s] *= cd_m2[column_of(*origin, patches)];
  }
  return result;
}

Mix even_patches(const LuminanceDatabase& database, const Mix& mix) {
  Mix result = mix;
  for (std::size_t s = 0; s < result.size(); ++s) {
    const auto& origin = database.sources()[s].daylight;
    if (origin && origin->part == DaylightPart::ramp) result[s] = 0.0;
  }
  return result;
}

Mix diffuse_daylight(const LuminanceDatabase& database, const Mix& mix) {
  Mix result = mix;
  for (std::size_t s = 0; s < result.size(); ++s) {
    const auto& origin = database.sources()[s].daylight;
    if (!origin || origin->part == DaylightPart::sun) result[s] = 0.0;
  }
  return result;
}

}  // namespace dim
