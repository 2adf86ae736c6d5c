#include "light/light_source.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>

#include "network/stream_key.hpp"

namespace dim {
namespace {

constexpr std::size_t kMostImages = 1'000'000;
constexpr std::size_t kMostLimits = 16;  // of a beam: cells are cut by them

// Points where the path from a receiver to an image meets its mirrors, last mirror first.
class MetMirrors {
 public:
  /// @returns false where it misses one
  bool find(const Zone& zone, const LightSource& source, const Vec3& receiver, const Vec3& on_image) {
    n_ = 0;
    if (source.mirrors.size() > few_.size()) many_.resize(source.mirrors.size());
    Vec3* met = many_.empty() ? few_.data() : many_.data();
    Vec3 from = receiver;
    origin_ = on_image;
    for (auto mirror = source.mirrors.rbegin(); mirror != source.mirrors.rend(); ++mirror) {
      const auto& polygon = zone.surfaces[static_cast<std::size_t>(*mirror)].polygon;
      const double before = polygon.frame().height(from), behind = polygon.frame().height(origin_);
      if (!(before > 0.0) || !(behind < 0.0)) return false;
      from += (before / (before - behind)) * (origin_ - from);
      if (!polygon.contains(polygon.frame().to_local(from))) return false;
      met[n_++] = from;
      origin_ = mirrored(zone, *mirror, origin_);
    }
    return true;
  }
  std::size_t size() const { return n_; }
  const Vec3& operator[](std::size_t i) const { return many_.empty() ? few_[i] : many_[i]; }
  /// Where the path begins, on the luminaire itself.
  const Vec3& origin() const { return origin_; }

