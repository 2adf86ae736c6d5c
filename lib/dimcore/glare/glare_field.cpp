#include "glare/glare_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dim {
namespace {

constexpr int kDirections = 4096;
constexpr int kLooks = 4;         // by as many: what of an opening is hidden
constexpr double kBefore = 1e-6;  // of the way: openings lie in surfaces
constexpr double kEnclosedShare = 0.3;

// Spiral of equal areas (Fibonacci's), each direction for as much of the sphere.
std::vector<Vec3> sphere_directions() {
  const double turn = kPi * (3.0 - std::sqrt(5.0));
  std::vector<Vec3> directions;
  for (int k = 0; k < kDirections; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / kDirections, across = std::sqrt(1.0 - z * z);
    directions.emplace_back(across * std::cos(turn * k), across * std::sin(turn * k), z);
  }
  return directions;
}

}  // namespace

double background_cd_m2(const EyePlace& place, const LineOfSight& sight) {
  double sum = 0.0;
  for (std::size_t k = 0; k < place.directions.size(); ++k)
    sum += static_cast<double>(place.luminance_cd_m2[k]) *
           std::max(0.0, glm::dot(place.directions[k], sight.forward));
  return 4.0 * sum / static_cast<double>(place.directions.size());
}

UnifiedGlareRating glare_at(const EyePlace& place, const LineOfSight& sight) {
  auto rating = unified_glare_rating(place.sources, background_cd_m2(place, sight), sight);
  if (place.enclosed) rating.ugr = std::numeric_limits<double>::quiet_NaN();
  return rating;
}

GlareField::GlareField(const LuminanceDatabase& database, const Mix& mix)
    : database_(database),
      directions_(sphere_directions()),
      caster_(plates_of(database.zone()), database.zone().diameter_m) {
  for (const auto& luminaire : database.luminaires())
    factor_.push_back(mix[luminaire.source] * luminaire.factor);
  for (const Vec3& xyz : cell_appearance(database, database.cells(), mix).xyz_cd_m2)
    cell_cd_m2_.push_back(static_cast<float>(xyz.y));
}

EyePlace GlareField::at(const Vec3& eye) const {
  EyePlace place;
  place.directions = directions_;
  int n_behind = 0;
  for (const Vec3& direction : directions_) {
    const Hit hit = caster_.nearest(eye, direction);
    n_behind += hit.plate >= 0 && hit.back;
    place.luminance_cd_m2.push_back(luminance_cd_m2(hit, direction));
  }
  place.enclosed = n_behind > kEnclosedShare * kDirections;
  for (std::size_t k = 0; k < factor_.size(); ++k) {
    const auto& luminaire = database_.luminaires()[k];
    const Vec3 way = eye - luminaire.at;
    const double distance_m = glm::length(way);
    if (!(factor_[k] > 0.0) || !(distance_m > 0.0)) continue;
    const Vec3 d = way / distance_m;
    const Vec3 local(glm::dot(d, luminaire.c0), glm::dot(d, luminaire.c90), glm::dot(d, luminaire.aim));
    const double intensity_cd = factor_[k] * database_.intensities()[luminaire.photometry].at(local);
    if (!(intensity_cd > 0.0)) continue;
    GlareSource source =
        glare_source(-d, intensity_cd, projected_luminous_area_m2(luminaire.opening, local), distance_m);
    source.solid_angle_sr *= visible_share(luminaire, eye);
    if (source.solid_angle_sr > 0.0) place.sources.push_back(source);
  }
  return place;
}

double GlareField::visible_share(const ShownLuminaire& luminaire, const Vec3& eye) const {
  const auto points = sample_grid(luminaire.opening, kLooks, kLooks);
  int n_seen = 0;
  for (const Vec3& p : points) {
    const Vec3 at = luminaire.at + p.x * luminaire.c0 + p.y * luminaire.c90 + p.z * luminaire.aim;
    n_seen += !caster_.blocked(eye, at + kBefore * (eye - at));
  }
  return static_cast<double>(n_seen) / static_cast<double>(points.size());
}

float GlareField::luminance_cd_m2(const Hit& hit, const Vec3& direction) const {
  if (hit.plate < 0 || hit.back) return 0.0F;
  const auto surface = static_cast<std::size_t>(hit.plate);
  const Cells& cells = database_.cells();
  if (cells.first(surface) == cells.first(surface + 1)) return 0.0F;
  return cell_cd_m2_[cells.cell_hit(surface, hit.local, direction)];
}

}  // namespace dim
