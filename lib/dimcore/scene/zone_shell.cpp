#include "scene/zone_shell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "database/toml_reader.hpp"
#include "scene/shell_edges.hpp"

namespace dim {
namespace {

// Union-find that also knows whether two members face opposite ways.
class Orientations {
 public:
  explicit Orientations(std::size_t n) : parent_(n), flipped_(n, 0), contradictory_(n, 0) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  std::size_t root(std::size_t i, bool& flipped) const {
    flipped = false;
    while (parent_[i] != i) {
      flipped ^= flipped_[i] != 0;
      i = parent_[i];
    }
    return i;
  }

  void join(const SharedEdge& edge) {
    bool flip_a = false, flip_b = false;
    const std::size_t a = root(edge.a, flip_a), b = root(edge.b, flip_b);
    const bool flip = flip_a != flip_b;
    if (a == b) {
      if (flip != edge.flipped) contradictory_[a] = 1;
      return;
    }
    parent_[b] = a;
    flipped_[b] = (flip != edge.flipped) ? 1 : 0;
    contradictory_[a] = contradictory_[a] || contradictory_[b] ? 1 : 0;
  }

  bool contradictory(std::size_t root) const { return contradictory_[root] != 0; }

 private:
  std::vector<std::size_t> parent_;
  std::vector<char> flipped_, contradictory_;
};

struct Part {
  std::vector<std::size_t> members;  ///< indices into the list of bounding surfaces
  std::vector<char> flipped;         ///< against the part's first surface
  bool contradictory = false;
  bool leaks = false;
  Vec3 low{std::numeric_limits<double>::max()}, high{std::numeric_limits<double>::lowest()};
  double volume_m3 = 0.0;  ///< with every member turned as the first

  Vec3 centre() const { return low + (high - low) / 2.0; }
};

// Solid angle of a triangle seen from the origin, signed (Van Oosterom & Strackee 1983, eq. 8).
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double numerator = glm::dot(a, glm::cross(b, c));
  const double denominator = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return 2.0 * std::atan2(numerator, denominator);
}

class Shell {
 public:
  Shell(const std::vector<Surface>& surfaces, double touch_m) {
    std::vector<const Polygon*> polygons;
    for (const auto& surface : surfaces) {
      if (!surface.bounding || surface.parent >= 0 || !(surface.polygon.area_m2() > 0.0)) continue;
      bounding_.push_back(&surface);
      polygons.push_back(&surface.polygon);
    }
    edges_ = match_edges(polygons, touch_m);
    find_parts();
    inner_.resize(parts_.size());
    for (std::size_t i = 0; i < parts_.size(); ++i) inner_[i] = is_inner(i) ? 1 : 0;
  }

  /// Edges through which light leaves the zone: a sheet standing free inside it has edges too.
  std::vector<LeakingEdge> leaking() const {
    auto leaks = edges_.leaking;
    std::erase_if(leaks, [this](const LeakingEdge& leak) { return inner_[part_of_[leak.polygon]] != 0; });
    return leaks;
  }
  const Surface& surface(std::size_t i) const { return *bounding_[i]; }
  bool empty() const { return bounding_.empty(); }

  double volume_m3() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (!inner_[i]) sum += std::abs(parts_[i].volume_m3);
    return sum;
  }

