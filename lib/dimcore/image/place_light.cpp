#include "image/place_light.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "light/opening_region.hpp"

namespace dim {
namespace {

constexpr std::array<int, 3> kLines = {4, 12, 32};
constexpr std::array<double, 2> kShareForMore = {0.03, 0.12};  // of all light at the place
constexpr double kUnseenShare = 2e-5;     // lamps that bring less are left out,
constexpr double kFaintShare = 2e-3;      // and of those that bring less the visible share is found once for a part
constexpr double kInterpolation = 0.02;   // straight lines may miss the nodes between by this share: curves do not
constexpr double kShadowBend = 0.01;      // the same of shadows, as a share of all light
constexpr std::size_t kFewPlaces = 4;     // not halved any more
constexpr std::size_t kFewForNodes = 10;  // interpolating would cost as much

// Nodes in a shadow cost as much as places: they are tried at two sizes of parts only.
bool is_size_for_shadows(std::size_t n_places) {
  return (n_places > 40 && n_places <= 64) || (n_places > kFewForNodes && n_places <= 20);
}

// What follows a function of two coordinates through the corners, middles of edges and the middle of a rectangle.
class NineNodes {
 public:
  template <class Function>
  NineNodes(const Vec2& low, const Vec2& high, Function&& f) : low_(low), size_(high - low) {
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) node(i, j) = f(low + 0.5 * Vec2(i, j) * size_);
  }
  double largest() const { return *std::max_element(value_.begin(), value_.end()); }
  /// How far straight lines between the corners miss the other nodes.
  double bend() const {
    double worst = 0.0;
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) {
        const double x = 0.5 * i, y = 0.5 * j;
        const double straight = (1 - x) * ((1 - y) * node(0, 0) + y * node(0, 2)) +
                                x * ((1 - y) * node(2, 0) + y * node(2, 2));
        worst = std::max(worst, std::abs(node(i, j) - straight));
      }
    }
    return worst;
  }
  double at(const Vec2& p) const {
    const auto weights = [](double x) {
      return std::array{(2 * x - 1) * (x - 1), 4 * x * (1 - x), x * (2 * x - 1)};
    };
    const auto u = weights(size_.x > 0.0 ? (p.x - low_.x) / size_.x : 0.0);
    const auto v = weights(size_.y > 0.0 ? (p.y - low_.y) / size_.y : 0.0);
    double sum = 0.0;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        sum += u[static_cast<std::size_t>(i)] * v[static_cast<std::size_t>(j)] * node(i, j);
    return std::max(0.0, sum);
  }

 private:
  double& node(int i, int j) { return value_[static_cast<std::size_t>(3 * j + i)]; }
  double node(int i, int j) const { return value_[static_cast<std::size_t>(3 * j + i)]; }
  Vec2 low_, size_;
  std::array<double, 9> value_{};
};

}  // namespace

// A lamp whose light at a part of the surface is still to be found.
struct PlaceLight::Open {
  std::size_t lamp = 0;
  bool free = false;             // nothing is in its way
  bool looked_at = false;        // what is in its way is known:
  std::vector<int> in_the_way{};
};

// Places, and the part of the surface that holds their footprints.
struct PlaceLight::Part {
  std::span<std::uint32_t> order;
  Vec2 low{std::numeric_limits<double>::max()}, high{std::numeric_limits<double>::lowest()};  // of the places
  Vec2 outer_low{low}, outer_high{high};                                                      // of footprints
};

class PlaceLight::Halving {
 public:
  Halving(const PlaceLight& light, std::size_t surface, std::span<const LitPlace> places, std::vector<double>& lx)
      : light_(light),
        surface_(surface),
        polygon_(light.zone_.surfaces[surface].polygon),
        places_(places),
        lx_(lx) {}

  void find(const Part& part, const std::vector<Open>& lamps) {
    Frame frame = polygon_.frame();
    frame.origin = world(0.5 * (part.low + part.high));
    const Receiver region = region_of(part, frame);
    const double all_lx = light_.field_.illuminance_lx(surface_, 0.5 * (part.low + part.high));
    std::vector<Open> rest;
    for (const Open& lamp : lamps) {
      Open open{lamp.lamp, lamp.free, false, {}};
      if (settle(part, region, all_lx, lamp, open)) continue;
      if (part.order.size() <= kFewPlaces)
        one_by_one(part, region, all_lx, open);
      else
        rest.push_back(std::move(open));
    }
    if (rest.empty()) return;
    const std::size_t n = split(part);
    for (const auto& half : {part.order.subspan(0, n), part.order.subspan(n)})
      if (!half.empty()) find(part_of(half), rest);
  }

