// Ray networks: any edit of a good file is refused in words, or gives light that is finite and not negative.
#include "fuzz/binary_edits.hpp"
#include "fuzz/small_room.hpp"
#include "network/network_storage.hpp"

namespace {

const dim::BinaryEdits& edits() {
  static const dim::BinaryEdits made = [] {
    const dim::Zone zone = dim::small_room();
    const dim::Cells cells(zone);
    const std::string path = dim::scratch_file("room.rays");
    dim::save_rays(path, zone, cells, dim::small_network(zone, cells));
    return dim::BinaryEdits(path);
  }();
  return made;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  edits().write(data, size);
  dim::Job job;
  job.memory_limit_bytes = std::size_t{256} << 20;
  try {
    const dim::RaysFile rays = dim::load_rays(dim::scratch_file("room.rays"), job);
    dim::Warnings warnings;
    const dim::Solution solution =
        dim::simulate(rays.zone, rays.cells, rays.network, dim::small_lights(), {}, job, warnings);
    for (const float lx : solution.cell_total)
      if (!std::isfinite(lx) || lx < 0.0F) std::abort();
  } catch (const dim::InternalError&) {
    std::abort();
  } catch (const dim::Error&) {
  }
  return 0;
}
