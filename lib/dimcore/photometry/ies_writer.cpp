#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "photometry/file_planes.hpp"
#include "photometry/photometry_writer.hpp"

namespace dim {
namespace {

constexpr std::size_t kLineLength = 78;
constexpr std::size_t kKeywordLineLength = 130;

std::string number(double value) { return fmt::format("{:.10g}", value == 0.0 ? 0.0 : value); }

void append_list(std::string& text, const std::vector<double>& values) {
  std::size_t line = 0;
  for (const double value : values) {
    const std::string word = number(value);
    if (line > 0 && line + 1 + word.size() > kLineLength) {
      text += '\n';
      line = 0;
    } else if (line > 0) {
      text += ' ';
      ++line;
    }
    text += word;
    line += word.size();
  }
  text += '\n';
}

/// Where to cut `value` so that the first part fits a line: at a blank, else between two characters.
std::size_t cut_before(const std::string& value, std::size_t longest) {
  if (value.size() <= longest) return value.size();
  if (const std::size_t blank = value.rfind(' ', longest); blank != std::string::npos && blank > 0)
    return blank;
  std::size_t cut = longest;
  while (cut > 1 && (static_cast<unsigned char>(value[cut]) & 0xC0U) == 0x80U) --cut;
  return cut;
}

void append_keyword(std::string& text, const std::string& name, std::string value) {
  std::string begin = name.empty() ? "[OTHER] " : "[" + name + "] ";
  while (true) {
    const std::size_t room = begin.size() < kKeywordLineLength ? kKeywordLineLength - begin.size() : 1;
    const std::size_t cut = cut_before(value, room);
    text += begin + value.substr(0, cut);
    while (text.back() == ' ') text.pop_back();
    text += '\n';
    value.erase(0, cut);
    value.erase(0, value.find_first_not_of(' '));
    if (value.empty()) return;
    begin = "[MORE] ";
  }
}

void append_keywords(std::string& text, const Photometry& photometry) {
  static constexpr std::array<const char*, 4> kRequired = {"TEST", "MANUFAC", "LUMCAT", "LUMINAIRE"};
  for (const auto& [key, value] : photometry.keywords) append_keyword(text, key, value);
  for (const char* name : kRequired) {
    const bool there = std::any_of(photometry.keywords.begin(), photometry.keywords.end(),
                                   [&](const auto& pair) { return pair.first == name; });
    if (!there) append_keyword(text, name, "");
  }
}

void append_tilt(std::string& text, const std::optional<LampTilt>& tilt) {
  if (!tilt) {
    text += "TILT=NONE\n";
    return;
  }
  text += fmt::format("TILT=INCLUDE\n{}\n{}\n", tilt->geometry, tilt->angle_rad.size());
  std::vector<double> angle_deg;
  for (const double angle : tilt->angle_rad) angle_deg.push_back(degrees(angle));
  append_list(text, angle_deg);
  append_list(text, tilt->factor);
}

/// The signs that LM-63-2002 gives the dimensions of a shape: width, length, height.
std::string dimensions(const LuminousOpening& opening, PhotometricType type) {
  double width = opening.width_m, length = opening.length_m, height = opening.height_m;
  switch (opening.shape) {
    case OpeningShape::kPoint:
      width = length = height = 0.0;
      break;
    case OpeningShape::kLine:
    case OpeningShape::kRectangle:
      height = 0.0;
      break;
    case OpeningShape::kBox:
      break;
    case OpeningShape::kEllipse:
      width = -width, length = -length, height = 0.0;
      break;
    case OpeningShape::kVerticalCylinder:
      width = -width, length = -length;
      break;
    case OpeningShape::kEllipsoid:
      width = -width, length = -length, height = -height;
      break;
    case OpeningShape::kHorizontalCylinder:
      (length >= width ? width : length) *= -1.0;
      height = -height;
      break;
    case OpeningShape::kVerticalEllipse:
      return fmt::format("{} 0 {}", number(-width), number(-height));
  }
  if (type != PhotometricType::kC) std::swap(width, length);
  return fmt::format("{} {} {}", number(width), number(length), number(height));
}

}  // namespace

std::string ies_text(const Photometry& photometry) {
  const FilePlanes planes = file_planes(photometry.distribution, photometry.symmetry);
  const auto lumens = photometry.lumens_per_lamp;
  std::string text = "IESNA:LM-63-2002\n";
  append_keywords(text, photometry);
  append_tilt(text, photometry.tilt);
  text += fmt::format("{} {} 1 {} {} {} 2 {}\n", photometry.n_lamps, lumens ? number(*lumens) : "-1",
                      planes.vertical_deg.size(), planes.horizontal_deg.size(),
                      static_cast<int>(photometry.distribution.type),
                      dimensions(photometry.opening, photometry.distribution.type));
  text += fmt::format("1 1 {}\n", number(photometry.watts.value_or(0.0)));
  append_list(text, planes.vertical_deg);
  append_list(text, planes.horizontal_deg);
  const auto n = static_cast<std::ptrdiff_t>(planes.vertical_deg.size());
  for (auto row = planes.intensity_cd.begin(); row != planes.intensity_cd.end(); row += n)
    append_list(text, {row, row + n});
  return text;
}

}  // namespace dim
