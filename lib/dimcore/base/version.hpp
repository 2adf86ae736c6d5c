#pragma once

#include <string>

namespace dim {

/// Version of the library and of the four programs, e.g. "0.1.0".
std::string version();

/// Where an installed copy keeps its databases.
std::string installed_database();

}  // namespace dim
