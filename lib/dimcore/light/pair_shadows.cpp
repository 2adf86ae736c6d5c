#include <algorithm>
#include <cmath>

#include "light/pair_parts.hpp"

// The part of PairIntegrator that finds how much of a pair's light is hidden.
namespace dim {
namespace {

// Shadows are found in parts of a pair that are not nearer than this, to a depth.
constexpr double kNearShadow = 1.0;
constexpr int kMostShadowHalvings = 8;
// Pairs of points tried for each that a beam lights.
constexpr int kMostTries = 64;
// Lines to each of the trial lines that tell their direction, and most of these in each of four directions.
constexpr int kLinesPerTrial = 32, kMostTrials = 8;

// Those of 64 and 256 points have least error on the blurred edges of shadows, of all there are: a line's place
// along itself does not count, so that even spread over four coordinates is not what is wanted.
constexpr FoldedLattice4::Generators kAcrossEdges = {1, 1, 1, 3, 3, 3, 37, 21, 69, 187, 493};

// Sums of free and visible light over two interleaved halves of the samples, and the unbiased estimate they
// give: the visible share that corrects one half is taken from the other. Halves of few points of a lattice know too much
// of each other for that; a share that nobody chose corrects them. At least two samples; exactly 0 or all
// of the free light where they agree.
class HalfSums {
 public:
  void add(double free, double visible) {
    Half& half = half_[n_lit_ & 1];
    half.free += free;
    half.visible += visible;
    ++half.n;
    n_lit_ += free > 0.0;
  }
  DirectEstimate estimate(double free_lx) const {
    std::array<double, 2> lx{};
    const double free = half_[0].free + half_[1].free, visible = half_[0].visible + half_[1].visible;
    const bool few = half_[0].n + half_[1].n <= kFewSamples && visible > 0.0 && visible < free;
    for (std::size_t h = 0; h < 2; ++h) {
      const Half &own = half_[h], &other = half_[1 - h];
      const double share = few                ? kShareOfFew
                           : other.free > 0.0 ? other.visible / other.free
                           : own.free > 0.0   ? own.visible / own.free
                                              : kShareOfFew;
      lx[h] = share * free_lx + (own.n > 0.0 ? (own.visible - share * own.free) / own.n : 0.0);
    }
    const double mean = 0.5 * (lx[0] + lx[1]), apart = 0.5 * (lx[0] - lx[1]);
    return {std::max(0.0, mean), apart * apart};
  }

