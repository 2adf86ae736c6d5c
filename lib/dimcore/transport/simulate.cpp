#include "transport/simulate.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "transport/assembly.hpp"
#include "transport/auto_bands.hpp"
#include "network/with_bodies.hpp"
#include "transport/daylight_columns.hpp"
#include "transport/direct_columns.hpp"
#include "transport/shine_memory.hpp"

namespace dim {
namespace {

constexpr std::size_t kBlockBytes = 32 * 4 * sizeof(double);  // a block of columns being solved
constexpr int kProbeRays = 1024;                              // to notice a luminaire in the wrong place
constexpr int kBalanceRays = 32768;  // to say what share of its light leaves the zone

void check_finishes(const Zone& zone, const Bands& bands, const ReflectanceClasses& classes) {
  Problems problems;
  for (std::size_t f = 0; f < zone.finishes.size(); ++f) {
    const auto& finish = zone.finishes[f];
    for (std::size_t b = 0; b < bands.size(); ++b) {
      const double rho = classes.at(classes.of_band[b], static_cast<int>(f)).diffuse;
      if (!(rho < 1.0))
        problems.add(
            {},
            fmt::format("finish '{}': reflectance {} at {:.0f}-{:.0f} nm; inter-reflection needs less "
                        "than 1",
                        finish.name, rho, bands.low_nm(b), bands.high_nm(b)),
            "a real surface absorbs something: write for example 0.99");
    }
  }
  problems.throw_if_any();
}

// Luminaires grouped into sources: same name after combining and same spectrum.
struct Sources {
  std::vector<Source> sources;
  std::vector<std::size_t> of_luminaire;
};

std::string combined_name(const Luminaire& luminaire, Combine combine) {
  if (combine == Combine::each) return luminaire.name;
  return combine == Combine::group ? luminaire.group : "all";
}

Sources make_sources(const Lights& lights, const Bands& bands, Combine combine) {
  Sources result;
  for (const auto& luminaire : lights.luminaires) {
    const auto& fitting = lights.fittings[static_cast<std::size_t>(luminaire.fitting)];
    const BandWeights weights = band_weights(fitting.spectrum, bands);
    const std::string name = combined_name(luminaire, combine);
    auto found = std::find_if(result.sources.begin(), result.sources.end(), [&](const Source& source) {
      return combine != Combine::each && source.name == name && source.weights == weights;
    });
    if (found == result.sources.end()) {
      Source source;
      source.name = name;
      source.group = combine == Combine::all ? name : luminaire.group;
      source.weights = weights;
      found = result.sources.insert(result.sources.end(), std::move(source));
    }
    found->luminaires.push_back(luminaire.name);
    found->flux_lm += luminaire.factor * fitting.intensity.flux_lm();
    result.of_luminaire.push_back(static_cast<std::size_t>(found - result.sources.begin()));
  }
  return result;
}


void check_size(std::size_t n_cells, std::size_t n_points, std::size_t n_sources, std::size_t n_classes,
                std::size_t n_bands, const Job& job) {
  constexpr double kGiB = 1024.0 * 1024.0 * 1024.0;
  const std::size_t needed =
      (n_cells + n_points) *
      (n_sources * n_classes * (3 * sizeof(double) + 2 * sizeof(float)) + kBlockBytes);
  if (needed > job.memory_limit_bytes)
    throw LimitError(
        fmt::format("{} cells and points x {} sources x {} bands need {:.2f} GiB, {:.2f} GiB are free; use "
                    "--combine group, fewer --bands or a larger --cell",
                    n_cells + n_points, n_sources, n_bands, static_cast<double>(needed) / kGiB,
                    static_cast<double>(job.memory_limit_bytes) / kGiB));
}

void check_shine_size(const ShineMemory& memory, const Job& job) {
  constexpr double kGiB = 1024.0 * 1024.0 * 1024.0;
  if (memory.total() > job.memory_limit_bytes)
    throw LimitError(fmt::format(
        "light by direction of {} off-specular cells x {} patches, and rays by mirrors, need {:.2f} GiB, {:.2f} "
        "GiB are free; use --combine group, fewer --bands, a larger --cell or fewer --patches",
        memory.n_off_specular, memory.n_patches, static_cast<double>(memory.total()) / kGiB,
        static_cast<double>(job.memory_limit_bytes) / kGiB));
}

// The first flights of each source, luminaires weighted by flux; the long count only where light can leave.
std::vector<FirstFlight> source_flights(const Zone& zone, const Network& network, const Lights& lights,
                                        const Sources& sources, const Job& job, Warnings& warnings) {
  const auto probes = first_flights(zone, lights, kProbeRays, job);
  // A few rays in a million that slip past an edge do not make a zone open.
  constexpr double kLeak = 1e-4;
  const double n_rays = static_cast<double>(network.sinks.n_rays());
  bool leaves = static_cast<double>(network.n_escaped_rays + network.n_back_rays) > kLeak * n_rays;
  for (std::size_t l = 0; l < probes.size(); ++l) {
    const auto& luminaire = lights.luminaires[l];
    const double off = probes[l].escaped + probes[l].lost;
    leaves = leaves || off > kLeak * 10.0;
    if (off > 0.5)
      warnings.push_back(
          {luminaire.place,
           fmt::format("luminaire '{}': {:.0f} % of its light never reaches the lit side of a surface; it "
                       "seems to be outside the zone or inside an obstruction",
                       luminaire.name, 100.0 * off),
           "check 'at' and 'aim'"});
  }
  std::vector<FirstFlight> flights(sources.sources.size());
  if (!leaves) return flights;
  const auto counted = first_flights(zone, lights, kBalanceRays, job);
  for (std::size_t l = 0; l < counted.size(); ++l) {
    const std::size_t s = sources.of_luminaire[l];
    const double weight =
        sources.sources[s].flux_lm > 0.0 ? counted[l].flux_lm / sources.sources[s].flux_lm : 0.0;
    flights[s].escaped += weight * counted[l].escaped;
    flights[s].lost += weight * counted[l].lost;
  }
  return flights;
}

// @param n_kept  cells of the solution: the first ones
Solution simulate_room(const Zone& zone, const Cells& cells, const Network& network, const Lights& lights,
                       std::size_t n_kept, const SimulationOptions& options, const Job& job,
                       Warnings& warnings) {
  const LampSpectra lamps = lamp_spectra(lights);
  const LatticeValues seen = luminous_weights(lamps.spectra, lamps.flux_lm);
  const ReflectanceClasses classes = classify(zone, options.bands, options.solve_every_band, &seen);
  check_finishes(zone, options.bands, classes);
  Sources sources = make_sources(lights, options.bands, options.combine);
  const Obstructions obstructions(zone, lights);
  std::optional<DaylightSources> daylight;
  std::vector<std::vector<double>> class_flux_lm(sources.sources.size());
  if (lights.sky) {
    daylight.emplace(zone, *lights.sky, classes, obstructions, options.combine, options.bands, sources.sources.size(),
                     job);
    daylight->append_to(sources.sources, class_flux_lm);
  }
  const std::size_t n_sources = sources.sources.size(), n_classes = classes.size();
  const std::size_t n_columns = n_sources * n_classes;
  check_size(cells.size(), zone.points.size(), n_sources, n_classes, options.bands.size(), job);

  const MirrorRayOptions mirror_rays;
  check_shine_size(
      shine_memory(zone, cells, network, classes, obstructions.caster(), mirror_rays, n_columns), job);
  const Shine shine(zone, cells, network, classes, obstructions.caster(), mirror_rays, job);
  auto flights = source_flights(zone, network, lights, sources, job, warnings);
  const bool in_the_way = options.always_test_visibility || !is_convex_and_empty(zone, lights);
  DirectColumns direct = direct_columns(zone, cells, network, lights, classes, shine, obstructions,
                                        sources.of_luminaire, n_sources,
                                        {options.gather.tolerance, options.mirror_depth}, in_the_way, job);
  if (daylight) {
    daylight->add_to(direct, n_sources, n_classes, zone, cells, job);
    daylight->add_flights(flights);
  }
  Reflectances reflectances{n_classes, std::vector<double>(zone.surfaces.size() * n_classes),
                            std::vector<std::size_t>(n_columns)};
  for (std::size_t c = 0; c < n_columns; ++c) reflectances.class_of_column[c] = c / n_sources;
  for (std::size_t surface = 0; surface < zone.surfaces.size(); ++surface) {
    for (std::size_t q = 0; q < n_classes; ++q)
      reflectances.of_surface[surface * n_classes + q] = classes.at(q, zone.surfaces[surface].finish).diffuse;
  }
  auto cell_direct = Columns<float>::from_rows(direct.cell, direct.n_columns);
  const auto point_direct = Columns<float>::from_rows(direct.point, direct.n_columns);
  Solution solution;
  solution.bands = options.bands;
  solution.sources = std::move(sources.sources);
  solution.n_cells = n_kept;
  solution.n_points = zone.points.size();
  solution.classes = classes;
  solution.n_direct_classes = direct.n_columns / n_sources;
  solution.plan = make_plan(zone, cells, network, lights, classes, shine, n_sources, direct, in_the_way);
  solution.cell_direct = rows_of_columns(cell_direct, n_kept, n_sources);
  solution.point_direct = rows_of_columns(point_direct, zone.points.size(), n_sources);
  solution.directional.direct = rows_of_states(direct.shine.psi, shine.grid(), n_sources, n_columns);
  solution.mirror_depth = direct.mirror_depth;
  if (direct.add_followed()) cell_direct = Columns<float>::from_rows(direct.cell, direct.n_columns);
  const GatherShine gather_shine{shine, zone, direct.shine};
  const auto* shiny = shine.any() ? &gather_shine : nullptr;
  auto gathered = options.solver == Solver::gather
                      ? gather(network, cells, cell_direct, point_direct, reflectances, options.gather, job, shiny)
                      : track(zone, network, cells, cell_direct, point_direct, reflectances, options.track, job,
                              shiny);
  for (std::size_t c = 0; c < n_columns && shine.any(); ++c) {
    gathered.columns[c].absorbed -= direct.shine.mirrored[c] + direct.shine.not_followed[c];
    gathered.columns[c].dropped += direct.shine.not_followed[c];
    gathered.columns[c].escaped += direct.shine.escaped[c];
    gathered.columns[c].error_bound += direct.uncertain[c];
  }

  solution.cell_total = rows_of_columns(gathered.cell, n_kept, n_sources);
  solution.point_total = rows_of_columns(gathered.point, zone.points.size(), n_sources);
  solution.counters["reflections"] = static_cast<double>(gathered.counts.reflections);
  solution.counters["link_columns"] = static_cast<double>(gathered.counts.link_columns);
  solution.directional.grid = shine.grid();
  solution.directional.cells = shine.off_specular();
  solution.directional.total = rows_of_states(gathered.psi, shine.grid(), n_sources, n_columns);
  if (daylight) {
    solution.sky = daylight->record();
    solution.plan.daylight = daylight->in_words();
    if (shine.any())
      warnings.push_back({{},
                          "finishes that shine absorb what they would reflect of direct daylight like a mirror; their "
                          "diffuse part and all light of luminaires are complete",
                          "--finish NAME=ENTRY with a diffuse finish shows how much it matters"});
    daylight->complete(solution.sources, class_flux_lm, gathered.columns);
  }
  add_energy(solution, gathered.columns, flights, class_flux_lm);
  check_storable(solution);
  return solution;
}

}  // namespace

Solution simulate(const Zone& zone, const Cells& cells, const Network& network, const Lights& lights,
                  const SimulationOptions& options, const Job& job, Warnings& warnings) {
  const auto room = add_bodies(zone, cells, network, lights, job);
  if (!room) return simulate_room(zone, cells, network, lights, cells.size(), options, job, warnings);
  Solution solution = simulate_room(room->zone, room->cells, room->network, room->lights, room->n_zone_cells,
                                    options, job, warnings);
  solution.plan.n_bodies = room->n_bodies;
  solution.plan.n_body_cells = room->cells.size() - room->n_zone_cells;
  return solution;
}

}  // namespace dim
