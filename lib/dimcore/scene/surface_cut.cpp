#include "scene/surface_cut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "scene/coplanar_pairs.hpp"

namespace dim {
namespace {

constexpr double kRelativeTouch = 1e-6;

std::string label(const Surface& surface) { return fmt::format("surface '{}'", surface.name); }

void check_feature(const Surface& feature, const Surface& parent, double touch_m, Problems& problems) {
  const Polygon &small = feature.polygon, &large = parent.polygon;
  double off_m = 0.0;
  if (!lies_in_plane(small, large.frame(), touch_m, &off_m))
    return problems.add(
        feature.place,
        fmt::format("{} lies {:.6g} m off the plane of its parent '{}'", label(feature), off_m, parent.name),
        "a feature's corners lie in its parent's plane");
  if (glm::dot(small.normal(), large.normal()) < 0.0)
    return problems.add(
        feature.place,
        fmt::format("{} faces the other way from its parent '{}'", label(feature), parent.name),
        "list its corners the other way round");
  const Region2 beyond =
      without_slivers(clip_difference(region_in_frame(small, large, touch_m), large.rings()), touch_m);
  if (!beyond.empty())
    problems.add(
        feature.place,
        fmt::format("{} reaches {:.6g} m2 beyond its parent '{}'", label(feature), area(beyond), parent.name),
        "keep it inside the parent's outline and clear of its holes");
}

void drop_empty(std::vector<Surface>& surfaces) {
  std::vector<int> moved(surfaces.size(), -1);
  std::vector<Surface> kept;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (!(surfaces[i].polygon.area_m2() > 0.0)) continue;
    moved[i] = static_cast<int>(kept.size());
    kept.push_back(std::move(surfaces[i]));
  }
  const auto follow = [&moved](int i) { return i < 0 ? -1 : moved[static_cast<std::size_t>(i)]; };
  for (auto& surface : kept) {
    surface.parent = follow(surface.parent);
    surface.twin = follow(surface.twin);
  }
  surfaces = std::move(kept);
}

// A feature on a panel and the panel's other side are back to back by nature.
bool lies_on_twin(const std::vector<Surface>& surfaces, std::size_t panel, std::size_t feature) {
  const int twin = surfaces[panel].twin;
  return twin >= 0 && is_ancestor(surfaces, static_cast<std::size_t>(twin), feature);
}

bool covers(double common_m2, const Polygon& polygon) {
  constexpr double kWhole = 1e-6;
  return common_m2 >= polygon.area_m2() * (1.0 - kWhole);
}

}  // namespace

double touch_tolerance_m(const std::vector<Surface>& surfaces) {
  Vec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  bool any_inside = false;
  for (const auto& surface : surfaces) any_inside = any_inside || !surface.outside;
  for (const auto& surface : surfaces) {
    if (surface.outside && any_inside) continue;
    for (const auto& ring : surface.polygon.corners())
      for (const auto& p : ring) low = glm::min(low, p), high = glm::max(high, p);
  }
  return surfaces.empty() ? 0.0 : kRelativeTouch * glm::length(high - low);
}

bool is_ancestor(const std::vector<Surface>& surfaces, std::size_t ancestor, std::size_t descendant) {
  int at = surfaces[descendant].parent;
  for (std::size_t steps = 0; at >= 0 && steps < surfaces.size(); ++steps) {
    if (at == static_cast<int>(ancestor)) return true;
    at = surfaces[static_cast<std::size_t>(at)].parent;
  }
  return false;
}

void join_features(std::vector<Surface>& surfaces, const std::vector<SurfaceLink>& links, double touch_m,
                   Problems& problems) {
  std::map<std::string, int> index;
  for (std::size_t i = 0; i < surfaces.size(); ++i) index.emplace(surfaces[i].name, static_cast<int>(i));
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    if (!links[i].on.empty()) surfaces[i].parent = index.at(links[i].on);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (surfaces[i].parent >= 0 && is_ancestor(surfaces, i, i)) {
      problems.add(links[i].on_place, fmt::format("{} lies on itself", label(surfaces[i])),
                   "name the surface that it is cut out of");
      return;
    }
  }
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (surfaces[i].parent < 0) continue;
    const auto* ancestor = &surfaces[static_cast<std::size_t>(surfaces[i].parent)];
    check_feature(surfaces[i], *ancestor, touch_m, problems);
    while (ancestor->parent >= 0) ancestor = &surfaces[static_cast<std::size_t>(ancestor->parent)];
    surfaces[i].bounding = ancestor->bounding;
    surfaces[i].outside = ancestor->outside;
  }
}

void cut_features(std::vector<Surface>& surfaces, double touch_m) {
  std::map<std::size_t, std::vector<std::size_t>> features;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    if (surfaces[i].parent >= 0) features[static_cast<std::size_t>(surfaces[i].parent)].push_back(i);
  std::map<std::size_t, Polygon> whole;  // a parent may itself be cut before it is taken from its own parent
  for (const auto& [parent, children] : features) {
    for (const std::size_t child : children) whole.emplace(child, surfaces[child].polygon);
  }
  for (const auto& [parent, children] : features) {
    std::vector<const Polygon*> removed;
    for (const std::size_t child : children) removed.push_back(&whole.at(child));
    cut_out(surfaces[parent].polygon, removed, touch_m);
  }
}

void remove_contacts(std::vector<Surface>& surfaces, const std::vector<SurfaceLink>& links, double touch_m,
                     Warnings& warnings) {
  std::map<std::size_t, std::vector<std::size_t>> contacts;
  for (const auto& pair : coplanar_pairs(surfaces, touch_m)) {
    if (pair.same_facing || lies_on_twin(surfaces, pair.large, pair.small) ||
        lies_on_twin(surfaces, pair.small, pair.large))
      continue;
    Surface &large = surfaces[pair.large], &small = surfaces[pair.small];
    const double common_m2 = common_area_m2(large.polygon, small.polygon, touch_m);
    if (!(common_m2 > 0.0)) continue;
    if (!links[pair.large].of_box && !links[pair.small].of_box) {
      if (covers(common_m2, large.polygon) && covers(common_m2, small.polygon)) {
        if (large.twin < 0 && small.twin < 0) {
          large.twin = static_cast<int>(pair.small);
          small.twin = static_cast<int>(pair.large);
        }
        continue;
      }
      warnings.push_back(
          {small.place,
           fmt::format("{} and surface '{}' touch back to back: their common {:.6g} m2 is left out",
                       label(small), large.name, common_m2),
           "a thin partition is one surface with sides = 2"});
    }
    contacts[pair.large].push_back(pair.small);
    contacts[pair.small].push_back(pair.large);
  }
  std::map<std::size_t, Polygon> whole;
  for (const auto& [i, others] : contacts) whole.emplace(i, surfaces[i].polygon);
  for (auto& surface : surfaces) surface.fills_rectangle = surface.polygon.is_rectangle();
  for (const auto& [i, others] : contacts) {
    std::vector<const Polygon*> removed;
    for (const std::size_t other : others) removed.push_back(&whole.at(other));
    cut_out(surfaces[i].polygon, removed, touch_m);
  }
  drop_empty(surfaces);
}

}  // namespace dim
