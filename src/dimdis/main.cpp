#include "dimdis/options.hpp"

int main(int argc, char** argv) {
  dim::Program program("dimdis", "Turns a zone into cells, hemisphere patches and a ray network.",
                       "  dimdis office.zone.toml -o office.rays\n  dimdis areas office.zone.toml",
                       "file formats: zone/1, rays/2");
  dim::DiscretiseCommand discretise(program);
  dim::GeometryCommands geometry(program);
  dim::ExportCommand exporter(program);
  dim::ImportCommand importer(program);
  dim::NewCommand starter(program);
  return program.run(argc, argv, [&] {
    if (exporter.run() || starter.run()) return dim::Exit::done;
    dim::Exit status = dim::Exit::done;
    return geometry.run(status) || importer.run(status) ? status : discretise.run();
  });
}
