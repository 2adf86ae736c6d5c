#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"
#include "dimdis/options.hpp"
#include "network/cells.hpp"
#include "scene/zone_reader.hpp"

namespace dim {

GeometryCommands::GeometryCommands(Program& program) : program_(program) {
  check_ = add("check", "Check a zone file and say what is in it", "  dimdis check office.zone.toml");
  areas_ = add("areas", "Area and cells of every surface as CSV, the volume on stderr",
               "  dimdis areas office.zone.toml -o areas.csv");
}

CLI::App* GeometryCommands::add(const std::string& name, const std::string& what, const std::string& example) {
  auto* command = program_.app().add_subcommand(name, what);
  command->footer("Example:\n" + example);
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
  else
    return false;
  return true;
}

Exit GeometryCommands::check() {
  const Zone zone = read_zone(program_, input_);
  const Cells cells(zone);
  program_.say(fmt::format("zone '{}' is good: {} surfaces, {} cells, {} measuring points, {} views, {}", zone.name,
                           zone.surfaces.size(), cells.size(), zone.points.size(), zone.views.size(),
                           zone.closed ? fmt::format("{:.6g} m3", zone_volume_m3(zone)) : "not closed"));
  return Exit::done;
}

Exit GeometryCommands::areas() {
  const Zone zone = read_zone(program_, input_);
  const Cells cells(zone);
  std::string csv = "surface,area_m2,cells\n";
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s)
    csv += fmt::format("{},{:.9g},{}\n", zone.surfaces[s].name, zone.surfaces[s].polygon.area_m2(),
                       cells.first(s + 1) - cells.first(s));
  write_file(output_, csv);
  program_.say(zone.closed ? fmt::format("volume {:.9g} m3", zone_volume_m3(zone))
                           : "the zone is not closed: it has no volume");
  return Exit::done;
}

}  // namespace dim
