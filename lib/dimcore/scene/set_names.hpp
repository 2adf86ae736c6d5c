#pragma once

#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

#include "database/toml_reader.hpp"
#include "scene/point_quantity.hpp"

namespace dim {

/// The names of a file's measuring planes and sensors, or of its views: each once.
class SetNames {
 public:
  /// Reports a name that is there already. @param table  that it is written in, under `name`
  void add(const TomlTable& table, const std::string& name) {
    const auto [it, added] = lines_.emplace(name, table.place("name").line);
    if (!added)
      table.problem("name", fmt::format("the name '{}' is used twice, first at line {}", name, it->second));
  }
  void add(const TomlTable& table, const std::string& name, const std::vector<Facing>& facings) {
    for (const Facing& facing : facings) add(table, name + facing.suffix);
  }

 private:
  std::map<std::string, int> lines_;
};

}  // namespace dim
