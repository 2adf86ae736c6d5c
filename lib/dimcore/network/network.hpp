#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/job.hpp"
#include "hemisphere/patches.hpp"
#include "network/cells.hpp"
#include "network/sink_table.hpp"
#include "scene/zone.hpp"

namespace dim {

enum class Sampling {
  stratified,  ///< a low-discrepancy point inside the cell and inside the patch for every ray
  centre       ///< the paper's: cell centre through patch centroid
};

struct NetworkOptions {
  PatchGrid patches{16, 32};
  PatchGrid point_patches{32, 64};
  Sampling sampling = Sampling::stratified;
  bool family = false;
  std::uint64_t seed = 1;
};

/// A correction to the plain rows: `weight` (share of the hemisphere, may be negative) of `cell`'s radiosity
/// is added to the row's irradiance. Family members come as such links, with the sink's share taken back.
struct ExtraLinks {
  std::vector<std::uint64_t> first;  ///< [n_cells + 1], or empty when there are none
  std::vector<std::uint32_t> cell;
  std::vector<double> weight;
};

/// The zone as rays: geometry only, whatever the light sources and finishes.
///
/// Irradiance of cell i from radiosities M: E_i = row_scale_i * sum_j F_ij column_scale_j M_j with
/// F_ij = sum over patches whose ray ends on j of w_k/pi, plus the extra links. The two scales make what is
/// sent equal to what arrives (see `balance`). Measuring points have rows of their own, without scales.
struct Network {
  PatchGrid patches;
  PatchGrid point_patches;
  Sampling sampling = Sampling::stratified;
  std::uint64_t seed = 1;
  SinkTable sinks;        ///< [cell, patch]
  SinkTable point_sinks;  ///< [point, point patch]
  ExtraLinks extra;
  std::vector<double> visible;              ///< [n_cells] share of the hemisphere whose rays end on cells
  std::vector<double> row_scale;            ///< [n_cells]
  std::vector<double> column_scale;         ///< [n_cells]
  double accuracy = 0.0;                    ///< share that `dimdis --accuracy` asked for; 0: none
  double imbalance = 0.0;                   ///< of scaled columns against their dues, see `balance`
  std::uint64_t n_escaped_rays = 0;         ///< of cells: ended nowhere, into the open
  std::uint64_t n_back_rays = 0;            ///< of cells: met the back of a surface
  std::vector<double> back_share;  ///< [n_surfaces] see BackLight; not kept in files
  std::vector<double> point_back_fraction;  ///< [n_points] share of a point's rays that met backs of surfaces

  bool has_family() const { return !extra.first.empty(); }
  bool is_open() const { return n_escaped_rays > 0 || n_back_rays > 0; }
};

/// Hemisphere of measuring points that suits their number: 64x128 for up to 64 points down to 16x32 for more
/// than some 500, so that points cost about as much as a small room's cells.
PatchGrid automatic_point_patches(std::size_t n_points);

/// Memory that making and writing the network takes, bytes.
double network_bytes(std::size_t n_cells, std::size_t n_points, const NetworkOptions& options);

/// Refuses a network that will not fit, before its cells are made: these are at least as many as their squares by
/// area.
/// @throws LimitError  with the memory it needs
void check_network_fits(const Zone& zone, const NetworkOptions& options, const Job& job);

/// Traces the ray network of a zone. The result depends on zone and options only, not on the number of
/// threads.
/// @throws LimitError  before any work, when the network does not fit job.memory_limit_bytes
/// @throws Interrupted
Network build_network(const Zone& zone, const Cells& cells, const NetworkOptions& options, const Job& job);

}  // namespace dim
