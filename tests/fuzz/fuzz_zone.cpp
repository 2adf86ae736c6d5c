// Zone files: any text is read or refused with InputError or LimitError; what is read has finite, positive surfaces.
#include <cmath>
#include <cstdlib>

#include "network/cells.hpp"
#include "scene/zone_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  constexpr std::size_t kMemory = std::size_t{64} << 20;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  dim::Warnings warnings;
  try {
    const dim::Zone zone = dim::read_zone(text, "fuzz.toml", {}, 0.0, {}, warnings);
    for (const auto& surface : zone.surfaces)
      if (!(surface.polygon.area_m2() > 0.0) || !std::isfinite(surface.polygon.area_m2())) std::abort();
    if (!std::isfinite(zone.volume_m3)) std::abort();
    dim::check_cells_fit(zone, kMemory);
    const dim::Cells cells(zone);
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (!(cells.area_m2(c) > 0.0)) std::abort();
  } catch (const dim::InputError&) {
  } catch (const dim::LimitError&) {
  }
  return 0;
}
