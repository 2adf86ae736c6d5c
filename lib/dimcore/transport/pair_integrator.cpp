#include "transport/pair_integrator.hpp"

#include <algorithm>
#include <cmath>

#include "transport/spherical_rectangle.hpp"

namespace dim {
namespace {

// Size of a pair (diagonals of cell part and opening part) over its distance, above which it is halved: with
// two Gauss points an axis the error of 1/r^2 then stays below 1e-3.
constexpr double kNear = 0.6;
constexpr int kMaxNearHalvings = 48;
// Between a cell and an opening with an extent, halving never ends where they touch: after this often, parts
// that are still near are sampled by solid angle instead, with this many rays each.
constexpr int kMaxPairHalvings = 10;
constexpr int kCloseRays = 32;
constexpr int kMaxHorizonHalvings = 4;
constexpr int kShadowRaysPerProbeRay = 4;
constexpr int kMinProbeRays = 4;
constexpr int kFaintRays = 2;

}  // namespace

PairIntegrator::PairIntegrator(const Zone& zone, const RayCaster& caster, const Emitter& emitter,
                               double faint_lx, int n_probe_rays, std::uint64_t stream, bool in_the_way)
    : zone_(zone),
      caster_(caster),
      emitter_(emitter),
      luminaire_(emitter.luminaire),
      fitting_(*emitter.fitting),
      n_probe_rays_(n_probe_rays),
      test_visibility_(in_the_way || !emitter.mirrors.empty()),
      stream_(mix(stream)),
      near_(kNear) {
  faint_ = luminaire_.factor > 0.0 ? faint_lx / luminaire_.factor : 0.0;
  // A beam must not fall between the points: parts are to be small against its width, too.
  const auto& beam = fitting_.intensity;
  if (beam.max_cd() > 0.0)
    near_ = std::clamp(0.6 * std::sqrt(beam.flux_lm() / (kPi * beam.max_cd())), 0.05, kNear);
  if (largest_dimension_m(luminaire_.opening) > 0.0)
    opening_m_ = {luminaire_.opening.length_m, luminaire_.opening.width_m};
}

double PairIntegrator::mean(const Receiver& receiver, const Part& pair) const {
  if (hidden_by_orientation(receiver, pair)) return 0.0;
  Chance chance{LowDiscrepancy4(receiver.stream ^ stream_)};
  const Sum sum =
      is_faint(receiver, pair) ? faint(receiver, pair, chance) : integrate(receiver, pair, 0, 0, chance);
  return sum.weight > 0.0 ? sum.value / sum.weight : of_sliver(receiver, pair, chance);
}

PairIntegrator::Path PairIntegrator::path(const Receiver& receiver, const Part& pair,
                                          const std::array<double, 4>& x) const {
  Path path;
  const Vec3 q = on_opening(pair[2].at(x[2]), pair[3].at(x[3]));
  if (receiver.polygon == nullptr) {
    path.at = receiver.frame->origin;
    path.towards = glm::normalize(q - path.at);
    const double lx = unshadowed(receiver, path.at, q);
    if (lx > 0.0 && !blocked(path.at, q, receiver.skip)) path.lx = lx;
    return path;
  }
  if (receiver.frame->height(q) <= caster_.tolerance_m()) return path;
  // Evenly over the solid angle that the cell fills: what is near is not missed.
  const Vec2 low(pair[0].low, pair[1].low), high(pair[0].high, pair[1].high);
  const SphericalRectangle seen(*receiver.frame, low, high, q);
  if (!(seen.solid_angle_sr() > 0.0)) return path;
  const Vec2 local = seen.sample(x[0], x[1]);
  path.at = receiver.frame->to_world(local);
  path.towards = glm::normalize(q - path.at);
  if (!receiver.whole && !receiver.contains(local)) return path;
  const double cd = fitting_.intensity.at(luminaire_.to_local(path.at - q));
  if (cd > 0.0 && !blocked(path.at, q, receiver.skip))
    path.lx = cd * seen.solid_angle_sr() / (pair[0].length() * pair[1].length());
  return path;
}

bool PairIntegrator::blocked(const Vec3& receiver, const Vec3& on_opening, int skip) const {
  if (!test_visibility_) return false;
  return emitter_.mirrors.empty() ? caster_.blocked(receiver, on_opening, skip)
                                  : path_blocked(zone_, caster_, emitter_, receiver, on_opening, skip);
}

Vec3 PairIntegrator::on_opening(double s, double t) const {
  return luminaire_.at + luminaire_.to_world(sample(luminaire_.opening, {s, t}));
}

// Of a cell that none of the rays found: light at a point of it stands for all.
double PairIntegrator::of_sliver(const Receiver& receiver, const Part& pair, Chance& chance) const {
  const Vec2& at = *receiver.centroid;
  Receiver point = receiver;
  point.polygon = nullptr;
  point.whole = true;
  return integrate(point, {Interval{at.x, at.x}, Interval{at.y, at.y}, pair[2], pair[3]}, 0, 0, chance).value;
}

// Whether the receiver lies wholly behind the opening (where that emits forwards only) or the opening wholly
// behind the receiver.
bool PairIntegrator::hidden_by_orientation(const Receiver& receiver, const Part& pair) const {
  const double reach_m = largest_dimension_m(luminaire_.opening);
  if (receiver.frame->height(luminaire_.at) <= -reach_m) return true;
  if (!fitting_.intensity.zero_behind() || luminaire_.opening.shape == OpeningShape::kVerticalEllipse)
    return false;
  for (const double x : {pair[0].low, pair[0].high}) {
    for (const double y : {pair[1].low, pair[1].high}) {
      if (glm::dot(receiver.frame->to_world({x, y}) - luminaire_.at, luminaire_.aim) > 0.0) return false;
    }
  }
  return true;
}

// Illuminance at p from the whole opening, were it all at q, before visibility.
double PairIntegrator::unshadowed(const Receiver& receiver, const Vec3& p, const Vec3& q) const {
  const Vec3 d = p - q;
  const double height = -glm::dot(d, receiver.frame->n);
  if (!(height > 0.0)) return 0.0;
  const double r2 = glm::dot(d, d);
  return fitting_.intensity.at(luminaire_.to_local(d)) * height / (r2 * std::sqrt(r2));
}

// Far away and bringing little, judged between the middles.
bool PairIntegrator::is_faint(const Receiver& receiver, const Part& pair) const {
  if (near(receiver, pair)) return false;
  const Vec3 p = receiver.frame->to_world({pair[0].middle(), pair[1].middle()});
  return unshadowed(receiver, p, on_opening(0.5, 0.5)) < faint_;
}

PairIntegrator::Sum PairIntegrator::faint(const Receiver& receiver, const Part& pair, Chance& chance) const {
  Probe sum;
  probe(sum, receiver.whole ? kFaintRays : n_probe_rays_, receiver, pair, chance);
  return {static_cast<double>(sum.n_inside) / sum.n, sum.visible / sum.n};
}

// Gauss points, two an axis, visibility left out.
PairIntegrator::Smooth PairIntegrator::smooth(const Receiver& receiver, const Part& part) const {
  const bool area = receiver.polygon != nullptr, extended = opening_m_ != Vec2(0.0);
  const int n = area && extended ? 8 : (area || extended ? 4 : 1);
  Smooth result;
  int n_lit = 0;
  for (int run = 0; run < n; ++run) {
    // A half fraction of the 2^4 design: every odd moment up to the third vanishes.
    std::array<int, 4> sign = {run & 1 ? 1 : -1, run & 2 ? 1 : -1, run & 4 ? 1 : -1, 0};
    sign[3] = sign[0] * sign[1] * sign[2];
    if (n == 4) sign = extended ? std::array{0, 0, sign[0], sign[1]} : std::array{sign[0], sign[1], 0, 0};
    if (n == 1) sign = {0, 0, 0, 0};
    const double lx =
        unshadowed(receiver, receiver.frame->to_world({part[0].gauss(sign[0]), part[1].gauss(sign[1])}),
                   on_opening(part[2].gauss(sign[2]), part[3].gauss(sign[3])));
    n_lit += lx > 0.0;
    result.mean += lx / n;
  }
  result.horizon = n_lit > 0 && n_lit < n;
  return result;
}

std::array<double, 4> PairIntegrator::sides_m(const Part& part) const {
  return {part[0].length(), part[1].length(), part[2].length() * opening_m_.x,
          part[3].length() * opening_m_.y};
}

bool PairIntegrator::near(const Receiver& receiver, const Part& part) const {
  const auto side = sides_m(part);
  const double size_m = std::hypot(side[0], side[1]) + std::hypot(side[2], side[3]);
  const Vec3 p = receiver.frame->to_world({part[0].middle(), part[1].middle()});
  const double limit = receiver.polygon ? near_ : near_ / 2.0;
  return size_m > limit * glm::length(p - on_opening(part[2].middle(), part[3].middle()));
}

PairIntegrator::Sum PairIntegrator::integrate(const Receiver& receiver, const Part& part, int near_halvings,
                                              int horizon_halvings, Chance& chance) const {
  if (near_halvings < kMaxNearHalvings && near(receiver, part)) {
    const bool pair = receiver.polygon != nullptr && opening_m_ != Vec2(0.0);
    if (pair && near_halvings == kMaxPairHalvings) return close(receiver, part, chance);
    return halves(receiver, part, near_halvings + 1, horizon_halvings, chance);
  }
  const Smooth expected = smooth(receiver, part);
  if (expected.horizon && horizon_halvings < kMaxHorizonHalvings)
    return halves(receiver, part, near_halvings, horizon_halvings + 1, chance);
  return leaf(receiver, part, expected, near_halvings + horizon_halvings, chance);
}

PairIntegrator::Sum PairIntegrator::halves(const Receiver& receiver, const Part& part, int near_halvings,
                                           int horizon_halvings, Chance& chance) const {
  const auto side = sides_m(part);
  const auto longest = static_cast<std::size_t>(std::max_element(side.begin(), side.end()) - side.begin());
  Part low = part, high = part;
  low[longest].high = high[longest].low = part[longest].middle();
  const Sum both = integrate(receiver, low, near_halvings, horizon_halvings, chance) +
                   integrate(receiver, high, near_halvings, horizon_halvings, chance);
  return {both.weight / 2.0, both.value / 2.0};
}

void PairIntegrator::probe(Probe& sum, int n, const Receiver& receiver, const Part& part,
                           Chance& chance) const {
  for (; sum.n < n; ++sum.n) {
    const auto x = chance.draw();
    const Vec2 local(part[0].at(x[0]), part[1].at(x[1]));
    if (!receiver.whole && !receiver.contains(local)) continue;
    ++sum.n_inside;
    const Vec3 p = receiver.frame->to_world(local), q = on_opening(part[2].at(x[2]), part[3].at(x[3]));
    const double lx = unshadowed(receiver, p, q);
    if (!(lx > 0.0)) continue;
    ++sum.n_lit;
    sum.lit += lx;
    if (blocked(p, q, receiver.skip)) continue;
    ++sum.n_visible;
    sum.visible += lx;
  }
}

PairIntegrator::Sum PairIntegrator::leaf(const Receiver& receiver, const Part& part, const Smooth& expected,
                                         int halvings, Chance& chance) const {
  if (receiver.whole && (!test_visibility_ || !(expected.mean > 0.0))) return {1.0, expected.mean};
  const bool points = receiver.polygon == nullptr && opening_m_ == Vec2(0.0);
  int n = std::max(kMinProbeRays, n_probe_rays_ >> std::min(halvings, 4));
  if (!receiver.whole) n = std::max(n, n_probe_rays_);
  Probe sum;
  probe(sum, points ? 1 : n, receiver, part, chance);
  if (sum.mixed())
    probe(sum, std::max(n, kShadowRaysPerProbeRay * n_probe_rays_ >> std::min(halvings, 4)), receiver, part,
          chance);
  const double weight = static_cast<double>(sum.n_inside) / sum.n;
  if (!receiver.whole) return {weight, sum.visible / sum.n};
  return {1.0, sum.lit > 0.0 ? expected.mean * sum.visible / sum.lit : 0.0};
}

// Light from points of the opening into the solid angle that the part of the cell fills: stays finite, and
// keeps its flux, however small the distance.
PairIntegrator::Sum PairIntegrator::close(const Receiver& receiver, const Part& part, Chance& chance) const {
  const Vec2 low(part[0].low, part[1].low), high(part[0].high, part[1].high);
  Sum sum;
  for (int i = 0; i < kCloseRays; ++i) {
    const auto x = chance.draw();
    if (receiver.whole || receiver.contains({part[0].at(x[0]), part[1].at(x[1])}))
      sum.weight += 1.0 / kCloseRays;
    const Vec3 q = on_opening(part[2].at(x[2]), part[3].at(x[3]));
    // In the plane of the cell there is nothing to see of it but rounding.
    if (receiver.frame->height(q) <= caster_.tolerance_m()) continue;
    const SphericalRectangle seen(*receiver.frame, low, high, q);
    if (!(seen.solid_angle_sr() > 0.0)) continue;
    const Vec2 local = seen.sample(x[0], x[1]);
    if (!receiver.whole && !receiver.contains(local)) continue;
    const Vec3 p = receiver.frame->to_world(local);
    const double cd = fitting_.intensity.at(luminaire_.to_local(p - q));
    if (cd > 0.0 && !blocked(p, q, receiver.skip)) sum.value += cd * seen.solid_angle_sr();
  }
  sum.value /= kCloseRays * part[0].length() * part[1].length();
  return sum;
}

}  // namespace dim
