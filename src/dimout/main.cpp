#include "dimout/colour.hpp"
#include "dimout/daylight.hpp"
#include "dimout/judging.hpp"
#include "dimout/report.hpp"

int main(int argc, char** argv) {
  dim::Program program("dimout", "Tables and pictures from a luminance database.",
                       "  dimout grid office.lum --stats\n  dimout image office.lum --view door -o door.png",
                       "file formats: lum/3");
  program.app().require_subcommand(1);
  program.add_common_options(program.app(), true);
  dim::TableCommands tables(program);
  dim::ColourCommand colour(program);
  dim::ImageCommand image(program);
  dim::ContourCommand contour(program);
  dim::GlareCommand glare(program);
  dim::CheckCommand check(program);
  dim::ReportCommand report(program);
  dim::AnnualCommand annual(program);
  dim::LevelsCommand levels(program);
  return program.run(argc, argv, [&] {
    dim::Exit status = dim::Exit::done;
    tables.run() || colour.run() || image.run() || contour.run() || glare.run() || check.run(status) ||
        report.run() || annual.run() || levels.run();
    return status;
  });
}
