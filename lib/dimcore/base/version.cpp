#include "base/version.hpp"

namespace dim {

std::string version() { return DIM_VERSION; }
std::string installed_database() { return DIM_INSTALLED_DB; }

}  // namespace dim
