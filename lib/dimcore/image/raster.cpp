#include "image/raster.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"

namespace dim {

namespace {

bool has_whole_bands(const Raster& raster) {
  const auto& edges = raster.band_edges_nm;
  if (edges.size() < 2 || raster.radiance.size() != raster.n_pixels() * (edges.size() - 1)) return false;
  const auto not_above = [](double low, double high) { return !(low < high); };
  return std::adjacent_find(edges.begin(), edges.end(), not_above) == edges.end();
}

}  // namespace

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
  if (!raster.radiance.empty() && !has_whole_bands(raster)) {
    throw InternalError(fmt::format("raster of {} pixels holds {} radiances for {} band edges", n,
                                    raster.radiance.size(), raster.band_edges_nm.size()));
  }
}

}  // namespace dim
