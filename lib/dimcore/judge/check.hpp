#pragma once

#include <string>
#include <vector>

#include "base/job.hpp"
#include "judge/requirements.hpp"
#include "judge/verdict.hpp"
#include "result/luminous.hpp"

namespace dim {

/// One figure held against its limit.
struct Finding {
  std::string where;  ///< plane or surface
  std::string what;   ///< "illuminance", "uniformity", "ugr" …
  std::string unit;   ///< "lx", "%", "W/m2" …; may be empty
  bool at_most = false;
  double limit = 0.0;
  double value = 0.0;    ///< maintained, where that differs
  double initial = 0.0;  ///< as new
  double error = 0.0;    ///< stated, of the value
  Verdict verdict = Verdict::undecided;
};

/// What can be said of the error of mixed illuminances where `point_errors` says nothing, relative to their mean: the bound on truncated
/// inter-reflection and what the energy balance leaves open, of each source by its share.
double stated_error(const LuminanceDatabase& database, const Mix& mix);

/// Maintained light: each source's factor of the mix times its maintenance factor, once: the one that the requirements
/// have for it by name, else that of the lights file, else that of the requirements for all; daylight stays.
/// @throws InputError  a factor for a source or group that is not there, at its place in the file
Mix maintained_mix(const LuminanceDatabase& database, const Requirements& requirements, const Mix& initial);

struct CheckInput {
  Mix initial;              ///< the electric light asked about, as new
  Mix daylight;             ///< diffuse daylight alone; empty where the database has none
  double outside_lx = 0.0;  ///< under the same sky
};

/// Holds a solution against requirements. Illuminance, uniformity and power per 100 lx are of maintained
/// light: each source times its maintenance factor, once; glare is of the room as new, as EN 12464-1 has it.
/// @throws InputError   a plane, surface or source that is not there, at its place in the file; a daylight
/// factor
///                      without daylight
/// @throws Interrupted
std::vector<Finding> check(const LuminanceDatabase& database, const Requirements& requirements,
                           const CheckInput& input, const Job& job);

}  // namespace dim
