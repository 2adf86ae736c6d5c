#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <sstream>

#include "catch.hpp"
#include "image/writer.hpp"
#include "image_file_support.hpp"

using dim::PictureFormat;
using dim::Raster;
using dim::test::kModuleDir;
using dim::test::TempFolder;

namespace {

// 5 x 3 pixels, three bands of unequal width; each value tells pixel and band apart.
Raster spectral_sample() {
  Raster raster{5, 3};
  raster.xyz.assign(3 * raster.n_pixels(), 20.0f);
  raster.band_edges_nm = {380, 499.5, 600, 780};
  for (std::size_t i = 0; i < 3 * raster.n_pixels(); ++i) {
    raster.radiance.push_back(0.25f * static_cast<float>(i + 1));
  }
  return raster;
}

std::string write_exr(const TempFolder& folder, const Raster& raster) {
  dim::PictureOptions options;
  options.format = PictureFormat::exr;
  const std::string path = folder / "s.exr";
  dim::write_picture(kModuleDir, path, raster, options);
  return path;
}

std::vector<float> channel_of(Imf::InputFile& file, const char* name) {
  const auto window = file.header().dataWindow();
  const auto width = static_cast<std::size_t>(window.max.x + 1);
  std::vector<float> values(width * static_cast<std::size_t>(window.max.y + 1));
  Imf::FrameBuffer frame;
  frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float),
                                sizeof(float) * width));
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  return values;
}

std::string text_of(const Imf::InputFile& file, const char* name) {
  return file.header().typedAttribute<Imf::StringAttribute>(name).value();
}

}  // namespace

TEST_CASE("Spectral channels are named by band centre with a decimal comma", "[image][unit]") {
  CHECK(dim::spectral_channel_name(550) == "S0.550,0nm");
  CHECK(dim::spectral_channel_name(439.75) == "S0.439,75nm");
  // What the reader of the layout's authors takes (library spectral-exr).
  const std::regex pattern(
      R"(^S([0-3])\.(\d*,?\d*([Ee][+-]?\d+)?)(Y|Z|E|P|T|G|M|k|h|da|d|c|m|u|n|p)?(m|Hz)$)");
  for (const double wavelength : {380.0, 382.5, 555.0 + 1.0 / 3.0, 779.9999}) {
    CHECK(std::regex_match(dim::spectral_channel_name(wavelength), pattern));
  }
}

TEST_CASE("A spectral OpenEXR file has a channel a band beside R, G, B and luminance", "[image][unit]") {
  const TempFolder folder;
  const std::string path = write_exr(folder, spectral_sample());
  const auto input = OIIO::ImageInput::open(path);
  REQUIRE(input);
  auto names = input->spec().channelnames;
  std::sort(names.begin(), names.end());
  CHECK(names ==
        std::vector<std::string>{"B", "G", "R", "S0.439,75nm", "S0.549,75nm", "S0.690,0nm", "luminance.Y"});
  const Imf::InputFile file(path.c_str());
  CHECK(file.header().channels().findChannel("S0.690,0nm")->type == Imf::FLOAT);
}

TEST_CASE("A spectral OpenEXR file says layout, unit and exact band edges", "[image][unit]") {
  const TempFolder folder;
  Raster raster = spectral_sample();
  raster.band_edges_nm[1] = 500 - 1.0 / 3.0;
  const Imf::InputFile file(write_exr(folder, raster).c_str());
  CHECK(text_of(file, "spectralLayoutVersion") == "1.0");
  CHECK(text_of(file, "emissiveUnits") == "W.m^-2.sr^-1.nm^-1");
  std::istringstream edges(text_of(file, "bandEdges_nm"));
  std::vector<double> read;
  for (std::string word; edges >> word;) read.push_back(std::strtod(word.c_str(), nullptr));
  CHECK(read == raster.band_edges_nm);
}

TEST_CASE("Spectral radiance times the bands' widths gives the radiance back", "[image][unit]") {
  const TempFolder folder;
  const Raster raster = spectral_sample();
  Imf::InputFile file(write_exr(folder, raster).c_str());
  const char* names[] = {"S0.439,75nm", "S0.549,75nm", "S0.690,0nm"};
  const double widths_nm[] = {119.5, 100.5, 180};
  for (std::size_t b = 0; b < 3; ++b) {
    const auto values = channel_of(file, names[b]);
    REQUIRE(values.size() == raster.n_pixels());
    for (std::size_t i = 0; i < values.size(); ++i) {
      REQUIRE(static_cast<double>(values[i]) * widths_nm[b] ==
              Approx(raster.radiance[3 * i + b]).epsilon(1e-6));
    }
  }
  const auto luminance = channel_of(file, "luminance.Y");
  CHECK(luminance == std::vector<float>(raster.n_pixels(), 20.0f));
}

TEST_CASE("Without radiance an OpenEXR file has no spectral channel and says no layout", "[image][unit]") {
  const TempFolder folder;
  Raster raster = spectral_sample();
  raster.radiance.clear();
  const Imf::InputFile file(write_exr(folder, raster).c_str());
  CHECK(file.header().find("spectralLayoutVersion") == file.header().end());
  int n_channels = 0;
  for (auto c = file.header().channels().begin(); c != file.header().channels().end(); ++c) ++n_channels;
  CHECK(n_channels == 4);
}

TEST_CASE("Radiance that is no number becomes zero", "[image][unit]") {
  Raster raster = spectral_sample();
  raster.radiance[0] = std::nanf("");
  raster.radiance[1] = HUGE_VALF;
  const auto pixels = dim::spectral_pixels(raster);
  CHECK(pixels.values[0] == 0.0f);
  CHECK(pixels.values[1] == 0.0f);
  CHECK(pixels.values[2] > 0.0f);
}

TEST_CASE("Radiance that does not belong to its bands is a broken raster", "[image][unit]") {
  Raster raster = spectral_sample();
  raster.radiance.pop_back();
  CHECK_THROWS_AS(dim::spectral_pixels(raster), dim::InternalError);
  for (const auto& edges : {std::vector<double>{}, {380, 780}, {380, 500, 500, 780}, {380, 600, 500, 780}}) {
    raster = spectral_sample();
    raster.band_edges_nm = edges;
    CHECK_THROWS_AS(dim::spectral_pixels(raster), dim::InternalError);
  }
}

TEST_CASE("A PNG of Stevens' tone says in words what the eye is adapted to", "[image][unit]") {
  const TempFolder folder;
  Raster raster{2, 1, {10, 10, 10, 40, 40, 40}};
  dim::PictureOptions options;
  options.tone = dim::Tone::stevens;
  const auto report = dim::write_picture(kModuleDir, folder / "b.png", raster, options);
  CHECK(report.scene_adaptation_cd_m2 == Approx(20));
  const auto input = OIIO::ImageInput::open(folder / "b.png");
  REQUIRE(input);
  CHECK(input->spec().get_string_attribute("ImageDescription") ==
        "Stevens brightness mapping, eye adapted to 20 cd/m2, screen of 100 cd/m2");
  std::vector<float> values(6);
  REQUIRE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, values.data()));
  dim::ToneOptions tone;
  tone.display_white_cd_m2 = 100;
  const auto expected = dim::tone_linear(dim::map_brightness(raster).shown, tone).picture.rgb;
  for (std::size_t i = 0; i < 6; ++i) CHECK(std::lround(values[i] * 255) == expected[i]);
}
