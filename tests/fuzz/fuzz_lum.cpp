// Luminance databases: any edit of a good file is refused in words, or gives figures that are finite and not negative.
#include "fuzz/binary_edits.hpp"
#include "fuzz/small_room.hpp"
#include "result/database.hpp"
#include "result/lum_file.hpp"
#include "result/luminous.hpp"

namespace {

const dim::BinaryEdits& edits() {
  static const dim::BinaryEdits made = [] {
    const dim::Zone zone = dim::small_room();
    const dim::Cells cells(zone);
    const dim::Lights lights = dim::small_lights();
    dim::Warnings warnings;
    const auto solution =
        dim::simulate(zone, cells, dim::small_network(zone, cells), lights, {}, dim::Job{}, warnings);
    const std::string path = dim::scratch_file("room.lum");
    dim::save_lum(path, zone, cells, lights, solution, std::string(32, '0'));
    return dim::BinaryEdits(path);
  }();
  return made;
}

void check(const std::vector<double>& values) {
  for (const double value : values)
    if (!std::isfinite(value) || value < 0.0) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  edits().write(data, size);
  dim::Job job;
  job.memory_limit_bytes = std::size_t{256} << 20;
  try {
    const dim::LuminanceDatabase database(dim::scratch_file("room.lum"), job);
    const dim::Mix mix(database.sources().size(), 1.0);
    check(dim::point_illuminance_lx(database, mix));
    check(dim::cell_illuminance_lx(database, mix));
  } catch (const dim::InternalError&) {
    std::abort();
  } catch (const dim::Error&) {
  }
  return 0;
}
