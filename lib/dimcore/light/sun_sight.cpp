#include "light/sun_sight.hpp"

#include <algorithm>
#include <cmath>

#include "sky/sun_position.hpp"

namespace dim {
namespace {

const double kRadius = std::tan(0.5 * kSunDiameter_rad);
constexpr int kDiscCorners = 24;
constexpr int kDirectionsOnCell = 16;
constexpr double kGoldenTurn = 0.3819660112501051;

// The disc as a polygon of its area, in units of the tangent plane.
ConvexPatch disc_patch() {
  const double turn = 2.0 * kPi / kDiscCorners;
  const double radius = kRadius * std::sqrt(turn / std::sin(turn));
  ConvexPatch patch;
  for (int i = 0; i < kDiscCorners; ++i) patch.add(radius * Vec2(std::cos(turn * i), std::sin(turn * i)));
  return patch;
}

// Whether a ball round `middle` lies off the cone of directions in which the sun is seen from `eye`.
bool off_cone(const Vec3& eye, const Vec3& towards, const Vec3& middle, double radius_m) {
  const Vec3 way = middle - eye;
  const double along = glm::dot(way, towards);
  if (along < -radius_m) return true;
  const double reach = radius_m + 1.1 * kRadius * (along + radius_m);
  return glm::dot(way, way) - along * along > reach * reach;
}

// The part of a ring with dot(normal, p) >= offset; of rings that are not convex its pieces hang together by edges
// along the cut, which even-odd counting does not see.
Ring3 front_of(const Ring3& ring, const Vec3& normal, double offset) {
  Ring3 front;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec3 &p = ring[i], &q = ring[i + 1 < ring.size() ? i + 1 : 0];
    const double at_p = glm::dot(normal, p) - offset, at_q = glm::dot(normal, q) - offset;
    if (at_p >= 0.0) front.push_back(p);
    if ((at_p >= 0.0) != (at_q >= 0.0)) front.push_back(p + at_p / (at_p - at_q) * (q - p));
  }
  return front;
}

}  // namespace

SunSight::Ball SunSight::ball_of(const Polygon& polygon) {
  Ball ball{polygon.frame().to_world(0.5 * polygon.size_m()), 0.0};
  ball.radius_m = 0.5 * glm::length(polygon.size_m());
  return ball;
}

SunSight::SunSight(const Zone& zone, const Windows& windows, std::vector<Plate> plates,
                   const ShadowPlates& shadows)
    : zone_(zone), windows_(windows), plates_(std::move(plates)), shadows_(shadows), outside_of_(windows.windows.size()) {
  const double tolerance_m = 1e-7 * zone.diameter_m;
  for (const auto& plate : plates_) ball_.push_back(ball_of(*plate.polygon));
  for (std::size_t w = 0; w < windows.windows.size(); ++w) {
    const Window& window = windows.windows[w];
    window_ball_.push_back(ball_of(window.polygon));
    if (window.open_outside) continue;
    for (std::size_t p = 0; p < plates_.size(); ++p) {
      const auto rings = plates_[p].polygon->corners();
      const bool behind = std::any_of(rings.begin(), rings.end(), [&](const Ring3& ring) {
        return std::any_of(ring.begin(), ring.end(),
                           [&](const Vec3& corner) { return window.frame().height(corner) < -tolerance_m; });
      });
      if (behind && static_cast<int>(p) != window.plate) outside_of_[w].push_back(static_cast<int>(p));
    }
  }
}

SunSight::Obstacles SunSight::obstacles(const ConvexRing& receiver, const Response& response, int skip) const {
  Obstacles found(windows_.windows.size());
  const Vec3& normal = response.normal;
  const double offset = glm::dot(normal, receiver[0]);
  std::vector<int> between;
  for (std::size_t w = 0; w < found.size(); ++w) {
    const Window& window = windows_.windows[w];
    found[w] = outside_of_[w];
    for (const auto& part : window.parts) {
      const ConvexRing front = response.is_planar() ? part.front_of(normal, offset) : part;
      if (front.empty()) continue;
      Shaft shaft(receiver, front, skip);
      if (response.is_planar()) shaft.add_limit(normal, offset);
      between.clear();
      shadows_.candidates(shaft, between);
      found[w].insert(found[w].end(), between.begin(), between.end());
    }
    std::sort(found[w].begin(), found[w].end());
    found[w].erase(std::unique(found[w].begin(), found[w].end()), found[w].end());
    std::erase(found[w], window.plate);
    std::erase(found[w], skip);
  }
  return found;
}

