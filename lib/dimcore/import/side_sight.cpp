#include "import/side_sight.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/low_discrepancy.hpp"

namespace dim {
namespace {

constexpr std::uint64_t kStream = 0x696d706f7274;

Vec3 cosine_weighted(const Vec3& normal, double a, double b) {
  const Vec3 u = perpendicular(normal), v = glm::cross(normal, u);
  const double sine = std::sqrt(a), angle = 2.0 * kPi * b;
  return glm::normalize(sine * std::cos(angle) * u + sine * std::sin(angle) * v +
                        std::sqrt(1.0 - a) * normal);
}

}  // namespace

SideSight::SideSight(const FaceMesh& mesh) : tolerance_m_(mesh.tolerance_m) {
  Box3 box;
  for (const Vec3& p : mesh.points) box.add(p);
  origin_ = box.low + (box.high - box.low) / 2.0;
  std::vector<Plate> plates;
  std::vector<Box3> boxes;
  for (const MeshFace& face : mesh.faces) {
    polygons_.push_back(polygon_of(mesh, face, origin_));
    plates.push_back({&polygons_.back()});
    samplers_.emplace_back(polygons_.back().rings());
    boxes.emplace_back();
    for (const std::uint32_t i : face.rings[0]) boxes.back().add(mesh.points[i] - origin_);
    boxes.back() = boxes.back().widened(tolerance_m_);
  }
  tree_.emplace(std::move(boxes));
  caster_.emplace(std::move(plates), mesh.size_m);
}

std::uint32_t SideSight::side_met(const Vec3& from, const Vec3& direction, int skip) const {
  const Hit hit = caster_->nearest(from, direction, skip);
  return hit.plate < 0 ? kNothing : 2 * static_cast<std::uint32_t>(hit.plate) + (hit.back ? 1 : 0);
}

std::optional<std::uint32_t> SideSight::face_at(const Vec3& point, std::uint32_t but) const {
  Box3 box;
  box.add(point);
  std::optional<std::uint32_t> found;
  const Vec3 normal = polygons_[but].normal();
  tree_->for_meeting(box, [&](std::size_t i) {
    const Polygon& polygon = polygons_[i];
    if (i == but || found || std::abs(glm::dot(polygon.normal(), normal)) < 0.999) return;
    if (std::abs(polygon.frame().height(point)) <= 2.0 * tolerance_m_ &&
        polygon.contains(polygon.frame().to_local(point)))
      found = static_cast<std::uint32_t>(i);
  });
  return found;
}

std::vector<std::uint32_t> SideSight::seen_from(const SidePart& part, int n_rays) const {
  std::vector<double> up_to;
  double sum = 0.0;
  for (const std::uint32_t side : part.sides) up_to.push_back(sum += polygons_[side / 2].area_m2());
  const LowDiscrepancy4 numbers(kStream);
  std::vector<std::uint32_t> seen;
  for (int i = 0; i < n_rays; ++i) {
    const auto place = numbers(static_cast<std::uint64_t>(2 * i)),
               way = numbers(static_cast<std::uint64_t>(2 * i + 1));
    const auto chosen = std::min<std::size_t>(
        static_cast<std::size_t>(std::upper_bound(up_to.begin(), up_to.end(), place[0] * sum) -
                                 up_to.begin()),
        up_to.size() - 1);
    const std::uint32_t side = part.sides[chosen], face = side / 2;
    const Polygon& polygon = polygons_[face];
    const Vec3 from = polygon.frame().to_world(samplers_[face].point(place[1], place[2]));
    if (face_at(from, face)) continue;
    const Vec3 normal = side % 2 == 0 ? polygon.normal() : -polygon.normal();
    seen.push_back(side_met(from, cosine_weighted(normal, way[0], way[1]), static_cast<int>(face)));
  }
  return seen;
}

std::vector<std::uint32_t> SideSight::seen_from(const Vec3& point, int n_rays) const {
  const LowDiscrepancy4 numbers(kStream);
  std::vector<std::uint32_t> seen;
  for (int i = 0; i < n_rays; ++i) {
    const auto u = numbers(static_cast<std::uint64_t>(i));
    const double z = 2.0 * u[0] - 1.0, sine = std::sqrt(1.0 - z * z), angle = 2.0 * kPi * u[1];
    seen.push_back(side_met(point - origin_, {sine * std::cos(angle), sine * std::sin(angle), z}, -1));
  }
  return seen;
}

std::optional<std::uint32_t> SideSight::lies_against(std::uint32_t face) const {
  constexpr int kPoints = 9;
  const LowDiscrepancy4 numbers(kStream);
  std::map<std::uint32_t, int> votes;
  for (int i = 0; i < kPoints; ++i) {
    const auto u = numbers(static_cast<std::uint64_t>(i));
    const Polygon& polygon = polygons_[face];
    if (const auto other = face_at(polygon.frame().to_world(samplers_[face].point(u[0], u[1])), face))
      ++votes[*other];
  }
  for (const auto& [other, n] : votes)
    if (2 * n > kPoints) return other;
  return std::nullopt;
}

}  // namespace dim
