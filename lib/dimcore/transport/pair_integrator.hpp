#pragma once

#include <array>
#include <cstdint>

#include "base/low_discrepancy.hpp"
#include "geometry/cell_grid.hpp"
#include "transport/emitter.hpp"

namespace dim {

struct Interval {
  double low = 0.0, high = 1.0;
  double middle() const { return (low + high) / 2.0; }
  double length() const { return high - low; }
  double gauss(int sign) const { return middle() + sign * length() * 0.28867513459481287; }
  double at(double t) const { return low + t * length(); }
};

/// A part of the pair cell x opening: axes 0, 1 run over the cell in metres, 2, 3 over the opening's unit
/// square.
using Part = std::array<Interval, 4>;

inline Part whole_pair(const Vec2& low, const Vec2& high) {
  return {Interval{low.x, high.x}, Interval{low.y, high.y}, Interval{0.0, 1.0}, Interval{0.0, 1.0}};
}

/// Where direct light is received: a cell, or a measuring point (a part without extent).
struct Receiver {
  const Frame* frame;
  const Polygon* polygon;          ///< null for a measuring point
  bool whole;                      ///< every point of the rectangle belongs to the cell
  int skip;                        ///< plate it lies on
  std::uint64_t stream;            ///< its own chance
  const Vec2* centroid;            ///< of the cell's clipped region; null for a measuring point
  const CellGrid* grid = nullptr;  ///< that the cell is of
  int cell = -1;                   ///< its number there

  bool contains(const Vec2& p) const { return polygon->contains(p) && grid->cell_at(p) == cell; }
};

/// The direct light of one emitter on any receiver, see `direct_light`. Mirrors reflect it whole: what they
/// absorb is for the caller to take off.
class PairIntegrator {
 public:
  /// @param faint_lx      pairs that bring less (where they are not near) are sampled coarsely
  /// @param n_probe_rays  that probe the visibility of a pair
  /// @param in_the_way    false where nothing can be: visibility is not tested (mirrors' edges are)
  PairIntegrator(const Zone& zone, const RayCaster& caster, const Emitter& emitter, double faint_lx,
                 int n_probe_rays, std::uint64_t stream, bool in_the_way = true);

  /// Mean illuminance over the receiver with the luminaire's factor left out.
  double mean(const Receiver& receiver, const Part& pair) const;

  /// One path between receiver and opening, at four coordinates in [0, 1): where it comes in, and what
  /// illuminance it brings to the whole receiver, 0 if blocked or outside the cell. The mean over many is the
  /// receiver's (times the cell's share of its rectangle). Cells are sampled by the solid angle they fill,
  /// seen from the opening.
  struct Path {
    Vec3 at{0.0};       ///< on the receiver
    Vec3 towards{0.0};  ///< unit, to the emitter
    double lx = 0.0;
  };
  Path path(const Receiver& receiver, const Part& pair, const std::array<double, 4>& x) const;

  Vec3 on_opening(double s, double t) const;

 private:
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
  struct Probe {
    int n = 0, n_inside = 0, n_lit = 0, n_visible = 0;
    double lit = 0.0, visible = 0.0;
    bool mixed() const { return n_visible > 0 && n_visible < n_lit; }
  };
  struct Smooth {
    double mean = 0.0;
    bool horizon = false;  // some points receive light, some do not
  };

  bool blocked(const Vec3& receiver, const Vec3& on_opening, int skip) const;
  double of_sliver(const Receiver& receiver, const Part& pair, Chance& chance) const;
  bool hidden_by_orientation(const Receiver& receiver, const Part& pair) const;
  double unshadowed(const Receiver& receiver, const Vec3& p, const Vec3& q) const;
  bool is_faint(const Receiver& receiver, const Part& pair) const;
  Sum faint(const Receiver& receiver, const Part& pair, Chance& chance) const;
  Smooth smooth(const Receiver& receiver, const Part& part) const;
  std::array<double, 4> sides_m(const Part& part) const;
  bool near(const Receiver& receiver, const Part& part) const;
  Sum integrate(const Receiver& receiver, const Part& part, int near_halvings, int horizon_halvings,
                Chance& chance) const;
  Sum halves(const Receiver& receiver, const Part& part, int near_halvings, int horizon_halvings,
             Chance& chance) const;
  void probe(Probe& sum, int n, const Receiver& receiver, const Part& part, Chance& chance) const;
  Sum leaf(const Receiver& receiver, const Part& part, const Smooth& expected, int halvings,
           Chance& chance) const;
  Sum close(const Receiver& receiver, const Part& part, Chance& chance) const;

  const Zone& zone_;
  const RayCaster& caster_;
  const Emitter& emitter_;
  const Luminaire& luminaire_;
  const Fitting& fitting_;
  int n_probe_rays_;
  bool test_visibility_;
  std::uint64_t stream_;
  Vec2 opening_m_{0.0};
  double faint_ = 0.0;
  double near_;
};

}  // namespace dim
