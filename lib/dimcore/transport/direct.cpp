#include "transport/direct.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace dim {
namespace {

// Size of a pair (diagonals of cell part and opening part) over its distance, above which it is halved: with
// two Gauss points an axis the error of 1/r^2 then stays below 1e-3.
constexpr double kNear = 0.6;
constexpr int kMaxNearHalvings = 48;
// Halvings spent on a shadow edge: 16 parts of 4 to 8 samples.
constexpr int kShadowHalvings = 4;
// Below this share of the luminaire's mean illuminance in the zone a shadow edge is not refined.
constexpr double kFaint = 1e-3;

struct Interval {
  double low = 0.0, high = 1.0;
  double middle() const { return (low + high) / 2.0; }
  double length() const { return high - low; }
  double gauss(int sign) const { return middle() + sign * length() * 0.28867513459481287; }
};

// A part of the pair cell x opening: axes 0, 1 run over the cell in metres, 2, 3 over the opening's unit square.
using Part = std::array<Interval, 4>;

struct Receiver {
  const Frame* frame;
  const Polygon* polygon;  // null for a measuring point
  bool whole;              // every point of the rectangle belongs to the cell
  int skip;                // plate it lies on
};

struct Sum {
  double weight = 0.0;  // share of the part's samples that lie in the cell
  double value = 0.0;   // weight * mean illuminance per candela factor
};

class Integrator {
 public:
  Integrator(const RayCaster& caster, const Luminaire& luminaire, const Fitting& fitting, double mean_lx)
      : caster_(caster), luminaire_(luminaire), fitting_(fitting), faint_lx_(kFaint * mean_lx) {
    opening_m_ = {luminaire.opening.length_m, luminaire.opening.width_m};
    if (largest_dimension_m(luminaire.opening) == 0.0) opening_m_ = Vec2(0.0);
  }

  double mean(const Receiver& receiver, const Part& part) const {
    if (hidden_by_orientation(receiver, part)) return 0.0;
    const Sum sum = integrate(receiver, part, 0, 0);
    return sum.weight > 0.0 ? sum.value / sum.weight : 0.0;
  }

 private:
  struct Samples {
    int n = 0, n_inside = 0, n_facing = 0, n_visible = 0;
    double total = 0.0, largest = 0.0;
  };

  Vec3 on_opening(double s, double t) const {
    const Vec3 local = sample(luminaire_.opening, {s, t});
    return luminaire_.at + local.x * luminaire_.c0 + local.y * luminaire_.c90 + local.z * luminaire_.aim;
  }

  // Whether the receiver lies wholly behind the opening (where that emits forwards only) or the opening wholly
  // behind the receiver.
  bool hidden_by_orientation(const Receiver& receiver, const Part& part) const {
    const double reach = largest_dimension_m(luminaire_.opening);
    if (receiver.frame->height(luminaire_.at) <= -reach) return true;
    if (!fitting_.intensity.zero_behind()) return false;
    for (const double x : {part[0].low, part[0].high}) {
      for (const double y : {part[1].low, part[1].high}) {
        if (glm::dot(receiver.frame->to_world({x, y}) - luminaire_.at, luminaire_.aim) > 0.0) return false;
      }
    }
    return luminaire_.opening.shape != OpeningShape::kVerticalEllipse;
  }

  // Illuminance from the whole opening, were it all at q, before visibility.
  double unshadowed(const Receiver& receiver, const Vec3& p, const Vec3& q) const {
    const Vec3 d = p - q;
    const double r2 = glm::dot(d, d);
    const double height = -glm::dot(d, receiver.frame->n);
    if (!(height > 0.0)) return 0.0;
    const Vec3 local(glm::dot(d, luminaire_.c0), glm::dot(d, luminaire_.c90), glm::dot(d, luminaire_.aim));
    return fitting_.intensity.at(local) * height / (r2 * std::sqrt(r2));
  }

  Samples take(const Receiver& receiver, const Part& part) const {
    Samples samples;
    const bool area = part[0].length() > 0.0 || part[1].length() > 0.0;
    const bool extended = opening_m_ != Vec2(0.0);
    const int n = area && extended ? 8 : (area || extended ? 4 : 1);
    for (int run = 0; run < n; ++run) {
      // A half fraction of the 2^4 design: every odd moment up to the third vanishes.
      std::array<int, 4> sign = {run & 1 ? 1 : -1, run & 2 ? 1 : -1, run & 4 ? 1 : -1, 0};
      sign[3] = sign[0] * sign[1] * sign[2];
      if (n == 4 && extended) sign = {0, 0, sign[0], sign[1]};
      if (n == 4 && area) sign = {sign[0], sign[1], 0, 0};
      if (n == 1) sign = {0, 0, 0, 0};
      add(samples, receiver, {part[0].gauss(sign[0]), part[1].gauss(sign[1])},
          {part[2].gauss(sign[2]), part[3].gauss(sign[3])});
    }
    return samples;
  }

