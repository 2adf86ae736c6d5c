#pragma once

#include <string>

#include "sky/daylight.hpp"

namespace dim {

/// The sky that `--sky SPEC` asks for, weather files read.
/// @throws InputError  about the option or the weather file
Daylight sky_asked_for(const std::string& spec);

}  // namespace dim
