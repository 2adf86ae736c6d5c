#pragma once

#include <optional>
#include <string>
#include <vector>

#include "network/cells.hpp"
#include "result/database.hpp"

namespace dim {

/// Factor on each source's light. [n_sources], 1 where not asked for.
using Mix = std::vector<double>;

/// The sources of that name or group.
/// @param option  that the name was given to, for the message
/// @throws InputError  unknown name
std::vector<std::size_t> sources_named(const std::string& name, const std::vector<Source>& sources,
                                       const std::string& option);

/// Mix from `NAME=FACTOR` texts; NAME is a source, a group (all its sources) or a luminaire that is a source
/// of its own. A later text overrides an earlier one.
/// @throws InputError  unknown name, factor not a number >= 0
Mix parse_mix(const std::vector<std::string>& texts, const std::vector<Source>& sources);

/// Puts groups of windows into states by `GROUP=STATE` texts: daylight of other states is dropped from the mix. Groups
/// not named stand as the zone file has them.
/// @throws InputError  unknown group or state
void put_into_states(const std::vector<std::string>& texts, const std::vector<Source>& sources, Mix& mix);

/// The mix of maintained light, each source times its maintenance factor; those without one, and daylight, as they are.
/// Nothing where no source of the mix has one.
std::optional<Mix> maintained(const std::vector<Source>& sources, const Mix& mix);

/// Illuminance of every measuring point, lx, sources mixed. [n_points]
std::vector<double> point_illuminance_lx(const LuminanceDatabase& database, const Mix& mix);
/// The same before any reflection but that of mirrors. [n_points]
std::vector<double> direct_point_illuminance_lx(const LuminanceDatabase& database, const Mix& mix);
/// Illuminance of every cell, lx, sources mixed. [n_cells]
std::vector<double> cell_illuminance_lx(const LuminanceDatabase& database, const Mix& mix);

/// Mix that keeps one source and drops the rest.
Mix only(const Mix& mix, std::size_t source);

/// What cells show an eye: illuminance and reflected CIE 1931 XYZ, Y in cd/m2.
struct CellAppearance {
  std::vector<double> illuminance_lx;  ///< [n_cells]
  std::vector<Vec3> xyz_cd_m2;         ///< [n_cells]
};
CellAppearance cell_appearance(const LuminanceDatabase& database, const Cells& cells, const Mix& mix);

/// XYZ of a source's own light for 1 cd/m2.
Vec3 source_xyz(const Source& source);

/// Figures of one surface, weighted by area.
struct SurfaceFigures {
  double area_m2 = 0.0;
  double illuminance_mean_lx = 0.0, illuminance_min_lx = 0.0, illuminance_max_lx = 0.0;
  Vec3 xyz_mean_cd_m2{0.0};
};
std::vector<SurfaceFigures> surface_figures(const Cells& cells, const CellAppearance& appearance);

/// Figures of a set of measuring points, those that are not valid left out: U0 = min/mean, Ud = min/max, 0
/// where nothing is lit; all of them NaN where no point is left.
struct GridStatistics {
  std::size_t n_points = 0;    ///< of the set
  std::size_t n_left_out = 0;  ///< of them
  double min_lx = 0.0, mean_lx = 0.0, max_lx = 0.0, u0 = 0.0, ud = 0.0;
};
GridStatistics grid_statistics(const std::vector<double>& illuminance_lx,
                               const std::vector<MeasuringPoint>& points, const PointSet& set);

}  // namespace dim
