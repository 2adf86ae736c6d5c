#include "database/search.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

namespace dim {
namespace {

namespace fs = std::filesystem;

bool is_plain_name(const std::string& name) {
  constexpr std::size_t kLongest = 200;
  return !name.empty() && name.size() <= kLongest && name[0] != '.' &&
         std::none_of(name.begin(), name.end(), [](char c) {
           return c == '/' || c == '\\' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
         });
}

}  // namespace

std::optional<std::string> DatabaseSearch::find(const std::string& kind, const std::string& name) const {
  if (!is_plain_name(name)) return std::nullopt;
  for (const auto& folder : folders) {
    const fs::path path = fs::path(folder) / kind / (name + ".toml");
    std::error_code error;
    if (fs::exists(path, error) && !fs::is_directory(path, error)) return path.string();
  }
  return std::nullopt;
}

std::vector<std::string> DatabaseSearch::names(const std::string& kind) const {
  std::set<std::string> found;
  for (const auto& folder : folders) {
    std::error_code error;
    fs::directory_iterator it(fs::path(folder) / kind, error);
    for (; !error && it != fs::directory_iterator(); it.increment(error)) {
      if (it->path().extension() == ".toml") found.insert(it->path().stem().string());
    }
  }
  return {found.begin(), found.end()};
}

std::string DatabaseSearch::places(const std::string& kind) const {
  std::string text;
  for (const auto& folder : folders) text += (text.empty() ? "" : ", ") + (fs::path(folder) / kind).string();
  return text.empty() ? "no database folder" : text;
}

}  // namespace dim
