#include <algorithm>
#include <cmath>
#include <set>

#include "image/contour_plan.hpp"
#include "report/packed.hpp"
#include "report/parts.hpp"
#include "result/point_error.hpp"

namespace dim {
namespace {

constexpr double kSymbolShare = 0.015;  // of the plan: smaller luminaires are drawn of this size

Json flat(const std::vector<Vec2>& points) {
  Json list = Json::array();
  for (const Vec2& p : points) {
    list.push_back(std::round(p.x * 1e4) / 1e4);
    list.push_back(std::round(p.y * 1e4) / 1e4);
  }
  return list;
}

Json pair(const Vec2& p) { return Json::array({p.x, p.y}); }

const char* stroke_name(PlanStroke stroke) {
  switch (stroke) {
    case PlanStroke::wall: return "wall";
    case PlanStroke::window: return "window";
    case PlanStroke::luminaire: return "luminaire";
    case PlanStroke::edge: break;
  }
  return "edge";
}

class Targets {
 public:
  Targets(const LuminanceDatabase& database, const std::vector<LightGroup>& groups, const Job& job)
      : database_(database), zone_(database.zone()), groups_(groups), job_(job) {
    for (const auto& group : groups) {
      point_lx_.push_back(point_illuminance_lx(database, group.full));
      point_error_.push_back(point_errors(database, group.full));
      share_.push_back(stated_error(database, group.full));
      appearance_.push_back(cell_appearance(database, database.cells(), group.full));
      surface_figures_.push_back(surface_figures(database.cells(), appearance_.back()));
      surface_error_.push_back(surface_errors(database, group.full, surface_figures_.back()));
    }
  }

  Json of_points(std::size_t k) const {
    const PointSet& set = zone_.point_sets[k];
    std::vector<std::uint32_t> at;  // points that count
    for (std::size_t p = set.first; p < set.first + set.count; ++p)
      if (zone_.points[p].valid) at.push_back(static_cast<std::uint32_t>(p));
    const bool is_plane = k < zone_.planes.size();
    Json target = {{"name", set.name}, {"kind", is_plane ? "plane" : "sensors"}, {"points", set.count},
                   {"left_out", set.count - at.size()}, {"groups", Json::array()}};
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      std::vector<double> lx, errors;
      const double mean = grid_statistics(point_lx_[g], zone_.points, set).mean_lx;
      for (const auto p : at) {
        lx.push_back(point_lx_[g][p]);
        errors.push_back(point_error_[g] ? (*point_error_[g])[p].total_lx() : share_[g] * mean);
      }
      const double of_mean =
          point_error_[g] ? mean_error(*point_error_[g], zone_.points, set).total_lx() : share_[g] * mean;
      target["groups"].push_back({{"lx", packed(lx)}, {"error", packed(errors)}, {"mean_error", of_mean}});
    }
    if (is_plane) target["plan"] = plan(k, at);
    return target;
  }

  Json of_surface(std::size_t s) const {
    const Cells& cells = database_.cells();
    const std::size_t first = cells.first(s), last = cells.first(s + 1);
    std::vector<double> areas;
    for (std::size_t c = first; c < last; ++c) areas.push_back(cells.area_m2(c));
    Json target = {{"name", zone_.surfaces[s].name}, {"kind", "surface"}, {"points", last - first}, {"left_out", 0},
                   {"weights", packed(areas)}, {"groups", Json::array()}};
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const auto& all = appearance_[g].illuminance_lx;
      const std::vector<double> lx(all.begin() + static_cast<std::ptrdiff_t>(first),
                                   all.begin() + static_cast<std::ptrdiff_t>(last));
      const double error = surface_error_[g] ? (*surface_error_[g])[s].total_lx()
                                             : share_[g] * surface_figures_[g][s].illuminance_mean_lx;
      target["groups"].push_back(
          {{"lx", packed(lx)}, {"error", packed(std::vector<double>(lx.size(), error))}, {"mean_error", error}});
    }
    return target;
  }

