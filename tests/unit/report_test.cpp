#include <zlib.h>

#include <cmath>
#include <cstring>

#include "catch.hpp"
#include "report/page_files.hpp"
#include "report/packed.hpp"

using namespace dim;

namespace {

std::string text_of(std::span<const std::byte> bytes) { return base64(bytes); }

std::string decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned long bits = 0;
  int n_bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | digits.find(c);
    n_bits += 6;
    if (n_bits >= 8) bytes += static_cast<char>(bits >> (n_bits -= 8) & 255);
  }
  return bytes;
}

std::vector<unsigned char> unpacked(const std::string& text, std::size_t n) {
  const std::string small = decoded(text);
  std::vector<unsigned char> bytes(n + 1);
  uLongf size = bytes.size();
  REQUIRE(uncompress(bytes.data(), &size, reinterpret_cast<const Bytef*>(small.data()), small.size()) == Z_OK);
  REQUIRE(size == n);
  return bytes;
}

// As the page's script reads them.
std::vector<int> codes(const std::string& text, int width, std::size_t n) {
  const auto bytes = unpacked(text, 2 * n);
  std::vector<int> result;
  for (std::size_t i = 0; i < n; ++i) {
    const int zigzag = bytes[i] | bytes[n + i] << 8;
    const int difference = zigzag & 1 ? -((zigzag + 1) / 2) : zigzag / 2;
    const auto across = static_cast<std::size_t>(width);
    result.push_back((i % across != 0 ? result[i - 1] : i >= across ? result[i - across] : 0) + difference);
  }
  return result;
}

}  // namespace

TEST_CASE("Base64 is that of RFC 4648, section 10", "[report][unit]") {
  const auto of = [](const std::string& s) { return text_of(std::as_bytes(std::span(s))); };
  CHECK(of("") == "");
  CHECK(of("f") == "Zg==");
  CHECK(of("fo") == "Zm8=");
  CHECK(of("foo") == "Zm9v");
  CHECK(of("foob") == "Zm9vYg==");
  CHECK(of("fooba") == "Zm9vYmE=");
  CHECK(of("foobar") == "Zm9vYmFy");
}

TEST_CASE("Packed numbers come out again bit by bit", "[report][unit]") {
  const std::vector<float> values = {0.0F, -1.5F, 3.25e-20F, 1e30F, 500.0F};
  const auto bytes = unpacked(packed(values), values.size() * sizeof(float));
  CHECK(std::memcmp(bytes.data(), values.data(), values.size() * sizeof(float)) == 0);
}

TEST_CASE("Codes of a picture come out again, whatever their steps", "[report][unit]") {
  const std::vector<std::uint16_t> wanted = {0, 16383, 1, 1, 16383, 0, 7, 9000, 42};
  const auto got = codes(packed_codes(wanted, 3), 3, wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) CHECK(got[i] == static_cast<int>(wanted[i]));
}

TEST_CASE("A packed picture's luminance is within half a step over five decades", "[report][unit]") {
  Raster raster;
  raster.width = 40;
  raster.height = 3;
  for (int i = 0; i < 120; ++i) {
    const float y = i == 0 ? 0.0F : static_cast<float>(std::pow(10.0, -1.0 + 5.0 * i / 120.0));
    raster.xyz.insert(raster.xyz.end(), {0.95F * y, y, 1.1F * y});
  }
  const auto picture = packed_picture(raster);
  CHECK(picture.one_colour);
  CHECK(picture.x == Approx(0.95 / 3.05).margin(1e-6));
  const auto got = codes(picture.luminance, 40, 120);
  CHECK(got[0] == 0);
  for (std::size_t i = 1; i < 120; ++i) {
    const double y = picture.greatest_cd_m2 * std::exp((got[i] - kLuminanceCodes) * kLuminanceStep);
    CHECK(std::abs(std::log(y / static_cast<double>(raster.xyz[3 * i + 1]))) <= 0.51 * kLuminanceStep);
  }
}

TEST_CASE("Colours of a packed picture are within half a step of chromaticity", "[report][unit]") {
  Raster raster;
  raster.width = 2;
  raster.height = 1;
  raster.xyz = {41.24F, 21.26F, 1.93F, 18.05F, 7.22F, 95.05F};  // sRGB's red and blue
  const auto picture = packed_picture(raster);
  CHECK_FALSE(picture.one_colour);
  const auto x = codes(picture.x_codes, 2, 2), y = codes(picture.y_codes, 2, 2);
  CHECK(x[0] * kChromaticityStep == Approx(0.64).margin(5.5e-4));
  CHECK(y[0] * kChromaticityStep == Approx(0.33).margin(5.5e-4));
  CHECK(x[1] * kChromaticityStep == Approx(0.15).margin(5.5e-4));
  CHECK(y[1] * kChromaticityStep == Approx(0.06).margin(5.5e-4));
}

TEST_CASE("A black picture is packed as nothing", "[report][unit]") {
  Raster raster;
  raster.width = raster.height = 4;
  raster.xyz.assign(48, 0.0F);
  CHECK(packed_picture(raster).greatest_cd_m2 == 0.0);
  CHECK(packed_picture(raster).luminance.empty());
}

TEST_CASE("The page's files are in the library", "[report][unit]") {
  for (const char* mark : {"@TITLE@", "@STYLE@", "@SCRIPT@", "@DATA@"})
    CHECK(page_file("report.html").find(mark) != std::string_view::npos);
  CHECK_THROWS(page_file("nothing.js"));
}
