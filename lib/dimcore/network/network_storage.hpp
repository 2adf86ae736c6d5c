#pragma once

#include "base/hdf5_file.hpp"
#include "network/network.hpp"

namespace dim {

inline constexpr int kRaysVersion = 1;

/// A `.rays` file: the zone and its ray network. Layout: docs/formats.md.
struct RaysFile {
  Zone zone;
  Network network;
  std::string hash;  ///< of the file's content
};

/// Puts the cells' surfaces, areas and centroids into a file under `/cells`.
void store_cells(Hdf5Writer& file, const Zone& zone, const Cells& cells);

/// Writes whole or not at all; `-` is standard output. @returns the content's hash
/// @throws IoError, Interrupted
std::string save_rays(const std::string& path, const Zone& zone, const Cells& cells, const Network& network,
                      const Job& job = {});

/// @throws IoError  missing, damaged, foreign or newer file; Interrupted
RaysFile load_rays(const std::string& path, const Job& job = {});

}  // namespace dim
