#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "catch.hpp"
#include "scene/zone_reader.hpp"

namespace dim::test {

inline Zone read(const std::string& text, const std::vector<std::string>& overrides = {},
                 Warnings* warnings = nullptr) {
  Warnings own;
  return read_zone(text, "room.toml", overrides, 0.0, {}, warnings ? *warnings : own);
}

/// The problems of a text that must be refused, each as "line:column what | cure".
inline std::vector<std::string> problems_of(const std::string& text,
                                            const std::vector<std::string>& overrides = {}) {
  try {
    read(text, overrides);
  } catch (const InputError& error) {
    std::vector<std::string> result;
    for (const auto& p : error.problems()) {
      std::string line = p.place.line > 0
                             ? std::to_string(p.place.line) + ":" + std::to_string(p.place.column)
                             : p.place.file;
      line += " " + p.what;
      if (!p.cure.empty()) line += " | " + p.cure;
      result.push_back(line);
    }
    return result;
  }
  return {};
}

inline const Surface* find(const Zone& zone, const std::string& name) {
  const auto it = std::find_if(zone.surfaces.begin(), zone.surfaces.end(),
                               [&](const Surface& s) { return s.name == name; });
  return it == zone.surfaces.end() ? nullptr : &*it;
}

inline double area_of(const Zone& zone, const std::string& name) {
  const auto* surface = find(zone, name);
  return surface ? surface->polygon.area_m2() : 0.0;
}

/// A closed room 6 x 4 x 3 without furniture; 30 lines.
inline const std::string kRoom = R"(dim = "zone/1"
name = "room"
cell = 0.5
[finishes]
wall = 0.5
dark = { diffuse = 0.2 }
[[surface]]
name = "floor"
finish = "dark"
vertices = [[0,0,0],[6,0,0],[6,4,0],[0,4,0]]
[[surface]]
name = "ceiling"
finish = "wall"
vertices = [[0,0,3],[0,4,3],[6,4,3],[6,0,3]]
[[surface]]
name = "south"
finish = "wall"
vertices = [[0,0,0],[0,0,3],[6,0,3],[6,0,0]]
[[surface]]
name = "north"
finish = "wall"
vertices = [[0,4,0],[6,4,0],[6,4,3],[0,4,3]]
[[surface]]
name = "west"
finish = "wall"
vertices = [[0,0,0],[0,4,0],[0,4,3],[0,0,3]]
[[surface]]
name = "east"
finish = "wall"
vertices = [[6,0,0],[6,0,3],[6,4,3],[6,4,0]]
)";

}  // namespace dim::test
