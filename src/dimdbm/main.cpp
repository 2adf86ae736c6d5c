#include "dimdbm/commands.hpp"

int main(int argc, char** argv) {
  dim::Program program(
      "dimdbm", "Looks after the database of fittings and surfaces.",
      "  dimdbm list\n  dimdbm add lamp.ldt --spectrum led-4000\n  dimdbm plot lamp -o lamp.svg",
      "file formats: fitting/1, surface/1, spectrum/1, IES LM-63-1986..2019, EULUMDAT, IES TM-33-18 and -23, "
      "TM-27");
  program.app().require_subcommand(1);
  program.add_common_options(program.app());
  dim::LookCommands look(program);
  dim::PlotCommand plot(program);
  dim::UgrCommand ugr(program);
  dim::AddCommand add(program);
  dim::RemoveCommand remove(program);
  dim::ExportCommand exporter(program);
  return program.run(argc, argv, [&] {
    dim::Exit status = dim::Exit::done;
    look.run(status) || plot.run() || ugr.run() || add.run() || remove.run() || exporter.run();
    return status;
  });
}