  void add(Samples& samples, const Receiver& receiver, const Vec2& local, const Vec2& on_unit) const {
    ++samples.n;
    if (!receiver.whole && !receiver.polygon->contains(local)) return;
    ++samples.n_inside;
    const Vec3 p = receiver.frame->to_world(local), q = on_opening(on_unit.x, on_unit.y);
    const double lx = unshadowed(receiver, p, q);
    if (!(lx > 0.0)) return;
    ++samples.n_facing;
    samples.largest = std::max(samples.largest, lx);
    if (caster_.blocked(p, q, receiver.skip)) return;
    ++samples.n_visible;
    samples.total += lx;
  }

  std::array<double, 4> sides_m(const Part& part) const {
    return {part[0].length(), part[1].length(), part[2].length() * opening_m_.x,
            part[3].length() * opening_m_.y};
  }

  bool near(const Receiver& receiver, const Part& part) const {
    const auto side = sides_m(part);
    const double size_m = std::hypot(side[0], side[1]) + std::hypot(side[2], side[3]);
    const Vec3 p = receiver.frame->to_world({part[0].middle(), part[1].middle()});
    return size_m > kNear * glm::length(p - on_opening(part[2].middle(), part[3].middle()));
  }

  Sum integrate(const Receiver& receiver, const Part& part, int near_halvings, int shadow_halvings) const {
    if (near_halvings < kMaxNearHalvings && near(receiver, part))
      return halves(receiver, part, near_halvings + 1, shadow_halvings);
    const Samples samples = take(receiver, part);
    const bool ragged = samples.n_inside < samples.n || samples.n_inside == 0;
    const bool split = (samples.n_visible > 0 && samples.n_visible < samples.n_facing) ||
                       (samples.n_facing > 0 && samples.n_facing < samples.n_inside);
    if ((split && samples.largest > faint_lx_ && shadow_halvings < kShadowHalvings) ||
        (ragged && shadow_halvings < kShadowHalvings + 2))
      return halves(receiver, part, near_halvings, shadow_halvings + 1);
    const double weight = static_cast<double>(samples.n_inside) / samples.n;
    return {weight, samples.n > 0 ? samples.total / samples.n : 0.0};
  }

  Sum halves(const Receiver& receiver, const Part& part, int near_halvings, int shadow_halvings) const {
    const auto side = sides_m(part);
    const auto longest = static_cast<std::size_t>(std::max_element(side.begin(), side.end()) - side.begin());
    Part low = part, high = part;
    low[longest].high = high[longest].low = part[longest].middle();
    const Sum a = integrate(receiver, low, near_halvings, shadow_halvings);
    const Sum b = integrate(receiver, high, near_halvings, shadow_halvings);
    return {(a.weight + b.weight) / 2.0, (a.value + b.value) / 2.0};
  }

  const RayCaster& caster_;
  const Luminaire& luminaire_;
  const Fitting& fitting_;
  Vec2 opening_m_{0.0};
  double faint_lx_ = 0.0;
};

double total_area_m2(const Zone& zone) {
  return std::accumulate(zone.surfaces.begin(), zone.surfaces.end(), 0.0,
                         [](double sum, const Surface& s) { return sum + s.polygon.area_m2(); });
}

Part whole_pair(const Vec2& low, const Vec2& high) {
  return {Interval{low.x, high.x}, Interval{low.y, high.y}, Interval{0.0, 1.0}, Interval{0.0, 1.0}};
}

}  // namespace

DirectLight direct_light(const Zone& zone, const Cells& cells, const Lights& lights,
                         const std::vector<std::size_t>& source_of, std::size_t n_sources, const Job& job) {
  const Obstructions obstructions(zone, lights);
  const double area_m2 = total_area_m2(zone);
  std::vector<Integrator> integrators;
  for (const auto& luminaire : lights.luminaires) {
    const auto& fitting = lights.fittings[static_cast<std::size_t>(luminaire.fitting)];
    integrators.emplace_back(obstructions.caster(), luminaire, fitting, fitting.intensity.flux_lm() / area_m2);
  }
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
      const Receiver receiver{&polygon.frame(), &polygon, cell.whole, static_cast<int>(surface)};
      add_all(receiver, whole_pair(cell.low, cell.high), &result.cell_lx[i * n_sources]);
    }
  });
  job.check();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, zone.points.size(), 8), [&](const auto& range) {
    if (job.stopped()) return;
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Frame frame = frame_at(zone.points[i]);
      add_all({&frame, nullptr, true, -1}, whole_pair(Vec2(0.0), Vec2(0.0)), &result.point_lx[i * n_sources]);
    }
  });
  job.check();
  return result;
}

}  // namespace dim
