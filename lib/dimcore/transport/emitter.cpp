#include "transport/emitter.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>

namespace dim {
namespace {

constexpr std::size_t kMostImages = 1'000'000;

const Frame& frame_of(const Zone& zone, int surface) {
  return zone.surfaces[static_cast<std::size_t>(surface)].polygon.frame();
}

Vec3 mirrored_direction(const Frame& frame, const Vec3& v) {
  return v - 2.0 * glm::dot(v, frame.n) * frame.n;
}

// Corners of the rectangle about what `sample` covers of an opening.
std::vector<Vec3> corners_of(const Luminaire& luminaire) {
  const auto& opening = luminaire.opening;
  if (!(largest_dimension_m(opening) > 0.0)) return {luminaire.at};
  const bool upright = opening.shape == OpeningShape::kVerticalEllipse;
  const Vec3 a = upright ? opening.width_m / 2.0 * luminaire.c90 : opening.length_m / 2.0 * luminaire.c0;
  const Vec3 b = upright ? opening.height_m / 2.0 * luminaire.aim : opening.width_m / 2.0 * luminaire.c90;
  return {luminaire.at - a - b, luminaire.at + a - b, luminaire.at + a + b, luminaire.at - a + b};
}

// Half the space for what emits forwards only; its opening lies in a plane.
Beam beam_of(const Luminaire& luminaire, const Fitting& fitting) {
  if (!fitting.intensity.zero_behind() || luminaire.opening.shape == OpeningShape::kVerticalEllipse)
    return {};
  return {{{luminaire.aim, glm::dot(luminaire.aim, luminaire.at)}}};
}

Ring3 hull_of(const Polygon& polygon) {
  std::vector<Vec2> corners;
  for (const auto& ring : polygon.rings()) corners.insert(corners.end(), ring.begin(), ring.end());
  Ring3 hull;
  for (const Vec2& p : convex_hull(std::move(corners))) hull.push_back(polygon.frame().to_world(p));
  return hull;
}

Emitter image_of(const Zone& zone, const Emitter& of, int mirror) {
  const Frame& frame = frame_of(zone, mirror);
  Emitter image;
  auto& luminaire = image.luminaire;
  luminaire.fitting = of.luminaire.fitting;
  luminaire.factor = of.luminaire.factor;
  luminaire.opening = of.luminaire.opening;
  luminaire.at = mirrored(zone, mirror, of.luminaire.at);
  luminaire.c0 = mirrored_direction(frame, of.luminaire.c0);
  luminaire.c90 = mirrored_direction(frame, of.luminaire.c90);
  luminaire.aim = mirrored_direction(frame, of.luminaire.aim);
  image.fitting = of.fitting;
  image.original = of.original;
  image.in_the_way = of.in_the_way;
  image.mirrors = of.mirrors;
  image.mirrors.push_back(mirror);
  return image;
}

}  // namespace

Vec3 mirrored(const Zone& zone, int surface, const Vec3& point) {
  const Frame& frame = frame_of(zone, surface);
  return point - 2.0 * frame.height(point) * frame.n;
}

std::vector<Emitter> own_emitters(const Lights& lights, bool in_the_way) {
  std::vector<Emitter> emitters;
  for (std::size_t l = 0; l < lights.luminaires.size(); ++l) {
    const auto& luminaire = lights.luminaires[l];
    const auto& fitting = lights.fittings[static_cast<std::size_t>(luminaire.fitting)];
    emitters.push_back({luminaire, &fitting, l, {}, beam_of(luminaire, fitting), in_the_way});
  }
  return emitters;
}

MirrorImages::MirrorImages(const Zone& zone, const std::vector<int>& mirrors) : zone_(zone) {
  for (const int mirror : mirrors)
    mirrors_.push_back({mirror, hull_of(zone.surfaces[static_cast<std::size_t>(mirror)].polygon)});
}

std::vector<Emitter> MirrorImages::of(const Emitter& emitter) const {
  std::vector<Emitter> images;
  const double reach_m = largest_dimension_m(emitter.luminaire.opening);
  for (const auto& mirror : mirrors_) {
    if (!emitter.mirrors.empty() && emitter.mirrors.back() == mirror.surface) continue;
    if (frame_of(zone_, mirror.surface).height(emitter.luminaire.at) <= -reach_m) continue;
    const Ring3 aperture = emitter.beam.part_of(mirror.hull);
    if (aperture.empty()) continue;
    images.push_back(image_of(zone_, emitter, mirror.surface));
    const auto& luminaire = images.back().luminaire;
    auto& beam = images.back().beam;
    beam = beam_through(aperture, frame_of(zone_, mirror.surface).n, corners_of(luminaire));
    const Beam forwards = beam_of(luminaire, *emitter.fitting);
    beam.limits.insert(beam.limits.end(), forwards.limits.begin(), forwards.limits.end());
  }
  return images;
}

std::optional<std::vector<Emitter>> MirrorImages::of(std::span<const Emitter> emitters,
                                                     std::size_t most) const {
  std::vector<std::vector<Emitter>> images(emitters.size());
  std::atomic<std::size_t> n = 0;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, emitters.size(), 64), [&](const auto& range) {
    for (std::size_t e = range.begin(); e != range.end() && n <= most; ++e) {
      images[e] = of(emitters[e]);
      n += images[e].size();
    }
  });
  if (n > most) return std::nullopt;
  std::vector<Emitter> all;
  all.reserve(n);
  for (auto& some : images) std::move(some.begin(), some.end(), std::back_inserter(all));
  return all;
}

