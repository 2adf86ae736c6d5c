#include "transport/emitter.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dim {
namespace {

const Frame& frame_of(const Zone& zone, int surface) {
  return zone.surfaces[static_cast<std::size_t>(surface)].polygon.frame();
}

Vec3 mirrored_direction(const Frame& frame, const Vec3& v) {
  return v - 2.0 * glm::dot(v, frame.n) * frame.n;
}

bool reaches_before(const Frame& frame, const Polygon& polygon) {
  constexpr double kInPlane_m = 1e-9;
  for (const auto& p : polygon.rings().front()) {
    if (frame.height(polygon.frame().to_world(p)) > kInPlane_m) return true;
  }
  return false;
}

bool face_each_other(const Zone& zone, int a, int b) {
  return reaches_before(frame_of(zone, a), zone.surfaces[static_cast<std::size_t>(b)].polygon) &&
         reaches_before(frame_of(zone, b), zone.surfaces[static_cast<std::size_t>(a)].polygon);
}

Emitter image(const Zone& zone, const Emitter& of, int mirror) {
  const Frame& frame = frame_of(zone, mirror);
  Emitter result = of;
  auto& luminaire = result.luminaire;
  luminaire.at = mirrored(zone, mirror, luminaire.at);
  for (Vec3* axis : {&luminaire.c0, &luminaire.c90, &luminaire.aim}) *axis = mirrored_direction(frame, *axis);
  result.mirrors.push_back(mirror);
  return result;
}

}  // namespace

Vec3 mirrored(const Zone& zone, int surface, const Vec3& point) {
  const Frame& frame = frame_of(zone, surface);
  return point - 2.0 * frame.height(point) * frame.n;
}

std::vector<Emitter> make_emitters(const Zone& zone, const Lights& lights, const std::vector<int>& mirrors,
                                   int depth) {
  constexpr std::size_t kMostImages = 1'000'000;
  std::vector<Emitter> emitters;
  for (std::size_t l = 0; l < lights.luminaires.size(); ++l) {
    const auto& luminaire = lights.luminaires[l];
    emitters.push_back({luminaire, &lights.fittings[static_cast<std::size_t>(luminaire.fitting)], l, {}});
  }
  std::size_t first = 0;
  for (int bounce = 0; bounce < depth && !mirrors.empty(); ++bounce) {
    const std::size_t last = emitters.size();
    for (std::size_t e = first; e < last; ++e) {
      for (const int mirror : mirrors) {
        const auto& luminaire = emitters[e].luminaire;
        if (frame_of(zone, mirror).height(luminaire.at) <= -largest_dimension_m(luminaire.opening)) continue;
        if (!emitters[e].mirrors.empty() && (emitters[e].mirrors.back() == mirror ||
                                             !face_each_other(zone, emitters[e].mirrors.back(), mirror)))
          continue;
        if (emitters.size() >= kMostImages)
          throw LimitError(
              fmt::format("more than {} images of luminaires in {} mirrors; use fewer mirrors or a "
                          "smaller --mirror-depth",
                          kMostImages, mirrors.size()));
        emitters.push_back(image(zone, Emitter(emitters[e]), mirror));
      }
    }
    first = last;
  }
  return emitters;
}

bool path_blocked(const Zone& zone, const RayCaster& caster, const Emitter& emitter, const Vec3& receiver,
                  const Vec3& on_image, int skip) {
  Vec3 from = receiver, to = on_image;
  for (auto mirror = emitter.mirrors.rbegin(); mirror != emitter.mirrors.rend(); ++mirror) {
    const auto& polygon = zone.surfaces[static_cast<std::size_t>(*mirror)].polygon;
    const double before = polygon.frame().height(from), behind = polygon.frame().height(to);
    if (!(before > 0.0) || !(behind < 0.0)) return true;
    const Vec3 at = from + (before / (before - behind)) * (to - from);
    if (!polygon.contains(polygon.frame().to_local(at))) return true;
    if (caster.blocked(from, at, skip)) return true;
    from = at;
    skip = *mirror;
    to = mirrored(zone, *mirror, to);
  }
  return caster.blocked(from, to, skip);
}

std::vector<double> mirror_cosines(const Zone& zone, const Emitter& emitter, const Vec3& receiver,
                                   const Vec3& on_image) {
  std::vector<double> cosines;
  Vec3 direction = glm::normalize(on_image - receiver);
  for (auto mirror = emitter.mirrors.rbegin(); mirror != emitter.mirrors.rend(); ++mirror) {
    const Frame& frame = frame_of(zone, *mirror);
    cosines.push_back(std::clamp(-glm::dot(direction, frame.n), 0.0, 1.0));
    direction = mirrored_direction(frame, direction);
  }
  return cosines;
}

}  // namespace dim
