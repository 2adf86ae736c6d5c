#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/job.hpp"
#include "hemisphere/patches.hpp"
#include "network/network.hpp"
#include "scene/lights.hpp"
#include "spectrum/bands.hpp"
#include "transport/plan.hpp"
#include "transport/track.hpp"

namespace dim {

enum class Combine { each, group, all };

enum class Solver { gather, track };

struct SimulationOptions {
  Bands bands;
  Combine combine = Combine::each;
  GatherOptions gather;
  Solver solver = Solver::gather;
  TrackOptions track;
  /// Savings not to be made (see `ModelPlan`): test visibility even where nothing can be in the way; solve
  /// each band even where bands reflect alike.
  bool always_test_visibility = false;
  bool solve_every_band = false;
  /// Mirrors one after the other that luminaires are imaged in; as many as the tolerance of the iteration
  /// asks for where it is not given.
  std::optional<int> mirror_depth;
};

/// Where one source's flux in one band went, W. `imbalance` is what is left of emitted after absorbed,
/// escaped, lost and dropped, over emitted: what the sampling of direct light misses and what the network's
/// columns are off by.
struct EnergyBalance {
  double emitted_W = 0.0;
  double absorbed_W = 0.0;
  double escaped_W = 0.0;  ///< out of an open zone, or reflected onto backs of surfaces
  double lost_W = 0.0;     ///< direct, on backs of surfaces and on luminaire bodies
  double dropped_W = 0.0;  ///< still being reflected when the solution was good enough; either sign
  double imbalance = 0.0;
};

/// What is solved as one: a luminaire, a group of them or all, with one spectrum.
struct Source {
  std::string name;
  std::string group;
  std::vector<std::string> luminaires;
  double flux_lm = 0.0;
  BandWeights weights;
  std::vector<EnergyBalance> energy;  ///< [n_bands]
  int iterations = 0;
  double residual = 0.0;
  /// Truncation of inter-reflection, relative to the mean irradiance, and of images of luminaires at points.
  double error_bound = 0.0;
};

/// Light by direction from off-specular cells, W/(m2 sr) per band: the mean radiance by their lobes into each
/// patch.
struct Directional {
  PatchGrid grid;
  std::vector<std::uint32_t> cells;  ///< [n_off_specular], ascending
  std::vector<float> direct,
      total;  ///< [n_sources, n_bands, n_off_specular, n_patches], of direct light and of all
};

/// Irradiance, W/m2 per band: [n_sources, n_bands, n_cells] or [n_sources, n_bands, n_points], last fastest.
struct Solution {
  Bands bands;
  std::vector<Source> sources;
  std::size_t n_cells = 0;
  std::size_t n_points = 0;
  std::vector<float> cell_direct, cell_total;
  std::vector<float> point_direct, point_total;
  std::size_t n_reflectance_classes = 0;
  Directional directional;
  ModelPlan plan;
  std::vector<int> mirror_depth;  ///< [n_luminaires] that cells have images of each in; empty: none

  std::size_t cell_row(std::size_t source, std::size_t band) const {
    return (source * bands.size() + band) * n_cells;
  }
  std::size_t point_row(std::size_t source, std::size_t band) const {
    return (source * bands.size() + band) * n_points;
  }
};

/// Sends the light of all luminaires through the network.
///
/// Direct light is computed once for all bands; bands in which every finish reflects alike share one
/// solution.
/// @throws InputError  finishes this version does not model (glazing), diffuse reflectance >= 1
/// @throws LimitError  when the solution does not fit job.memory_limit_bytes
Solution simulate(const Zone& zone, const Cells& cells, const Network& network, const Lights& lights,
                  const SimulationOptions& options, const Job& job, Warnings& warnings);

}  // namespace dim
