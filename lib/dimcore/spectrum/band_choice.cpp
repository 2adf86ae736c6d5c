#include "spectrum/band_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "spectrum/bounce_lights.hpp"

namespace dim {
namespace {

// What bands of 5 nm do not reach is not asked of fewer.
double delta_e_asked(const BandAccuracy& accuracy, const BounceLights::Truth& truth) {
  return std::max(accuracy.delta_e_2000, truth.finest_delta_e);
}
double luminance_asked(const BandAccuracy& accuracy, const BounceLights::Truth& truth) {
  return accuracy.luminance + truth.finest_luminance;
}

// Cost of every band as a weighted sum of squared errors of the cases that matter.
class BandCosts {
 public:
  void add(BounceLights& lights, std::size_t c, const BandAccuracy& accuracy) {
    lights.prepare(c);
    for (std::size_t from = 0; from < kTableSize; ++from) {
      for (std::size_t to = from + 1; to <= kTableSize; ++to) {
        at(from, to) += lights.band_cost(c, from, to, accuracy.delta_e_2000, accuracy.luminance);
      }
    }
  }

  // The cheapest partition in n bands.
  CellEdges partition(std::size_t n) const {
    constexpr double kNever = std::numeric_limits<double>::max();
    std::vector<std::vector<double>> best(n + 1, std::vector<double>(kTableSize + 1, kNever));
    std::vector<std::vector<std::size_t>> before(n + 1, std::vector<std::size_t>(kTableSize + 1, 0));
    best[0][0] = 0.0;
    for (std::size_t bands = 1; bands <= n; ++bands) {
      for (std::size_t to = bands; to <= kTableSize; ++to) {
        for (std::size_t from = bands - 1; from < to; ++from) {
          if (best[bands - 1][from] == kNever) continue;
          const double cost = best[bands - 1][from] + at(from, to);
          if (cost < best[bands][to]) best[bands][to] = cost, before[bands][to] = from;
        }
      }
    }
    CellEdges edges{kTableSize};
    for (std::size_t bands = n; bands > 0; --bands) edges.push_back(before[bands][edges.back()]);
    std::reverse(edges.begin(), edges.end());
    return edges;
  }

 private:
  double at(std::size_t from, std::size_t to) const { return cost_[to * (kTableSize + 1) + from]; }
  double& at(std::size_t from, std::size_t to) { return cost_[to * (kTableSize + 1) + from]; }

  std::vector<double> cost_ = std::vector<double>((kTableSize + 1) * (kTableSize + 1), 0.0);
};

struct Judged {
  CellEdges edges;
  std::vector<std::pair<double, std::size_t>> worst;  // how far off, in units of the accuracy asked for; case

  bool good() const { return worst.empty() || worst.front().first <= 1.0; }
};

class Search {
 public:
  Search(BounceLights& lights, const BandAccuracy& accuracy) : lights_(lights), accuracy_(accuracy) {}

  // A partition in n bands that is good, or the last of several tries; cases that are off weigh more from
  // then.
  Judged try_with(std::size_t n) {
    constexpr int kRounds = 5;
    constexpr double kHopeless = 3.0;
    Judged judged;
    for (int round = 0; round < kRounds; ++round) {
      judged = judge(costs_.partition(n));
      if (judged.good() || (round > 0 && judged.worst.front().first > kHopeless)) break;
      for (const auto& [off, c] : judged.worst)
        if (off > 1.0) costs_.add(lights_, c, accuracy_);
    }
    return judged;
  }

 private:
  // The few cases that are furthest off, the worst first.
  Judged judge(CellEdges edges) const {
    constexpr std::size_t kFew = 6;
    constexpr double kMostOverLab = 2.0;  // CIEDE2000 is less than this times the distance in CIELAB
    std::vector<std::pair<double, std::size_t>> worst;
    lights_.for_each(
        lights_.banded(edges), [&](std::size_t c, const BounceLights::Truth& truth, const Lab& lab, double luminance) {
          const double delta_e = delta_e_asked(accuracy_, truth);
          const double distance =
              glm::length(Vec3(lab.l - truth.lab.l, lab.a - truth.lab.a, lab.b - truth.lab.b));
          double off = luminance / luminance_asked(accuracy_, truth);
          const double least = worst.size() < kFew ? 0.0 : worst.back().first;
          if (std::max(off, kMostOverLab * distance / delta_e) <= least) return;
          off = std::max(off, delta_e_2000(truth.lab, lab) / delta_e);
          if (off <= least) return;
          const auto place =
              std::find_if(worst.begin(), worst.end(), [&](const auto& w) { return w.first < off; });
          worst.insert(place, {off, c});
          if (worst.size() > kFew) worst.pop_back();
        });
    return {std::move(edges), std::move(worst)};
  }

  BounceLights& lights_;
  BandAccuracy accuracy_;
  BandCosts costs_;
};

BandChoice judged(const BounceLights& lights, const BounceLights::Banded& banded, Bands bands,
                  const BandAccuracy& accuracy) {
  BandChoice choice;
  choice.bands = std::move(bands);
  lights.for_each(banded,
                  [&](std::size_t, const BounceLights::Truth& truth, const Lab& lab, double luminance) {
                    const double delta_e = delta_e_2000(truth.lab, lab);
                    choice.delta_e_2000 = std::max(choice.delta_e_2000, delta_e);
                    choice.luminance = std::max(choice.luminance, luminance);
                    choice.off = std::max({choice.off, delta_e / delta_e_asked(accuracy, truth),
                                           luminance / luminance_asked(accuracy, truth)});
                  });
  return choice;
}

Bands bands_of(const CellEdges& edges) {
  Bands bands;
  bands.edges_nm.clear();
  for (const std::size_t edge : edges) bands.edges_nm.push_back(cell_edge_nm(edge));
  return bands;
}

}  // namespace

BandChoice choose_bands(const std::vector<SpectralCurve>& spectra,
                        const std::vector<SpectralCurve>& reflectances, const BandAccuracy& accuracy) {
  BounceLights lights(spectra, reflectances);
  Search search(lights, accuracy);
  std::size_t too_few = 0, enough = 1;
  Judged found = search.try_with(enough);
  while (!found.good() && enough < kTableSize) {
    too_few = enough;
    enough = std::min(kTableSize, enough < 4 ? enough + 1 : enough + enough / 2);
    found = search.try_with(enough);
  }
  while (enough - too_few > 1) {
    const std::size_t n = (too_few + enough) / 2;
    Judged fewer = search.try_with(n);
    if (fewer.good())
      enough = n, found = std::move(fewer);
    else
      too_few = n;
  }
  return judged(lights, lights.banded(found.edges), bands_of(found.edges), accuracy);
}

std::string in_words(const BandChoice& choice) {
  return fmt::format("{} waveband{}: colours within dE00 {:.2f}, luminances within {:.2f} %", choice.bands.size(),
                     choice.bands.size() == 1 ? "" : "s", choice.delta_e_2000, 100.0 * choice.luminance);
}

BandChoice judge_bands(const std::vector<SpectralCurve>& spectra,
                       const std::vector<SpectralCurve>& reflectances, const Bands& bands,
                       const LatticeValues* luminous_weights, const BandAccuracy& accuracy) {
  const BounceLights lights(spectra, reflectances);
  return judged(lights, luminous_weights ? lights.banded(*luminous_weights) : lights.banded(bands), bands,
                accuracy);
}

}  // namespace dim