std::vector<Emitter> make_emitters(const Zone& zone, const Lights& lights, const std::vector<int>& mirrors,
                                   const std::vector<int>& depth) {
  const MirrorImages images(zone, mirrors);
  std::vector<Emitter> emitters = own_emitters(lights), order = emitters;
  for (int n = 1; !order.empty(); ++n) {
    std::erase_if(order, [&](const Emitter& emitter) { return depth[emitter.original] < n; });
    auto next = images.of(order, kMostImages - std::min(kMostImages, emitters.size()));
    if (!next)
      throw LimitError(
          fmt::format("more than {} images of luminaires in {} mirrors; use a smaller "
                      "--mirror-depth",
                      kMostImages, mirrors.size()));
    order = std::move(*next);
    emitters.insert(emitters.end(), order.begin(), order.end());
  }
  return emitters;
}

bool path_blocked(const Zone& zone, const RayCaster& caster, const Emitter& emitter, const Vec3& receiver,
                  const Vec3& on_image, int skip) {
  // Where the path meets the mirrors is quickly told and fails most often; legs are cast after.
  constexpr std::size_t kUsual = 16;
  std::array<Vec3, kUsual> few;
  std::vector<Vec3> many(emitter.mirrors.size() > kUsual ? emitter.mirrors.size() : 0);
  Vec3* met = many.empty() ? few.data() : many.data();
  Vec3 from = receiver, to = on_image;
  std::size_t n = 0;
  for (auto mirror = emitter.mirrors.rbegin(); mirror != emitter.mirrors.rend(); ++mirror) {
    const auto& polygon = zone.surfaces[static_cast<std::size_t>(*mirror)].polygon;
    const double before = polygon.frame().height(from), behind = polygon.frame().height(to);
    if (!(before > 0.0) || !(behind < 0.0)) return true;
    from += (before / (before - behind)) * (to - from);
    if (!polygon.contains(polygon.frame().to_local(from))) return true;
    met[n++] = from;
    to = mirrored(zone, *mirror, to);
  }
  if (!emitter.in_the_way) return false;
  from = receiver;
  for (std::size_t m = 0; m < n; ++m) {
    if (caster.blocked(from, met[m], skip)) return true;
    from = met[m];
    skip = emitter.mirrors[n - 1 - m];
  }
  return caster.blocked(from, to, skip);
}

}  // namespace dim
