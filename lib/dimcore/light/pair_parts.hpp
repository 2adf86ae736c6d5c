#pragma once

#include "light/pair_integrator.hpp"

/// What the two halves of `PairIntegrator`, free light and shadows, hand each other.
namespace dim {

struct PairIntegrator::Pair {
  Side cell, opening;
  const Response& response;  // of the receiver
  double size_m() const { return 2.0 * (cell.radius_m + opening.radius_m); }
  double distance_m() const { return glm::length(cell.middle - opening.middle); }
  // Rounding does not decide between equals.
  bool halve_cell() const { return cell.radius_m >= (1.0 - 1e-9) * opening.radius_m; }
};

// The chance of one pair: a stream of points, each used once.
struct PairIntegrator::Chance {
  explicit Chance(std::uint64_t stream) : points(stream) {}
  LowDiscrepancy4 points;
  std::uint64_t next = 0;
  std::array<double, 4> draw() { return points(next++); }
};

struct PairIntegrator::Shadows {
  const ConvexRing& bounds;  // of the whole opening, clipped
  double free_lx;            // of the whole pair
  double lines;              // for the whole pair
  int skip;
  Chance chance;
  struct Part {
    Pair pair;
    std::vector<int> plates;  // that hide some of it
    double free_lx;
  };
  std::vector<Part> parts{};
  Intervals hidden{};
};

}  // namespace dim
