#include "image/spectral_pixels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dim {

std::string spectral_channel_name(double wavelength_nm) {
  std::string figure = fmt::format("{}", wavelength_nm);
  if (figure.find('.') == std::string::npos) figure += ".0";
  std::replace(figure.begin(), figure.end(), '.', ',');
  return "S0." + figure + "nm";
}

SpectralPixels spectral_pixels(const Raster& raster) {
  check_raster(raster);
  SpectralPixels result;
  if (raster.radiance.empty()) return result;
  const auto& edges = raster.band_edges_nm;
  const std::size_t n_bands = edges.size() - 1;
  for (std::size_t b = 0; b < n_bands; ++b) {
    result.channels.push_back(spectral_channel_name(0.5 * (edges[b] + edges[b + 1])));
  }
  result.band_edges_nm = fmt::format("{}", fmt::join(edges, " "));
  result.values.resize(raster.radiance.size());
  for (std::size_t i = 0; i < raster.radiance.size(); ++i) {
    const std::size_t b = i % n_bands;
    const double spectral = static_cast<double>(raster.radiance[i]) / (edges[b + 1] - edges[b]);
    result.values[i] = std::isfinite(spectral) ? static_cast<float>(spectral) : 0.0f;
  }
  return result;
}

}  // namespace dim
