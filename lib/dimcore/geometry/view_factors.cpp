#include "geometry/view_factors.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <tuple>
#include <utility>

#include "base/low_discrepancy.hpp"
#include "geometry/pair_exchange.hpp"
#include "geometry/visible_share.hpp"

namespace dim {
namespace {

// A polygon, or the part of it in front of another, ready to exchange light.
struct Region {
  std::vector<Ring3> rings;
  AreaSampler area;
  Vec3 centre{0.0};
  double radius_m = 0.0;
};

Region region_of(std::vector<Ring3> rings, const Frame& frame) {
  Region region;
  std::vector<Ring2> flat;
  Vec3 low(0.0), high(0.0);
  bool first = true;
  for (const auto& ring : rings) {
    flat.emplace_back();
    for (const auto& p : ring) {
      flat.back().push_back(frame.to_local(p));
      low = first ? p : glm::min(low, p);
      high = first ? p : glm::max(high, p);
      first = false;
    }
  }
  region.area = AreaSampler(flat);
  region.centre = (low + high) / 2.0;
  region.radius_m = glm::length(high - low) / 2.0;
  region.rings = std::move(rings);
  return region;
}

struct Pair {
  std::uint32_t first = 0, second = 0;  // first < second
  double exchange_m2 = 0.0;
  double difference_m2 = 0.0;  // of the exchange seen by the rays of the two
};

// Reports progress from whichever thread happens to be free to, and stops when asked.
template <class Function>
void for_each_parallel(std::size_t n, std::size_t grain, const char* stage, const Job& job, Function&& f) {
  std::atomic<std::size_t> done{0};
  std::mutex mutex;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, grain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      if (job.stopped()) return;
      f(i);
    }
    const std::size_t so_far = done += range.size();
    const std::unique_lock lock(mutex, std::try_to_lock);
    if (lock) job.report(stage, static_cast<double>(so_far) / static_cast<double>(n));
  });
  job.check();
}

class Calculation {
 public:
  Calculation(const std::vector<Plate>& plates, double diameter_m, int n_rays, const Job& job)
      : plates_(plates), caster_(plates, diameter_m), n_rays_(static_cast<std::uint64_t>(n_rays)), job_(job) {
    for (const auto& plate : plates) regions_.push_back(region_of(plate.polygon->corners(), frame(plate)));
  }

  ViewFactors run() {
    trace();
    auto pairs = seen_pairs();
    measure_reciprocity(pairs);
    share_out_lines(pairs);
    for_each_parallel(pairs.size(), 16, "pairs", job_, [&](std::size_t i) { refine(pairs[i]); });
    fill_rows(pairs);
    return std::move(result_);
  }

 private:
  static const Frame& frame(const Plate& plate) { return plate.polygon->frame(); }
  double area_m2(std::size_t plate) const { return plates_[plate].polygon->area_m2(); }

  void trace() {
    const std::size_t n = plates_.size();
    seen_.resize(n);
    result_.escaped.resize(n);
    result_.behind.resize(n);
    for_each_parallel(n, 1, "rays", job_, [&](std::size_t plate) { trace_from(plate); });
  }

  void trace_from(std::size_t plate) {
    std::vector<std::uint32_t> hits(plates_.size());
    std::uint64_t escaped = 0, behind = 0;
    const LowDiscrepancy4 points(mix(plate));
    const Frame& f = frame(plates_[plate]);
    for (std::uint64_t ray = 0; ray < n_rays_; ++ray) {
      const auto x = points(ray);
      const double sine = std::sqrt(x[0]), turn = 2.0 * kPi * x[1];
      const Vec3 direction(sine * std::cos(turn), sine * std::sin(turn), std::sqrt(1.0 - x[0]));
      const Hit hit = caster_.nearest(f.to_world(regions_[plate].area.point(x[2], x[3])),
                                      f.direction_to_world(direction), static_cast<int>(plate));
      if (hit.plate < 0)
        ++escaped;
      else if (hit.back)
        ++behind;
      else
        ++hits[static_cast<std::size_t>(hit.plate)];
    }
    const auto total = static_cast<double>(n_rays_);
    result_.escaped[plate] = static_cast<double>(escaped) / total;
    result_.behind[plate] = static_cast<double>(behind) / total;
    for (std::size_t to = 0; to < hits.size(); ++to) {
      if (hits[to] > 0) seen_[plate].push_back({static_cast<std::uint32_t>(to), hits[to] / total});
    }
  }

  // Every pair that a ray joins, with what the rays of both say. Equal numbers of rays give the exchange a
  // variance that grows with the area they start from: the mean is weighted with the reciprocals.
  std::vector<Pair> seen_pairs() const {
    struct Half {
      std::uint32_t first, second;
      bool forward;
      double factor;
    };
    std::vector<Half> halves;
    for (std::uint32_t from = 0; from < seen_.size(); ++from) {
      for (const auto& [to, factor] : seen_[from])
        halves.push_back({std::min(from, to), std::max(from, to), from < to, factor});
    }
    std::sort(halves.begin(), halves.end(), [](const Half& p, const Half& q) {
      return std::tie(p.first, p.second, p.forward) < std::tie(q.first, q.second, q.forward);
    });
    std::vector<Pair> pairs;
    for (const auto& half : halves) {
      if (pairs.empty() || pairs.back().first != half.first || pairs.back().second != half.second)
        pairs.push_back({half.first, half.second, 0.0, 0.0});
      Pair& pair = pairs.back();
      const double a = area_m2(half.first), b = area_m2(half.second);
      pair.exchange_m2 += half.factor * a * b / (a + b);
      pair.difference_m2 += half.forward ? a * half.factor : -b * half.factor;
    }
    return pairs;
  }

