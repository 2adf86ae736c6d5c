#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "catch.hpp"
#include "image/writer.hpp"
#include "image_file_support.hpp"

namespace fs = std::filesystem;
using dim::PictureFormat;
using dim::Raster;
using dim::Vec3;
using dim::test::kModuleDir;
using dim::test::TempFolder;

namespace {

/// 40 x 9: luminance 0.01 to 10,000 cd/m2 along x; rows alternate equal-energy grey and two colours.
Raster sample() {
  Raster raster{40, 9, {}, {}, "lx"};
  const Vec3 colours[3] = {{1, 1, 1}, {1.3, 1, 0.6}, {0.8, 1, 1.4}};
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      const double luminance = std::pow(10.0, -2 + 6.0 * x / (raster.width - 1));
      for (int c = 0; c < 3; ++c) raster.xyz.push_back(static_cast<float>(luminance * colours[y % 3][c]));
      raster.scalar.push_back(static_cast<float>(luminance));
    }
  }
  return raster;
}

struct ReadBack {
  OIIO::ImageSpec spec;
  std::vector<float> values;
};

ReadBack read(const std::string& path) {
  const auto input = OIIO::ImageInput::open(path);
  REQUIRE(input);
  ReadBack result;
  result.spec = input->spec();
  result.values.resize(static_cast<std::size_t>(result.spec.image_pixels()) *
                       static_cast<std::size_t>(result.spec.nchannels));
  REQUIRE(input->read_image(0, 0, 0, result.spec.nchannels, OIIO::TypeDesc::FLOAT, result.values.data()));
  return result;
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("A PNG reads back as the toned pixels, 8-bit sRGB, with its exposure in words", "[image][unit]") {
  const TempFolder folder;
  const Raster raster = sample();
  dim::PictureOptions options;
  options.linear.display_white_cd_m2 = 200;
  options.notes.software = "DIM test";
  const auto report = dim::write_picture(kModuleDir, folder / "a.png", raster, options);
  CHECK(report.display_white_cd_m2 == 200);
  CHECK_FALSE(report.automatic_exposure);
  CHECK(report.n_above_white > 0);
  const ReadBack back = read(folder / "a.png");
  CHECK(back.spec.format == OIIO::TypeDesc::UINT8);
  CHECK(back.spec.nchannels == 3);
  CHECK(back.spec.get_string_attribute("oiio:ColorSpace") == "sRGB");
  CHECK(back.spec.get_string_attribute("Software") == "DIM test");
  CHECK(back.spec.get_string_attribute("ImageDescription") == "linear tone, white = 200 cd/m2");
  CHECK(bytes_of(folder / "a.png").find("sRGB") != std::string::npos);
  const auto expected = dim::tone_linear(raster, options.linear).picture.rgb;
  REQUIRE(back.values.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    REQUIRE(std::lround(back.values[i] * 255) == expected[i]);
  }
}

TEST_CASE("A Radiance picture holds luminance / 179 within its one-byte mantissa", "[image][unit]") {
  const TempFolder folder;
  const Raster raster = sample();
  dim::PictureOptions options;
  options.format = PictureFormat::radiance_hdr;
  options.notes.software = "DIM test\nnot a header line";
  options.notes.radiance_view = "-vtv -vp 0 0 1.6 -vd 0 1 0 -vu 0 0 1 -vh 70 -vv 55";
  dim::write_picture(kModuleDir, folder / "a.hdr", raster, options);
  const ReadBack back = read(folder / "a.hdr");
  const Vec3 weights = dim::luminance_weights(dim::kRadiancePrimaries);
  for (std::size_t i = 0; i < raster.n_pixels(); ++i) {
    const Vec3 rgb(back.values[3 * i], back.values[3 * i + 1], back.values[3 * i + 2]);
    const double exact = static_cast<double>(raster.xyz[3 * i + 1]);
    const double luminance = 179 * glm::dot(rgb, weights);
    // Mantissas are cut to 8 bits: up to 1/128 of the greatest component too low, never too high.
    REQUIRE(luminance <= exact * (1 + 1e-5));
    REQUIRE(luminance >= exact - 179 * std::max({rgb.x, rgb.y, rgb.z}) * 1.01 / 128);
  }
}

TEST_CASE("A Radiance header names primaries, exposure, software and view before the blank line",
          "[image][unit]") {
  const TempFolder folder;
  dim::PictureOptions options;
  options.format = PictureFormat::radiance_hdr;
  options.notes.software = "DIM test\nnot a header line";
  options.notes.radiance_view = "-vtv -vh 70";
  dim::write_picture(kModuleDir, folder / "a.hdr", sample(), options);
  const std::string bytes = bytes_of(folder / "a.hdr");
  const std::string header = bytes.substr(0, bytes.find("\n\n"));
  CHECK(header.find("#?RADIANCE\n") == 0);
  CHECK(header.find("\nPRIMARIES= 0.6400 0.3300 0.2900 0.6000 0.1500 0.0600 0.3333 0.3333\n") !=
        std::string::npos);
  CHECK(header.find("\nEXPOSURE=1\n") != std::string::npos);
  CHECK(header.find("\nSOFTWARE= DIM test not a header line\n") != std::string::npos);
  CHECK(header.find("\nVIEW= -vtv -vh 70\n") != std::string::npos);
  CHECK(header.find("\nFORMAT=32-bit_rle_rgbe") != std::string::npos);
  CHECK(bytes.find("\n\n-Y 9 +X 40\n") != std::string::npos);
}

TEST_CASE("An OpenEXR file gives XYZ in cd/m2 back from its own attributes", "[image][unit]") {
  const TempFolder folder;
  const Raster raster = sample();
  dim::PictureOptions options;
  options.format = PictureFormat::exr;
  options.linear.scene_white_xyz = Vec3(0.98, 1.0, 0.9);
  dim::write_picture(kModuleDir, folder / "a.exr", raster, options);

  const Imf::InputFile file((folder / "a.exr").c_str());
  const Imf::Header& header = file.header();
  CHECK(header.compression() == Imf::ZIP_COMPRESSION);
  CHECK(header.typedAttribute<Imf::StringAttribute>("unit").value() == "cd/m2");
  CHECK(Imf::whiteLuminance(header) == 1.0f);
  const Imf::Chromaticities c = Imf::chromaticities(header);
  const auto point = [](const Imath::V2f& v) {
    return dim::Chromaticity{static_cast<double>(v.x), static_cast<double>(v.y)};
  };
  const glm::dmat3 to_xyz = dim::rgb_to_xyz({point(c.red), point(c.green), point(c.blue), point(c.white)}) *
                            static_cast<double>(Imf::whiteLuminance(header));
  CHECK(header.channels().findChannel("R")->type == Imf::FLOAT);

  const ReadBack back = read(folder / "a.exr");
  REQUIRE(back.spec.nchannels == 4);
  CHECK(back.spec.channelnames == std::vector<std::string>{"R", "G", "B", "luminance.Y"});
  for (std::size_t i = 0; i < raster.n_pixels(); ++i) {
    const Vec3 xyz = to_xyz * Vec3(back.values[4 * i], back.values[4 * i + 1], back.values[4 * i + 2]);
    for (int k = 0; k < 3; ++k) {
      REQUIRE(xyz[k] == Approx(raster.xyz[3 * i + static_cast<std::size_t>(k)]).epsilon(1e-5));
    }
    REQUIRE(back.values[4 * i + 3] == raster.xyz[3 * i + 1]);
  }
}

TEST_CASE("A false-colour PNG carries a legend and reads back in its colours", "[image][unit]") {
  const TempFolder folder;
  const Raster raster = sample();
  dim::PictureOptions options;
  options.tone = dim::Tone::false_colour;
  options.false_colour.kind = dim::ScaleKind::logarithmic;
  const auto report = dim::write_picture(kModuleDir, folder / "a.png", raster, options);
  CHECK(report.width > raster.width);
  CHECK(report.scale.low == Approx(1));
  CHECK(report.scale.high == Approx(10000));
  CHECK(report.warnings.empty());
  const ReadBack back = read(folder / "a.png");
  CHECK(back.spec.width == report.width);
  CHECK(back.spec.height == report.height);
  const dim::Rgb8 top = dim::colour_map(1);
  for (std::size_t c = 0; c < 3; ++c) CHECK(std::lround(255 * back.values[39 * 3 + c]) == top[c]);
}

TEST_CASE("Words on pictures are drawn, anti-aliased, clipped at the edge", "[image][unit]") {
  const dim::PictureModule module(kModuleDir);
  if (!module.available()) {
    WARN("skipped: " << module.no_font_reason());
    return;
  }
  const dim::TextExtent extent = module.measure("cd/m²", 20);
  CHECK(extent.width > 40);
  CHECK(extent.above >= 14);
  dim::Picture8 picture{60, 30, std::vector<std::uint8_t>(60 * 30 * 3, 255)};
  module.draw(picture, 2, 22, "cd/m²", 20, {0, 0, 0});
  std::size_t black = 0;
  std::size_t between = 0;
  for (const auto v : picture.rgb) {
    black += v < 32;
    between += v >= 32 && v < 224;
  }
  CHECK(black > 100);
  CHECK(between > 100);
  CHECK_NOTHROW(module.draw(picture, 50, 22, "a long text", 20, {0, 0, 0}));
}

TEST_CASE("A superscript two is drawn small and high, an unknown character as a question mark",
          "[image][unit]") {
  const dim::PictureModule module(kModuleDir);
  if (!module.available()) {
    WARN("skipped: " << module.no_font_reason());
    return;
  }
  const auto drawn = [&](const std::string& text) {
    dim::Picture8 picture{200, 60, std::vector<std::uint8_t>(200 * 60 * 3, 255)};
    module.draw(picture, 5, 45, text, 40, {0, 0, 0});
    return picture;
  };
  const dim::Picture8 two = drawn("²");
  std::size_t above = 0;
  std::size_t below = 0;
  for (std::size_t i = 0; i < two.n_pixels(); ++i) {
    // The upper and lower half of a capital: the baseline is row 45, the letter height about 29.
    if (two.rgb[3 * i] < 128) ++(i / 200 < 34 ? above : below);
  }
  CHECK(above > 20);
  CHECK(below == 0);
  CHECK(module.measure("cd/m²", 40).width < module.measure("cd/m2", 40).width);
  CHECK(drawn("≥").rgb == drawn("?").rgb);
  CHECK(drawn("ä").rgb == drawn("?").rgb);
  CHECK_NOTHROW(drawn("\xe2\x89"));
  CHECK_NOTHROW(drawn(""));
}

TEST_CASE("The same raster gives the same bytes", "[image][unit]") {
  const dim::PictureModule module(kModuleDir);
  for (const auto format : {PictureFormat::png, PictureFormat::radiance_hdr, PictureFormat::exr}) {
    dim::PictureOptions options;
    options.format = format;
    const std::string first = dim::encode_picture(module, sample(), options).bytes;
    CHECK(first == dim::encode_picture(module, sample(), options).bytes);
    CHECK(first.size() > 100);
  }
}

TEST_CASE("Every format takes a picture of one pixel and one that is dark", "[image][unit]") {
  const dim::PictureModule module(kModuleDir);
  const Raster dark{1, 1, {0, 0, 0}, {0}, "lx"};
  for (const auto format : {PictureFormat::png, PictureFormat::radiance_hdr, PictureFormat::exr}) {
    dim::PictureOptions options;
    options.format = format;
    CHECK_NOTHROW(dim::encode_picture(module, dark, options));
    options.tone = dim::Tone::false_colour;
    CHECK_NOTHROW(dim::encode_picture(module, dark, options));
  }
}

TEST_CASE("A missing or foreign picture module is an IoError that names it", "[image][unit]") {
  const TempFolder folder;
  try {
    dim::write_picture(folder / "nowhere", folder / "a.png", sample(), {});
    FAIL("nothing thrown");
  } catch (const dim::IoError& error) {
    CHECK(std::string(error.what()).find("nowhere/dimimage.so: the module that writes pictures is missing") !=
          std::string::npos);
  }
  CHECK_FALSE(fs::exists(folder / "a.png"));
  std::ofstream(folder / "dimimage.so") << "not a library";
  CHECK_THROWS_AS(dim::PictureModule(folder.path.string()), dim::IoError);
}

TEST_CASE("A path that cannot be written is an IoError", "[image][unit]") {
  const TempFolder folder;
  CHECK_THROWS_AS(dim::write_picture(kModuleDir, folder / "no such folder/a.png", sample(), {}),
                  dim::IoError);
  CHECK_THROWS_AS(dim::write_picture(kModuleDir, folder.path.string(), sample(), {}), dim::IoError);
}

TEST_CASE("The format follows the file name's ending", "[image][unit]") {
  CHECK(dim::picture_format_of("a/b.PNG") == PictureFormat::png);
  CHECK(dim::picture_format_of("b.hdr") == PictureFormat::radiance_hdr);
  CHECK(dim::picture_format_of("b.x.exr") == PictureFormat::exr);
  CHECK_FALSE(dim::picture_format_of("png"));
  CHECK_FALSE(dim::picture_format_of("b.jpg"));
}
