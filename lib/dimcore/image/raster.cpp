#include "image/raster.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace dim {

void check_raster(const Raster& raster) {
  const auto possible = [](int side) { return side >= 1 && side <= kMaxPictureSide; };
  if (!possible(raster.width) || !possible(raster.height)) {
    throw LimitError(fmt::format("a picture of {} x {} pixels is outside 1..{} a side", raster.width,
                                 raster.height, kMaxPictureSide));
  }
  const std::size_t n = raster.n_pixels();
  if (raster.xyz.size() != 3 * n || (!raster.scalar.empty() && raster.scalar.size() != n)) {
    throw InternalError(fmt::format("raster of {} pixels holds {} colour values and {} scalars", n,
                                    raster.xyz.size(), raster.scalar.size()));
  }
}

}  // namespace dim