  void measure_reciprocity(const std::vector<Pair>& pairs) {
    double total_area_m2 = 0.0;
    for (std::size_t plate = 0; plate < plates_.size(); ++plate) total_area_m2 += area_m2(plate);
    double sum = 0.0, squares = 0.0;
    for (const auto& pair : pairs) {
      sum += std::abs(pair.difference_m2);
      squares += pair.difference_m2 * pair.difference_m2;
    }
    result_.reciprocity_total = sum / total_area_m2;
    result_.reciprocity_rms = std::sqrt(squares) / total_area_m2;
  }

  // A pair of factor F gets lines_per_root_ * sqrt(F) lines: the polygon's number of rays, or more in a zone
  // of so few pairs that all together would be less than kFewestLines times that.
  void share_out_lines(const std::vector<Pair>& pairs) {
    constexpr double kFewestLines = 64.0;
    double roots = 0.0;
    for (const auto& pair : pairs)
      roots += std::sqrt(pair.exchange_m2 / std::min(area_m2(pair.first), area_m2(pair.second)));
    lines_per_root_ =
        static_cast<double>(n_rays_) * (roots > 0.0 ? std::max(1.0, kFewestLines / roots) : 1.0);
  }

  // The region of a plate in front of another, made in `store` unless that is all of it; null if there is
  // none.
  const Region* in_front(std::size_t plate, std::size_t of, Region& store) const {
    const Region& whole = regions_[plate];
    double lowest = std::numeric_limits<double>::max(), highest = std::numeric_limits<double>::lowest();
    for (const auto& ring : whole.rings) {
      for (const auto& p : ring) {
        const double height = frame(plates_[of]).height(p);
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
      }
    }
    if (highest <= caster_.tolerance_m()) return nullptr;
    if (lowest >= -caster_.tolerance_m()) return &whole;
    auto rings = front_part(whole.rings, frame(plates_[of]), caster_.tolerance_m());
    if (rings.empty()) return nullptr;
    store = region_of(std::move(rings), frame(plates_[plate]));
    return store.area.area() > 0.0 ? &store : nullptr;
  }

  void refine(Pair& pair) const {
    std::size_t from = pair.first, to = pair.second;
    if (area_m2(from) > area_m2(to)) std::swap(from, to);
    Region store_from, store_to;
    const Region* a = in_front(from, to, store_from);
    const Region* b = in_front(to, from, store_to);
    if (!a || !b) return;  // almost one plane: what the rays say must do
    const double free_m2 = pair_exchange_m2(a->rings, b->rings);
    if (!(free_m2 > 0.0)) return;
    constexpr double kFewest = 64.0;
    const double factor = std::min(1.0, free_m2 / area_m2(from));
    const double lines = std::max(kFewest, lines_per_root_ * std::sqrt(factor));
    const double probe = std::max(kFewest, lines / 8.0);
    pair.exchange_m2 =
        free_m2 * visible_share(caster_, side(from, *a), side(to, *b), static_cast<std::uint64_t>(probe),
                                static_cast<std::uint64_t>(lines),
                                mix(pair.first * plates_.size() + pair.second));
  }

  PairSide side(std::size_t plate, const Region& region) const {
    return {static_cast<int>(plate), &frame(plates_[plate]), &region.area, region.centre, region.radius_m};
  }

  void fill_rows(const std::vector<Pair>& pairs) {
    result_.rows.resize(plates_.size());
    result_.row_sums.assign(plates_.size(), 0.0);
    for (const auto& pair : pairs) {
      if (!(pair.exchange_m2 > 0.0)) continue;
      add(pair.first, pair.second, pair.exchange_m2);
      add(pair.second, pair.first, pair.exchange_m2);
    }
    for (auto& row : result_.rows)
      std::sort(row.begin(), row.end(), [](const auto& p, const auto& q) { return p.to < q.to; });
  }

  void add(std::uint32_t from, std::uint32_t to, double exchange_m2) {
    const double factor = exchange_m2 / area_m2(from);
    result_.rows[from].push_back({to, factor});
    result_.row_sums[from] += factor;
  }

  const std::vector<Plate>& plates_;
  RayCaster caster_;
  std::uint64_t n_rays_;
  double lines_per_root_ = 0.0;
  const Job& job_;
  std::vector<Region> regions_;
  std::vector<std::vector<ViewFactors::Entry>> seen_;
  ViewFactors result_;
};

}  // namespace

double ViewFactors::at(std::size_t from, std::size_t to) const {
  const auto& row = rows.at(from);
  const auto found = std::lower_bound(
      row.begin(), row.end(), to, [](const Entry& entry, std::size_t wanted) { return entry.to < wanted; });
  return found != row.end() && found->to == to ? found->value : 0.0;
}

ViewFactors view_factors(const std::vector<Plate>& plates, double diameter_m, int rays_per_polygon,
                         const Job& job) {
  return Calculation(plates, diameter_m, std::max(1, rays_per_polygon), job).run();
}

}  // namespace dim
