#include <cmath>

#include "glare/observers.hpp"
#include "report/packed.hpp"
#include "report/parts.hpp"

namespace dim {
namespace {

Json number(double v) { return std::isfinite(v) ? Json(v) : Json(nullptr); }

// The sum over sources that gave this rating, from the formula.
double glare_sum(const UnifiedGlareRating& rating) {
  if (std::isnan(rating.ugr)) return 0.0;
  return rating.background_cd_m2 / 0.25 * std::pow(10.0, rating.ugr / 8.0);
}

Json group_json(const std::vector<UnifiedGlareRating>& ratings) {
  std::vector<double> sums, background;
  for (const auto& rating : ratings) {
    sums.push_back(glare_sum(rating));
    background.push_back(rating.background_cd_m2);
  }
  return {{"sum", packed(sums)}, {"background", packed(background)}};
}

Json of_view(const View& view, const std::vector<GlareField>& fields) {
  Json part = {{"kind", "view"}, {"name", view.name}, {"groups", Json::array()}};
  for (const auto& field : fields)
    part["groups"].push_back(group_json({glare_at(field.at(view.eye), LineOfSight::along(view.focus - view.eye, view.up))}));
  return part;
}

Json of_plane(const Zone& zone, const Requirement& requirement, const PointSet& set,
              const std::vector<GlareField>& fields, const Job& job) {
  Json part = {{"kind", "plane"}, {"name", set.name}, {"height_m", requirement.eye_height_m},
               {"directions", requirement.directions}, {"groups", Json::array()}};
  for (const auto& field : fields) {
    std::vector<UnifiedGlareRating> ratings;
    for (const auto& o : observer_ratings(zone, field, set, {requirement.eye_height_m, requirement.directions}, job))
      ratings.push_back(o.rating);
    part["groups"].push_back(group_json(ratings));
  }
  return part;
}

}  // namespace

Json glare_part(const LuminanceDatabase& database, const std::vector<LightGroup>& groups,
                const std::optional<Requirements>& requirements, const Job& job) {
  const Zone& zone = database.zone();
  Json list = Json::array();
  if (database.luminaires().empty()) return list;
  std::vector<GlareField> fields;
  fields.reserve(groups.size());
  for (const auto& group : groups) fields.emplace_back(database, group.full);
  for (const auto& view : zone.views) list.push_back(of_view(view, fields));
  if (!requirements) return list;
  for (const auto& requirement : requirements->requirements) {
    if (!requirement.ugr) continue;
    for (const auto& set : zone.point_sets)
      if (set.name == requirement.plane) list.push_back(of_plane(zone, requirement, set, fields, job));
  }
  return list;
}

Json requirements_part(const LuminanceDatabase& database, const ReportOptions& options, const Job& job) {
  if (!options.requirements) return nullptr;
  Json findings = Json::array();
  Requirements one = *options.requirements;
  for (const auto& requirement : options.requirements->requirements) {
    one.requirements = {requirement};
    for (const auto& f : check(database, one, options.asked, job))
      findings.push_back({{"where", f.where},
                          {"surface", requirement.plane.empty()},
                          {"what", f.what},
                          {"unit", f.unit},
                          {"at_most", f.at_most},
                          {"limit", f.limit},
                          {"value", number(f.value)},
                          {"initial", number(f.initial)},
                          {"error", number(f.error)},
                          {"verdict", verdict_name(f.verdict)}});
  }
  return {{"title", options.requirements->title},
          {"source", options.requirements->source},
          {"maintenance_factor", options.requirements->maintenance_factor},
          {"findings", findings}};
}

}  // namespace dim