  Part part_of(std::span<std::uint32_t> order) const {
    Part part{order};
    for (const auto i : order) {
      const LitPlace& place = places_[i];
      part.low = glm::min(part.low, place.local);
      part.high = glm::max(part.high, place.local);
      part.outer_low = glm::min(part.outer_low, place.local);
      part.outer_high = glm::max(part.outer_high, place.local);
      if (!place.whole) continue;
      for (const Vec2& corner : place.footprint) {
        part.outer_low = glm::min(part.outer_low, corner);
        part.outer_high = glm::max(part.outer_high, corner);
      }
    }
    return part;
  }

 private:
  Vec3 world(const Vec2& local) const { return polygon_.frame().to_world(local); }

  double& lx(std::uint32_t place, std::size_t lamp) { return lx_[place * light_.lamps_.size() + lamp]; }

  Receiver region_of(const Part& part, const Frame& frame) const {
    Receiver region{&frame, {}, static_cast<int>(surface_), places_[part.order.front()].chance};
    if (part.outer_low == part.outer_high) {
      region.ring.add(world(part.outer_low));
      return region;
    }
    const Vec2 &a = part.outer_low, &b = part.outer_high;
    for (const Vec2& p : {a, Vec2(b.x, a.y), b, Vec2(a.x, b.y)}) region.ring.add(world(p));
    return region;
  }

  double free_lx(std::size_t lamp, const Vec2& local) const {
    Frame frame = polygon_.frame();
    frame.origin = world(local);
    return light_.free_[lamp].mean(point_receiver(frame, static_cast<int>(surface_), 0)).lx;
  }

  // Whether the lamp's light at all places of the part is known now.
  bool settle(const Part& part, const Receiver& region, double all_lx, const Open& before, Open& open) {
    const auto& lamps = light_.lamps_;
    const LightSource& emitter = lamps.emitter(open.lamp);
    if (emitter.beam.misses({region.ring.begin(), region.ring.end()}, lamps.obstructions().caster().tolerance_m()))
      return true;
    const Vec3 middle = region.ring.middle();
    const double scale = lamps.factor_of(open.lamp);
    if (scale * light_.bound_lx(open.lamp, middle, region.ring.radius_m(middle)) <= kUnseenShare * all_lx)
      return true;
    if (!emitter.mirrors.empty()) return false;
    if (!open.free) {
      using Sight = PairIntegrator::Sight;
      const auto sight = light_.shadowed_[0][open.lamp].sight(
          region, before.looked_at ? &before.in_the_way : nullptr, open.in_the_way);
      if (sight == Sight::hidden) return true;
      open.free = sight == Sight::free;
      open.looked_at = true;
    }
    if (part.order.size() <= kFewForNodes) return false;
    return interpolate(part, region, all_lx / scale, open);
  }

  // Between nodes, where nothing or hardly any light is in the lamp's way.
  bool interpolate(const Part& part, const Receiver& region, double all_lx, const Open& open) {
    const NineNodes nodes(part.low, part.high, [&](const Vec2& p) { return free_lx(open.lamp, p); });
    const double largest = nodes.largest();
    if (nodes.bend() > kInterpolation * largest && nodes.bend() > kFaintShare * all_lx) return false;
    if (!open.free && largest > kFaintShare * all_lx) return interpolate_shadow(part, region, all_lx, open);
    double visible = 1.0;
    if (!open.free) {
      const Receiver at = point_receiver(*region.frame, region.skip, region.stream);
      const double free = light_.free_[open.lamp].mean(at).lx;
      visible = free > 0.0 ? shadowed_lx(1, open, region, at) / free : 0.0;
    }
    for (const auto i : part.order) lx(i, open.lamp) = visible * nodes.at(places_[i].local);
    return true;
  }

