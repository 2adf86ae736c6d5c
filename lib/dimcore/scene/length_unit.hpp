#pragma once

#include <array>
#include <optional>
#include <string>

namespace dim {

/// A unit of length that files may be written in.
struct LengthUnit {
  const char* name;
  double metres;
};

inline constexpr std::array<LengthUnit, 5> kLengthUnits = {
    {{"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}, {"in", 0.0254}, {"ft", 0.3048}}};

/// Length of a unit by its name in a zone file, m; nothing for other words.
inline std::optional<double> unit_named(const std::string& name) {
  for (const LengthUnit& unit : kLengthUnits)
    if (name == unit.name) return unit.metres;
  return std::nullopt;
}

}  // namespace dim
