#include "dimout/colour.hpp"

namespace dim {
namespace {

std::vector<std::string> with_figures(std::vector<std::string> columns) {
  for (const char* name :
       {"cie_x", "cie_y", "cie_u_prime", "cie_v_prime", "cct_K", "duv", "ra", "melanopic_edi_lx"})
    columns.emplace_back(name);
  return columns;
}

std::vector<Table::Value> with_figures(std::vector<Table::Value> row, const LightColour& c) {
  row.insert(row.end(), {c.illuminance_lx, c.xy.x, c.xy.y, c.uv.x, c.uv.y, c.white.cct_K, c.white.duv, c.ra,
                         c.melanopic_edi_lx});
  return row;
}

}  // namespace

ColourCommand::ColourCommand(Program& program) : program_(program) {
  colour_ = add_command(program, input_, "colour",
                        "Colour temperature, Ra and melanopic effect of the light at points or on surfaces",
                        "dimout colour office.lum --plane workplane\n  dimout colour office.lum --surfaces");
  add_table_options(*colour_, input_, true);
  auto* plane = add_plane_option(*colour_, planes_);
  colour_->add_flag("--surfaces", surfaces_, "Light falling on each surface, in place of measuring points")
      ->excludes(plane);
}

bool ColourCommand::run() {
  if (!colour_->parsed()) return false;
  program_.check_output(input_.output, {input_.path});
  const LuminanceDatabase database = open_database(program_, input_);
  const LightColours colours(database);
  program_.warn(colours.left_out(mix_of(database, input_)));
  if (surfaces_)
    surfaces(database, colours);
  else
    points(database, colours);
  return true;
}

void ColourCommand::points(const LuminanceDatabase& database, const LightColours& colours) {
  const Zone& zone = database.zone();
  const auto sets = chosen_sets(zone, planes_, input_.path);
  if (sets.empty()) program_.say("the zone has no measuring planes or sensors; see --surfaces");
  Table table(
      columns_with_source(input_, with_figures({"plane", "point", "x_m", "y_m", "z_m", "illuminance_lx"})));
  for_sources(database, input_, [&](const std::string& source, const Mix& mix) {
    const auto at = colours.at_points(mix);
    for (const auto& set : sets) {
      for (std::size_t p = set.first; p < set.first + set.count; ++p) {
        const Vec3 place = zone.points[p].position + zone.origin_m;
        table.add(row_with_source(
            source,
            with_figures({set.name, static_cast<long>(p - set.first), place.x, place.y, place.z}, at[p])));
      }
    }
  });
  write_table(program_, table, input_);
}

void ColourCommand::surfaces(const LuminanceDatabase& database, const LightColours& colours) {
  const Zone& zone = database.zone();
  const Cells& cells = database.cells();
  Table table(columns_with_source(input_, with_figures({"surface", "illuminance_mean_lx"})));
  for_sources(database, input_, [&](const std::string& source, const Mix& mix) {
    const auto on = colours.on_surfaces(cells, mix);
    for (std::size_t s = 0; s < zone.surfaces.size(); ++s)
      if (!zone.surfaces[s].outside)
        table.add(row_with_source(source, with_figures({zone.surfaces[s].name}, on[s])));
  });
  write_table(program_, table, input_);
}

}  // namespace dim