  // The same across the blurred edge of a shadow. Each node is the mean over a rectangle half as large as the part,
  // so that nothing falls between them.
  bool interpolate_shadow(const Part& part, const Receiver& region, double all_lx, const Open& open) {
    if (!is_size_for_shadows(part.order.size())) return false;
    const std::size_t care = care_for(free_lx(open.lamp, 0.5 * (part.low + part.high)) / all_lx);
    const Vec2 quarter = 0.25 * (part.high - part.low);
    std::uint64_t n = 0;
    const NineNodes nodes(part.low, part.high, [&](const Vec2& p) {
      Receiver at{region.frame, {}, region.skip, region.stream ^ mix(n++)};
      const Vec2 low = glm::max(part.low, p - quarter), high = glm::min(part.high, p + quarter);
      for (const Vec2& corner : {low, Vec2(high.x, low.y), high, Vec2(low.x, high.y)}) at.ring.add(world(corner));
      return shadowed_lx(care, open, region, at);
    });
    if (nodes.bend() > kShadowBend * all_lx) return false;
    for (const auto i : part.order) lx(i, open.lamp) = nodes.at(places_[i].local);
    return true;
  }

  static std::size_t care_for(double share) {
    return share > kShareForMore[1] ? 2 : share > kShareForMore[0] ? 1 : 0;
  }

  double shadowed_lx(std::size_t care, const Open& open, const Receiver& region, const Receiver& at) const {
    PlatesBetween between{region, open.in_the_way, open.looked_at};
    return light_.shadowed_[care][open.lamp].mean(at, between).lx;
  }

  void one_by_one(const Part& part, const Receiver& region, double all_lx, const Open& open) {
    if (open.free) {
      for (const auto i : part.order) lx(i, open.lamp) = free_lx(open.lamp, places_[i].local);
      return;
    }
    const double share = light_.lamps_.factor_of(open.lamp) * free_lx(open.lamp, 0.5 * (part.low + part.high)) / all_lx;
    for (const auto i : part.order) {
      const LitPlace& place = places_[i];
      Frame frame = polygon_.frame();
      frame.origin = world(place.local);
      Receiver receiver{&frame, {}, static_cast<int>(surface_), place.chance};
      if (place.whole)
        for (const Vec2& corner : place.footprint) receiver.ring.add(world(corner));
      else
        receiver.ring.add(frame.origin);
      lx(i, open.lamp) = shadowed_lx(care_for(share * place.weight), open, region, receiver);
    }
  }

  // Orders the places by halves across the longer side; the number of those in the first.
  std::size_t split(const Part& part) const {
    const Vec2 size = part.high - part.low;
    const int axis = size.x >= size.y ? 0 : 1;
    const double middle = 0.5 * (part.low[axis] + part.high[axis]);
    const auto second = std::stable_partition(part.order.begin(), part.order.end(), [&](std::uint32_t i) {
      return places_[i].local[axis] < middle;
    });
    const auto n = static_cast<std::size_t>(second - part.order.begin());
    return n == 0 || n == part.order.size() ? part.order.size() / 2 : n;
  }

  const PlaceLight& light_;
  std::size_t surface_;
  const Polygon& polygon_;
  std::span<const LitPlace> places_;
  std::vector<double>& lx_;
};

PlaceLight::PlaceLight(const Zone& zone, const Lamps& lamps, const LightField& field)
    : zone_(zone), lamps_(lamps), field_(field), free_(lamps.integrators(0)) {
  for (std::size_t i = 0; i < kLines.size(); ++i) shadowed_[i] = lamps.integrators(kLines[i]);
  for (std::size_t e = 0; e < lamps.size(); ++e) {
    const OpeningRegion opening = opening_region(lamps.emitter(e).luminaire);
    const Vec3 middle = opening.ring.middle();
    balls_.push_back({middle, opening.ring.radius_m(middle)});
  }
}

double PlaceLight::bound_lx(std::size_t lamp, const Vec3& middle, double radius_m) const {
  const Ball& ball = balls_[lamp];
  const LightSource& emitter = lamps_.emitter(lamp);
  const Vec3 d = middle - ball.middle;
  const double distance_m = glm::length(d), reach_m = radius_m + ball.radius_m;
  if (distance_m <= 1.01 * reach_m) return std::numeric_limits<double>::infinity();
  const double cd = emitter.fitting->intensity.bound_cd(emitter.luminaire.to_local(d / distance_m),
                                                        std::asin(reach_m / distance_m));
  return cd / ((distance_m - reach_m) * (distance_m - reach_m));
}

void PlaceLight::find(std::size_t surface, std::span<const LitPlace> places, std::vector<double>& lx) const {
  lx.assign(places.size() * lamps_.size(), 0.0);
  std::vector<std::uint32_t> order(places.size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<Open> all(lamps_.size());
  for (std::size_t e = 0; e < all.size(); ++e) all[e].lamp = e;
  Halving halving(*this, surface, places, lx);
  halving.find(halving.part_of(order), all);
}

}  // namespace dim
