#include "dimout/colour.hpp"
#include "dimout/daylight.hpp"

int main(int argc, char** argv) {
  dim::Program program("dimout", "Tables and pictures from a luminance database.",
                       "  dimout grid office.lum --stats\n  dimout image office.lum --view door -o door.png",
                       "file formats: lum/2");
  program.app().require_subcommand(1);
  program.add_common_options(program.app(), true);
  dim::TableCommands tables(program);
  dim::ColourCommand colour(program);
  dim::ImageCommand image(program);
  dim::AnnualCommand annual(program);
  dim::LevelsCommand levels(program);
  return program.run(argc, argv, [&] {
    tables.run() || colour.run() || image.run() || annual.run() || levels.run();
    return dim::Exit::done;
  });
}