 private:
  static constexpr double kFewSamples = 8.0, kShareOfFew = 0.5;
  struct Half {
    double n = 0.0, free = 0.0, visible = 0.0;
  };
  std::size_t n_lit_ = 0;
  std::array<Half, 2> half_{};
};

}  // namespace

bool PairIntegrator::blocked(const Vec3& receiver, const Vec3& on_opening, int skip) const {
  return source_.mirrors.empty() ? caster_.blocked(receiver, on_opening, skip)
                                  : path_blocked(zone_, caster_, source_, receiver, on_opening, skip);
}

// What is hidden wholly or not at all needs no lines: all of them go to the parts that are hidden in part.
DirectEstimate PairIntegrator::shadowed(const Pair& pair, const std::vector<int>& plates, Shadows& shadows) const {
  DirectEstimate sum{find_half_hidden(pair, plates, 0, shadows), 0.0};
  double free_lx = 0.0;
  for (const auto& part : shadows.parts) free_lx += part.free_lx;
  for (const auto& part : shadows.parts) {
    // Of equal halves none is to get a line more by rounding.
    const double n = shadows.lines * std::min(1.0, part.free_lx / free_lx) - 1e-9;
    const DirectEstimate of_part =
        by_lines(part.pair, part.free_lx, part.plates, std::max(1, static_cast<int>(std::ceil(n))), shadows);
    sum.lx += of_part.lx;
    sum.variance_lx2 += of_part.variance_lx2;
  }
  return sum;
}

// The light of parts that nothing hides; keeps those that are hidden in part.
double PairIntegrator::find_half_hidden(const Pair& pair, std::vector<int> plates, int depth, Shadows& shadows) const {
  constexpr int kFewCorners = 8;
  const auto& ring = pair.opening.ring;
  const Shaft shaft(pair.cell.ring, ring.size() > kFewCorners && depth == 0 ? shadows.bounds : ring, shadows.skip);
  std::size_t n_kept = 0;
  for (const int plate : plates) {
    const auto cover = plates_.cover(plate, shaft);
    if (cover == ShadowPlates::Cover::whole) return 0.0;
    if (cover == ShadowPlates::Cover::part) plates[n_kept++] = plate;
  }
  plates.resize(n_kept);
  const double free_lx = depth == 0 ? shadows.free_lx : free(pair, 0);
  if (plates.empty() || !(free_lx > 0.0)) return free_lx;
  if (depth == kMostShadowHalvings || pair.size_m() <= kNearShadow * pair.distance_m()) {
    shadows.parts.push_back({pair, std::move(plates), free_lx});
    return 0.0;
  }
  double sum_lx = 0.0;
  for (const Side& part : halves(pair.halve_cell() ? pair.cell : pair.opening)) {
    if (!(part.share > 0.0)) continue;
    sum_lx += pair.halve_cell() ? find_half_hidden({part, pair.opening, pair.response}, plates, depth + 1, shadows)
                                : find_half_hidden({pair.cell, part, pair.response}, plates, depth + 1, shadows);
  }
  return sum_lx;
}

DirectEstimate PairIntegrator::by_rays(const Pair& pair, double free_lx, int n, int skip, Chance& chance) const {
  const double share = pair.cell.share * pair.opening.share;
  HalfSums sums;
  // Of a beam that lights little of the cell, pairs of points that it misses tell nothing.
  const int most = kMostTries * n;
  for (int i = 0, n_lit = 0; n_lit < n && i < most; ++i) {
    const auto x = chance.draw();
    const Vec3 p = pair.cell.ring.sample(x[0], x[1]), q = pair.opening.ring.sample(x[2], x[3]);
    const double lx = share * illuminance(pair.response, p, q);
    if (!(lx > 0.0)) {
      sums.add(0.0, 0.0);
      continue;
    }
    sums.add(lx, blocked(p, q, skip) ? 0.0 : lx);
    ++n_lit;
  }
  return sums.estimate(free_lx);
}

// Lines lie in whichever of the two throws the larger image on what is in the way: across the blurred edge of a
// shadow its light then changes gradually from line to line.
bool PairIntegrator::lines_on_cell(const Pair& pair, const std::vector<int>& plates) const {
  if (pair.opening.ring.size() == 1) return true;
  if (pair.cell.ring.size() == 1) return false;
  double along = 0.0;
  for (const int plate : plates) along += plates_.crossing_share(plate, pair.cell.middle, pair.opening.middle);
  along /= static_cast<double>(plates.size());
  return pair.cell.radius_m * (1.0 - along) > (1.0 + 1e-9) * pair.opening.radius_m * along;
}

// Of four directions the one along which lines differ least in how much of them is hidden: across the edges of
// the shadow rather than along them. Trial lines are worth an eighth of the lines, in each direction at least two.
Vec3 PairIntegrator::line_direction(const ConvexRing& ring, const Vec3& eye, const std::vector<int>& plates,
                                    ShadowPlates::LooksFrom looks_from, int n, Intervals& hidden) const {
  if (ring.size() < 3) return Vec3(0.0);
  constexpr double kLess = 1e-9;  // rounding does not decide between equals
  const int n_trials = std::min(kMostTrials, n / kLinesPerTrial);
  const Vec3 e1 = glm::normalize(ring[1] - ring[0]);
  const Vec3 e2 = glm::normalize(glm::cross(glm::cross(e1, ring[ring.size() - 1] - ring[0]), e1));
  if (n_trials < 2) return e1;
  Vec3 best(0.0);
  double least = 1e300;
  for (const Vec3& along : {e1, e2, e1 + e2, e1 - e2}) {
    const Vec3 across = glm::dot(along, e2) * e1 - glm::dot(along, e1) * e2;
    double low = 1e300, high = -1e300;
    for (const Vec3& corner : ring) {
      low = std::min(low, glm::dot(corner, across));
      high = std::max(high, glm::dot(corner, across));
    }
    const Vec3 middle = ring.middle();
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < n_trials; ++i) {
      const double offset = low + (high - low) * (i + 0.5) / n_trials - glm::dot(middle, across);
      const auto line = ring.chord(middle + offset / glm::dot(across, across) * across, along);
      hidden.clear();
      for (const int plate : plates) plates_.add_hidden(plate, eye, line[0], line[1], looks_from, hidden);
      hidden.merge();
      double share = 0.0;
      for (const auto& part : hidden.parts()) share += part.high - part.low;
      sum += share;
      squares += share * share;
    }
    const double spread = squares / n_trials - sum * sum / (n_trials * n_trials);
    if (spread > least - kLess) continue;
    least = spread;
    best = along;
  }
  return best;
}

DirectEstimate PairIntegrator::by_lines(const Pair& pair, double free_lx, const std::vector<int>& plates, int n,
                                        Shadows& shadows) const {
  const bool on_cell = lines_on_cell(pair, plates);
  const ConvexRing& ring = on_cell ? pair.cell.ring : pair.opening.ring;
  const ConvexRing& eyes = on_cell ? pair.opening.ring : pair.cell.ring;
  const auto looks_from = on_cell ? ShadowPlates::LooksFrom::segment : ShadowPlates::LooksFrom::eye;
  const Vec3 along = line_direction(ring, on_cell ? pair.opening.middle : pair.cell.middle, plates, looks_from, n,
                                    shadows.hidden);
  const double share = pair.cell.share * pair.opening.share;
  HalfSums sums;
  const FoldedLattice4 points(n, shadows.chance.draw(), kAcrossEdges);
  for (std::uint64_t i = 0; i < points.size(); ++i) {
    const auto x = points(i);
    const Vec3 eye = eyes.sample(x[0], x[1]);
    const auto line = ring.chord(ring.sample(x[2], x[3]), along);
    const auto mean_of = [&](double low, double high) {  // times its length: Gauss, two points
      double sum = 0.0;
      for (const double at : {0.5 - 0.28867513459481287, 0.5 + 0.28867513459481287}) {
        const Vec3 on_line = line[0] + (low + at * (high - low)) * (line[1] - line[0]);
        sum += on_cell ? illuminance(pair.response, on_line, eye) : illuminance(pair.response, eye, on_line);
      }
      return 0.5 * sum * (high - low);
    };
    shadows.hidden.clear();
    for (const int plate : plates) plates_.add_hidden(plate, eye, line[0], line[1], looks_from, shadows.hidden);
    shadows.hidden.merge();
    const double free = mean_of(0.0, 1.0);
    double visible = free;
    if (!shadows.hidden.parts().empty()) {
      visible = 0.0;
      double from = 0.0;
      for (const auto& part : shadows.hidden.parts()) {
        if (part.low > from) visible += mean_of(from, part.low);
        from = part.high;
      }
      if (from < 1.0) visible += mean_of(from, 1.0);
    }
    sums.add(share * free, share * visible);
  }
  return sums.estimate(free_lx);
}

}  // namespace dim
