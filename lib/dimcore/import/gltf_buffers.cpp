#include "import/gltf_buffers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "import/byte_reader.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {
namespace {

constexpr int kInt8 = 5120, kUint8 = 5121, kInt16 = 5122, kUint16 = 5123, kUint32 = 5125, kFloat = 5126;

std::size_t size_of_component(const JsonNode& accessor) {
  switch (static_cast<int>(accessor["componentType"].number(kInt8, kFloat))) {
    case kInt8:
    case kUint8:
      return 1;
    case kInt16:
    case kUint16:
      return 2;
    case kUint32:
    case kFloat:
      return 4;
    default:
      accessor["componentType"].fail("is of no kind that glTF knows");
  }
}

int base64_value(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' || c == '-' ? 62 : c == '/' || c == '_' ? 63 : -1;
}

std::string from_base64(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  unsigned bits = 0;
  int n_bits = 0;
  for (const char c : text) {
    const int value = base64_value(c);
    if (value < 0) continue;  // padding, line ends
    bits = (bits << 6 | static_cast<unsigned>(value)) & 0xFFFFFFu;
    n_bits += 6;
    if (n_bits < 8) continue;
    n_bits -= 8;
    bytes += static_cast<char>(bits >> n_bits & 0xFFu);
  }
  return bytes;
}

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

std::string without_percent(std::string_view uri) {
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool is_code =
        uri[i] == '%' && i + 2 < uri.size() && hex_value(uri[i + 1]) >= 0 && hex_value(uri[i + 2]) >= 0;
    path += is_code ? static_cast<char>(hex_value(uri[i + 1]) * 16 + hex_value(uri[i + 2])) : uri[i];
    if (is_code) i += 2;
  }
  return path;
}

std::string bytes_of(const JsonNode& buffer, const ImportInput& input) {
  const std::string uri = buffer["uri"].text();
  if (uri.starts_with("data:")) {
    const auto comma = uri.find(',');
    if (comma == std::string::npos || uri.substr(0, comma).find(";base64") == std::string::npos)
      buffer["uri"].fail("is no data in base64");
    return from_base64(std::string_view(uri).substr(comma + 1));
  }
  auto bytes = input.beside(without_percent(uri));
  if (!bytes)
    throw InputError({input.place(0),
                      fmt::format("the file {}, which holds the geometry, is not there", dim::quoted(uri)),
                      "put it beside the model"});
  return std::move(*bytes);
}

double component_at(const char* at, int kind, bool normalized) {
  switch (kind) {
    case kInt8:
      return std::max(number_at<std::int8_t>(at, false) / (normalized ? 127.0 : 1.0),
                      normalized ? -1.0 : -128.0);
    case kUint8:
      return number_at<std::uint8_t>(at, false) / (normalized ? 255.0 : 1.0);
    case kInt16:
      return std::max(number_at<std::int16_t>(at, false) / (normalized ? 32767.0 : 1.0),
                      normalized ? -1.0 : -32768.0);
    case kUint16:
      return number_at<std::uint16_t>(at, false) / (normalized ? 65535.0 : 1.0);
    case kUint32:
      return number_at<std::uint32_t>(at, false);
    default:
      return static_cast<double>(number_at<float>(at, false));
  }
}

}  // namespace

GltfBuffers::GltfBuffers(const JsonNode& root, std::string_view binary, const ImportInput& input)
    : root_(root) {
  const std::size_t n = root.count("buffers");
  owned_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const JsonNode buffer = root["buffers"].at(i);
    const bool is_chunk = i == 0 && !buffer.has("uri");
    if (!is_chunk) owned_[i] = bytes_of(buffer, input);
    std::string_view bytes = is_chunk ? binary : std::string_view(owned_[i]);
    const std::size_t stated = buffer["byteLength"].index(kMaxImportBytes);
    if (bytes.size() < stated) buffer.fail(fmt::format("holds {} bytes instead of {}", bytes.size(), stated));
    buffers_.push_back(bytes.substr(0, stated));
  }
}

GltfBuffers::Numbers GltfBuffers::numbers(std::size_t index, const char* type,
                                          std::size_t n_components) const {
  const JsonNode accessor = root_["accessors"].at(index);
  if (accessor["type"].text() != type) accessor.fail(fmt::format("is no {}", type));
  if (accessor.has("sparse")) accessor.fail("is sparse, which is not read");
  Numbers numbers;
  numbers.component = static_cast<int>(accessor["componentType"].number());
  numbers.normalized = accessor.flag("normalized", false);
  numbers.n = accessor["count"].index(kMaxImportedCorners);
  const JsonNode view = root_["bufferViews"].at(accessor["bufferView"].index(root_.count("bufferViews")));
  const std::size_t element = n_components * size_of_component(accessor);
  numbers.stride = view.has("byteStride") ? view["byteStride"].index(1 << 20) : element;
  const std::string_view buffer = buffers_[view["buffer"].index(buffers_.size())];
  const std::size_t start = view.whole("byteOffset", 0), length = view["byteLength"].index(kMaxImportBytes);
  const std::size_t offset = accessor.whole("byteOffset", 0);
  const bool fits = start <= buffer.size() && length <= buffer.size() - start && offset <= length &&
                    (numbers.n == 0 || (element <= length - offset &&
                                        (numbers.n - 1) * numbers.stride <= length - offset - element));
  if (!fits) accessor.fail("reaches beyond its buffer");
  numbers.first = buffer.data() + start + offset;
  return numbers;
}

std::vector<Vec3> GltfBuffers::positions(std::size_t accessor) const {
  const Numbers numbers = this->numbers(accessor, "VEC3", 3);
  const std::size_t size = size_of_component(root_["accessors"].at(accessor));
  std::vector<Vec3> positions;
  for (std::size_t i = 0; i < numbers.n; ++i) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = component_at(numbers.first + i * numbers.stride + static_cast<std::size_t>(axis) * size,
                             numbers.component, numbers.normalized);
    if (!is_finite(p)) root_["accessors"].at(accessor).fail("holds values that are no numbers");
    positions.push_back(p);
  }
  return positions;
}

std::vector<std::uint32_t> GltfBuffers::indices(std::size_t accessor) const {
  const Numbers numbers = this->numbers(accessor, "SCALAR", 1);
  if (numbers.component != kUint8 && numbers.component != kUint16 && numbers.component != kUint32)
    root_["accessors"].at(accessor).fail("is no list of indices");
  std::vector<std::uint32_t> indices;
  for (std::size_t i = 0; i < numbers.n; ++i)
    indices.push_back(static_cast<std::uint32_t>(
        component_at(numbers.first + i * numbers.stride, numbers.component, false)));
  return indices;
}

}  // namespace dim
