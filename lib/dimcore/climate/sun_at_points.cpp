#include <tbb/parallel_for.h>

#include <algorithm>
#include <memory>

#include "climate/stored_coefficients.hpp"
#include "light/obstructions.hpp"
#include "light/sun_sight.hpp"
#include "network/cells.hpp"
#include "sky/direction.hpp"

namespace dim {
namespace {

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

/// The sun as measuring points of a zone see it.
class SunAtPoints {
 public:
  SunAtPoints(const LuminanceDatabase& database, const WindowStates& states, const std::vector<std::string>& groups)
      : zone_(database.zone()),
        north_rad_(zone_.site ? radians(zone_.site->north_deg) : 0.0),
        obstructions_(zone_, Lights{}),
        windows_(find_windows(zone_)),
        sight_(zone_, windows_, plates_of(zone_), obstructions_.shadows()),
        obstacles_(zone_.points.size()) {
    const auto asked = [&](const std::string& group) {
      return groups.empty() || std::find(groups.begin(), groups.end(), group) != groups.end();
    };
    open_ = windows_.dome && asked(kOpenings);
    for (const auto& window : windows_.windows) {
      const int finish = finish_of(windows_, window, states);
      Glass glass{asked(windows_.groups[window.group].name), finish < 0, {}};
      if (finish >= 0)
        glass.straight = Transmission(zone_.finishes[static_cast<std::size_t>(finish)],
                                      luminous_transmittance(database, finish));
      glasses_.push_back(glass);
    }
    tbb::parallel_for(std::size_t{0}, zone_.points.size(), [&](std::size_t p) {
      obstacles_[p] = sight_.obstacles(ConvexRing(zone_.points[p].position), zone_.points[p].response(), -1);
    });
  }

  void factors(const Vec3& towards, std::size_t first, std::span<float> out) const {
    const Vec3 sun = to_zone(towards, north_rad_);
    std::vector<SunSight::Seen> seen;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const MeasuringPoint& point = zone_.points[first + i];
      sight_.seen(ConvexRing(point.position), point.response(), -1, obstacles_[first + i], sun, seen);
      double sum = 0.0;
      for (const auto& part : seen) sum += part.factor * passed(part);
      out[i] = static_cast<float>(sum);
    }
  }

 private:
  /// A window as sunlight meets it.
  struct Glass {
    bool counts;
    bool is_open;  // nothing in it
    Transmission straight;
  };

  double passed(const SunSight::Seen& part) const {
    if (part.window == SunSight::kNoWindow) return open_ ? 1.0 : 0.0;
    const Glass& glass = glasses_[part.window];
    return !glass.counts ? 0.0 : glass.is_open ? 1.0 : glass.straight.at(part.incidence);
  }

  const Zone& zone_;
  double north_rad_;
  Obstructions obstructions_;
  Windows windows_;
  SunSight sight_;
  bool open_ = false;
  std::vector<Glass> glasses_;                  // [n_windows]
  std::vector<SunSight::Obstacles> obstacles_;  // [n_points]
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

SunFactors sun_at_points(const LuminanceDatabase& database, const WindowStates& states,
                       const std::vector<std::string>& groups) {
  const auto sun = std::make_shared<const SunAtPoints>(database, states, groups);
  return [sun](const Vec3& towards, std::size_t first, std::span<float> factors) {
    sun->factors(towards, first, factors);
  };
}

}  // namespace dim
