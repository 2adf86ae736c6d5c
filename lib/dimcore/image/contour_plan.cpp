#include "image/contour_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/hidden_lines.hpp"
#include "network/cells.hpp"

namespace dim {
namespace {

constexpr double kLevel = 0.7;         // |n.z| from which a plane counts as level
constexpr double kSurroundings = 0.5;  // shown of them round a small plane, of its longer side
constexpr double kMargin = 0.02;       // beyond the room, of its longer side

struct Bounds {
  Vec2 low{std::numeric_limits<double>::max()}, high{std::numeric_limits<double>::lowest()};

  void add(const Vec2& p) { low = glm::min(low, p), high = glm::max(high, p); }
  void grow(double by) { low -= Vec2(by), high += Vec2(by); }
  double longer() const { return std::max(high.x - low.x, high.y - low.y); }
};

bool is_level(const Frame& frame) { return std::abs(frame.n.z) > kLevel; }

Frame facing_reader(const Polygon& polygon) {
  Frame frame;
  frame.origin = Vec3(0.0);
  frame.n = polygon.normal();
  if (is_level(frame) && frame.n.z < 0.0) frame.n = -frame.n;
  const Vec3 wanted = is_level(frame) ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  frame.u = glm::normalize(glm::cross(wanted, frame.n));
  frame.v = glm::cross(frame.n, frame.u);
  frame.origin = polygon.frame().origin;
  return frame;
}

Bounds bounds_of(const Polygon& polygon, const Frame& frame) {
  Bounds bounds;
  for (const auto& ring : polygon.corners())
    for (const Vec3& corner : ring) bounds.add(frame.to_local(corner));
  return bounds;
}

// A polygon seen edge-on shrinks to a line: its ends.
std::optional<std::vector<Vec2>> edge_on(const Polygon& polygon, const PlanFrame& plan) {
  constexpr double kFlat = 1e-6;
  if (std::abs(glm::dot(polygon.normal(), plan.frame.n)) > kFlat) return {};
  const Vec3 along = glm::cross(polygon.normal(), plan.frame.n);
  std::pair<double, Vec2> first{std::numeric_limits<double>::max(), {}}, last{-first.first, {}};
  for (const auto& ring : polygon.corners()) {
    for (const Vec3& corner : ring) {
      const double s = glm::dot(corner - plan.frame.origin, along);
      if (s < first.first) first = {s, plan.to_plan(corner)};
      if (s > last.first) last = {s, plan.to_plan(corner)};
    }
  }
  return std::vector<Vec2>{first.second, last.second};
}

std::vector<Vec3> opening_corners(const ShownLuminaire& luminaire) {
  std::vector<Vec3> corners;
  for (const Vec3& p : outline(luminaire.opening))
    corners.push_back(luminaire.at + p.x * luminaire.c0 + p.y * luminaire.c90 + p.z * luminaire.aim);
  return corners;
}

// Height above the plane from which the room is looked at.
double eye_height_m(const Zone& zone, const std::vector<ShownLuminaire>& luminaires, const PlanFrame& plan) {
  const double slack_m = 1e-3 * zone.diameter_m;
  if (!is_level(plan.frame)) return 1e-4 * zone.diameter_m;
  double top = 0.0;
  for (const auto& surface : zone.surfaces) {
    if (surface.outside) continue;
    for (const auto& ring : surface.polygon.corners())
      for (const Vec3& corner : ring) top = std::max(top, plan.frame.height(corner));
  }
  top += slack_m;
  for (const auto& luminaire : luminaires) {
    const double height = plan.frame.height(luminaire.at);
    if (height > 2.0 * slack_m) top = std::min(top, height - slack_m);
  }
  return top;
}

void add_closed(std::vector<PlanLine>& lines, PlanStroke stroke, std::vector<Vec2> points) {
  points.push_back(points.front());
  lines.push_back({stroke, std::move(points)});
}

void add_symbol(std::vector<PlanLine>& lines, const Vec2& middle, double radius) {
  constexpr int kCorners = 24;
  std::vector<Vec2> circle;
  for (int k = 0; k < kCorners; ++k) {
    const double turn = 2.0 * kPi * k / kCorners;
    circle.push_back(middle + radius * Vec2(std::cos(turn), std::sin(turn)));
  }
  add_closed(lines, PlanStroke::luminaire, std::move(circle));
  const double d = radius * std::sqrt(0.5);
  for (const double side : {1.0, -1.0})
    lines.push_back({PlanStroke::luminaire, {middle - Vec2(d, side * d), middle + Vec2(d, side * d)}});
}

}  // namespace

PlanFrame plan_frame(const Zone& zone, const Polygon& polygon) {
  PlanFrame plan;
  plan.frame = facing_reader(polygon);
  const Bounds plane = bounds_of(polygon, plan.frame);
  Bounds room = plane;
  const bool of_wall = !is_level(plan.frame);
  for (const auto& surface : zone.surfaces) {
    if (surface.outside) continue;
    const Bounds its = bounds_of(surface.polygon, plan.frame);
    room.add(its.low);
    room.add(its.high);
  }
  Bounds shown = plane;
  shown.grow(kSurroundings * plane.longer());
  if (of_wall || room.longer() <= shown.longer()) shown = room;
  shown.low = glm::max(shown.low, room.low);
  shown.high = glm::min(shown.high, room.high);
  shown.grow(kMargin * shown.longer());
  plan.low_m = shown.low;
  plan.high_m = shown.high;
  return plan;
}

std::vector<PlanLine> plan_of_room(const Zone& zone, const std::vector<ShownLuminaire>& luminaires,
                                   const PlanFrame& plan, const Job& job) {
  auto plates = plates_of(zone);
  std::vector<Plate> shown;
  std::vector<PlanLine> lines;
  for (std::size_t s = 0; s < plates.size(); ++s) {
    const Surface& surface = zone.surfaces[s];
    if (surface.outside) continue;
    shown.push_back(plates[s]);
    shown.back().open_back |= surface.bounding;
    if (!surface.bounding) continue;
    if (auto ends = edge_on(surface.polygon, plan))
      lines.push_back({is_window(zone, surface) ? PlanStroke::window : PlanStroke::wall, *ends});
  }
  // The picture's pixels are only to scale: hidden_lines wants some.
  constexpr int kWidth_px = 10000;
  const double px_per_m = kWidth_px / plan.width_m();
  const Vec2 middle = 0.5 * (plan.low_m + plan.high_m);
  Camera camera;
  camera.focus = plan.frame.to_world(middle);
  camera.eye = camera.focus + eye_height_m(zone, luminaires, plan) * plan.frame.n;
  camera.up = plan.frame.v;
  camera.width = kWidth_px;
  camera.height = std::max(1, static_cast<int>(std::ceil(plan.height_m() * px_per_m)));
  camera.parallel_m = plan.width_m();
  const Vec2 centre_px(0.5 * camera.width, 0.5 * camera.height);
  const auto to_plan = [&](const Vec2& px) {
    return middle + Vec2(px.x - centre_px.x, centre_px.y - px.y) / px_per_m;
  };
  for (const auto& segment : hidden_lines(shown, zone.diameter_m, camera, job))
    lines.push_back({PlanStroke::edge, {to_plan(segment.a), to_plan(segment.b)}});
  std::stable_sort(lines.begin(), lines.end(), [](const PlanLine& a, const PlanLine& b) {
    return static_cast<int>(a.stroke) < static_cast<int>(b.stroke);
  });
  return lines;
}

std::vector<PlanLine> plan_of_surface(const Zone& zone, std::size_t surface, const PlanFrame& plan) {
  std::vector<PlanLine> lines;
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
    const bool itself = s == surface;
    const Surface& other = zone.surfaces[s];
    if (!itself && other.parent != static_cast<int>(surface)) continue;
    const auto stroke = is_window(zone, other) ? PlanStroke::window
                        : itself               ? PlanStroke::wall
                                               : PlanStroke::edge;
    for (const auto& ring : other.polygon.corners()) {
      std::vector<Vec2> points;
      for (const Vec3& corner : ring) points.push_back(plan.to_plan(corner));
      add_closed(lines, stroke, std::move(points));
    }
  }
  return lines;
}

