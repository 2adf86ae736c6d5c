#include "image/module/text.hpp"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

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

// A stretch of text of one size on one baseline.
struct Run {
  std::string ascii;
  int size_px = 0;
  int raised_px = 0;
};

constexpr std::array<std::string_view, 4> kSuperscripts = {"\u00b9", "\u00b2", "\u00b3", "\u2070"};
constexpr std::string_view kSuperscriptDigits = "1230";

// Bytes of the UTF-8 character that starts with `first`.
std::size_t length_of_character(unsigned char first) {
  if (first < 0xc0) return 1;
  return first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
}

void append(std::vector<Run>& runs, char c, int size_px, int raised_px) {
  if (runs.empty() || runs.back().size_px != size_px) runs.push_back({"", size_px, raised_px});
  runs.back().ascii += c;
}

// OpenImageIO 2.4 keeps only the last six bits of a character beyond ASCII (a superscript two comes out as a
// plain 2, a greater-or-equal as a percent sign), so that no such character may reach it.
std::vector<Run> runs_of(std::string_view utf8, int size_px) {
  const int small_px = std::max(6, size_px * 5 / 8);
  const int raised_px = size_px * 3 / 10;
  std::vector<Run> runs;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto character = utf8.substr(i, length_of_character(static_cast<unsigned char>(utf8[i])));
    i += character.size();
    const auto found = std::find(kSuperscripts.begin(), kSuperscripts.end(), character);
    if (found != kSuperscripts.end()) {
      append(runs, kSuperscriptDigits[static_cast<std::size_t>(found - kSuperscripts.begin())], small_px,
             raised_px);
    } else {
      const char c = character[0];
      append(runs, character.size() == 1 && c >= ' ' && c <= '~' ? c : '?', size_px, 0);
    }
  }
  return runs;
}

OIIO::ROI box_of(const Run& run) {
  return OIIO::ImageBufAlgo::text_size(run.ascii, run.size_px, font_name());
}

int gap_after(const Run& run) { return std::max(1, run.size_px / 16); }

}  // namespace

DimImageExtent measure_text(const DimImageText& text) {
  font_name();
  DimImageExtent extent{0, 0, 0};
  int x = 0;
  for (const Run& run : runs_of(text.utf8, text.size_px)) {
    const OIIO::ROI box = box_of(run);
    if (!box.defined()) continue;
    extent.width = x + box.xend;
    extent.above = std::max(extent.above, run.raised_px - box.ybegin);
    extent.below = std::max(extent.below, box.yend - run.raised_px);
    x = extent.width + gap_after(run);
  }
  return extent;
}

void draw_text(const DimImageText& text, std::uint8_t* rgb, int width, int height) {
  using namespace OIIO::ImageBufAlgo;
  const std::string& font = font_name();
  OIIO::ImageBuf picture(OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::UINT8), rgb);
  std::array<float, 3> colour{};
  for (std::size_t i = 0; i < 3; ++i) colour[i] = static_cast<float>(text.colour[i]) / 255.0f;
  int x = text.x;
  for (const Run& run : runs_of(text.utf8, text.size_px)) {
    if (!render_text(picture, x, text.y - run.raised_px, run.ascii, run.size_px, font, colour,
                     TextAlignX::Left, TextAlignY::Baseline, 0, {}, 1)) {
      throw std::runtime_error(picture.geterror());
    }
    const OIIO::ROI box = box_of(run);
    if (box.defined()) x += box.xend + gap_after(run);
  }
}

}  // namespace dim::image_module
