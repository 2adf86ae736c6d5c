#include "base/atomic_file.hpp"
#include "dimdis/options.hpp"
#include "scene/zone_export.hpp"

namespace dim {

ExportCommand::ExportCommand(Program& program) : program_(program) {
  command_ = program.add_command("export", "Write the zone for other programs: Radiance, OBJ",
                                 "  dimdis export office.zone.toml --to radiance --points office.pts "
                                 "-o office.rad");
  add_zone_options(*command_, input_, true);
  command_->add_option("--to", format_, "Format")->required()->check(CLI::IsMember({"radiance", "obj"}));
  command_->add_option("--points", points_, "Also write the measuring points, as rtrace reads them")
      ->type_name("FILE");
  command_->add_option("-o,--output", output_, "File to write, - for standard output")->type_name("FILE");
  program.add_common_options(*command_);
}

bool ExportCommand::run() {
  if (!command_->parsed()) return false;
  program_.check_output(output_, {input_.path});
  if (!points_.empty()) program_.check_output(points_, {input_.path, output_});
  if (points_ == "-" && output_ == "-")
    throw UsageError("the zone and its points cannot both go to standard output\n        give -o a name");
  const Zone zone = read_zone(program_, input_);
  Warnings warnings;
  const std::string text = format_ == "obj" ? to_obj(zone) : to_radiance(zone, warnings);
  warn(program_, input_, warnings);
  program_.stage(kWritingStage);
  write_file(output_, text);
  if (!points_.empty()) write_file(points_, to_sensor_points(zone));
  program_.stage("");
  return true;
}

}  // namespace dim
