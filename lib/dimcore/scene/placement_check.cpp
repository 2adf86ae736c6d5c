#include "scene/placement_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "database/toml_reader.hpp"
#include "scene/inside_test.hpp"
#include "scene/length_unit.hpp"

namespace dim {
namespace {

constexpr std::size_t kBoxFaces = 6;
constexpr std::size_t kMostNamed = 5;

constexpr double kSmallestRoom_m = 0.3;
constexpr double kLargestRoom_m = 1500.0;
constexpr double kTallestRoom_m = 100.0;

std::string unit_name(double unit_m) {
  for (const auto& unit : kLengthUnits)
    if (unit.metres == unit_m) return unit.name;
  return fmt::format("{:g} m", unit_m);
}

Vec3 extent_of(const Zone& zone) {
  Vec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const auto& surface : zone.surfaces) {
    if (!surface.bounding) continue;
    for (const auto& ring : surface.polygon.corners())
      for (const auto& p : ring) low = glm::min(low, p), high = glm::max(high, p);
  }
  return low.x <= high.x ? high - low : Vec3(0.0);
}

double largest(const Vec3& v) { return std::max({v.x, v.y, v.z}); }
double smallest(const Vec3& v) { return std::min({v.x, v.y, v.z}); }

bool like_a_room(const Vec3& size_m) {
  return largest(size_m) >= 1.5 && largest(size_m) <= 150.0 && smallest(size_m) <= 30.0 &&
         smallest(size_m) >= 1.0;
}

/// A solid of the zone: a box's six faces, or one panel.
struct Body {
  const Surface* first = nullptr;
  BodyFaces faces;
  std::string label;           ///< "box 'desk'"
  std::vector<Vec3> extremes;  ///< points of it that must lie inside, a little within its outline
  bool outside = false;        ///< an external obstruction: may lie outside

  bool contains(const Vec3& p, double touch_m) const {
    if (faces.n != kBoxFaces) return false;
    for (std::size_t i = 0; i < faces.n; ++i)
      if (first[i].polygon.frame().height(p) > -touch_m) return false;
    return true;
  }
};

std::string name_of_box(const std::string& face) { return face.substr(0, face.rfind('.')); }

Body body_at(const std::vector<Surface>& surfaces, std::size_t i, bool of_box, double touch_m) {
  Body body;
  body.first = &surfaces[i];
  body.faces = {i, of_box ? kBoxFaces : 1};
  body.outside = surfaces[i].outside;
  body.label = of_box ? fmt::format("box '{}'", name_of_box(surfaces[i].name))
                      : fmt::format("surface '{}'", surfaces[i].name);
  Vec3 middle(0.0);
  for (std::size_t f = 0; f < body.faces.n; ++f)
    for (const auto& ring : surfaces[i + f].polygon.corners())
      body.extremes.insert(body.extremes.end(), ring.begin(), ring.end());
  for (const auto& p : body.extremes) middle += p / static_cast<double>(body.extremes.size());
  // What only touches a wall lies inside it.
  for (auto& p : body.extremes) {
    const Vec3 inwards = middle - p;
    const double distance = glm::length(inwards);
    if (distance > 0.0) p += inwards * std::min(1.0, 10.0 * touch_m / distance);
  }
  body.extremes.push_back(middle);
  return body;
}

std::vector<Body> bodies_of(const Zone& zone, const std::vector<SurfaceLink>& links, double touch_m) {
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < zone.surfaces.size(); ++i) {
    const auto& surface = zone.surfaces[i];
    const bool panel = surface.twin > static_cast<int>(i);
    if (!links[i].of_box && !panel) continue;
    if (links[i].of_box && i + kBoxFaces > zone.surfaces.size()) break;
    bodies.push_back(body_at(zone.surfaces, i, links[i].of_box, touch_m));
    if (links[i].of_box) i += kBoxFaces - 1;
  }
  return bodies;
}

/// One line a kind: the first by name, the rest by number.
class Named {
 public:
  void add(const Body& body) {
    if (n_++ == 0) place_ = body.first->place;
    if (n_ <= kMostNamed) names_ += (names_.empty() ? "" : ", ") + body.label;
  }
  std::string names() const {
    return n_ > kMostNamed ? fmt::format("{} and {} more", names_, n_ - kMostNamed) : names_;
  }
  std::size_t n() const { return n_; }
  const Place& place() const { return place_; }

 private:
  std::size_t n_ = 0;
  std::string names_;
  Place place_;
};

