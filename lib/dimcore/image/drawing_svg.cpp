#include <fmt/format.h>

#include <iterator>

#include "base/xml_text.hpp"
#include "image/drawing.hpp"

namespace dim {
namespace {

std::string hex(const Rgb8& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

void append_points(std::string& svg, const std::vector<Vec2>& points) {
  const char* separator = "";
  for (const Vec2& p : points) {
    fmt::format_to(std::back_inserter(svg), "{}{:.2f},{:.2f}", separator, p.x, p.y);
    separator = " ";
  }
}

void append_area(std::string& svg, const DrawnArea& area) {
  if (area.more_outlines.empty()) {
    fmt::format_to(std::back_inserter(svg), "<polygon fill=\"{}\" points=\"", hex(area.colour));
    append_points(svg, area.outline);
    svg += "\"/>\n";
    return;
  }
  fmt::format_to(std::back_inserter(svg), "<path fill=\"{}\" fill-rule=\"evenodd\" d=\"", hex(area.colour));
  const auto append_ring = [&](const std::vector<Vec2>& ring) {
    svg += 'M';
    append_points(svg, ring);
    svg += 'z';
  };
  append_ring(area.outline);
  for (const auto& ring : area.more_outlines) append_ring(ring);
  svg += "\"/>\n";
}

const char* anchor_name(TextAnchor anchor) {
  return anchor == TextAnchor::start ? "start" : anchor == TextAnchor::middle ? "middle" : "end";
}

}  // namespace

std::string svg_text(const Drawing& drawing) {
  std::string svg = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n"
      "<title>{2}</title>\n<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      drawing.width, drawing.height, xml_text(drawing.title));
  auto out = std::back_inserter(svg);
  for (const auto& area : drawing.areas) append_area(svg, area);
  for (const auto& line : drawing.lines) {
    fmt::format_to(
        out,
        "<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\" stroke-linejoin=\"round\"{} points=\"",
        hex(line.colour), line.width_px,
        line.dashed ? fmt::format(" stroke-dasharray=\"{0:.2f} {0:.2f}\"", 4.0 * line.width_px) : "");
    append_points(svg, line.points);
    svg += "\"/>\n";
  }
  for (const auto& text : drawing.texts)
    fmt::format_to(
        out,
        "<text x=\"{:.2f}\" y=\"{:.2f}\" font-family=\"sans-serif\" font-size=\"{}\" text-anchor=\"{}\" "
        "fill=\"{}\"{}>{}</text>\n",
        text.at.x, text.at.y, text.size_px, anchor_name(text.anchor), hex(text.colour),
        text.halo ? " stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\"" : "", xml_text(text.utf8));
  return svg + "</svg>\n";
}

}  // namespace dim
