#pragma once

#include <string>
#include <vector>

#include "base/vec.hpp"
#include "database/toml_reader.hpp"
#include "scene/lights.hpp"

namespace dim {

/// Most luminaires of one file, fields expanded.
inline constexpr std::size_t kMaxLuminaires = 100'000;

/// Largest number of luminaires along one direction of a field.
inline constexpr int kMaxCount = 10000;

/// One luminaire of an entry that stands for several.
struct FieldPlace {
  std::string suffix;     ///< "[i,j]" or "[i]"; empty for a single luminaire
  Vec3 at{0.0};           ///< in the file's unit
  double turn_rad = 0.0;  ///< of the whole luminaire about the vertical, counter-clockwise seen from above
};

/// Reads `at` and what may multiply it, one of:
///   count = [nx, ny], pitch = [px, py]: a field along the zone's x and y; along = "own": along the
///   luminaire's
///     c0 and c90; along = [[x, y, z], [x, y, z]]: along these directions
///   line = { from, to, count }: evenly from end to end, both included; in place of `at`
///   ring = { radius, count, start }: on a horizontal circle about `at`, from `start` degrees (0: +x) on,
///     counter-clockwise seen from above, each luminaire turned along with it
/// @param luminaire  its axes, for along = "own"
/// @param most       how many more the file may have
/// @returns empty where something is wrong, which is reported
std::vector<FieldPlace> read_field(const TomlTable& table, const Luminaire& luminaire, std::size_t most);

/// A vector turned about the vertical.
Vec3 turned_about_vertical(const Vec3& v, double angle_rad);

}  // namespace dim
