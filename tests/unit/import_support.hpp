#pragma once

#include <map>
#include <string>
#include <vector>

#include "catch.hpp"
#include "import/import.hpp"
#include "scene_support.hpp"

namespace dim::test {

/// Imports a text; files that it names are looked up in `beside`.
inline ImportResult import_text(const std::string& text, const std::string& format,
                                const ImportOptions& options = {},
                                const std::map<std::string, std::string>& beside = {}) {
  const ImportInput input{text,
                          "model",
                          [&](const std::string& name) -> std::optional<std::string> {
                            const auto found = beside.find(name);
                            return found == beside.end() ? std::nullopt : std::optional(found->second);
                          },
                          {}};
  return import_file(input, format, options);
}

/// The zone that is written, as dimdis reads it.
inline Zone zone_of(const ImportResult& result, Warnings* warnings = nullptr) {
  return read(result.zone, {}, warnings);
}

inline double total_area(const Zone& zone) {
  double sum = 0.0;
  for (const Surface& surface : zone.surfaces) sum += surface.polygon.area_m2();
  return sum;
}

inline bool warns_of(const Warnings& warnings, const std::string& words) {
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const Problem& warning) { return warning.what.find(words) != std::string::npos; });
}

/// What is said in refusing a text; empty where it is not.
inline std::string refusal(const std::string& text, const std::string& format,
                           const ImportOptions& options = {}) {
  try {
    import_text(text, format, options);
  } catch (const InputError& error) {
    return to_string(error.problems().at(0));
  } catch (const LimitError& error) {
    return error.what();
  }
  return "";
}

struct Triangle {
  std::string group;
  Vec3 a, b, c;
};

/// The six sides of a box, each of 2 n² triangles that face outwards, in groups NAME0 … NAME5 (bottom, top,
/// south, east, north, west).
inline std::vector<Triangle> box_triangles(const std::string& name, const Vec3& low, const Vec3& size,
                                           int n = 1) {
  std::vector<Triangle> triangles;
  const auto side = [&](int number, const Vec3& from, const Vec3& u, const Vec3& v) {
    const auto at = [&](int i, int k) { return from + u * (double(i) / n) + v * (double(k) / n); };
    const std::string group = name + std::to_string(number);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) {
        triangles.push_back({group, at(i, k), at(i + 1, k), at(i + 1, k + 1)});
        triangles.push_back({group, at(i, k), at(i + 1, k + 1), at(i, k + 1)});
      }
  };
  const Vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
  side(0, low, y, x);
  side(1, low + z, x, y);
  side(2, low, x, z);
  side(3, low + x, y, z);
  side(4, low + y, z, x);
  side(5, low, z, y);
  return triangles;
}

inline std::vector<Triangle> operator+(std::vector<Triangle> a, const std::vector<Triangle>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline std::string obj_text(const std::vector<Triangle>& triangles) {
  std::string text = "usemtl m\n", group;
  int n = 0;
  for (const Triangle& t : triangles) {
    if (t.group != group) text += "g " + t.group + "\n";
    group = t.group;
    for (const Vec3& p : {t.a, t.b, t.c}) text += fmt::format("v {:.17g} {:.17g} {:.17g}\n", p.x, p.y, p.z);
    text += fmt::format("f {} {} {}\n", n + 1, n + 2, n + 3);
    n += 3;
  }
  return text;
}

}  // namespace dim::test