std::vector<PlanLine> luminaire_symbols(const std::vector<ShownLuminaire>& luminaires, const PlanFrame& plan,
                                        double least_m) {
  std::vector<PlanLine> lines;
  for (const auto& luminaire : luminaires) {
    const Vec2 at = plan.to_plan(luminaire.at);
    if (at.x < plan.low_m.x || at.y < plan.low_m.y || at.x > plan.high_m.x || at.y > plan.high_m.y) continue;
    Bounds bounds;
    std::vector<Vec2> points;
    for (const Vec3& corner : opening_corners(luminaire)) {
      points.push_back(plan.to_plan(corner));
      bounds.add(points.back());
    }
    if (points.empty() || bounds.longer() < least_m) {
      add_symbol(lines, at, 0.5 * least_m);
      continue;
    }
    if (points.size() == 4)
      for (const std::size_t k : {std::size_t{0}, std::size_t{1}})
        lines.push_back({PlanStroke::luminaire, {points[k], points[k + 2]}});
    add_closed(lines, PlanStroke::luminaire, std::move(points));
  }
  return lines;
}

std::optional<Vec2> north_in_plan(const Zone& zone, const PlanFrame& plan) {
  if (!zone.site || !is_level(plan.frame)) return {};
  const double turn = radians(zone.site->north_deg);
  const Vec3 north(std::sin(turn), std::cos(turn), 0.0);
  const Vec2 in_plan(glm::dot(north, plan.frame.u), glm::dot(north, plan.frame.v));
  return glm::normalize(in_plan);
}

}  // namespace dim
