#include "dimray/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace dim {
namespace {

constexpr double kGoodBalance = 2e-3;

// The bound is a bound: usually some ten times what is left. Beyond that the result is not what was asked for.
constexpr double kGoodBound = 0.01, kBoundOfTolerance = 10.0;
double largest_bound(double tolerance) { return std::min(1.0, std::max(kGoodBound, kBoundOfTolerance * tolerance)); }

struct Totals {
  double flux_lm = 0.0, error_bound = 0.0, residual = 0.0, imbalance = 0.0;
  int iterations = 0;
  EnergyBalance energy;
};

Totals totals_of(const std::vector<Source>& sources) {
  Totals sum;
  for (const auto& source : sources) {
    sum.flux_lm += source.flux_lm;
    sum.error_bound = std::max(sum.error_bound, source.error_bound);
    sum.residual = std::max(sum.residual, source.residual);
    sum.iterations = std::max(sum.iterations, source.iterations);
    for (const auto& e : source.energy) {
      sum.energy.emitted_W += e.emitted_W;
      sum.energy.absorbed_W += e.absorbed_W;
      sum.energy.escaped_W += e.escaped_W;
      sum.energy.lost_W += e.lost_W;
      sum.energy.dropped_W += e.dropped_W;
    }
  }
  const auto& e = sum.energy;
  if (e.emitted_W > 0.0)
    sum.imbalance = 1.0 - (e.absorbed_W + e.escaped_W + e.lost_W + e.dropped_W) / e.emitted_W;
  return sum;
}

nlohmann::json energy_json(const EnergyBalance& e) {
  return {{"emitted_W", e.emitted_W}, {"absorbed_W", e.absorbed_W}, {"escaped_W", e.escaped_W},
          {"lost_W", e.lost_W},       {"dropped_W", e.dropped_W},   {"imbalance", e.imbalance}};
}

nlohmann::json source_json(const Source& source) {
  nlohmann::json energy = nlohmann::json::array();
  double worst = 0.0;
  for (const auto& e : source.energy) {
    energy.push_back(energy_json(e));
    worst = std::max(worst, std::abs(e.imbalance));
  }
  return {{"name", source.name},
          {"flux_lm", source.flux_lm},
          {"imbalance", worst},
          {"error_bound", source.error_bound},
          {"iterations", source.iterations},
          {"energy", std::move(energy)}};
}

void fill_stats(nlohmann::json& stats, const Solution& solution, const Totals& sum, const WorstBalance& worst) {
  stats["sources"] = nlohmann::json::array();
  for (const auto& source : solution.sources) stats["sources"].push_back(source_json(source));
  stats["luminaire_bodies"] = solution.plan.n_bodies;
  stats["luminaire_images"] = solution.mirrors.n_images;
  stats["mirror_depth"] = solution.mirrors.deepest();
  stats["mirror_rays"] = solution.mirrors.n_rays;
  stats["mirror_rays_share"] = solution.mirrors.rays_share;
  stats["images_uncertain"] = solution.mirrors.uncertain;
  stats["mirror_rays_cut_off"] = solution.mirrors.rays_cut_off;
  stats["cells"] = solution.n_cells;
  stats["points"] = solution.n_points;
  stats["bands"] = solution.bands.size();
  stats["band_edges_nm"] = solution.bands.edges_nm;
  stats["reflectance_classes"] = solution.classes.size();
  stats["iterations"] = sum.iterations;
  stats["residual"] = sum.residual;
  stats["error_bound"] = sum.error_bound;
  stats["energy"] = energy_json(sum.energy);
  stats["energy"]["imbalance"] = sum.imbalance;
  stats["energy"]["worst_source_imbalance"] = std::abs(worst.imbalance);
  stats["counters"] = solution.counters;
}

}  // namespace

Exit report(Program& program, const Solution& solution, const EndOfBounces& end) {
  const Totals sum = totals_of(solution.sources);
  const WorstBalance worst = worst_balance(solution.sources);
  fill_stats(program.stats(), solution, sum, worst);
  const auto percent = [&](double watts) {
    return sum.energy.emitted_W > 0.0 ? 100.0 * watts / sum.energy.emitted_W : 0.0;
  };
  program.say(fmt::format(
      "{} source{}, {:.6g} lm; absorbed {:.3f} %, escaped {:.3f} %, lost {:.3f} %, dropped {:.4f} %, "
      "imbalance {:+.4f} % (worst source {:.4f} %)",
      solution.sources.size(), solution.sources.size() == 1 ? "" : "s", sum.flux_lm,
      percent(sum.energy.absorbed_W), percent(sum.energy.escaped_W), percent(sum.energy.lost_W),
      percent(sum.energy.dropped_W), 100.0 * sum.imbalance, 100.0 * std::abs(worst.imbalance)));
  program.say(
      end.tracked
          ? fmt::format("inter-reflection tracked, {:.2g} % of the light dropped", 100.0 * sum.residual)
      : std::isfinite(sum.error_bound)
          ? fmt::format("inter-reflection cut after {} iterations, error at most {:.2g} % of a source's mean",
                        sum.iterations, 100.0 * sum.error_bound)
          : fmt::format("inter-reflection cut after {} iterations", sum.iterations));
  if (!std::isfinite(sum.error_bound)) {
    program.say("there is no bound of its error: surfaces reflect all but what the network's own imbalance is; "
                "use lower reflectances, or more --patches with dimdis");
    return Exit::check_failed;
  }
  const double uncertain = solution.mirrors.uncertain;
  if (!(uncertain <= end.tolerance))
    program.say(
        fmt::format("images in mirrors deeper than those made leave light at points uncertain by {:.2g} %",
                    100.0 * uncertain));
  if ((!end.tracked && !(sum.residual <= end.tolerance)) || !(uncertain <= end.tolerance)) {
    program.say("the accuracy asked for was not reached");
    return Exit::check_failed;
  }
  if (!end.tracked && sum.error_bound > largest_bound(end.tolerance)) {
    program.say(
        fmt::format("that is more than {:g} %: surfaces reflect nearly all light; use a smaller --tolerance, or lower "
                    "reflectances",
                    100.0 * largest_bound(end.tolerance)));
    return Exit::check_failed;
  }
  if (!(std::abs(worst.imbalance) <= kGoodBalance)) {
    program.say(fmt::format(
        "the energy balance of source '{}' is open by {:+.2f} % at {:g}-{:g} nm, more than {:g} %; use a "
        "smaller --cell or more --patches with dimdis",
        solution.sources[worst.source].name, 100.0 * worst.imbalance, solution.bands.low_nm(worst.band),
        solution.bands.high_nm(worst.band), 100.0 * kGoodBalance));
    return Exit::check_failed;
  }
  return Exit::done;
}

}  // namespace dim
