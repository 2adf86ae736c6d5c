#pragma once

#include <optional>
#include <string>

#include "base/job.hpp"
#include "image/shader.hpp"
#include "judge/check.hpp"

namespace dim {

struct ReportOptions {
  Mix mix;                ///< asked for, daylight included
  CheckInput asked;       ///< of the requirements
  Shading shading = Shading::smooth;
  std::string file;       ///< name of the luminance database, to be said
  std::optional<Requirements> requirements;
  std::string requirements_file;
};

/// Pixels of all pictures together, each counted once for every group of lights: it keeps the page of six groups
/// within 10 MB.
inline constexpr double kMostGroupPixels = 7e6;

/// Everything a room's lighting is judged by as one web page, which needs no other file and asks no host: plans,
/// figures with their errors, requirements, luminaires, glare, energy balance, pictures. The light of each group is
/// in it, so that whoever reads it can dim the room; what is linear in light, and UGR, follow exactly.
/// @throws InputError   as check has it
/// @throws Interrupted
std::string report_page(const LuminanceDatabase& database, const ReportOptions& options, const Job& job);

}  // namespace dim
