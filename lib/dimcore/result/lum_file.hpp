#pragma once

#include <memory>
#include <string>

#include "base/file_layout.hpp"
#include "base/job.hpp"
#include "result/content.hpp"
#include "result/transfer.hpp"

namespace dim {

/// The newest version; and the one written where every point measures planar illuminance, which older programs read.
inline constexpr int kLumVersion = 4, kPlanarLumVersion = 3;

/// All that a `.lum` file holds.
const FileSchema& lum_schema();

/// Writes a luminance database (`.lum`), whole or not at all; `-` is standard output. Layout:
/// docs/formats.md.
/// @param rays_hash  of the network the solution was made on
/// @returns the content's hash
/// @throws IoError, Interrupted
std::string save_lum(const std::string& path, const Zone& zone, const Cells& cells, const Lights& lights,
                     const Solution& solution, const std::string& rays_hash, const Job& job = {});

/// A luminance database read from a file.
struct LumFile {
  ResultContent content;
  std::unique_ptr<TransferStore> light;  ///< reads from the open file
  std::string hash, rays_hash;
};

/// @throws IoError  missing, damaged, foreign, older or newer file
LumFile load_lum(const std::string& path, const Job& job);

}  // namespace dim
