#include "image/module/text.hpp"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <array>
#include <stdexcept>
#include <string>

namespace dim::image_module {
namespace {

// Sans-serif fonts that systems have; OpenImageIO looks through the usual font folders.
constexpr std::array<const char*, 6> kFonts = {
    "DejaVuSans", "LiberationSans-Regular", "NotoSans-Regular", "DroidSans", "FreeSans", "Arial"};

// Looking through the folders takes a while: once.
const std::string& font_name() {
  static const std::string found = [] {
    for (const char* name : kFonts) {
      if (OIIO::ImageBufAlgo::text_size("0", 16, name).defined()) return std::string(name);
    }
    OIIO::geterror();
    return std::string();
  }();
  if (found.empty()) {
    throw std::runtime_error("no font for words on pictures is installed (Debian: fonts-dejavu-core)");
  }
  return found;
}

}  // namespace

DimImageExtent measure_text(const DimImageText& text) {
  const OIIO::ROI box = OIIO::ImageBufAlgo::text_size(text.utf8, text.size_px, font_name());
  if (!box.defined()) return {0, 0, 0};
  return {box.xend, -box.ybegin, box.yend};
}

void draw_text(const DimImageText& text, std::uint8_t* rgb, int width, int height) {
  const std::string& font = font_name();
  OIIO::ImageBuf picture(OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::UINT8), rgb);
  std::array<float, 3> colour{};
  for (std::size_t i = 0; i < 3; ++i) colour[i] = static_cast<float>(text.colour[i]) / 255.0f;
  using namespace OIIO::ImageBufAlgo;
  if (!render_text(picture, text.x, text.y, text.utf8, text.size_px, font, colour, TextAlignX::Left,
                   TextAlignY::Baseline, 0, {}, 1)) {
    throw std::runtime_error(picture.geterror());
  }
}

}  // namespace dim::image_module
