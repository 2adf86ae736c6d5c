#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

/// For the tests that write pictures with the module and read them back with other programs' libraries.
namespace dim::test {

inline const std::string kModuleDir = DIM_IMAGE_MODULE_DIR;

/// A folder of its own, with a space and a letter beyond ASCII in its name; removed at the end.
struct TempFolder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("dim-image-ä " + std::to_string(getpid()));
  TempFolder() { std::filesystem::create_directories(path); }
  ~TempFolder() { std::filesystem::remove_all(path); }
  std::string operator/(const std::string& name) const { return (path / name).string(); }
};

}  // namespace dim::test
