#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "sky/daylight.hpp"

namespace dim {

/// Adds `--state GROUP=STATE`, for states of windows, to a command.
CLI::Option* add_state_option(CLI::App& command, std::vector<std::string>& states);

/// The sky that `--sky SPEC` asks for, weather files read.
/// @throws InputError  about the option or the weather file
Daylight sky_asked_for(const std::string& spec);

}  // namespace dim