std::vector<int> SunSight::in_the_open(const ConvexRing& receiver, int skip, const Vec3& towards) const {
  const double far_m = 2.0 * zone_.diameter_m;
  const Vec3 middle = receiver.middle(), u = perpendicular(towards), v = glm::cross(towards, u);
  const double half_m = receiver.radius_m(middle) + 1.5 * kRadius * far_m;
  ConvexRing sun;
  for (const Vec2& corner : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)})
    sun.add(middle + far_m * towards + half_m * (corner.x * u + corner.y * v));
  std::vector<int> between;
  shadows_.candidates(Shaft(receiver, sun, skip), between);
  std::erase(between, skip);
  return between;
}

CoverRings SunSight::flat(int plate, const Vec3& normal, double least_height,
                          const std::function<Vec2(const Vec3&)>& projected) const {
  const Plate& cover = plates_[static_cast<std::size_t>(plate)];
  std::vector<Ring3> rings = cover.polygon->corners();
  if (cover.fills_rectangle) {
    const Frame& frame = cover.polygon->frame();
    const Vec2 size = cover.polygon->size_m();
    rings = {{frame.to_world({0.0, 0.0}), frame.to_world({size.x, 0.0}), frame.to_world(size),
              frame.to_world({0.0, size.y})}};
  }
  CoverRings result;
  for (const auto& ring : rings) {
    Ring2 on_plane;
    for (const Vec3& p : front_of(ring, normal, least_height)) on_plane.push_back(projected(p));
    if (on_plane.size() > 2) result.push_back(std::move(on_plane));
  }
  return result;
}

void SunSight::seen(const ConvexRing& receiver, const Response& response, int skip, const Obstacles& obstacles,
                    const Vec3& towards, std::vector<Seen>& result) const {
  result.clear();
  if (!(towards.z > -0.5 * kSunDiameter_rad)) return;
  if (response.is_planar() && !(glm::dot(response.normal, towards) > -0.5 * kSunDiameter_rad)) return;
  if (receiver.size() == 1)
    seen_by_point(receiver[0], response, obstacles, towards, result);
  else
    seen_by_cell(receiver, response.normal, skip, obstacles, towards, result);
}

void SunSight::seen_by_point(const Vec3& point, const Response& response, const Obstacles& obstacles,
                             const Vec3& towards, std::vector<Seen>& result) const {
  static const ConvexPatch kDisc = disc_patch();
  const Vec3 u = perpendicular(towards), v = glm::cross(towards, u);
  const auto keep = [&](ConvexPatch& patch, const Vec3& inwards) {
    patch.keep(glm::dot(inwards, towards), glm::dot(inwards, u), glm::dot(inwards, v));
  };
  ConvexPatch disc = kDisc;
  if (response.is_planar() && glm::dot(response.normal, towards) < kRadius) keep(disc, response.normal);
  if (towards.z < kRadius) keep(disc, {0, 0, 1});
  if (disc.empty()) return;
  const auto projected = [&](const Vec3& p) {
    const Vec3 way = p - point;
    return Vec2(glm::dot(way, u), glm::dot(way, v)) / glm::dot(way, towards);
  };
  const auto add = [&](std::size_t window, const ConvexPatch& patch, const std::vector<int>& in_the_way) {
    if (patch.empty()) return;
    std::vector<CoverRings> covers;
    for (const int plate : in_the_way) {
      const Ball& ball = ball_[static_cast<std::size_t>(plate)];
      if (off_cone(point, towards, ball.middle, ball.radius_m)) continue;
      const double nearest = glm::dot(towards, point) + 1e-6 * zone_.diameter_m;
      covers.push_back(flat(plate, towards, nearest, projected));
    }
    const double area = uncovered_area(patch, covers);
    if (!(area > 0.0)) return;
    const Vec2 middle = patch.centroid();
    const Vec3 direction = glm::normalize(towards + middle.x * u + middle.y * v);
    const double incidence =
        window == kNoWindow ? 1.0 : -glm::dot(windows_.windows[window].frame().n, direction);
    if (incidence > 0.0)
      result.push_back({window, area / (kPi * kRadius * kRadius) * response.of(direction), incidence});
  };
  if (windows_.dome) add(kNoWindow, disc, in_the_open(ConvexRing(point), -1, towards));
  for (std::size_t w = 0; w < windows_.windows.size(); ++w) {
    const Window& window = windows_.windows[w];
    if (off_cone(point, towards, window_ball_[w].middle, window_ball_[w].radius_m) ||
        !(window.frame().height(point) > 0.0))
      continue;
    for (const auto& part : window.parts) {
      ConvexPatch patch = disc;
      const Vec3 middle = part.middle() - point;
      for (int i = 0; i < part.size() && !patch.empty(); ++i) {
        Vec3 inwards = glm::cross(part[i] - point, part[i + 1 < part.size() ? i + 1 : 0] - point);
        if (glm::dot(inwards, middle) < 0.0) inwards = -inwards;
        if (glm::dot(inwards, towards) < 1.1 * kRadius * glm::length(inwards)) keep(patch, inwards);
      }
      add(w, patch, obstacles[w]);
    }
  }
}

