#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "import/import_input.hpp"

namespace dim {

enum class PlyEncoding : std::uint8_t { text, little_endian, big_endian };
enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(PlyType type);
double as_double(PlyType type, const char* bytes, bool is_big_endian);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::size_t n = 0;
  std::vector<PlyProperty> properties;
  int line = 0;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::text;
  std::vector<PlyElement> elements;
  std::size_t body = 0;  ///< first byte behind the header
  int n_lines = 0;       ///< of the header
};

/// @throws InputError  not a PLY header, or one of a kind that is not known
PlyHeader read_ply_header(const ImportInput& input);

}  // namespace dim