 private:
  std::array<Vec3, 16> few_;
  std::vector<Vec3> many_;
  Vec3 origin_{0.0};
  std::size_t n_ = 0;
};

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

std::uint64_t stream_of(const Zone& zone, const Luminaire& luminaire) {
  return mix(place_key(luminaire.at, luminaire.aim, zone.diameter_m));
}

LightSource image_of(const Zone& zone, const LightSource& of, int mirror) {
  const Frame& frame = frame_of(zone, mirror);
  LightSource image;
  auto& luminaire = image.luminaire;
  luminaire.fitting = of.luminaire.fitting;
  luminaire.factor = of.luminaire.factor;
  luminaire.opening = of.luminaire.opening;
  luminaire.at = mirrored(zone, mirror, of.luminaire.at);
  luminaire.c0 = mirrored_direction(frame, of.luminaire.c0);
  luminaire.c90 = mirrored_direction(frame, of.luminaire.c90);
  luminaire.aim = mirrored_direction(frame, of.luminaire.aim);
  image.stream = stream_of(zone, luminaire);
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

LightSource::Emission LightSource::emit(const std::array<double, 4>& x) const {
  const auto [local, weight] = fitting->intensity.emission(x[0], x[1]);
  return {{luminaire.at + luminaire.to_world(sample(luminaire.opening, {x[2], x[3]})), luminaire.to_world(local)},
          weight};
}

std::vector<LightSource> own_sources(const Zone& zone, const Lights& lights, bool in_the_way) {
  std::vector<LightSource> sources;
  for (std::size_t l = 0; l < lights.luminaires.size(); ++l) {
    const auto& luminaire = lights.luminaires[l];
    const auto& fitting = lights.fitting_of(luminaire);
    sources.push_back({luminaire, &fitting, l, stream_of(zone, luminaire), {}, beam_of(luminaire, fitting),
                       in_the_way, true});
  }
  return sources;
}

MirrorImages::MirrorImages(const Zone& zone, const std::vector<int>& mirrors) : zone_(zone) {
  constexpr double kConvex = 1e-9;
  for (const int mirror : mirrors) {
    const Polygon& polygon = zone.surfaces[static_cast<std::size_t>(mirror)].polygon;
    const Ring3 hull = hull_of(polygon);
    mirrors_.push_back({mirror, hull, 0.5 * glm::length(newell(hull)) < (1.0 + kConvex) * polygon.area_m2()});
  }
}

std::vector<LightSource> MirrorImages::of(const LightSource& source) const {
  std::vector<LightSource> images;
  const double reach_m = largest_dimension_m(source.luminaire.opening);
  for (const auto& mirror : mirrors_) {
    if (!source.mirrors.empty() && source.mirrors.back() == mirror.surface) continue;
    if (frame_of(zone_, mirror.surface).height(source.luminaire.at) <= -reach_m) continue;
    const Ring3 aperture = source.beam.part_of(mirror.hull);
    if (aperture.empty()) continue;
    images.push_back(image_of(zone_, source, mirror.surface));
    const auto& luminaire = images.back().luminaire;
    auto& beam = images.back().beam;
    beam = beam_through(aperture, frame_of(zone_, mirror.surface).n, corners_of(luminaire));
    // Of more limits some are let go, which widens the beam.
    images.back().beam_is_tight =
        source.beam_is_tight && mirror.is_convex && beam.limits.size() <= kMostLimits;
    beam.limits.resize(std::min(beam.limits.size(), kMostLimits));
    const Beam forwards = beam_of(luminaire, *source.fitting);
    beam.limits.insert(beam.limits.end(), forwards.limits.begin(), forwards.limits.end());
  }
  return images;
}

std::optional<std::vector<LightSource>> MirrorImages::of(std::span<const LightSource> sources,
                                                     std::size_t most) const {
  std::vector<std::vector<LightSource>> images(sources.size());
  std::atomic<std::size_t> n = 0;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sources.size(), 64), [&](const auto& range) {
    for (std::size_t e = range.begin(); e != range.end() && n <= most; ++e) {
      images[e] = of(sources[e]);
      n += images[e].size();
    }
  });
  if (n > most) return std::nullopt;
  std::vector<LightSource> all;
  all.reserve(n);
  for (auto& some : images) std::move(some.begin(), some.end(), std::back_inserter(all));
  return all;
}

std::vector<LightSource> sources_with_images(const Zone& zone, const Lights& lights, const std::vector<int>& mirrors,
                                   const std::vector<int>& depth) {
  const MirrorImages images(zone, mirrors);
  std::vector<LightSource> sources = own_sources(zone, lights), order = sources;
  for (int n = 1; !order.empty(); ++n) {
    std::erase_if(order, [&](const LightSource& source) { return depth[source.original] < n; });
    auto next = images.of(order, kMostImages - std::min(kMostImages, sources.size()));
    if (!next)
      throw LimitError(
          fmt::format("more than {} images of luminaires in {} mirrors; use a smaller "
                      "--mirror-depth",
                      kMostImages, mirrors.size()));
    order = std::move(*next);
    sources.insert(sources.end(), order.begin(), order.end());
  }
  return sources;
}

bool path_blocked(const Zone& zone, const RayCaster& caster, const LightSource& source, const Vec3& receiver,
                  const Vec3& on_image, int skip) {
  // Where the path meets the mirrors is quickly told and fails most often; legs are cast after.
  MetMirrors met;
  if (!met.find(zone, source, receiver, on_image)) return true;
  if (!source.in_the_way) return false;
  Vec3 from = receiver;
  for (std::size_t m = 0; m < met.size(); ++m) {
    if (caster.blocked(from, met[m], skip)) return true;
    from = met[m];
    skip = source.mirrors[met.size() - 1 - m];
  }
  return caster.blocked(from, met.origin(), skip);
}

bool mirrors_pass_all(const Zone& zone, const LightSource& source, std::span<const Vec3> receiver,
                      std::span<const Vec3> on_image) {
  MetMirrors met;
  return source.beam_is_tight && std::all_of(receiver.begin(), receiver.end(), [&](const Vec3& p) {
           return std::all_of(on_image.begin(), on_image.end(),
                              [&](const Vec3& q) { return met.find(zone, source, p, q); });
         });
}

}  // namespace dim
