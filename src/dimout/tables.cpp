#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"
#include "climate/sky_mix.hpp"
#include "dimout/commands.hpp"
#include "dimout/sky_option.hpp"

namespace dim {
namespace {

const double kUnknown = std::nan("");

double chromaticity(const Vec3& xyz, int axis) {
  const double sum = xyz.x + xyz.y + xyz.z;
  return sum > 0.0 ? xyz[axis] / sum : std::nan("");
}

double worst_imbalance(const Source& source) {
  double worst = 0.0;
  for (const auto& energy : source.energy) {
    if (std::abs(energy.imbalance) > std::abs(worst)) worst = energy.imbalance;
  }
  return worst;
}

bool is_maintained(const LuminanceDatabase& database) {
  const auto& sources = database.sources();
  return std::any_of(sources.begin(), sources.end(), [](const Source& source) { return source.maintenance.has_value(); });
}

}  // namespace

TableCommands::TableCommands(Program& program) : program_(program) {
  info_ =
      add_command(program, input_, "info", "What is in a luminance database, its energy balance and errors",
                  "dimout info office.lum");
  add_table_options(*info_, input_, false);
  surfaces_ = add_command(program, input_, "surfaces", "Illuminance, luminance and colour of every surface",
                          "dimout surfaces office.lum --by source");
  add_table_options(*surfaces_, input_, true);
  cells_ = add_command(program, input_, "cells", "Illuminance and luminance of every cell",
                       "dimout cells office.lum");
  add_table_options(*cells_, input_, true);
  grid_ = add_command(program, input_, "grid", "Illuminance at the measuring points",
                      "dimout grid office.lum --plane workplane --stats");
  add_table_options(*grid_, input_, true);
  add_plane_option(*grid_, planes_);
  auto* factor = grid_->add_flag("--daylight-factor", daylight_factor_,
                                 "Daylight over the illuminance outside, %, in a column of its own: luminaires and the "
                                 "sun's beam left out; coefficients under a CIE overcast sky unless --sky says another");
  grid_->add_flag("--stats", stats_, "Minimum, mean, maximum and uniformity of each plane")->excludes(factor);
  grid_->add_flag("--direct", direct_, "Light before any reflection but that of mirrors, as for emergency lighting")
      ->excludes(factor);
}

bool TableCommands::run() {
  const auto chosen = program_.app().get_subcommands();
  const std::array<CLI::App*, 4> ours = {info_, surfaces_, cells_, grid_};
  if (std::find(ours.begin(), ours.end(), chosen.front()) == ours.end()) return false;
  program_.check_output(input_.output, {input_.path});
  if (info_->parsed())
    info();
  else if (surfaces_->parsed())
    surfaces();
  else if (cells_->parsed())
    cells();
  else
    grid();
  return true;
}

void TableCommands::info() {
  const LuminanceDatabase database = open_database(program_, input_);
  const Zone& zone = database.zone();
  nlohmann::ordered_json json = {{"zone", zone.name},
                                 {"surfaces", zone.surfaces.size()},
                                 {"cells", database.n_cells()},
                                 {"points", zone.points.size()},
                                 {"bands_nm", database.bands().edges_nm},
                                 {"hash", database.hash()},
                                 {"rays_hash", database.rays_hash()},
                                 {"sources", nlohmann::ordered_json::array()}};
  std::string text = fmt::format("zone {}: {} surfaces, {} cells, {} measuring points, {} waveband{}\n",
                                 zone.name, zone.surfaces.size(), database.n_cells(), zone.points.size(),
                                 database.bands().size(), database.bands().size() == 1 ? "" : "s");
  text += fmt::format("{:<24} {:<16} {:>12} {:>12} {:>12}\n", "source", "group", "flux, lm", "imbalance, %",
                      "error <=, %");
  for (const auto& source : database.sources()) {
    const double imbalance = worst_imbalance(source);
    text += fmt::format("{:<24} {:<16} {:>12.6g} {:>+12.4f} {:>12.2g}\n", source.name, source.group,
                        source.flux_lm, 100.0 * imbalance, 100.0 * source.error_bound);
    json["sources"].push_back({{"name", source.name},
                               {"group", source.group},
                               {"luminaires", source.luminaires},
                               {"flux_lm", source.flux_lm},
                               {"maintenance_factor", source.maintenance ? nlohmann::ordered_json(*source.maintenance)
                                                                         : nlohmann::ordered_json(nullptr)},
                               {"imbalance", imbalance},
                               {"error_bound", source.error_bound},
                               {"iterations", source.iterations}});
  }
  json["planes"] = nlohmann::ordered_json::array();
  text += planes_info(database, json["planes"]);
  program_.stage(kWritingStage);
  write_file(input_.output, input_.json ? json.dump(1) + "\n" : text);
}

// What each plane's stated error consists of.
std::string TableCommands::planes_info(const LuminanceDatabase& database, nlohmann::ordered_json& planes) const {
  const Mix mix(database.sources().size(), 1.0);
  const auto errors = point_errors(database, mix);
  const auto lx = point_illuminance_lx(database, mix);
  const auto& zone = database.zone();
  if (!errors || zone.point_sets.empty()) return {};
  std::string text = fmt::format("{:<24} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10}   stated at 95 % of the points, %\n",
                                 "plane", "error", "bound", "cells ~", "rays ~", "their r. ~", "direct ~");
  for (const auto& set : zone.point_sets) {
    const StatedShare share = stated_share(*errors, lx, zone.points, set);
    text += fmt::format("{:<24} {:>10.3g} {:>10.2g} {:>10.2g} {:>10.2g} {:>10.2g} {:>10.2g}\n", set.name,
                        100.0 * share.total, 100.0 * share.bound, 100.0 * share.cells, 100.0 * share.rays,
                        100.0 * share.cell_rays, 100.0 * share.direct);
    planes.push_back({{"plane", set.name},
                      {"error", share.total},
                      {"bound", share.bound},
                      {"estimate_cells", share.cells},
                      {"estimate_rays", share.rays},
                      {"estimate_cell_rays", share.cell_rays},
                      {"estimate_direct", share.direct}});
  }
  return text + "bound: light between surfaces left out; ~: standard deviations estimated from the run itself, two of them "
                "in the error\n";
}

void TableCommands::surfaces() {
  const LuminanceDatabase database = open_database(program_, input_);
  const Cells& cells = database.cells();
  const bool shows_maintained = is_maintained(database);
  std::vector<std::string> columns{"surface",            "area_m2",              "illuminance_mean_lx",
                                   "illuminance_min_lx", "illuminance_max_lx",   "luminance_mean_cd_m2",
                                   "cie_x",              "cie_y",                "error_lx"};
  if (shows_maintained) columns.emplace_back("maintained_mean_lx");
  Table table(columns_with_source(input_, columns));
  for_sources(database, input_, [&](const std::string& source, const Mix& mix) {
    const auto figures = surface_figures(cells, cell_appearance(database, cells, mix));
    const auto kept_mix = maintained(database.sources(), mix);
    std::vector<SurfaceFigures> kept;
    if (kept_mix) kept = surface_figures(cells, cell_appearance(database, cells, *kept_mix));
    const auto errors = surface_errors(database, mix, figures);
    for (std::size_t s = 0; s < figures.size(); ++s) {
      if (database.zone().surfaces[s].outside) continue;
      const auto& f = figures[s];
      std::vector<Table::Value> row{database.zone().surfaces[s].name, f.area_m2, f.illuminance_mean_lx,
                                    f.illuminance_min_lx, f.illuminance_max_lx, f.xyz_mean_cd_m2.y,
                                    chromaticity(f.xyz_mean_cd_m2, 0), chromaticity(f.xyz_mean_cd_m2, 1),
                                    errors ? (*errors)[s].total_lx() : kUnknown};
      if (shows_maintained) row.emplace_back(kept.empty() ? kUnknown : kept[s].illuminance_mean_lx);
      table.add(row_with_source(source, std::move(row)));
    }
  });
  write_table(program_, table, input_);
}

void TableCommands::cells() {
  const LuminanceDatabase database = open_database(program_, input_);
  const Zone& zone = database.zone();
  const Cells& cells = database.cells();
  Table table(columns_with_source(
      input_, {"surface", "cell", "x_m", "y_m", "z_m", "area_m2", "illuminance_lx", "luminance_cd_m2"}));
  for_sources(database, input_, [&](const std::string& source, const Mix& mix) {
    const auto appearance = cell_appearance(database, cells, mix);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::size_t s = cells.surface_of(i);
      const Vec3 p = zone.surfaces[s].polygon.frame().to_world(cells[i].centroid) + zone.origin_m;
      table.add(row_with_source(source, {zone.surfaces[s].name, static_cast<long>(i - cells.first(s)), p.x, p.y, p.z,
                                         cells.area_m2(i), appearance.illuminance_lx[i], appearance.xyz_cd_m2[i].y}));
    }
  });
  write_table(program_, table, input_);
}