 private:
  Json plan(std::size_t k, const std::vector<std::uint32_t>& at) const {
    const MeasuringPlane& plane = zone_.planes[k];
    const PlanFrame plan = plan_frame(zone_, plane.polygon);
    const Frame& own = plane.polygon.frame();
    const Vec2 origin = plan.to_plan(own.to_world(Vec2(0.0)));
    Json part = {{"low", pair(plan.low_m)},
                 {"high", pair(plan.high_m)},
                 {"nu", plane.nu},
                 {"nv", plane.nv},
                 {"size", pair(plane.polygon.size_m())},
                 {"origin", pair(origin)},
                 {"u", pair(plan.to_plan(own.to_world(Vec2(1.0, 0.0))) - origin)},
                 {"v", pair(plan.to_plan(own.to_world(Vec2(0.0, 1.0))) - origin)},
                 {"squares", packed(squares(plane, zone_.point_sets[k], at))},
                 {"rings", Json::array()},
                 {"lines", Json::array()},
                 {"luminaires", Json::array()}};
    for (const auto& ring : plane.polygon.corners()) {
      std::vector<Vec2> points;
      for (const Vec3& corner : ring) points.push_back(plan.to_plan(corner));
      part["rings"].push_back(flat(points));
    }
    add_lines(plan, part["lines"]);
    for (const auto& luminaire : database_.luminaires()) part["luminaires"].push_back(pair(plan.to_plan(luminaire.at)));
    if (const auto north = north_in_plan(zone_, plan)) part["north"] = pair(*north);
    return part;
  }

  // Of each square of the plane's grid, its place among the points that count.
  std::vector<std::uint32_t> squares(const MeasuringPlane& plane, const PointSet& set,
                                     const std::vector<std::uint32_t>& at) const {
    constexpr std::uint32_t kNone = 0xffffffffU;
    std::vector<std::uint32_t> squares;
    const Vec2 size = plane.polygon.size_m();
    auto point = static_cast<std::uint32_t>(set.first);
    for (int j = 0; j < plane.nv; ++j) {
      for (int i = 0; i < plane.nu; ++i) {
        std::uint32_t index = kNone;
        if (plane.polygon.contains(Vec2(size.x * (i + 0.5) / plane.nu, size.y * (j + 0.5) / plane.nv))) {
          const auto found = std::lower_bound(at.begin(), at.end(), point);
          if (found != at.end() && *found == point) index = static_cast<std::uint32_t>(found - at.begin());
          ++point;
        }
        squares.push_back(index);
      }
    }
    return squares;
  }

  void add_lines(const PlanFrame& plan, Json& lines) const {
    auto all = plan_of_room(zone_, database_.luminaires(), plan, job_);
    const auto symbols = luminaire_symbols(database_.luminaires(), plan,
                                           kSymbolShare * std::max(plan.width_m(), plan.height_m()));
    all.insert(all.end(), symbols.begin(), symbols.end());
    for (const auto& line : all) lines.push_back({{"stroke", stroke_name(line.stroke)}, {"points", flat(line.points_m)}});
  }

  const LuminanceDatabase& database_;
  const Zone& zone_;
  const std::vector<LightGroup>& groups_;
  const Job& job_;
  std::vector<std::vector<double>> point_lx_;                         // [n_groups][n_points]
  std::vector<std::optional<std::vector<PointError>>> point_error_;  // [n_groups]
  std::vector<CellAppearance> appearance_;                            // [n_groups]
  std::vector<std::vector<SurfaceFigures>> surface_figures_;          // [n_groups][n_surfaces]
  std::vector<std::optional<std::vector<PointError>>> surface_error_;  // [n_groups]
  std::vector<double> share_;                                         // [n_groups] of what has no error of its own
};

}  // namespace

Json targets_part(const LuminanceDatabase& database, const std::vector<LightGroup>& groups,
                  const std::optional<Requirements>& requirements, const Job& job) {
  const Targets targets(database, groups, job);
  const Zone& zone = database.zone();
  Json list = Json::array();
  for (std::size_t k = 0; k < zone.point_sets.size(); ++k) {
    job.check();
    list.push_back(targets.of_points(k));
  }
  if (!requirements) return list;
  std::set<std::string> named;
  for (const auto& requirement : requirements->requirements)
    named.insert(requirement.surfaces.begin(), requirement.surfaces.end());
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s)
    if (!zone.surfaces[s].outside && named.contains(zone.surfaces[s].name)) list.push_back(targets.of_surface(s));
  return list;
}

}  // namespace dim