void SunSight::seen_by_cell(const ConvexRing& cell, const Vec3& normal, int skip, const Obstacles& obstacles,
                            const Vec3& towards, std::vector<Seen>& result) const {
  const Vec3 origin = cell[0], u = perpendicular(normal), v = glm::cross(normal, u);
  const auto on_cell = [&](const Vec3& p) { return Vec2(glm::dot(p - origin, u), glm::dot(p - origin, v)); };
  ConvexPatch whole;
  for (const Vec3& corner : cell) whole.add(on_cell(corner));
  const double area_m2 = whole.area();
  if (!(area_m2 > 0.0)) return;
  const SunDisc disc({towards, 1.0});
  const std::vector<int> above =
      windows_.dome ? this->in_the_open(cell, skip, towards) : std::vector<int>();
  for (int k = 0; k < kDirectionsOnCell; ++k) {
    const Vec3 direction = disc.direction((k + 0.5) / kDirectionsOnCell, k * kGoldenTurn);
    const double cosine = glm::dot(normal, direction);
    if (!(cosine > 0.0) || !(direction.z > 0.0)) continue;
    const double lowest = glm::dot(normal, origin) + 1e-6 * zone_.diameter_m;
    const auto projected = [&](const Vec3& p) {
      return on_cell(p - glm::dot(normal, p - origin) / cosine * direction);
    };
    const auto add = [&](std::size_t window, const ConvexPatch& patch, const std::vector<int>& in_the_way,
                         double incidence) {
      if (patch.empty()) return;
      std::vector<CoverRings> covers;
      for (const int plate : in_the_way) covers.push_back(flat(plate, normal, lowest, projected));
      const double open = uncovered_area(patch, covers);
      if (open > 0.0) result.push_back({window, open / area_m2 * cosine / kDirectionsOnCell, incidence});
    };
    if (windows_.dome) add(kNoWindow, whole, above, 1.0);
    for (std::size_t w = 0; w < windows_.windows.size(); ++w) {
      const Frame& pane = windows_.windows[w].frame();
      const double incidence = -glm::dot(pane.n, direction);
      if (!(incidence > 0.0)) continue;
      for (const auto& part : windows_.windows[w].parts) {
        ConvexPatch patch = whole;
        const Vec3 middle = part.middle();
        const auto keep = [&](const Vec3& inwards, const Vec3& through) {
          patch.keep(glm::dot(inwards, origin - through), glm::dot(inwards, u), glm::dot(inwards, v));
        };
        keep(pane.n, pane.origin);
        for (int i = 0; i < part.size() && !patch.empty(); ++i) {
          Vec3 inwards = glm::cross(part[i + 1 < part.size() ? i + 1 : 0] - part[i], direction);
          if (glm::dot(inwards, middle - part[i]) < 0.0) inwards = -inwards;
          keep(inwards, part[i]);
        }
        add(w, patch, obstacles[w], incidence);
      }
    }
  }
}

}  // namespace dim
