#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/atomic_file.hpp"
#include "common/counted.hpp"
#include "common/in_file.hpp"
#include "common/table.hpp"
#include "dimdis/options.hpp"
#include "geometry/hidden_lines.hpp"
#include "geometry/view_factors.hpp"
#include "network/cells.hpp"
#include "network/point_places.hpp"
#include "scene/inside_test.hpp"
#include "scene/zone_reader.hpp"

namespace dim {

GeometryCommands::GeometryCommands(Program& program) : program_(program) {
  check_ = add("check", "Check a zone file and say what is in it", "  dimdis check office.zone.toml");
  areas_ = add("areas", "Area and cells of every surface as CSV, the volume on stderr",
               "  dimdis areas office.zone.toml -o areas.csv");
  view_factors_ = add("viewfactors", "Diffuse view factors of all pairs of surfaces as CSV, checks on stderr",
                      "  dimdis viewfactors office.zone.toml -o factors.csv");
  view_factors_->add_option("--rays", rays_, "Rays from each surface; the error falls about as their root")
      ->check(CLI::Range(1, 100'000'000))
      ->group("Accuracy");
  draw_ =
      add("draw", "Hidden-line perspective as SVG", "  dimdis draw office.zone.toml --view door -o door.svg");
  draw_->add_option("--view", view_, "View of the zone file; its first one unless said")->type_name("NAME");
}

CLI::App* GeometryCommands::add(const std::string& name, const std::string& what,
                                const std::string& example) {
  auto* command = program_.add_command(name, what, example);
  add_zone_options(*command, input_, true);
  if (name != "check")
    command->add_option("-o,--output", output_, "File to write, - for standard output")->type_name("FILE");
  program_.add_common_options(*command);
  return command;
}

bool GeometryCommands::run(Exit& status) {
  if (check_->parsed())
    status = check();
  else if (areas_->parsed())
    status = areas();
  else if (view_factors_->parsed())
    status = factors();
  else if (draw_->parsed())
    status = draw();
  else
    return false;
  return true;
}

Exit GeometryCommands::check() {
  Zone zone = read_zone(program_, input_);
  const InsideTest test(plates_of(zone), zone.diameter_m, zone.closed);
  for (auto& point : zone.points) point.valid = !test.outside(point);
  warn(program_, input_, left_out_warnings(zone));
  const Cells cells(zone);
  program_.say(fmt::format("zone '{}' is good: {}, {}, {}, {}, {}", zone.name,
                           counted(zone.surfaces.size(), "surface"), counted(cells.size(), "cell"),
                           counted(zone.points.size(), "measuring point"), counted(zone.views.size(), "view"),
                           zone.closed ? fmt::format("{:.6g} m3", zone_volume_m3(zone)) : "not closed"));
  return Exit::done;
}

Exit GeometryCommands::areas() {
  program_.check_output(output_, {input_.path});
  const Zone zone = read_zone(program_, input_);
  const Cells cells(zone);
  Table table({"surface", "area_m2", "cells"});
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s)
    table.add({zone.surfaces[s].name, zone.surfaces[s].polygon.area_m2(),
               static_cast<long>(cells.first(s + 1) - cells.first(s))});
  program_.stage(kWritingStage);
  write_file(output_, table.csv());
  program_.stage("");
  program_.say(zone.closed ? fmt::format("volume {:.9g} m3", zone_volume_m3(zone))
                           : "the zone is not closed: it has no volume");
  return Exit::done;
}

Exit GeometryCommands::factors() {
  program_.check_output(output_, {input_.path});
  const Zone zone = read_zone(program_, input_);
  program_.stage("rays");
  const ViewFactors factors = view_factors(plates_of(zone), zone.diameter_m, rays_, program_.job());
  program_.stage(kWritingStage);
  Table table({"from", "to", "view_factor"});
  double worst_row = 0.0, escaped = 0.0;
  for (std::size_t i = 0; i < factors.rows.size(); ++i) {
    for (const auto& entry : factors.rows[i])
      table.add({zone.surfaces[i].name, zone.surfaces[entry.to].name, entry.value});
    worst_row =
        std::max(worst_row, std::abs(factors.row_sums[i] + factors.escaped[i] + factors.behind[i] - 1.0));
    escaped = std::max(escaped, factors.escaped[i] + factors.behind[i]);
    program_.say_verbose(fmt::format("{}: row sum {:.6f}, escaped {:.6f}", zone.surfaces[i].name,
                                     factors.row_sums[i], factors.escaped[i] + factors.behind[i]));
  }
  write_file(output_, table.csv());
  program_.stage("");
  program_.say(fmt::format(
      "reciprocity of the rays {:.2e} of the area (RMS {:.2e}); rows add up to 1 within {:.2e}; at "
      "most {:.4f} of a surface's view leaves the zone",
      factors.reciprocity_total, factors.reciprocity_rms, worst_row, escaped));
  return Exit::done;
}

Exit GeometryCommands::draw() {
  program_.check_output(output_, {input_.path});
  const Zone zone = read_zone(program_, input_);
  const View& view = in_file(input_.path, [&]() -> const View& { return find_view(zone, view_); });
  if (view.round())
    throw UsageError(fmt::format("--view '{}' is of kind {}, in which edges are curved: lines cannot be drawn of it; see dimout image",
                                 view.name, view_kind_words()[static_cast<std::size_t>(view.kind)]));
  auto plates = plates_of(zone);
  // From outside the camera looks through the near walls, as into a cut-away model.
  for (std::size_t s = 0; s < plates.size(); ++s) plates[s].open_back |= zone.surfaces[s].bounding;
  program_.stage("lines");
  const auto lines = hidden_lines(plates, zone.diameter_m, camera_of(view), program_.job());
  program_.stage(kWritingStage);
  write_file(output_, to_svg(lines, view.width, view.height, zone.name + ", view " + view.name));
  return Exit::done;
}

}  // namespace dim
