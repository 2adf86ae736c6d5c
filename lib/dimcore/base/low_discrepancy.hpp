#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace dim {

/// Mixes a 64-bit value so that every bit depends on every other (finaliser of SplitMix64, Steele et al.
/// 2014).
inline std::uint64_t mix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31);
}

/// A uniform number in [0, 1) from a hash.
inline double unit_from(std::uint64_t hash) { return static_cast<double>(hash >> 11) * 0x1p-53; }

/// Points of a four-dimensional additive recurrence (Kronecker sequence with the powers of the root of
/// x^5 = x + 1, which spread points most evenly), shifted by an offset of their own for every `stream`: the
/// same stream always gives the same points, different streams are independent.
class LowDiscrepancy4 {
 public:
  explicit LowDiscrepancy4(std::uint64_t stream) {
    for (std::size_t d = 0; d < 4; ++d) offset_[d] = mix(stream * 4 + d);
  }

  /// Point `index` of the stream, each coordinate in [0, 1).
  std::array<double, 4> operator()(std::uint64_t index) const {
    std::array<double, 4> point{};
    // Fractions are kept as 64-bit integers, whose overflow is the wrap round 1.
    for (std::size_t d = 0; d < 4; ++d) point[d] = unit_from(offset_[d] + index * kStep[d]);
    return point;
  }

 private:
  static constexpr std::array<std::uint64_t, 4> kStep = {0xDB4F0B9175AE2165ULL, 0xBBE0563303A4615FULL,
                                                         0xA0F2EC75A1FE1575ULL, 0x89E182857D9ED689ULL};
  std::array<std::uint64_t, 4> offset_{};
};

/// A rank-1 lattice of 2^m points in four dimensions (Korobov's), shifted by a
/// point of chance and folded by the tent map (Hickernell 2002): the mean of a continuous function converges
/// as n^-1.5 to n^-2, where independent points reach n^-0.5. Even and odd points are a lattice each.
class FoldedLattice4 {
 public:
  /// @param wanted  points: the next power of two from 4 to 1024 is made
  /// @param shift   each in [0, 1)
  FoldedLattice4(int wanted, const std::array<double, 4>& shift) : shift_(shift) {
    while (m_ < 10 && (1 << m_) < wanted) ++m_;
  }

  std::uint64_t size() const { return std::uint64_t{1} << m_; }

  /// Each coordinate in [0, 1].
  std::array<double, 4> operator()(std::uint64_t index) const {
    const std::uint64_t last = size() - 1;
    std::array<double, 4> point{};
    std::uint64_t step = index;
    for (std::size_t d = 0; d < 4; ++d, step *= kGenerator[static_cast<std::size_t>(m_)]) {
      double x = static_cast<double>(step & last) / static_cast<double>(size()) + shift_[d];
      x -= std::floor(x);
      point[d] = 1.0 - std::abs(2.0 * x - 1.0);
    }
    return point;
  }

 private:
  // By least P2; those of 64 and 256 points by least error on blurred edges of shadows, where three of the four
  // coordinates count, of all there are.
  static constexpr std::array<std::uint64_t, 11> kGenerator = {1, 1, 1, 3, 3, 3, 37, 21, 69, 187, 493};
  int m_ = 2;
  std::array<double, 4> shift_;
};

}  // namespace dim
