#include "light/pair_integrator.hpp"

#include <algorithm>
#include <cmath>

#include "light/pair_parts.hpp"
#include "light/spherical_rectangle.hpp"

namespace dim {
namespace {

// Size of a pair (diameters of cell part and opening part) over its distance, above which it is halved: with
// two Gauss points an axis the error of 1/r^2 then stays below 1e-3. Points get twice the care.
constexpr double kNear = 0.6;
constexpr double kNearPoint = 0.3;
// Next to the axis of a cylinder its response has no slope: pairs are halved there down to this size.
constexpr double kNearAxis = 0.03;
constexpr int kMostHalvings = 48;
// Where cell and opening touch, halving would never end: parts of the cell this small a share of it are left to
// Lambert's edge sum.
constexpr double kSmallestShare = 1.0 / 4096.0;
// A Lambertian opening needs the cell's parts small only, its own light is exact.
constexpr double kNearLambertian = 0.5;
// Against the beam's light, what counts as dark: no care is taken of its shape there.
constexpr double kSpill = 1e-3;
// With fewer lines than this, rays cost less; not of a beam narrower than this share of a Lambertian one's width,
// of which they find next to nothing.
constexpr int kFewLines = 4;
constexpr double kNarrow = 0.5;
// Seen at grazing angles from a cell that faces it, an opening's projected area vanishes.
constexpr double kLeastRatio = 0.02;

}  // namespace

Receiver point_receiver(const Frame& frame, int skip, std::uint64_t stream, Quantity quantity) {
  Receiver receiver{&frame, {}, skip, stream, quantity};
  receiver.ring.add(frame.origin);
  return receiver;
}

PairIntegrator::PairIntegrator(const Zone& zone, const RayCaster& caster, const ShadowPlates& plates,
                               const LightSource& source, const PairOptions& options)
    : zone_(zone),
      caster_(caster),
      plates_(plates),
      source_(source),
      luminaire_(source.luminaire),
      fitting_(*source.fitting),
      options_(options),
      test_paths_(options.in_the_way || !source.mirrors.empty()),
      opening_(opening_region(source.luminaire)),
      beam_(kNear) {
  test_visibility_ = test_paths_ && (options.in_the_way || !source.beam_is_tight || opening_.ring.size() > 1);
  // A beam must not fall between the points: parts are to be small against its width, too.
  const auto& light = fitting_.intensity;
  if (light.max_cd() > 0.0) beam_ = std::min(kNear, 0.6 * std::sqrt(light.flux_lm() / (kPi * light.max_cd())));
}

PairIntegrator::Side PairIntegrator::side(const ConvexRing& ring, double share) {
  const Vec3 middle = ring.middle();
  return {ring, share, middle, ring.radius_m(middle)};
}

std::array<PairIntegrator::Side, 2> PairIntegrator::halves(const Side& whole) {
  const auto rings = whole.ring.halves();
  const double measure = whole.ring.measure();
  std::array<Side, 2> parts;
  for (std::size_t i = 0; i < 2; ++i) {
    if (rings[i].empty())
      parts[i].share = 0.0;
    else
      parts[i] = side(rings[i], measure > 0.0 ? whole.share * rings[i].measure() / measure : whole.share / 2.0);
  }
  return parts;
}

// The part of the cell within the source's beam and of the opening before the cell.
bool PairIntegrator::clip(const Receiver& receiver, Side& cell, Side& opening) const {
  const Frame& frame = *receiver.frame;
  ConvexRing above = opening_.ring;
  if (receiver.response().is_planar()) {
    above = above.front_of(frame.n, glm::dot(frame.n, receiver.ring[0]));
    if (above.empty()) return false;
    double highest_m = 0.0;
    for (const Vec3& corner : above) highest_m = std::max(highest_m, glm::dot(frame.n, corner - receiver.ring[0]));
    if (!(highest_m > caster_.tolerance_m())) return false;
  }
  opening = side(above, above.measure() / opening_.measure);
  if (!(opening.share > 0.0)) return false;
  ConvexRing lit = receiver.ring;
  for (const auto& limit : source_.beam.limits) {
    lit = lit.front_of(limit.normal, limit.offset);
    if (lit.empty()) return false;
  }
  const double whole = receiver.ring.measure();
  cell = side(lit, whole > 0.0 ? lit.measure() / whole : 1.0);
  return cell.share > 0.0;
}

DirectEstimate PairIntegrator::mean(const Receiver& receiver, PlatesBetween& between) const {
  Side cell, opening;
  if (!clip(receiver, cell, opening)) return {};
  const Response response = receiver.response();
  const Pair pair{cell, opening, response};
  const double free_lx = free(pair, 0);
  if (!(free_lx > 0.0) || !test_visibility_) return {free_lx, 0.0};
  Chance chance(receiver.stream ^ source_.stream);
  const double importance = options_.typical_lx > 0.0 ? std::min(1.0, free_lx / options_.typical_lx) : 1.0;
  const double lines = receiver.is_point() ? options_.shadow_lines * std::max(0.5, importance)
                                           : std::max(2.0, options_.shadow_lines * importance);
  const bool ray = receiver.is_point() && opening.ring.size() == 1;
  if (ray) return {blocked(receiver.ring[0], opening.ring[0], receiver.skip) ? 0.0 : free_lx, 0.0};
  if (!options_.in_the_way && mirrors_pass_all(zone_, source_, {cell.ring.begin(), cell.ring.end()},
                                               {opening_.bounds.begin(), opening_.bounds.end()}))
    return {free_lx, 0.0};
  const bool narrow = beam_ < kNarrow * kNear;
  if ((lines < kFewLines && !narrow) || !source_.mirrors.empty())
    return by_rays(pair, free_lx, static_cast<int>(std::ceil(lines)), receiver.skip, chance);
  if (!between.known) find(between);
  if (between.found.empty()) return {free_lx, 0.0};
  const ConvexRing bounds =
      response.is_planar() ? opening_.bounds.front_of(response.normal, glm::dot(response.normal, receiver.ring[0]))
                           : opening_.bounds;
  Shadows shadows{bounds, free_lx, lines, receiver.skip, chance};
  return shadowed(pair, between.found, shadows);
}

void PairIntegrator::find(PlatesBetween& between) const {
  between.known = true;
  sight(between.region, nullptr, between.found);
}

PairIntegrator::Sight PairIntegrator::sight(const Receiver& region, const std::vector<int>* among,
                                            std::vector<int>& found) const {
  found.clear();
  const Vec3& n = region.frame->n;
  const double offset = glm::dot(n, region.ring[0]);
  const bool is_planar = region.response().is_planar();
  const ConvexRing bounds = is_planar ? opening_.bounds.front_of(n, offset) : opening_.bounds;
  if (bounds.empty()) return Sight::free;
  Shaft shaft(region.ring, bounds, region.skip);
  if (is_planar) shaft.add_limit(n, offset);
  bool hidden = false;
  const auto look_at = [&](int plate) {
    const auto cover = plates_.cover(plate, shaft);
    hidden = hidden || cover == ShadowPlates::Cover::whole;
    return cover != ShadowPlates::Cover::none;
  };
  if (among) {
    for (const int plate : *among)
      if (look_at(plate)) found.push_back(plate);
  } else {
    plates_.candidates(shaft, found);
    for (const int plate : found) look_at(plate);
  }
  return hidden ? Sight::hidden : found.empty() ? Sight::free : Sight::part;
}

double PairIntegrator::illuminance(const Response& response, const Vec3& p, const Vec3& q) const {
  const Vec3 d = p - q;
  const double weight = response.of(-d);
  if (!(weight > 0.0)) return 0.0;
  const double r2 = glm::dot(d, d);
  return fitting_.intensity.at(luminaire_.to_local(d)) * weight / (r2 * std::sqrt(r2));
}

// How large a pair may be against its distance; 0 where it is wholly dark.
double PairIntegrator::near_limit(const Pair& pair) const {
  const double limit = pair.cell.ring.size() == 1 ? kNearPoint : kNear;
  if (!(beam_ < kNear)) return limit;
  const Vec3 d = pair.cell.middle - pair.opening.middle;
  const double sine = 0.5 * pair.size_m() / glm::length(d);
  if (!(sine < 1.0)) return limit * beam_ / kNear;
  const double bound_cd = fitting_.intensity.bound_cd(luminaire_.to_local(d), std::asin(sine));
  if (bound_cd == 0.0) return 0.0;
  return bound_cd < kSpill * fitting_.intensity.max_cd() ? limit : limit * beam_ / kNear;
}

// Whether the response of the receiver is, over the opening.
bool PairIntegrator::is_smooth(const Pair& pair) const {
  const double size_m = pair.size_m();
  return pair.response.is_planar() || size_m <= kNearAxis * pair.distance_m() ||
         size_m <= kNearPoint * pair.response.off_axis(pair.opening.middle - pair.cell.middle);
}

// Illuminance that the parts of a pair bring to the whole receiver, with nothing in the way.
double PairIntegrator::free(const Pair& pair, int depth) const {
  const bool area = pair.cell.ring.size() > 2, extended = pair.opening.ring.size() > 2;
  const double distance_m = pair.distance_m(), size_m = pair.size_m();
  const double limit = near_limit(pair);
  if (limit == 0.0) return 0.0;
  if (size_m <= limit * distance_m && is_smooth(pair)) return by_gauss(pair);
  if (extended && fitting_.intensity.is_lambertian() && pair.response.is_planar()) return of_lambertian(pair, depth);
  const bool near = size_m > kNear * distance_m;
  if (depth >= kMostHalvings || (near && area && extended && pair.cell.share <= kSmallestShare &&
                                 pair.opening.radius_m <= 2.0 * pair.cell.radius_m))
    return touching(pair);
  double sum = 0.0;
  for (const Side& part : halves(pair.halve_cell() ? pair.cell : pair.opening)) {
    if (!(part.share > 0.0)) continue;
    sum += pair.halve_cell() ? free({part, pair.opening, pair.response}, depth + 1)
                             : free({pair.cell, part, pair.response}, depth + 1);
  }
  return sum;
}

double PairIntegrator::by_gauss(const Pair& pair) const {
  ConvexRing::Nodes p, q;
  pair.cell.ring.nodes(p);
  pair.opening.ring.nodes(q);
  double sum = 0.0;
  if (p.n == 4 && q.n == 4) {
    // A half fraction of the 2^4 design: every odd moment up to the third vanishes.
    for (std::size_t run = 0; run < 8; ++run) {
      const std::size_t s0 = run & 1, s1 = run >> 1 & 1, s2 = run >> 2, s3 = (s0 + s1 + s2) & 1;
      sum += illuminance(pair.response, p.at[2 * s0 + s1], q.at[2 * s2 + s3]) / 8.0;
    }
  } else {
    for (std::size_t i = 0; i < static_cast<std::size_t>(p.n); ++i) {
      for (std::size_t j = 0; j < static_cast<std::size_t>(q.n); ++j)
        sum += p.weight[i] * q.weight[j] * illuminance(pair.response, p.at[i], q.at[j]);
    }
  }
  return pair.cell.share * pair.opening.share * sum;
}

// Parts so near that 1/r^2 cannot be sampled: exact in the solid angle, the intensity taken once.
double PairIntegrator::touching(const Pair& pair) const {
  ConvexRing::Nodes nodes;
  double sum = 0.0;
  if (pair.opening.ring.size() > 2) {
    pair.cell.ring.nodes(nodes);
    for (std::size_t i = 0; i < static_cast<std::size_t>(nodes.n); ++i) {
      const Vec3 d = nodes.at[i] - pair.opening.middle;
      // Cosine at the cell over that at the opening: their heights over each other's plane, which between
      // parallel planes is 1 in every direction.
      const double over_cell_m = pair.response.of(-d);
      const double over_opening_m = std::abs(glm::dot(d, opening_.normal));
      if (!(over_cell_m > 0.0)) continue;
      const double ratio = over_cell_m / std::max(over_opening_m, kLeastRatio * over_cell_m);
      sum += nodes.weight[i] * fitting_.intensity.at(luminaire_.to_local(d)) * ratio / opening_.measure *
             solid_angle_sr(pair.opening.ring, nodes.at[i]);
    }
    return pair.cell.share * sum;
  }
  if (pair.cell.ring.size() == 1) return 0.0;  // the source stands on the point itself
  pair.opening.ring.nodes(nodes);
  for (std::size_t i = 0; i < static_cast<std::size_t>(nodes.n); ++i) {
    const Vec3 d = pair.cell.middle - nodes.at[i];
    if (d == Vec3(0.0)) continue;
    sum += nodes.weight[i] * fitting_.intensity.at(luminaire_.to_local(d)) *
           solid_angle_sr(pair.cell.ring, nodes.at[i]) / pair.cell.ring.area_m2();
  }
  return pair.cell.share * pair.opening.share * sum;
}

// Lambert's edge sum at points of the cell, whose parts are halved towards the opening.
double PairIntegrator::of_lambertian(const Pair& pair, int depth) const {
  const Side& cell = pair.cell;
  const bool small = cell.ring.size() == 1 || cell.share <= kSmallestShare || depth >= kMostHalvings ||
                     2.0 * cell.radius_m <= kNearLambertian * pair.opening.ring.distance_m(cell.middle);
  double sum = 0.0;
  if (!small) {
    for (const Side& part : halves(cell)) {
      if (part.share > 0.0) sum += of_lambertian({part, pair.opening, pair.response}, depth + 1);
    }
    return sum;
  }
  ConvexRing::Nodes nodes;
  cell.ring.nodes(nodes);
  for (std::size_t i = 0; i < static_cast<std::size_t>(nodes.n); ++i)
    sum += nodes.weight[i] * projected_solid_angle_sr(pair.opening.ring, nodes.at[i], pair.response.normal);
  return cell.share * sum * fitting_.intensity.max_cd() / opening_.measure;
}

PairIntegrator::Path PairIntegrator::path(const Receiver& receiver, const std::array<double, 4>& x) const {
  Path path;
  const Vec3 q = opening_.ring.sample(x[2], x[3]);
  const Frame& frame = *receiver.frame;
  if (receiver.is_point()) {
    path.at = receiver.ring[0];
    path.towards = glm::normalize(q - path.at);
    const double lx = illuminance(receiver.response(), path.at, q);
    if (lx > 0.0 && !(test_paths_ && blocked(path.at, q, receiver.skip))) path.lx = lx;
    return path;
  }
  if (frame.height(q) <= caster_.tolerance_m()) return path;
  // Evenly over the solid angle that the cell's rectangle fills: what is near is not missed.
  Vec2 low = frame.to_local(receiver.ring[0]), high = low;
  for (const Vec3& corner : receiver.ring) {
    low = glm::min(low, frame.to_local(corner));
    high = glm::max(high, frame.to_local(corner));
  }
  const SphericalRectangle seen(frame, low, high, q);
  if (!(seen.solid_angle_sr() > 0.0)) return path;
  path.at = frame.to_world(seen.sample(x[0], x[1]));
  path.towards = glm::normalize(q - path.at);
  if (receiver.ring.distance_m(path.at) > caster_.tolerance_m()) return path;
  const double cd = fitting_.intensity.at(luminaire_.to_local(path.at - q));
  if (cd > 0.0 && !(test_paths_ && blocked(path.at, q, receiver.skip)))
    path.lx = cd * seen.solid_angle_sr() / receiver.ring.area_m2();
  return path;
}

}  // namespace dim
