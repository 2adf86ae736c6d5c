#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace dim {

/// A number as it stands in memory, in the byte order said.
/// @param bytes  at least sizeof(Number)
template <typename Number>
Number number_at(const char* bytes, bool is_big_endian) {
  char ordered[sizeof(Number)];
  for (std::size_t i = 0; i < sizeof(Number); ++i)
    ordered[i] =
        bytes[is_big_endian == (std::endian::native == std::endian::big) ? i : sizeof(Number) - 1 - i];
  Number number;
  std::memcpy(&number, ordered, sizeof(Number));
  return number;
}

}  // namespace dim
