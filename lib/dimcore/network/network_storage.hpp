#pragma once

#include "base/file_layout.hpp"
#include "base/hdf5_file.hpp"
#include "network/network.hpp"

namespace dim {

/// The newest version; and the one written where every point measures planar illuminance, which older programs read.
inline constexpr int kRaysVersion = 3, kPlanarRaysVersion = 2;

/// A `.rays` file: the zone and its ray network. Layout: docs/formats.md.
struct RaysFile {
  Zone zone;
  Cells cells;
  Network network;
  std::string hash;  ///< of the file's content
};

/// What the file holds of cells, and all that a `.rays` file holds.
FileSchema cells_schema();
const FileSchema& rays_schema();

/// Puts the cells' surfaces, areas, centroids and outlines into a file under `/cells`.
void store_cells(Hdf5Writer& file, const Zone& zone, const Cells& cells);

/// The cells of a file's zone, made anew.
/// @throws IoError     they are not those whose surfaces and areas the file holds
/// @throws LimitError  they do not fit
Cells load_cells(const Hdf5Reader& file, const Zone& zone, const std::string& path, const Job& job = {});

/// Writes whole or not at all; `-` is standard output. @returns the content's hash
/// @throws IoError, Interrupted
std::string save_rays(const std::string& path, const Zone& zone, const Cells& cells, const Network& network,
                      const Job& job = {});

/// @throws IoError  missing, damaged, foreign or newer file; Interrupted
RaysFile load_rays(const std::string& path, const Job& job = {});

}  // namespace dim
