#include "dimray/run.hpp"

int main(int argc, char** argv) {
  dim::Program program("dimray", "Sends the light of luminaires through a ray network.",
                       "  dimray office.rays office.lights.toml -o office.lum",
                       "file formats: rays/2, lights/1, lum/3");
  dim::SolveCommand solve(program);
  return program.run(argc, argv, [&] { return solve.run(); });
}
