#include "report/packed.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.hpp"

namespace dim {
namespace {

static_assert(std::endian::native == std::endian::little, "pages are written as numbers lie in memory");

constexpr double kOneColour = 2e-4;  // of chromaticity: what no eye tells apart

struct ChromaticityRange {
  double low_x = 1.0, high_x = 0.0, low_y = 1.0, high_y = 0.0;

  void add(double x, double y) {
    low_x = std::min(low_x, x), high_x = std::max(high_x, x);
    low_y = std::min(low_y, y), high_y = std::max(high_y, y);
  }
  bool is_one_colour() const { return high_x - low_x < kOneColour && high_y - low_y < kOneColour; }
};

bool is_lit(const float* xyz) {
  return xyz[1] > 0.0F && std::isfinite(xyz[0]) && std::isfinite(xyz[1]) && std::isfinite(xyz[2]);
}

Vec2 chromaticity(const float* xyz) {
  const double x = static_cast<double>(xyz[0]), y = static_cast<double>(xyz[1]), z = static_cast<double>(xyz[2]);
  return Vec2(x, y) / (x + y + z);
}

std::uint16_t luminance_code(double share) {
  const double steps = kLuminanceCodes + std::log(share) / kLuminanceStep;
  return static_cast<std::uint16_t>(std::clamp(std::lround(steps), 1L, static_cast<long>(kLuminanceCodes)));
}

std::uint16_t chromaticity_code(double v) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(v, 0.0, 1.0) / kChromaticityStep));
}

}  // namespace

std::string base64(std::span<const std::byte> bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    unsigned long group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < n ? std::to_integer<unsigned long>(bytes[i + k]) : 0UL);
    for (std::size_t k = 0; k < 4; ++k) text += k <= n ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string packed(std::span<const std::byte> bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<std::byte> small(size);
  constexpr int kLevel = 6;
  if (compress2(reinterpret_cast<Bytef*>(small.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), kLevel) != Z_OK)
    throw InternalError("a report's numbers could not be deflated");
  return base64({small.data(), size});
}

std::string packed(const std::vector<float>& values) { return packed(std::as_bytes(std::span(values))); }
std::string packed(const std::vector<std::uint32_t>& values) { return packed(std::as_bytes(std::span(values))); }
std::string packed(const std::vector<double>& values) { return packed(std::vector<float>(values.begin(), values.end())); }

std::string packed_codes(const std::vector<std::uint16_t>& codes, int width) {
  const auto across = static_cast<std::size_t>(width);
  std::vector<std::byte> bytes(2 * codes.size());
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const int before = i % across != 0 ? codes[i - 1] : i >= across ? codes[i - across] : 0;
    const int difference = codes[i] - before;
    const unsigned zigzag = difference < 0 ? static_cast<unsigned>(-2 * difference - 1) : static_cast<unsigned>(2 * difference);
    bytes[i] = static_cast<std::byte>(zigzag & 255U);
    bytes[codes.size() + i] = static_cast<std::byte>(zigzag >> 8);
  }
  return packed(bytes);
}

PackedPicture packed_picture(const Raster& raster) {
  PackedPicture picture;
  picture.width = raster.width;
  picture.height = raster.height;
  ChromaticityRange range;
  for (std::size_t i = 0; i < raster.n_pixels(); ++i) {
    const float* xyz = &raster.xyz[3 * i];
    if (!is_lit(xyz)) continue;
    picture.greatest_cd_m2 = std::max(picture.greatest_cd_m2, static_cast<double>(xyz[1]));
    const Vec2 xy = chromaticity(xyz);
    range.add(xy.x, xy.y);
  }
  if (picture.greatest_cd_m2 == 0.0) return picture;
  picture.one_colour = range.is_one_colour();
  picture.x = 0.5 * (range.low_x + range.high_x);
  picture.y = 0.5 * (range.low_y + range.high_y);
  std::vector<std::uint16_t> luminance(raster.n_pixels(), 0), x(raster.n_pixels(), 0), y(raster.n_pixels(), 0);
  for (std::size_t i = 0; i < raster.n_pixels(); ++i) {
    const float* xyz = &raster.xyz[3 * i];
    if (!is_lit(xyz)) continue;
    luminance[i] = luminance_code(static_cast<double>(xyz[1]) / picture.greatest_cd_m2);
    const Vec2 xy = chromaticity(xyz);
    x[i] = chromaticity_code(xy.x);
    y[i] = chromaticity_code(xy.y);
  }
  picture.luminance = packed_codes(luminance, raster.width);
  if (picture.one_colour) return picture;
  picture.x_codes = packed_codes(x, raster.width);
  picture.y_codes = packed_codes(y, raster.width);
  return picture;
}

}  // namespace dim
