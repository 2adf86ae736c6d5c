#include "transport/point_images.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "light/direct_light.hpp"
#include "network/stream_key.hpp"
#include "transport/cell_light.hpp"
#include "transport/image_series.hpp"

namespace dim {
namespace {

// Images of one luminaire, and of all luminaires together: beyond, what is left is extrapolated.
constexpr std::size_t kMostOfOne = 50'000;
constexpr std::size_t kMostOfAll = 1'000'000;
// Points darker than this share of the luminaire's mean illuminance are judged as if they had it.
constexpr double kDark = 1e-2;
constexpr std::ptrdiff_t kLatest = 6;  // orders whose mirrors count for deeper ones

double total_area_m2(const Zone& zone) {
  return std::accumulate(zone.surfaces.begin(), zone.surfaces.end(), 0.0,
                         [](double sum, const Surface& s) { return sum + s.polygon.area_m2(); });
}

// One luminaire's images at one point, order by order.
struct Series {
  std::vector<std::vector<double>> lx;  // [n_classes][orders]
  std::vector<std::vector<double>>
      reflectance;  // the same: the largest share that a mirror left, 0 without images
};

class OneLuminaire {
 public:
  OneLuminaire(const Room& room, const ModelPlan& plan, const MirrorImages& images,
               const LightSource& luminaire)
      : room_(room),
        plan_(plan),
        images_(images),
        order_{luminaire},
        series_(room.n_points(), {std::vector<std::vector<double>>(plan.n_classes()),
                                  std::vector<std::vector<double>>(plan.n_classes())}) {}

  // Whether there was one.
  bool next_order(std::size_t most, const Job& job) {
    auto next = images_.of(order_, most - std::min(most, n_));
    if (!next) return false;
    if (next->empty()) {
      exhausted_ = true;
      return false;
    }
    order_ = std::move(*next);
    n_ += order_.size();
    ++depth_;
    const auto integrators = make_integrators(room_.zone, order_, room_.obstructions, plan_.pairs());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, series_.size(), 4), [&](const auto& range) {
      for (std::size_t p = range.begin(); p != range.end() && !job.stopped(); ++p) add_order(p, integrators);
    });
    job.check();
    return true;
  }

  // Finds out whether the order reached is the last that there can be.
  void look_ahead() {
    const auto next = images_.of(order_, 1);
    exhausted_ = next && next->empty();
  }

  ImageTail tail(std::size_t point, std::size_t klass) const {
    if (exhausted_) return {};
    const auto& reflectance = series_[point].reflectance[klass];
    const auto latest = std::min<std::ptrdiff_t>(kLatest, std::ssize(reflectance));
    const double largest =
        latest > 0 ? *std::max_element(reflectance.end() - latest, reflectance.end()) : 0.0;
    return tail_of_images(series_[point].lx[klass], largest);
  }
  double sum(std::size_t point, std::size_t klass) const {
    const auto& lx = series_[point].lx[klass];
    return std::accumulate(lx.begin(), lx.end(), 0.0);
  }
  int depth() const { return depth_; }
  std::size_t n() const { return n_; }

 private:
  void add_order(std::size_t point, const std::vector<PairIntegrator>& integrators) {
    const MeasuringPoint& at = room_.zone.points[point];
    const Frame frame = frame_at(at);
    const Receiver receiver = point_receiver(frame, -1, point_key(room_.zone, point), at.quantity);
    const double tolerance_m = 1e-9 * room_.zone.diameter_m;
    std::vector<double> sums(plan_.n_classes(), 0.0), largest(plan_.n_classes(), 0.0);
    for (std::size_t e = 0; e < order_.size(); ++e) {
      const auto& luminaire = order_[e].luminaire;
      if (order_[e].beam.misses({&frame.origin, 1}, tolerance_m)) continue;
      const double lx = luminaire.factor * integrators[e].mean(receiver).lx;
      if (!(lx > 0.0)) continue;
      const auto tint = tints_of(room_.zone, plan_.classes, order_[e], frame.origin);
      for (std::size_t q = 0; q < tint.size(); ++q) {
        sums[q] += lx * tint[q];
        largest[q] = std::max(largest[q], tint[q]);
      }
    }
    for (std::size_t q = 0; q < sums.size(); ++q) {
      series_[point].lx[q].push_back(sums[q]);
      series_[point].reflectance[q].push_back(std::pow(largest[q], 1.0 / depth_));
    }
  }

  const Room& room_;
  const ModelPlan& plan_;
  const MirrorImages& images_;
  std::vector<LightSource> order_;
  std::vector<Series> series_;
  int depth_ = 0;
  std::size_t n_ = 0;
  bool exhausted_ = false;
};

}  // namespace

PointImages point_images(const Room& room, const ModelPlan& plan, const std::vector<int>& mirrors,
                         const std::vector<double>& direct_lx, const PointImagesOptions& options,
                         const Job& job) {
  const std::size_t n_points = room.n_points(), n_luminaires = room.n_luminaires();
  const std::size_t n_classes = plan.n_classes();
  PointImages result;
  result.lx.assign(n_points * plan.n_columns(), 0.0);
  result.uncertain_lx.assign(result.lx.size(), 0.0);
  const MirrorImages images(room.zone, mirrors);
  const double area_m2 = total_area_m2(room.zone);
  std::size_t most = kMostOfAll / std::max<std::size_t>(n_luminaires, 1);
  if (!options.depth) most = std::min(most, kMostOfOne);
  for (const LightSource& luminaire : own_sources(room.zone, room.lights, plan.tests_visibility)) {
    const std::size_t l = luminaire.original;
    OneLuminaire one(room, plan, images, luminaire);
    const double dark_lx = kDark * luminaire.power_lm() / area_m2;
    const auto is_good = [&] {
      for (std::size_t p = 0; p < n_points; ++p) {
        for (std::size_t q = 0; q < n_classes; ++q) {
          const double lx = std::max(dark_lx, direct_lx[p * n_luminaires + l] + one.sum(p, q));
          if (one.tail(p, q).uncertain_lx > options.tolerance * lx) return false;
        }
      }
      return true;
    };
    while ((options.depth ? one.depth() < *options.depth : one.depth() == 0 || !is_good()) &&
           one.next_order(most, job)) {
    }
    if (options.depth) one.look_ahead();
    for (std::size_t p = 0; p < n_points; ++p) {
      for (std::size_t q = 0; q < n_classes; ++q) {
        const ImageTail tail = one.tail(p, q);
        const std::size_t at = p * plan.n_columns() + plan.column(plan.source_of[l], q);
        result.lx[at] += one.sum(p, q) + (options.depth ? 0.0 : tail.lx);
        result.uncertain_lx[at] += tail.uncertain_lx + (options.depth ? tail.lx : 0.0);
      }
    }
    result.depth.push_back(one.depth());
    result.n += one.n();
  }
  return result;
}

}  // namespace dim
