#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/vec.hpp"

namespace dim {

/// A small convex planar polygon in space, or what one shrinks to: a segment (two corners) or a point (one).
/// Kept in place, without allocation, since integration cuts very many of them.
class ConvexRing {
 public:
  static constexpr int kMostCorners = 40;

  ConvexRing() {}  // by hand: the defaulted one would let {} set all corners to zero
  explicit ConvexRing(const Vec3& point) { add(point); }
  ConvexRing(const ConvexRing& other) : n_(other.n_) { std::copy_n(other.corner_.data(), n_, corner_.data()); }
  ConvexRing& operator=(const ConvexRing& other) {
    n_ = other.n_;
    std::copy_n(other.corner_.data(), n_, corner_.data());
    return *this;
  }

  int size() const { return n_; }
  bool empty() const { return n_ == 0; }
  const Vec3& operator[](int i) const { return corner_[static_cast<std::size_t>(i)]; }
  const Vec3* begin() const { return corner_.data(); }
  const Vec3* end() const { return corner_.data() + n_; }
  /// @throws InternalError beyond kMostCorners
  void add(const Vec3& corner);

  /// Area, m2; 0 for segments and points.
  double area_m2() const;
  /// Length of a segment, area of a polygon, 1 for a point: what shares of it are measured in.
  double measure() const;
  /// Mean of the corners.
  Vec3 middle() const;
  /// Largest distance of a corner from `middle`.
  double radius_m(const Vec3& middle) const;
  bool is_parallelogram() const;
  /// Distance of a point from the ring and what it encloses.
  double distance_m(const Vec3& p) const;

  /// The part with dot(normal, p) - offset >= 0. Empty where less than three corners of a polygon remain.
  ConvexRing front_of(const Vec3& normal, double offset) const;

  /// Both halves, cut across the longest side (or longest diameter of many-sided rings) through its middle.
  std::array<ConvexRing, 2> halves() const;

  /// The point that belongs to (a, b) of the unit square; equal areas of the square go to equal areas.
  Vec3 sample(double a, double b) const;

  /// Ends of the chord through `p` (a point of the ring) along `direction` (in its plane, not zero). Of a
  /// segment: its ends.
  std::array<Vec3, 2> chord(const Vec3& p, const Vec3& direction) const;

  /// Nodes of a quadrature of the mean over the ring, exact for polynomials of degree 2 (3 on
  /// parallelograms and segments), and their weights, which add up to 1.
  struct Nodes {
    int n = 0;
    std::array<Vec3, 3 * kMostCorners> at;
    std::array<double, 3 * kMostCorners> weight;
  };
  void nodes(Nodes& result) const;

 private:
  int n_ = 0;
  std::array<Vec3, kMostCorners> corner_;
};

/// Lambert's edge sum: pi times the configuration factor of a polygon wholly in front of the plane through
/// `p` with unit normal `n`: the integral of cos(theta) over the solid angle it fills, sr. Never negative,
/// whichever way the ring runs. Stays right however near the polygon is.
double projected_solid_angle_sr(const ConvexRing& ring, const Vec3& p, const Vec3& n);

/// Solid angle of a polygon seen from `p`, sr (Van Oosterom & Strackee 1983).
double solid_angle_sr(const ConvexRing& ring, const Vec3& p);

}  // namespace dim