void TableCommands::grid() {
  const LuminanceDatabase database = open_database(program_, input_);
  const double horizontal_lx = daylight_factor_ ? outside_lx(database, input_) : 0.0;
  const Zone& zone = database.zone();
  const auto sets = daylight_factor_ ? planar_sets(zone, planes_, input_.path, "the daylight factor")
                                     : chosen_sets(zone, planes_, input_.path);
  if (sets.empty()) program_.say("the zone has no measuring planes or sensors");
  if (stats_) return grid_stats(database, sets);
  std::vector<std::string> columns{"plane", "point", "x_m", "y_m", "z_m", "nx", "ny", "nz", "illuminance_lx"};
  if (daylight_factor_) columns.emplace_back("daylight_factor_percent");
  const bool shows_quantity = any_bodies_measure(zone), shows_maintained = is_maintained(database);
  columns.emplace_back("error_lx");
  if (shows_quantity) columns.emplace_back("quantity");
  if (shows_maintained) columns.emplace_back("maintained_lx");
  Table table(columns_with_source(input_, columns));
  for_sources(database, input_, [&](const std::string& source, const Mix& asked) {
    const Mix mix = daylight_factor_ ? diffuse_daylight(database, asked) : asked;
    const auto lx = point_lx(database, mix);
    const auto kept_lx = maintained_lx(database, mix);
    const auto errors = point_errors(database, mix);
    for (const auto& set : sets) {
      for (std::size_t p = set.first; p < set.first + set.count; ++p) {
        const Vec3 at = zone.points[p].position + zone.origin_m, n = zone.points[p].normal;
        std::vector<Table::Value> row{set.name, static_cast<long>(p - set.first), at.x, at.y, at.z, n.x, n.y, n.z, lx[p]};
        if (daylight_factor_) row.emplace_back(100.0 * lx[p] / horizontal_lx);
        row.emplace_back(errors ? stated_lx((*errors)[p]) : kUnknown);
        if (shows_quantity) row.emplace_back(quantity_word(zone.points[p].quantity));
        if (shows_maintained) row.emplace_back(kept_lx.empty() ? kUnknown : kept_lx[p]);
        table.add(row_with_source(source, std::move(row)));
      }
    }
  });
  write_table(program_, table, input_);
}

