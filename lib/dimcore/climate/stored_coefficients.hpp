#pragma once

#include <map>
#include <string>
#include <vector>

#include "climate/coefficients.hpp"
#include "light/window.hpp"
#include "result/database.hpp"

namespace dim {

/// The state that a group of windows is to be in, by the group's name.
using WindowStates = std::map<std::string, std::string>;

/// WindowStates from `GROUP=STATE` texts. @throws InputError  without a place: not of that form
WindowStates parse_states(const std::vector<std::string>& texts);

/// Coefficients of the measuring points of a luminance database, all groups of windows together, each in its
/// state: the one asked for or that of the zone file.
/// @param groups  only the light of these groups of windows; empty: of all
/// @throws InputError  without a place: no coefficients in the file, no such group or state
DaylightCoefficients stored_coefficients(const LuminanceDatabase& database, const WindowStates& states,
                                         const std::vector<std::string>& groups = {});

/// The groups of windows of a database.
std::vector<std::string> window_groups(const LuminanceDatabase& database);

/// Luminous transmittance at normal incidence of a group's first window in its state; 1 for an opening.
double group_transmittance(const LuminanceDatabase& database, const std::string& group,
                           const WindowStates& states);

/// The sun at the points of a database: what is seen of its disc through windows in their states, past everything
/// that the zone has inside and outside. What panes scatter of it is left to the coefficients. Keeps a
/// reference to the database.
/// @param groups  only through these groups of windows; empty: through all
/// @error see SunSight
SunFactors sun_at_points(const LuminanceDatabase& database, const WindowStates& states,
                       const std::vector<std::string>& groups = {});

}  // namespace dim
