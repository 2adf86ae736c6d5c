#pragma once

#include <optional>
#include <string>
#include <vector>

#include "import/import_input.hpp"
#include "import/import_report.hpp"

/// Files of other programs turned into zone and lights files.
namespace dim {

struct ImportOptions {
  std::optional<double> unit_m;  ///< in place of what the file states
  std::optional<UpAxis> up;      ///< in place of what the file states
  std::optional<Vec3> inside;    ///< a point of the room that is wanted, m, z up
  std::optional<double> gap_m;   ///< corners nearer than this are one; default: see `default_gap_m`
  std::string zone_name;
};

struct ImportResult {
  std::string zone;
  std::string lights;               ///< empty where the file has none
  std::vector<ImportedFile> files;  ///< that the lights file names
  std::string conventions;          ///< "OBJ, metres (assumed), z up (assumed), gaps up to 0.09 mm closed"
  ImportReport report;
  Warnings warnings;
};

/// Words for `--format`: obj, ply, stl, gltf, dae, radiance, hbjson, gbxml, esp-r.
const std::vector<std::string>& import_formats();
/// The format that a file's name ends in says; empty where none does.
std::string import_format_of(const std::string& path);

/// 1e-5 of the model's size, at most 0.1 mm.
double default_gap_m(double size_m);

/// Reads, cleans up and writes.
/// @throws InputError, LimitError
ImportResult import_file(const ImportInput& input, const std::string& format, const ImportOptions& options);

/// What was read and changed, a line each; then a line a room.
std::vector<std::string> summary_lines(const ImportReport& report);

}  // namespace dim