std::vector<double> TableCommands::point_lx(const LuminanceDatabase& database, const Mix& mix) const {
  return direct_ ? direct_point_illuminance_lx(database, mix) : point_illuminance_lx(database, mix);
}

// Empty where no source has a maintenance factor.
std::vector<double> TableCommands::maintained_lx(const LuminanceDatabase& database, const Mix& mix) const {
  const auto kept = maintained(database.sources(), mix);
  return kept ? point_lx(database, *kept) : std::vector<double>{};
}

double TableCommands::stated_lx(const PointError& error) const {
  return direct_ ? PointError{.direct_lx = error.direct_lx}.total_lx() : error.total_lx();
}

void TableCommands::grid_stats(const LuminanceDatabase& database, const std::vector<PointSet>& sets) {
  const bool shows_quantity = any_bodies_measure(database.zone()), shows_maintained = is_maintained(database);
  std::vector<std::string> columns{"plane", "points", "min_lx", "mean_lx", "max_lx", "u0", "ud", "left_out", "error_lx"};
  if (shows_quantity) columns.emplace_back("quantity");
  if (shows_maintained) columns.emplace_back("maintained_mean_lx");
  Table table(columns_with_source(input_, columns));
  for_sources(database, input_, [&](const std::string& source, const Mix& mix) {
    const auto lx = point_lx(database, mix);
    const auto kept_lx = maintained_lx(database, mix);
    const auto errors = point_errors(database, mix);
    for (const auto& set : sets) {
      const auto s = grid_statistics(lx, database.zone().points, set);
      std::vector<Table::Value> row{set.name, static_cast<long>(s.n_points), s.min_lx, s.mean_lx,
                                    s.max_lx, s.u0, s.ud, static_cast<long>(s.n_left_out),
                                    errors && s.n_left_out < s.n_points
                                        ? stated_lx(mean_error(*errors, database.zone().points, set))
                                        : kUnknown};
      if (shows_quantity) row.emplace_back(quantity_word(quantity_of(database.zone(), set)));
      if (shows_maintained)
        row.emplace_back(kept_lx.empty() ? kUnknown
                                         : grid_statistics(kept_lx, database.zone().points, set).mean_lx);
      table.add(row_with_source(source, std::move(row)));
    }
  });
  write_table(program_, table, input_);
}

}  // namespace dim
