#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/vec.hpp"
#include "photometry/intensity.hpp"
#include "photometry/opening.hpp"
#include "photometry/photometry.hpp"
#include "scene/sky_light.hpp"
#include "spectrum/curve.hpp"

/// The validated model of a lights file: fittings, each once, and the luminaires that use them, in the zone's
/// centred metres.
namespace dim {

/// A kind of luminaire.
struct Fitting {
  std::string name;
  IntensityTable intensity;  ///< ideal sources: of 1 cd, the luminaire's factor says how many
  LuminousOpening opening;
  double flux_lm = 0.0;         ///< integral of `intensity`
  SpectralCurve spectrum{1.0};  ///< relative; equal-energy where the entry says nothing
  bool has_spectrum = false;
  std::string spectrum_name;     ///< where the spectrum was asked for by name
  double watts = 0.0;            ///< 0 where not known
  std::optional<LampTilt> tilt;  ///< how the lamps' output changes with the luminaire's position
  double in_use_factor = 1.0;    ///< flux in use over flux as new, in `intensity`: the entry's factors
  double maintenance_factor = 1.0;  ///< the part of that which is for ageing and dirt
};

/// One luminaire in its place. Its frame is x = c0, y = c90, z = aim, as IntensityTable and LuminousOpening
/// have it.
struct Luminaire {
  std::string name;
  std::string group;
  int fitting = 0;          ///< index into Lights::fittings
  Vec3 at{0.0};             ///< photometric centre, zone-centred metres
  Vec3 c0{1, 0, 0};         ///< C = 0
  Vec3 c90{0, 1, 0};        ///< c0 x aim
  Vec3 aim{0, 0, -1};       ///< gamma = 0
  double factor = 1.0;      ///< times the fitting's intensity: dim, lamp tilt, lumens or intensity asked for
  std::optional<double> maintenance;  ///< maintained over initial light, not in `factor`; nothing: not said
  LuminousOpening opening;  ///< the fitting's, or what the lights file says instead
  bool body = false;        ///< the opening also obstructs and reflects, see scene/luminaire_body.hpp
  double body_reflectance = 0.0;  ///< 0..1, not 1
  Place place;

  Vec3 to_local(const Vec3& direction) const {
    return {glm::dot(direction, c0), glm::dot(direction, c90), glm::dot(direction, aim)};
  }
  Vec3 to_world(const Vec3& local) const { return local.x * c0 + local.y * c90 + local.z * aim; }
};

struct Lights {
  std::vector<Fitting> fittings;
  std::vector<Luminaire> luminaires;
  std::optional<SkyLight> sky;

  const Fitting& fitting_of(const Luminaire& luminaire) const {
    return fittings[static_cast<std::size_t>(luminaire.fitting)];
  }
};

}  // namespace dim
