#pragma once

#include <string>
#include <vector>

#include "image/raster.hpp"

/// Spectral channels of an OpenEXR file, in the layout of Fichet, Pacanowski & Wilkie 2021 ("An OpenEXR
/// layout for spectral images", J. Comput. Graph. Tech. 10(3), 1-18): a channel per wavelength named
/// S0.<wavelength>nm (S0: the first Stokes component, the whole of unpolarised light; the decimal mark is a
/// comma, as a full stop parts OpenEXR's layers), and the attributes below.
namespace dim {

inline constexpr const char* kSpectralLayoutVersion = "1.0";         ///< attribute spectralLayoutVersion
inline constexpr const char* kEmissiveUnits = "W.m^-2.sr^-1.nm^-1";  ///< attribute emissiveUnits

/// Spectral radiance of a picture, one channel a waveband.
struct SpectralPixels {
  std::vector<std::string> channels;  ///< [n_bands] names, by band centre
  std::vector<float> values;          ///< [height][width][n_bands] mean spectral radiance, W/(m2 sr nm)
  /// Attribute bandEdges_nm, which the layout does not have: the n_bands + 1 edges, nm, parted by spaces;
  /// each reads back as the same double.
  std::string band_edges_nm;

  bool empty() const { return channels.empty(); }
};

/// "S0.550,0nm" for 550: at least one decimal, and as many as it takes to read back as the same double.
std::string spectral_channel_name(double wavelength_nm);

/// Radiance by band divided by the bands' widths; empty where the raster has none. NaN and infinity become 0.
/// @throws LimitError, InternalError  see check_raster
SpectralPixels spectral_pixels(const Raster& raster);

}  // namespace dim