std::vector<ShellCut> warn_of_bodies(const Zone& zone, const std::vector<Body>& bodies, const InsideTest& test,
                                     double touch_m, Warnings& warnings) {
  Named outside, through, cut_off;
  std::vector<ShellCut> cuts;
  for (const auto& body : bodies) {
    if (body.outside) continue;
    const auto n_outside = std::count_if(body.extremes.begin(), body.extremes.end(),
                                         [&](const Vec3& p) { return test.outside(p); });
    // A body may stand in the zone with every corner outside, and be pierced by a corner of it with none.
    const bool pierced = goes_through_shell(zone.surfaces, body.faces, touch_m);
    if (n_outside == 0 && !pierced) continue;
    if (n_outside == static_cast<std::ptrdiff_t>(body.extremes.size()) && !pierced) {
      outside.add(body);
      continue;
    }
    const auto found = find_shell_cuts(zone.surfaces, body.faces, test, touch_m);
    (found.empty() ? through : cut_off).add(body);
    cuts.insert(cuts.end(), found.begin(), found.end());
  }
  if (outside.n() > 0)
    warnings.push_back(
        {outside.place(),
         fmt::format("{} {} outside the zone: no light gets there", outside.names(),
                     outside.n() == 1 ? "lies" : "lie"),
         fmt::format("check the position and the unit (every length is in {}); an external obstruction "
                     "is written outside = true",
                     unit_name(zone.unit_m))});
  const auto warn_of_through = [&](const Named& named, const std::string& part) {
    if (named.n() == 0) return;
    warnings.push_back(
        {named.place(),
         fmt::format("{} {} through the zone's surfaces: {}", named.names(), named.n() == 1 ? "goes" : "go", part),
         fmt::format("check the position and the size (every length is in {}), or end it at the wall",
                     unit_name(zone.unit_m))});
  };
  warn_of_through(cut_off, "the part outside is cut off");
  warn_of_through(through,
                  "they cannot end it there, so it is kept whole; what lies outside stays dark and counts in its "
                  "figures");
  return cuts;
}

void warn_of_eyes(const Zone& zone, const std::vector<Place>& eyes, const std::vector<Body>& bodies,
                  const InsideTest& test, const ZoneFrame& frame, double touch_m, Warnings& warnings) {
  for (std::size_t i = 0; i < zone.views.size(); ++i) {
    const View& view = zone.views[i];
    const auto body = std::find_if(bodies.begin(), bodies.end(),
                                   [&](const Body& b) { return b.contains(view.eye, touch_m); });
    if (view.parallel() && body != bodies.end()) continue;  // a section may begin in a cabinet
    const std::string eye =
        fmt::format("view '{}': its eye {}", view.name, short_point(frame.to_file(view.eye)));
    if (body != bodies.end())
      warnings.push_back({eyes.at(i), fmt::format("{} lies inside {}: nothing can be seen", eye, body->label),
                          "move the eye, or the box"});
    else if (test.outside(view.eye))
      warnings.push_back(
          {eyes.at(i),
           eye + " lies outside the zone, or inside furniture written as surfaces: it looks "
                 "through the backs of what is before it",
           fmt::format("check the position and the unit (every length is in {})", unit_name(zone.unit_m))});
  }
}

}  // namespace

void warn_of_size(const Zone& zone, const Place& place, Warnings& warnings) {
  const Vec3 size_m = extent_of(zone);
  if (!(largest(size_m) > 0.0)) return;
  const bool small = largest(size_m) < kSmallestRoom_m;
  const bool large = largest(size_m) > kLargestRoom_m || smallest(size_m) > kTallestRoom_m;
  if (!small && !large) return;
  std::string cure =
      fmt::format("every length of the file is in {}; say unit = \"...\"", unit_name(zone.unit_m));
  for (const auto& unit : kLengthUnits)
    if (like_a_room(size_m * (unit.metres / zone.unit_m))) {
      cure = fmt::format("every length of the file is in {}: is it unit = \"{}\"?", unit_name(zone.unit_m),
                         unit.name);
      break;
    }
  warnings.push_back({place,
                      fmt::format("the zone measures {:.4g} x {:.4g} x {:.4g} m, which no room does",
                                  size_m.x, size_m.y, size_m.z),
                      cure});
}

std::vector<ShellCut> warn_of_placement(const Zone& zone, const std::vector<SurfaceLink>& links,
                                        const std::vector<Place>& eyes, const ZoneFrame& frame, double touch_m,
                                        Warnings& warnings) {
  const auto bodies = bodies_of(zone, links, touch_m);
  if (bodies.empty() && zone.views.empty()) return {};
  const InsideTest test(zone.surfaces, zone.diameter_m, zone.closed);
  auto cuts = warn_of_bodies(zone, bodies, test, touch_m, warnings);
  warn_of_eyes(zone, eyes, bodies, test, frame, touch_m, warnings);
  return cuts;
}

}  // namespace dim