  void check_facing(Problems& problems, Warnings& warnings) const {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const Part& part = parts_[i];
      if (part.contradictory || !has_volume(part)) continue;
      const bool first_wrong = (part.volume_m3 < 0.0) != (inner_[i] != 0);
      std::vector<const Surface*> wrong;
      for (std::size_t m = 0; m < part.members.size(); ++m)
        if ((part.flipped[m] != 0) != first_wrong) wrong.push_back(bounding_[part.members[m]]);
      if (wrong.empty()) continue;
      const bool all = wrong.size() == part.members.size();
      if (all && (part.leaks || inner_[i])) continue;  // an open scene, a sealed cell: may be meant
      report(wrong, all, inner_[i] != 0, part.leaks, problems, warnings);
    }
  }

 private:
  void find_parts() {
    Orientations orientations(bounding_.size());
    for (const auto& edge : edges_.shared) orientations.join(edge);
    std::map<std::size_t, std::size_t> index;
    for (std::size_t i = 0; i < bounding_.size(); ++i) {
      bool flipped = false;
      const std::size_t root = orientations.root(i, flipped);
      const auto [it, added] = index.emplace(root, parts_.size());
      if (added) parts_.emplace_back();
      Part& part = parts_[it->second];
      part.contradictory = orientations.contradictory(root);
      part.members.push_back(i);
      part.flipped.push_back(flipped ? 1 : 0);
      part_of_.push_back(it->second);
      for (const auto& ring : bounding_[i]->polygon.corners())
        for (const auto& p : ring) part.low = glm::min(part.low, p), part.high = glm::max(part.high, p);
    }
    for (auto& part : parts_) orient(part);
    for (const auto& leak : edges_.leaking) parts_[part_of_[leak.polygon]].leaks = true;
  }

  // Counts orientation from the first listed member, and measures the volume that this encloses.
  void orient(Part& part) {
    const char first = part.flipped[0];
    for (std::size_t m = 0; m < part.members.size(); ++m) {
      part.flipped[m] = part.flipped[m] != first ? 1 : 0;
      const Polygon& polygon = bounding_[part.members[m]]->polygon;
      const double term =
          -glm::dot(polygon.centroid() - part.centre(), polygon.normal()) * polygon.area_m2() / 3.0;
      part.volume_m3 += part.flipped[m] ? -term : term;
    }
  }

  bool has_volume(const Part& part) const {
    constexpr double kLeast = 1e-4;  // of surface times size; a flat hall 100 x 100 x 3 m has 3e-2
    double area_m2 = 0.0;
    for (const std::size_t i : part.members) area_m2 += bounding_[i]->polygon.area_m2();
    return std::abs(part.volume_m3) > kLeast * area_m2 * glm::length(part.high - part.low);
  }

  // Inside an odd number of others, by the solid angle that they fill as seen from its centre.
  bool is_inner(std::size_t i) const {
    int n = 0;
    for (std::size_t j = 0; j < parts_.size(); ++j) {
      if (j == i || !larger(parts_[j], parts_[i]) || !has_volume(parts_[j])) continue;
      // 4 pi inside a closed part, less where it leaks, 2 pi on its face.
      if (std::abs(solid_angle_of(parts_[j], parts_[i].centre())) > 2.5 * kPi) ++n;
    }
    return n % 2 == 1;
  }

  static bool larger(const Part& outer, const Part& inner) {
    const double slack = 1e-6 * glm::length(outer.high - outer.low);
    for (int axis = 0; axis < 3; ++axis) {
      if (inner.low[axis] < outer.low[axis] - slack || inner.high[axis] > outer.high[axis] + slack)
        return false;
    }
    return glm::length(outer.high - outer.low) > glm::length(inner.high - inner.low);
  }

  double solid_angle_of(const Part& part, const Vec3& from) const {
    double sum = 0.0;
    for (std::size_t m = 0; m < part.members.size(); ++m) {
      double one = 0.0;
      for (const auto& ring : bounding_[part.members[m]]->polygon.corners())
        for (std::size_t i = 1; i + 1 < ring.size(); ++i)
          one += solid_angle(ring[0] - from, ring[i] - from, ring[i + 1] - from);
      sum += part.flipped[m] ? -one : one;
    }
    return sum;
  }

  static void report(const std::vector<const Surface*>& wrong, bool all, bool inner, bool leaks,
                     Problems& problems, Warnings& warnings) {
    const std::string where = inner ? "faces into itself, not into the zone" : "faces out of the zone";
    const std::string cure = "list its corners the other way round: counter-clockwise seen from the lit side";
    if (all) {
      problems.add(wrong[0]->place,
                   fmt::format("surface '{}' and all {} that it meets face out of the zone", wrong[0]->name,
                               wrong.size() - 1),
                   "list their corners the other way round: counter-clockwise seen from the lit side");
      return;
    }
    for (const auto* surface : wrong) {
      if (leaks)
        warnings.push_back({surface->place,
                            fmt::format("surface '{}' seems turned round: it {}", surface->name, where),
                            cure});
      else
        problems.add(surface->place, fmt::format("surface '{}' {}", surface->name, where), cure);
    }
  }

  std::vector<const Surface*> bounding_;
  ShellEdges edges_;
  std::vector<Part> parts_;
  std::vector<std::size_t> part_of_;
  std::vector<char> inner_;
};

void warn_of_leaks(const Shell& shell, const ZoneFrame& frame, Warnings& warnings) {
  constexpr std::size_t kMostShown = 3;
  const auto leaking = shell.leaking();
  for (std::size_t i = 0; i < std::min(leaking.size(), kMostShown); ++i) {
    const auto& leak = leaking[i];
    const Surface& surface = shell.surface(leak.polygon);
    std::string what =
        fmt::format("the zone is not closed: the edge of '{}' from {} to {} meets no other surface",
                    surface.name, short_point(frame.to_file(leak.from)), short_point(frame.to_file(leak.to)));
    if (i + 1 == kMostShown && leaking.size() > kMostShown)
      what += fmt::format(" (and {} more edges)", leaking.size() - kMostShown);
    warnings.push_back({surface.place, what, "light that leaves there is counted as escaped"});
  }
}

}  // namespace

ShellCheck check_shell(const std::vector<Surface>& surfaces, const ZoneFrame& frame, double touch_m,
                       Problems& problems, Warnings& warnings) {
  const Shell shell(surfaces, touch_m);
  if (shell.empty()) {
    warnings.push_back({surfaces.empty() ? Place{} : surfaces[0].place,
                        "the zone is not closed: it has no bounding surface", "light escapes on all sides"});
    return {};
  }
  shell.check_facing(problems, warnings);
  warn_of_leaks(shell, frame, warnings);
  return {shell.leaking().empty() && shell.volume_m3() > 0.0, shell.volume_m3(), shell.leaking()};
}

}  // namespace dim
