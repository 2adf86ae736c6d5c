#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace dim {

/// Values every 5 nm from 380 to 780 nm, how every table of this folder is kept. Sources and licences:
/// README.md beside this file.
inline constexpr std::size_t kTableSize = 81;
inline constexpr double kTableStep_nm = 5.0;
using FiveNanometreTable = std::span<const double, kTableSize>;

/// A relative spectral power distribution and the name it is asked for by.
struct TabulatedSpectrum {
  std::string_view name;
  FiveNanometreTable values;
};

}  // namespace dim
