#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/low_discrepancy.hpp"
#include "geometry/shadow_plates.hpp"
#include "hemisphere/response.hpp"
#include "light/light_source.hpp"
#include "light/opening_region.hpp"

namespace dim {

/// Where direct light is received: a convex cell, or a measuring point (a ring of one corner).
struct Receiver {
  const Frame* frame;  ///< of the plane, n towards the lit side; its origin is the point
  ConvexRing ring;     ///< in space, in that plane
  int skip;            ///< plate it lies on, or -1
  std::uint64_t stream;  ///< its own chance
  Quantity quantity = Quantity::planar;  ///< of a measuring point
  bool is_point() const { return ring.size() == 1; }
  Response response() const { return {frame->n, quantity}; }
};
Receiver point_receiver(const Frame& frame, int skip, std::uint64_t stream, Quantity quantity = Quantity::planar);

/// Mean illuminance and the variance of its estimate, lx and lx2; 0 where it is exact to quadrature.
struct DirectEstimate {
  double lx = 0.0;
  double variance_lx2 = 0.0;
};

/// Plates that can stand between a source and a region of receivers; found when first asked for.
struct PlatesBetween {
  const Receiver& region;  ///< holds the receivers
  std::vector<int> found{};
  bool known = false;
};

struct PairOptions {
  /// Lines along which the visible share of a cell is found where something is in the way; a cell that gets
  /// less than the source's typical illuminance has in proportion fewer; points, which are read one by one, half
  /// of them at least.
  int shadow_lines = 128;
  double typical_lx = 0.0;   ///< see `typical_illuminance_lx`; 0: every cell has all
  bool in_the_way = true;    ///< false where nothing can be: visibility is not tested (mirrors' edges are)
};

/// The direct light of one source on any receiver. Mirrors reflect it whole: what they absorb is for the
/// caller to take off.
///
/// E = 1/(A_cell A_opening) times the integral over cell and opening of I(direction) cos(theta) / r^2
/// (equation 8 of the paper for each pair of points), at measuring points of other quantities with their weight in place
/// of the cosine and no horizon. Cell and opening are first clipped by each other's
/// horizon, exactly. The integral without obstruction is taken by Gauss's rule, the pair halved wherever it is
/// large against its distance, and by Lambert's edge sum where the two touch. Where plates stand within the
/// hull of the pair, exactly: not at all, wholly (0), or in part; in part, the share is found along lines
/// through the opening from points of the cell (or the other way round), on each of which it is exact. The
/// estimate is unbiased: E = c E_free + mean(visible - c free) with c from the other half of the lines.
/// Nothing depends on what other sources there are.
class PairIntegrator {
 public:
  PairIntegrator(const Zone& zone, const RayCaster& caster, const ShadowPlates& plates, const LightSource& source,
                 const PairOptions& options);

  const LightSource& source() const { return source_; }

  /// The luminaire's factor is left out.
  /// @param between  of a region that holds the receiver, for this source: neighbours share it
  DirectEstimate mean(const Receiver& receiver, PlatesBetween& between) const;
  DirectEstimate mean(const Receiver& receiver) const {
    PlatesBetween between{receiver};
    return mean(receiver, between);
  }

  /// What can stand between the opening and a region of receivers.
  enum class Sight {
    free,    ///< nothing on any line
    hidden,  ///< one plate on every line
    part
  };
  /// @param among  plates to look at, null: all
  /// @param found  set to those in the way of some lines
  Sight sight(const Receiver& region, const std::vector<int>* among, std::vector<int>& found) const;

  /// One path between receiver and opening, at four coordinates in [0, 1): where it comes in, and what
  /// illuminance it brings to the whole receiver, 0 if blocked. The mean over many is the receiver's. Cells
  /// are sampled by the solid angle they fill, seen from the opening.
  struct Path {
    Vec3 at{0.0};       ///< on the receiver
    Vec3 towards{0.0};  ///< unit, to the source
    double lx = 0.0;
  };
  Path path(const Receiver& receiver, const std::array<double, 4>& x) const;

 private:
  // A part of the cell or of the opening, and the share of the whole it is.
  struct Side {
    ConvexRing ring;
    double share = 1.0;
    Vec3 middle{0.0};
    double radius_m = 0.0;
  };
  struct Pair;
  struct Chance;
  struct Shadows;
  static Side side(const ConvexRing& ring, double share);
  static std::array<Side, 2> halves(const Side& whole);

  void find(PlatesBetween& between) const;
  bool clip(const Receiver& receiver, Side& cell, Side& opening) const;
  double illuminance(const Response& response, const Vec3& p, const Vec3& q) const;
  double near_limit(const Pair& pair) const;
  bool is_smooth(const Pair& pair) const;
  double free(const Pair& pair, int depth) const;
  double by_gauss(const Pair& pair) const;
  double touching(const Pair& pair) const;
  double of_lambertian(const Pair& pair, int depth) const;
  DirectEstimate shadowed(const Pair& pair, const std::vector<int>& plates, Shadows& shadows) const;
  double find_half_hidden(const Pair& pair, std::vector<int> plates, int depth, Shadows& shadows) const;
  DirectEstimate by_lines(const Pair& pair, double free_lx, const std::vector<int>& plates, int n,
                          Shadows& shadows) const;
  DirectEstimate by_rays(const Pair& pair, double free_lx, int n, int skip, Chance& chance) const;
  bool lines_on_cell(const Pair& pair, const std::vector<int>& plates) const;
  Vec3 line_direction(const ConvexRing& ring, const Vec3& eye, const std::vector<int>& plates,
                      ShadowPlates::LooksFrom looks_from, int n, Intervals& hidden) const;
  bool blocked(const Vec3& receiver, const Vec3& on_opening, int skip) const;

  const Zone& zone_;
  const RayCaster& caster_;
  const ShadowPlates& plates_;
  const LightSource& source_;
  const Luminaire& luminaire_;
  const Fitting& fitting_;
  PairOptions options_;
  bool test_paths_;       // one by one
  bool test_visibility_;  // of what is left of a receiver within the beam
  OpeningRegion opening_;
  double beam_;  // limit of size over distance within the beam
};

}  // namespace dim
