#pragma once

#include <cstdlib>
#include <fstream>
#include <string>

#include "catch.hpp"

namespace dim::test {

/// Opens a file of the reference data: in $DIM_SHARED_DATA, else in ../shared/data beside the project. Where
/// it is absent the test says so by name and is to return.
inline bool open_shared(std::ifstream& file, const std::string& path) {
  const char* folder = std::getenv("DIM_SHARED_DATA");
  file.open((folder ? std::string(folder) : std::string(DIM_SOURCE_DIR) + "/../shared/data") + "/" + path);
  if (file) return true;
  WARN("skipped: no reference data " << path);
  return false;
}

}  // namespace dim::test
