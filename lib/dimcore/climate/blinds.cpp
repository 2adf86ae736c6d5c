#include "climate/blinds.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "climate/outer_face.hpp"

namespace dim {
namespace {

/// A complaint about what a plan names becomes one about its place.
template <typename Work>
auto about(const BlindPlan& plan, const Work& work) {
  try {
    return work();
  } catch (const InputError& error) {
    const Problem& problem = error.problems().front();
    throw InputError(
        Problem{plan.place, fmt::format("blind of '{}': {}", plan.windows, problem.what), problem.cure});
  }
}

/// Points that light reaches of the sets that a plan names.
std::vector<std::size_t> points_of(const BlindPlan& plan, const Zone& zone) {
  std::vector<std::string> wanted = plan.points, known;
  for (const auto& set : zone.point_sets) known.push_back(set.name);
  const auto is_planar = [&](const PointSet& set) { return quantity_of(zone, set) == Quantity::planar; };
  const auto add_first = [&](std::size_t n) {
    for (std::size_t k = 0; k < n; ++k)
      if (is_planar(zone.point_sets[k])) wanted.push_back(zone.point_sets[k].name);
  };
  if (wanted.empty()) add_first(zone.planes.size());
  if (wanted.empty()) add_first(zone.point_sets.size());
  std::vector<std::size_t> points;
  for (const auto& name : wanted) {
    const auto set = std::find_if(zone.point_sets.begin(), zone.point_sets.end(),
                                  [&](const PointSet& s) { return s.name == name; });
    if (set == zone.point_sets.end())
      throw InputError(Problem{{}, fmt::format("no sensors or measuring plane '{}'", name), name_cure(name, known)});
    if (!is_planar(*set))
      throw InputError(Problem{{}, fmt::format("'{}' does not measure planar illuminance", name), ""});
    for (std::size_t p = set->first; p < set->first + set->count; ++p)
      if (zone.points[p].valid) points.push_back(p);
  }
  if (points.empty()) throw InputError(Problem{{}, "no measuring point for its law", "give the zone a [[plane]]"});
  return points;
}

/// Share of the points that get more than the plan's direct sun through its open windows. [n_steps]
std::vector<double> sunlit_shares(const BlindPlan& plan, const std::vector<std::size_t>& points, const AnnualSky& sky,
                                  const SunFactors& open, std::size_t n_points, const Job& job) {
  std::vector<double> shares(sky.n_steps, 0.0);
  tbb::parallel_for(std::size_t{0}, sky.lit.size(), [&](std::size_t i) {
    if (job.stopped() || !(sky.sun_normal_lx[i] > plan.most_sun_lx)) return;
    std::vector<float> factors(n_points);
    open(sky.sun[i], 0, factors);
    const auto sunlit = std::count_if(points.begin(), points.end(), [&](std::size_t p) {
      return static_cast<double>(factors[p]) * sky.sun_normal_lx[i] > plan.most_sun_lx;
    });
    shares[sky.lit[i]] = static_cast<double>(sunlit) / static_cast<double>(points.size());
  });
  job.check();
  return shares;
}

/// On the outer face, lx or W/m2. [n_steps]
std::vector<double> on_face(const BlindPlan& plan, const Zone& zone, const AnnualSky& sky, double ground_reflectance) {
  const OuterFace face(zone, plan.windows, sky.patches.subdivision());
  if (!face.exists()) throw InputError(Problem{{}, "it has no panes whose outer face could be lit", ""});
  const auto& weights = face.column_lx();
  const std::size_t ground = sky.patches.ground();
  std::vector<double> values(sky.n_steps, 0.0);
  for (std::size_t i = 0; i < sky.lit.size(); ++i) {
    const float* cd_m2 = &sky.luminance_cd_m2[i * weights.size()];
    double sky_lx = 0.0;
    for (std::size_t c = 0; c < weights.size(); ++c)
      if (c != ground) sky_lx += weights[c] * static_cast<double>(cd_m2[c]);
    const double sun = sky.sun_normal_lx[i] > 0.0 ? face.sun_factor(sky.sun[i]) : 0.0;
    if (plan.law == BlindLaw::illuminance) {
      values[sky.lit[i]] = sky_lx + weights[ground] * static_cast<double>(cd_m2[ground]) + sun * sky.sun_normal_lx[i];
      continue;
    }
    // Irradiance spreads over the sky as light does.
    const Irradiance& w = sky.irradiance[i];
    const double horizontal_lx = sky.sky_horizontal_lx[sky.lit[i]];
    const double of_sky = horizontal_lx > 0.0 ? sky_lx * w.diffuse_horizontal_W_m2 / horizontal_lx : 0.0;
    const double of_beam = sky.sun_normal_lx[i] > 0.0 ? w.direct_normal_W_m2 : 0.0;
    const double level = w.diffuse_horizontal_W_m2 + of_beam * std::max(0.0, sky.sun[i].z);
    values[sky.lit[i]] = of_sky + weights[ground] * ground_reflectance * level / kPi + sun * of_beam;
  }
  return values;
}

void refuse_twice(const std::vector<BlindPlan>& plans) {
  for (std::size_t i = 1; i < plans.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (plans[i].windows == plans[j].windows)
        throw InputError(
            Problem{plans[i].place, fmt::format("a second blind of the windows '{}'", plans[i].windows), ""});
}

}  // namespace

std::vector<bool> closed_by_level(const std::vector<double>& values, double close_above, double open_below) {
  std::vector<bool> closed(values.size());
  bool now = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    now = values[i] > (now ? open_below : close_above);
    closed[i] = now;
  }
  return closed;
}

OperatedWindows operate(const LuminanceDatabase& database, const WindowStates& states,
                        const std::vector<BlindPlan>& plans, const AnnualSky& sky, const Job& job) {
  refuse_twice(plans);
  const Zone& zone = database.zone();
  OperatedWindows operated;
  std::vector<std::string> others = window_groups(database);
  for (const auto& plan : plans) {
    WindowStates closed_states = states;
    closed_states[plan.windows] = plan.closed;
    WindowPart closed{about(plan, [&] { return stored_coefficients(database, closed_states, {plan.windows}); }),
                      sun_at_points(database, closed_states, {plan.windows}),
                      {},
                      false};
    WindowPart open{stored_coefficients(database, states, {plan.windows}),
                    sun_at_points(database, states, {plan.windows}),
                    {},
                    true};
    const auto values = about(plan, [&] {
      return plan.law == BlindLaw::direct_sun
                 ? sunlit_shares(plan, points_of(plan, zone), sky, open.sun, zone.points.size(), job)
                 : on_face(plan, zone, sky, open.coefficients.ground_reflectance);
    });
    const bool by_points = plan.law == BlindLaw::direct_sun;
    BlindYear year{plan.windows, plan.closed,
                   closed_by_level(values, by_points ? plan.most_points : plan.close_above,
                                   by_points ? plan.most_points : plan.open_below)};
    for (const std::size_t step : sky.lit) {
      closed.active.push_back(year.closed[step]);
      open.active.push_back(!year.closed[step]);
    }
    operated.parts.push_back(std::move(open));
    operated.parts.push_back(std::move(closed));
    operated.blinds.push_back(std::move(year));
    std::erase(others, plan.windows);
  }
  if (!others.empty())
    operated.parts.push_back(
        {stored_coefficients(database, states, others), sun_at_points(database, states, others), {}, true});
  return operated;
}

}  // namespace dim
