#include "judge/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "glare/observers.hpp"
#include "result/light_colour.hpp"
#include "result/point_error.hpp"

namespace dim {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kUgrPerShare = 8.0 / 2.302585092994046;  // d UGR / d ln

struct Figures {
  double mean_lx = kNone, u0 = kNone;
  double mean_error_lx = kNone, u0_error = kNone;  // stated
};

// Minimum and mean may both be off by as much as is said of them, either way.
double u0_error(double u0, double mean_lx, double min_error_lx, double mean_error_lx) {
  return mean_lx > 0.0 ? (min_error_lx + u0 * mean_error_lx) / mean_lx : 0.0;
}

// The room's floor: what bounds it from below, level.
double floor_area_m2(const Zone& zone) {
  constexpr double kLevel = 0.99;
  double area = 0.0;
  for (const auto& surface : zone.surfaces)
    if (surface.bounding && !surface.outside && surface.polygon.normal().z > kLevel)
      area += surface.polygon.area_m2();
  return area;
}

template <class Work>
auto at_place(const Place& place, Work&& work) -> decltype(work()) {
  try {
    return work();
  } catch (const InputError& error) {
    throw InputError({place, error.problems().front().what, error.problems().front().cure});
  }
}

class Checker {
 public:
  Checker(const LuminanceDatabase& database, const Requirements& requirements, const CheckInput& input,
          const Job& job)
      : database_(database),
        zone_(database.zone()),
        input_(input),
        job_(job),
        maintained_(maintained_mix(database, requirements, input.initial)),
        error_share_(stated_error(database, maintained_)) {}

  std::vector<Finding> run(const Requirements& requirements) {
    for (const auto& requirement : requirements.requirements)
      requirement.plane.empty() ? of_surfaces(requirement) : of_plane(requirement);
    return std::move(findings_);
  }

 private:
  [[noreturn]] static void absent(const Requirement& r, const std::string& kind, const std::string& name,
                                  const std::vector<std::string>& names) {
    throw InputError({r.place, "no " + kind + " '" + name + "' in the room", name_cure(name, names)});
  }

  void add(const std::string& where, const std::string& what, const std::string& unit,
           std::optional<double> limit, bool at_most, double value, double initial, double error) {
    if (!limit) return;
    const Verdict verdict =
        at_most ? judge_at_most(value, error, *limit) : judge_at_least(value, error, *limit);
    findings_.push_back({where, what, unit, at_most, *limit, value, initial, error, verdict});
  }

  void add_light(const Requirement& r, const std::string& where, const Figures& kept, const Figures& as_new) {
    add(where, "illuminance", "lx", r.illuminance_lx, false, kept.mean_lx, as_new.mean_lx,
        kept.mean_error_lx);
    add(where, "uniformity", "", r.uniformity, false, kept.u0, as_new.u0, kept.u0_error);
  }

  void of_plane(const Requirement& r) {
    std::vector<std::string> names;
    const PointSet* set = nullptr;
    for (const auto& one : zone_.point_sets) {
      names.push_back(one.name);
      if (one.name == r.plane) set = &one;
    }
    if (!set) absent(r, "measuring plane or sensors", r.plane, names);
    const Figures kept = of_points(maintained_, *set);
    add_light(r, r.plane, kept, of_points(input_.initial, *set));
    add_colour(r, r.plane, [&](const LightColours& colours) {
      double least = HUGE_VAL;
      const auto at = colours.at_points(maintained_);
      for (std::size_t p = set->first; p < set->first + set->count; ++p)
        if (zone_.points[p].valid) least = std::isnan(at[p].ra) ? kNone : std::min(least, at[p].ra);
      return std::isfinite(least) ? least : kNone;
    });
    if (r.daylight_factor_percent) add_daylight(r, *set);
    if (r.ugr) add_glare(r, *set);
    add_power(r, r.plane);
    const double power = installed_W_m2();
    add(r.plane, "power per 100 lx", "W/m2/100 lx", r.power_W_m2_100lx, true, 100.0 * power / kept.mean_lx,
        100.0 * power / of_points(input_.initial, *set).mean_lx, kept.mean_error_lx / kept.mean_lx * 100.0 * power / kept.mean_lx);
  }

  Figures of_points(const Mix& mix, const PointSet& set) const {
    const auto lx = point_illuminance_lx(database_, mix);
    const auto statistics = grid_statistics(lx, zone_.points, set);
    Figures figures{statistics.mean_lx, statistics.u0};
    const auto errors = point_errors(database_, mix);
    double min_error_lx = stated_error(database_, mix) * statistics.mean_lx;
    figures.mean_error_lx = min_error_lx;
    if (errors) {
      figures.mean_error_lx = mean_error(*errors, zone_.points, set).total_lx();
      for (std::size_t p = set.first; p < set.first + set.count; ++p)
        if (zone_.points[p].valid && lx[p] == statistics.min_lx) min_error_lx = (*errors)[p].total_lx();
    }
    figures.u0_error = u0_error(statistics.u0, statistics.mean_lx, min_error_lx, figures.mean_error_lx);
    return figures;
  }

