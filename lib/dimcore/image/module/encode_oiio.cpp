#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

#include "image/module/encode.hpp"

namespace dim::image_module {
namespace {

std::vector<std::uint8_t> encode(const std::string& name, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                                 const void* pixels) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(name);
  if (!output) throw std::runtime_error(OIIO::geterror());
  if (!output->supports("ioproxy") || !output->set_ioproxy(&memory)) {
    throw std::runtime_error("this OpenImageIO cannot write '" + name + "' to memory");
  }
  if (!output->open(name, spec) || !output->write_image(type, pixels) || !output->close()) {
    throw std::runtime_error(output->geterror());
  }
  return bytes;
}

// A header line of the Radiance format cannot hold a line break.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, ' ');
  return text;
}

std::string radiance_header_lines(const DimImagePicture& picture) {
  std::string lines = "SOFTWARE= " + one_line(picture.software) + "\n";
  if (*picture.description) lines += "COMMENT= " + one_line(picture.description) + "\n";
  if (*picture.view) lines += "VIEW= " + one_line(picture.view) + "\n";
  lines += "EXPOSURE=1\nPRIMARIES=";
  for (const double xy : picture.primaries_xy) {
    char number[32];
    std::snprintf(number, sizeof number, " %.4f", xy);
    lines += number;
  }
  return lines + "\n";
}

}  // namespace

std::vector<std::uint8_t> encode_png(const DimImagePicture& picture) {
  OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("Software", picture.software);
  if (*picture.description) spec.attribute("Description", picture.description);
  return encode("dim.png", spec, OIIO::TypeDesc::UINT8, picture.coded);
}

std::vector<std::uint8_t> encode_radiance(const DimImagePicture& picture) {
  const OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::FLOAT);
  std::vector<std::uint8_t> bytes = encode("dim.hdr", spec, OIIO::TypeDesc::FLOAT, picture.linear);
  // OpenImageIO's writer knows neither PRIMARIES nor EXPOSURE; the lines go behind its first, "#?RADIANCE".
  const auto line_end = std::find(bytes.begin(), bytes.end(), '\n');
  if (line_end == bytes.end()) throw std::runtime_error("OpenImageIO wrote no Radiance header");
  const std::string lines = radiance_header_lines(picture);
  bytes.insert(line_end + 1, lines.begin(), lines.end());
  return bytes;
}

}  // namespace dim::image_module
