#include "transport/direct.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/low_discrepancy.hpp"
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
// Rays that probe the visibility of a pair, and how many more where they disagree. Parts of a halved pair
// share them. They are spread over cell and opening by chance, the same chance in every run: a fixed pattern
// would miss the same strip of every cell along the foot of a cabinet. The fewer luminaires, the more each
// gets: of many, the errors average out.
constexpr int kProbeRaysPerReceiver = 384;
constexpr int kMostProbeRays = 64;
constexpr int kLeastProbeRays = 16;
constexpr int kShadowRaysPerProbeRay = 4;
constexpr int kMinProbeRays = 4;
// Pairs that bring less than this share of the mean direct illuminance get a few rays only. Their mean is as
// unbiased as the rest's, only coarser, and there are many of them.
constexpr double kFaint = 1e-2;
constexpr int kFaintRays = 2;

struct Interval {
  double low = 0.0, high = 1.0;
  double middle() const { return (low + high) / 2.0; }
  double length() const { return high - low; }
  double gauss(int sign) const { return middle() + sign * length() * 0.28867513459481287; }
  double at(double t) const { return low + t * length(); }
};

// A part of the pair cell x opening: axes 0, 1 run over the cell in metres, 2, 3 over the opening's unit
// square.
using Part = std::array<Interval, 4>;

struct Receiver {
  const Frame* frame;
  const Polygon* polygon;  // null for a measuring point
  bool whole;              // every point of the rectangle belongs to the cell
  int skip;                // plate it lies on
  std::uint64_t stream;    // its own chance
  const Vec2* centroid;    // of the cell's clipped region; null for a measuring point
};

struct Sum {
  double weight = 0.0;  // share of the part that belongs to the cell
  double value = 0.0;   // weight * mean illuminance
  Sum operator+(const Sum& other) const { return {weight + other.weight, value + other.value}; }
};

// The chance of one pair: a stream of points, each used once.
struct Chance {
  LowDiscrepancy4 points;
  std::uint64_t next = 0;
  std::array<double, 4> draw() { return points(next++); }
};

class Integrator {
 public:
  Integrator(const RayCaster& caster, const Luminaire& luminaire, const Fitting& fitting, double faint_lx,
             int n_probe_rays, std::uint64_t stream)
      : caster_(caster),
        luminaire_(luminaire),
        fitting_(fitting),
        n_probe_rays_(n_probe_rays),
        stream_(mix(stream)) {
    faint_ = luminaire.factor > 0.0 ? faint_lx / luminaire.factor : 0.0;
    // A beam must not fall between the points: parts are to be small against its width, too.
    const auto& beam = fitting.intensity;
    if (beam.max_cd() > 0.0)
      near_ = std::clamp(0.6 * std::sqrt(beam.flux_lm() / (kPi * beam.max_cd())), 0.05, kNear);
    if (largest_dimension_m(luminaire.opening) > 0.0)
      opening_m_ = {luminaire.opening.length_m, luminaire.opening.width_m};
  }

  /// Mean illuminance over the receiver with the luminaire's factor left out.
  double mean(const Receiver& receiver, const Part& pair) const {
    if (hidden_by_orientation(receiver, pair)) return 0.0;
    Chance chance{LowDiscrepancy4(receiver.stream ^ stream_)};
    const Sum sum =
        is_faint(receiver, pair) ? faint(receiver, pair, chance) : integrate(receiver, pair, 0, 0, chance);
    return sum.weight > 0.0 ? sum.value / sum.weight : of_sliver(receiver, pair, chance);
  }

 private:
  // Of a cell that none of the rays found: light at a point of it stands for all.
  double of_sliver(const Receiver& receiver, const Part& pair, Chance& chance) const {
    const Vec2& at = *receiver.centroid;
    Receiver point = receiver;
    point.polygon = nullptr;
    point.whole = true;
    return integrate(point, {Interval{at.x, at.x}, Interval{at.y, at.y}, pair[2], pair[3]}, 0, 0, chance)
        .value;
  }

  Vec3 on_opening(double s, double t) const {
    return luminaire_.at + luminaire_.to_world(sample(luminaire_.opening, {s, t}));
  }

