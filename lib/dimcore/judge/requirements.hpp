#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace dim {

/// What is asked of a measuring plane (or sensors), or of surfaces each. Nothing where a figure is not asked
/// for.
struct Requirement {
  std::string plane;                              ///< or
  std::vector<std::string> surfaces;              ///< not both
  std::optional<double> illuminance_lx;           ///< maintained mean, at least
  std::optional<double> uniformity;               ///< U0 = min over mean, at least
  std::optional<double> colour_rendering;         ///< Ra, at least
  std::optional<double> daylight_factor_percent;  ///< mean, at least; planes only
  std::optional<double> ugr;                      ///< of eyes over the plane, at most
  double eye_height_m = 1.2;
  int directions = 24;
  std::optional<double> power_W_m2;        ///< installed, of the room's floor, at most
  std::optional<double> power_W_m2_100lx;  ///< the same for each 100 lx maintained there, at most
  Place place;
};

/// A requirements file.
struct Requirements {
  std::string title;
  std::string source;                         ///< where the figures are from
  double maintenance_factor = 1.0;            ///< maintained over initial light of sources whose lights file has none
  std::map<std::string, double> maintenance;  ///< of a source or group, in place of either
  std::map<std::string, Place> maintenance_place;
  std::vector<Requirement> requirements;
};

/// Reads `dim = "requirements/1"`.
/// @throws InputError  every problem together
Requirements read_requirements(std::string_view text, const std::string& file,
                               const std::vector<std::string>& overrides);

}  // namespace dim
