// Models of other programs: any bytes are read or refused with InputError or LimitError; what comes out is a
// zone file that is read, or refused with InputError, and whose surfaces are finite.
#include <cmath>
#include <cstdlib>

#include "import/import.hpp"
#include "scene/zone_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  dim::Job job;
  job.memory_limit_bytes = std::size_t{256} << 20;
  // Files beside the model are a part of it themselves: material libraries and buffers get fuzzed, too.
  const dim::ImportInput input{bytes, "fuzz",
                               [&](const std::string& name) -> std::optional<std::string> {
                                 if (name.empty() || name[0] == 'x') return std::nullopt;
                                 return std::string(bytes.substr(size / 2));
                               },
                               job};
  try {
    const dim::ImportResult result = dim::import_file(input, DIM_IMPORT_FORMAT, {});
    dim::Warnings warnings;
    const dim::Zone zone = dim::read_zone(result.zone, "fuzz.toml", {}, 0.0, {}, warnings);
    for (const auto& surface : zone.surfaces)
      if (!(surface.polygon.area_m2() > 0.0) || !std::isfinite(surface.polygon.area_m2())) std::abort();
  } catch (const dim::InputError&) {
  } catch (const dim::LimitError&) {
  }
  return 0;
}
