#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hemisphere/patches.hpp"
#include "transport/mirror_outcome.hpp"
#include "transport/plan.hpp"
#include "transport/source.hpp"

namespace dim {

/// Light by direction from off-specular cells: the mean by their lobes into each patch, cd/m2 as `Solution`
/// has lx.
struct Directional {
  PatchGrid grid;
  std::vector<std::uint32_t> cells;  ///< [n_off_specular], ascending
  /// [n_sources, n_classes, n_off_specular, n_patches], of direct light and of all
  std::vector<float> direct, total;
};

/// Transfer from sources to cells and measuring points, apart from spectra. Bands in which every finish
/// reflects alike form a class; a value is the illuminance, lx, that a receiver would have if all of the
/// source's flux were light of that class. Irradiance in band b is transfer[class of b] *
/// Source::watts_per_lumen(b), illuminance the sum over classes weighted by the Y of
/// Source::xyz_by_class.
///
/// [n_sources, n_classes, n_cells] or [..., n_points], last fastest; direct light has n_direct_classes.
struct Solution {
  Bands bands;
  ReflectanceClasses classes;
  std::vector<Source> sources;
  std::size_t n_cells = 0;
  std::size_t n_points = 0;
  std::size_t n_direct_classes = 1;  ///< 1 where no mirror colours direct light, else that of all classes
  std::vector<float> cell_direct, cell_total;
  std::vector<float> point_direct, point_total;
  /// What is known of the errors of point_total, as `Gathered` has them; all empty where one part is not
  /// known (tracked; lobes).
  std::vector<float> point_cells, point_rays, point_cell_rays;
  std::vector<float> point_direct_deviation;  ///< standard deviation of point_direct
  /// The same of the means of surfaces, [..., n_surfaces] of the zone.
  std::vector<float> surface_cells, surface_rays;
  std::vector<float> surface_direct_deviation;
  Directional directional;
  std::optional<SkyRecord> sky;
  ModelPlan plan;
  MirrorOutcome mirrors;
  std::map<std::string, double> counters;  ///< what was done: rays by kind, culled pairs, iterations …

  std::size_t cell_row(std::size_t source, std::size_t klass) const {
    return (source * classes.size() + klass) * n_cells;
  }
  std::size_t point_row(std::size_t source, std::size_t klass) const {
    return (source * classes.size() + klass) * n_points;
  }
};

}  // namespace dim
