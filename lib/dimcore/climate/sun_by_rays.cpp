#include <array>
#include <memory>

#include "climate/stored_coefficients.hpp"
#include "light/sun_disc.hpp"
#include "sky/direction.hpp"
#include "transport/direct.hpp"

namespace dim {
namespace {

constexpr int kDiscRays = 8;

/// A window as sunlight meets it.
struct Glass {
  const Window* window = nullptr;
  Transmission straight;
  bool open = false;  ///< nothing in it
  double at(double cos_incidence) const { return open ? 1.0 : straight.at(cos_incidence); }
};

/// What the eye makes of a finish's transmittance in the light of the sky.
double luminous_transmittance(const LuminanceDatabase& database, int finish) {
  for (const auto& source : database.sources()) {
    if (!source.daylight) continue;
    const auto xyz = source.xyz_by_class(database.classes());
    double sum = 0.0;
    for (std::size_t q = 0; q < xyz.size(); ++q)
      sum += xyz[q].y * database.classes().at(q, finish).transmittance;
    return sum;
  }
  return 0.0;
}

/// The finish of a window in the state that its group is in, -1 for what is open.
int finish_of(const Windows& windows, const Window& window, const WindowStates& states) {
  const WindowGroup& group = windows.groups[window.group];
  const auto asked = states.find(group.name);
  std::size_t state = 0;
  while (asked != states.end() && group.states[state] != asked->second) ++state;
  return window.finish_of_state[state];
}

/// Rays from measuring points of a zone to the sun.
class SunRays {
 public:
  SunRays(const LuminanceDatabase& database, const WindowStates& states)
      : zone_(database.zone()),
        north_rad_(zone_.site ? radians(zone_.site->north_deg) : 0.0),
        obstructions_(zone_, Lights{}),
        windows_(find_windows(zone_)) {
    for (const auto& window : windows_.windows) {
      const int finish = finish_of(windows_, window, states);
      Glass glass{&window, {}, finish < 0};
      if (finish >= 0)
        glass.straight = Transmission(zone_.finishes[static_cast<std::size_t>(finish)],
                                      luminous_transmittance(database, finish));
      glasses_.push_back(glass);
    }
  }

  void factors(const Vec3& towards, std::size_t first, std::span<float> out) const {
    const SunDisc disc({to_zone(towards, north_rad_), 1.0});
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = static_cast<float>(factor(disc, zone_.points[first + i]));
  }

 private:
  double factor(const SunDisc& disc, const MeasuringPoint& point) const {
    double sum = 0.0;
    for (int ray = 0; ray < kDiscRays; ++ray) {
      // Rings of equal area, turned by the golden angle.
      const Vec3 direction = disc.direction((ray + 0.5) / kDiscRays, ray * 0.381966);
      const double cosine = glm::dot(point.normal, direction);
      if (cosine > 0.0 && direction.z > 0.0) sum += cosine * passed(point.position, direction);
    }
    return sum / kDiscRays;
  }

  double passed(const Vec3& from, const Vec3& direction) const {
    const RayCaster& caster = obstructions_.caster();
    if (windows_.dome && caster.nearest(from, direction).plate < 0) return 1.0;
    for (const auto& glass : glasses_) {
      const Frame& frame = glass.window->frame();
      const double height_m = frame.height(from), incidence = -glm::dot(frame.n, direction);
      if (!(height_m > 0.0) || !(incidence > 0.0)) continue;
      const Vec3 on_glass = from + (height_m / incidence) * direction;
      if (!glass.window->polygon.contains(frame.to_local(on_glass)) || caster.blocked(from, on_glass))
        continue;
      if (!glass.window->open_outside && caster.nearest(on_glass, direction, glass.window->plate).plate >= 0)
        continue;
      return glass.at(incidence);
    }
    return 0.0;
  }

  const Zone& zone_;
  double north_rad_;
  Obstructions obstructions_;
  Windows windows_;
  std::vector<Glass> glasses_;
};

}  // namespace

double group_transmittance(const LuminanceDatabase& database, const std::string& group,
                           const WindowStates& states) {
  const Windows windows = find_windows(database.zone());
  for (const auto& window : windows.windows) {
    if (windows.groups[window.group].name != group) continue;
    const int finish = finish_of(windows, window, states);
    return finish < 0 ? 1.0 : luminous_transmittance(database, finish);
  }
  return 1.0;
}

SunFactors sun_by_rays(const LuminanceDatabase& database, const WindowStates& states) {
  const auto rays = std::make_shared<const SunRays>(database, states);
  return [rays](const Vec3& towards, std::size_t first, std::span<float> factors) {
    rays->factors(towards, first, factors);
  };
}

}  // namespace dim