  // A cell's own error is not known: the least is taken to be off by the same share as the mean.
  std::vector<Figures> of_all_surfaces(const Mix& mix) const {
    const auto surfaces = surface_figures(database_.cells(), cell_appearance(database_, database_.cells(), mix));
    const auto errors = surface_errors(database_, mix, surfaces);
    std::vector<Figures> figures;
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
      const double mean = surfaces[s].illuminance_mean_lx, u0 = mean > 0.0 ? surfaces[s].illuminance_min_lx / mean : 0.0;
      const double error_lx = errors ? (*errors)[s].total_lx() : error_share_ * mean;
      figures.push_back({mean, u0, error_lx, u0_error(u0, mean, u0 * error_lx, error_lx)});
    }
    return figures;
  }

  void of_surfaces(const Requirement& r) {
    const auto kept = of_all_surfaces(maintained_), as_new = of_all_surfaces(input_.initial);
    for (const auto& name : r.surfaces) {
      const std::size_t s = surface_named(r, name);
      add_light(r, name, kept[s], as_new[s]);
      add_colour(r, name,
                 [&](const LightColours& c) { return c.on_surfaces(database_.cells(), maintained_)[s].ra; });
      add_power(r, name);
    }
  }

  std::size_t surface_named(const Requirement& r, const std::string& name) const {
    std::vector<std::string> names;
    for (std::size_t s = 0; s < zone_.surfaces.size(); ++s) {
      if (zone_.surfaces[s].outside) continue;
      if (zone_.surfaces[s].name == name) return s;
      names.push_back(zone_.surfaces[s].name);
    }
    absent(r, "surface", name, names);
  }

  template <class Ra>
  void add_colour(const Requirement& r, const std::string& where, Ra&& ra) {
    if (!r.colour_rendering) return;
    const double value = ra(LightColours(database_));
    add(where, "colour rendering", "Ra", r.colour_rendering, false, value, value, 0.0);
  }

  void add_daylight(const Requirement& r, const PointSet& set) {
    if (input_.daylight.empty())
      throw InputError({r.place, "asks for a daylight factor, and the room holds no daylight",
                        "run dimray with a [sky] in the lights file"});
    const Figures daylight = of_points(input_.daylight, set);
    const double percent = 100.0 / input_.outside_lx, value = percent * daylight.mean_lx;
    add(r.plane, "daylight factor", "%", r.daylight_factor_percent, false, value, value,
        percent * daylight.mean_error_lx);
  }

  // Of the light that eyes are adapted to.
  double background_share() const {
    const auto light = surface_light(database_, input_.initial);
    return light && light->lm > 0.0 ? light->error_lm / light->lm : error_share_;
  }

  void add_glare(const Requirement& r, const PointSet& set) {
    const GlareField field(database_, input_.initial);
    const auto ratings = observer_ratings(zone_, field, set, {r.eye_height_m, r.directions}, job_);
    const auto* worst = worst_of(ratings);
    const double value = worst ? worst->rating.ugr : kNone;
    add(r.plane, "ugr", "", r.ugr, true, value, value, kUgrPerShare * background_share());
    // Eyes that no source dazzles are content.
    const bool nothing_seen =
        std::any_of(ratings.begin(), ratings.end(), [](const auto& o) { return o.rating.n_sources == 0; });
    if (!worst && nothing_seen) findings_.back().verdict = Verdict::met;
  }

  void add_power(const Requirement& r, const std::string& where) {
    add(where, "power density", "W/m2", r.power_W_m2, true, installed_W_m2(), installed_W_m2(), 0.0);
  }

  // NaN where a luminaire's watts are not known.
  double installed_W_m2() const {
    double watts = 0.0;
    for (const auto& luminaire : database_.luminaires()) {
      const double its = database_.photometry()[luminaire.photometry].watts;
      if (!(its > 0.0)) return kNone;
      watts += its;
    }
    return watts / floor_area_m2(zone_);
  }

  const LuminanceDatabase& database_;
  const Zone& zone_;
  const CheckInput& input_;
  const Job& job_;
  Mix maintained_;
  double error_share_;
  std::vector<Finding> findings_;
};

}  // namespace

Mix maintained_mix(const LuminanceDatabase& database, const Requirements& requirements, const Mix& initial) {
  std::vector<double> factor;
  for (const auto& source : database.sources())
    factor.push_back(source.maintenance.value_or(requirements.maintenance_factor));
  for (const auto& entry : requirements.maintenance) {
    const std::string& name = entry.first;
    const auto named = at_place(requirements.maintenance_place.at(name),
                                [&] { return sources_named(name, database.sources(), "[maintenance]"); });
    for (const std::size_t s : named) factor[s] = entry.second;
  }
  Mix mix = initial;
  for (std::size_t s = 0; s < mix.size(); ++s)
    if (!database.sources()[s].daylight) mix[s] *= factor[s];
  return mix;
}

double stated_error(const LuminanceDatabase& database, const Mix& mix) {
  double flux_lm = 0.0, error_lm = 0.0;
  for (std::size_t s = 0; s < mix.size(); ++s) {
    const Source& source = database.sources()[s];
    double open = 0.0;
    for (const auto& energy : source.energy) open = std::max(open, std::abs(energy.imbalance));
    flux_lm += mix[s] * source.flux_lm;
    error_lm += mix[s] * source.flux_lm * (source.error_bound + open);
  }
  return flux_lm > 0.0 ? error_lm / flux_lm : 0.0;
}

std::vector<Finding> check(const LuminanceDatabase& database, const Requirements& requirements,
                           const CheckInput& input, const Job& job) {
  return Checker(database, requirements, input, job).run(requirements);
}

}  // namespace dim