  // Whether the receiver lies wholly behind the opening (where that emits forwards only) or the opening
  // wholly behind the receiver.
  bool hidden_by_orientation(const Receiver& receiver, const Part& pair) const {
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
  double unshadowed(const Receiver& receiver, const Vec3& p, const Vec3& q) const {
    const Vec3 d = p - q;
    const double height = -glm::dot(d, receiver.frame->n);
    if (!(height > 0.0)) return 0.0;
    const double r2 = glm::dot(d, d);
    return fitting_.intensity.at(luminaire_.to_local(d)) * height / (r2 * std::sqrt(r2));
  }

  struct Probe {
    int n = 0, n_inside = 0, n_lit = 0, n_visible = 0;
    double lit = 0.0, visible = 0.0;
    bool mixed() const { return n_visible > 0 && n_visible < n_lit; }
  };

  // Far away and bringing little, judged between the middles.
  bool is_faint(const Receiver& receiver, const Part& pair) const {
    if (near(receiver, pair)) return false;
    const Vec3 p = receiver.frame->to_world({pair[0].middle(), pair[1].middle()});
    return unshadowed(receiver, p, on_opening(0.5, 0.5)) < faint_;
  }

  Sum faint(const Receiver& receiver, const Part& pair, Chance& chance) const {
    Probe sum;
    probe(sum, receiver.whole ? kFaintRays : n_probe_rays_, receiver, pair, chance);
    return {static_cast<double>(sum.n_inside) / sum.n, sum.visible / sum.n};
  }

  struct Smooth {
    double mean = 0.0;
    bool horizon = false;  // some points receive light, some do not
  };

  // Gauss points, two an axis, visibility left out.
  Smooth smooth(const Receiver& receiver, const Part& part) const {
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

  std::array<double, 4> sides_m(const Part& part) const {
    return {part[0].length(), part[1].length(), part[2].length() * opening_m_.x,
            part[3].length() * opening_m_.y};
  }

  bool near(const Receiver& receiver, const Part& part) const {
    const auto side = sides_m(part);
    const double size_m = std::hypot(side[0], side[1]) + std::hypot(side[2], side[3]);
    const Vec3 p = receiver.frame->to_world({part[0].middle(), part[1].middle()});
    const double limit = receiver.polygon ? near_ : near_ / 2.0;
    return size_m > limit * glm::length(p - on_opening(part[2].middle(), part[3].middle()));
  }

  Sum integrate(const Receiver& receiver, const Part& part, int near_halvings, int horizon_halvings,
                Chance& chance) const {
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

  Sum halves(const Receiver& receiver, const Part& part, int near_halvings, int horizon_halvings,
             Chance& chance) const {
    const auto side = sides_m(part);
    const auto longest = static_cast<std::size_t>(std::max_element(side.begin(), side.end()) - side.begin());
    Part low = part, high = part;
    low[longest].high = high[longest].low = part[longest].middle();
    const Sum both = integrate(receiver, low, near_halvings, horizon_halvings, chance) +
                     integrate(receiver, high, near_halvings, horizon_halvings, chance);
    return {both.weight / 2.0, both.value / 2.0};
  }

  void probe(Probe& sum, int n, const Receiver& receiver, const Part& part, Chance& chance) const {
    for (; sum.n < n; ++sum.n) {
      const auto x = chance.draw();
      const Vec2 local(part[0].at(x[0]), part[1].at(x[1]));
      if (!receiver.whole && !receiver.polygon->contains(local)) continue;
      ++sum.n_inside;
      const Vec3 p = receiver.frame->to_world(local), q = on_opening(part[2].at(x[2]), part[3].at(x[3]));
      const double lx = unshadowed(receiver, p, q);
      if (!(lx > 0.0)) continue;
      ++sum.n_lit;
      sum.lit += lx;
      if (caster_.blocked(p, q, receiver.skip)) continue;
      ++sum.n_visible;
      sum.visible += lx;
    }
  }

  Sum leaf(const Receiver& receiver, const Part& part, const Smooth& expected, int halvings,
           Chance& chance) const {
    if (receiver.whole && !(expected.mean > 0.0)) return {1.0, 0.0};
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
  Sum close(const Receiver& receiver, const Part& part, Chance& chance) const {
    const Vec2 low(part[0].low, part[1].low), high(part[0].high, part[1].high);
    Sum sum;
    for (int i = 0; i < kCloseRays; ++i) {
      const auto x = chance.draw();
      if (receiver.whole || receiver.polygon->contains({part[0].at(x[0]), part[1].at(x[1])}))
        sum.weight += 1.0 / kCloseRays;
      const Vec3 q = on_opening(part[2].at(x[2]), part[3].at(x[3]));
      // In the plane of the cell there is nothing to see of it but rounding.
      if (receiver.frame->height(q) <= caster_.tolerance_m()) continue;
      const SphericalRectangle seen(*receiver.frame, low, high, q);
      if (!(seen.solid_angle_sr() > 0.0)) continue;
      const Vec2 local = seen.sample(x[0], x[1]);
      if (!receiver.whole && !receiver.polygon->contains(local)) continue;
      const Vec3 p = receiver.frame->to_world(local);
      const double cd = fitting_.intensity.at(luminaire_.to_local(p - q));
      if (cd > 0.0 && !caster_.blocked(p, q, receiver.skip)) sum.value += cd * seen.solid_angle_sr();
    }
    sum.value /= kCloseRays * part[0].length() * part[1].length();
    return sum;
  }

  const RayCaster& caster_;
  const Luminaire& luminaire_;
  const Fitting& fitting_;
  int n_probe_rays_;
  std::uint64_t stream_;
  Vec2 opening_m_{0.0};
  double faint_ = 0.0;
  double near_ = kNear;
};

double total_area_m2(const Zone& zone) {
  return std::accumulate(zone.surfaces.begin(), zone.surfaces.end(), 0.0,
                         [](double sum, const Surface& s) { return sum + s.polygon.area_m2(); });
}

double total_flux_lm(const Lights& lights) {
  return std::accumulate(
      lights.luminaires.begin(), lights.luminaires.end(), 0.0, [&](double sum, const Luminaire& l) {
        return sum + l.factor * lights.fittings[static_cast<std::size_t>(l.fitting)].intensity.flux_lm();
      });
}

Part whole_pair(const Vec2& low, const Vec2& high) {
  return {Interval{low.x, high.x}, Interval{low.y, high.y}, Interval{0.0, 1.0}, Interval{0.0, 1.0}};
}

}  // namespace

DirectLight direct_light(const Zone& zone, const Cells& cells, const Lights& lights,
                         const std::vector<std::size_t>& source_of, std::size_t n_sources, const Job& job) {
  const Obstructions obstructions(zone, lights);
  const double faint_lx = kFaint * total_flux_lm(lights) / total_area_m2(zone);
  const int n_probe_rays =
      std::clamp(kProbeRaysPerReceiver / std::max(1, static_cast<int>(lights.luminaires.size())),
                 kLeastProbeRays, kMostProbeRays);
  std::vector<Integrator> integrators;
  for (const auto& luminaire : lights.luminaires)
    integrators.emplace_back(obstructions.caster(), luminaire,
                             lights.fittings[static_cast<std::size_t>(luminaire.fitting)], faint_lx,
                             n_probe_rays, integrators.size());
  const auto add_all = [&](const Receiver& receiver, const Part& pair, double* out_lx) {
    for (std::size_t l = 0; l < integrators.size(); ++l)
      out_lx[source_of[l]] += lights.luminaires[l].factor * integrators[l].mean(receiver, pair);
  };
  DirectLight result;
  result.cell_lx.assign(cells.size() * n_sources, 0.0);
  result.point_lx.assign(zone.points.size() * n_sources, 0.0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size(), 8), [&](const auto& range) {
    if (job.stopped()) return;
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const auto surface = cells.surface_of(i);
      const auto& polygon = zone.surfaces[surface].polygon;
      const GridCell& cell = cells[i];
      const Receiver receiver{&polygon.frame(),          &polygon, cell.whole,
                              static_cast<int>(surface), mix(i),   &cell.centroid};
      add_all(receiver, whole_pair(cell.low, cell.high), &result.cell_lx[i * n_sources]);
    }
  });
  job.check();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, zone.points.size(), 8), [&](const auto& range) {
    if (job.stopped()) return;
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Frame frame = frame_at(zone.points[i]);
      add_all({&frame, nullptr, true, -1, mix(~i), nullptr}, whole_pair(Vec2(0.0), Vec2(0.0)),
              &result.point_lx[i * n_sources]);
    }
  });
  job.check();
  return result;
}

}  // namespace dim
