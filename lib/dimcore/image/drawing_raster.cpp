#include <algorithm>
#include <cmath>

#include "image/drawing.hpp"

namespace dim {
namespace {

constexpr int kSubLines = 4;

/// Share of each pixel that a shape covers, 0..1, over the whole picture.
class Coverage {
 public:
  Coverage(int width, int height)
      : width_(width),
        height_(height),
        share_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0F) {}

  /// Even-odd area: exact along each of a few lines a pixel row.
  void add_area(const std::vector<Vec2>& outline) {
    std::vector<double> crossings;
    for (int sub = 0; sub < height_ * kSubLines; ++sub) {
      const double y = (sub + 0.5) / kSubLines;
      crossings.clear();
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec2& a = outline[i];
        const Vec2& b = outline[(i + 1) % outline.size()];
        if ((a.y > y) != (b.y > y)) crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
      }
      std::sort(crossings.begin(), crossings.end());
      for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
        add_span(sub / kSubLines, crossings[i], crossings[i + 1]);
    }
  }

  void add_segment(const Vec2& a, const Vec2& b, double half_width_px) {
    const double reach = half_width_px + 1.0;
    const int x0 = clamp_x(std::floor(std::min(a.x, b.x) - reach)), x1 = clamp_x(std::max(a.x, b.x) + reach);
    const int y0 = clamp_y(std::floor(std::min(a.y, b.y) - reach)), y1 = clamp_y(std::max(a.y, b.y) + reach);
    const Vec2 way = b - a;
    const double length2 = glm::dot(way, way);
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const Vec2 p = Vec2(x + 0.5, y + 0.5) - a;
        const double along = length2 > 0.0 ? std::clamp(glm::dot(p, way) / length2, 0.0, 1.0) : 0.0;
        const double share = std::clamp(half_width_px + 0.5 - glm::length(p - along * way), 0.0, 1.0);
        float& here = at(x, y);
        here = std::max(here, static_cast<float>(share));
      }
    }
  }

  void paint(Picture8& picture, const Rgb8& colour) const {
    for (std::size_t i = 0; i < share_.size(); ++i) {
      if (share_[i] <= 0.0F) continue;
      const double share = std::min(1.0, static_cast<double>(share_[i]));
      for (std::size_t c = 0; c < 3; ++c) {
        std::uint8_t& value = picture.rgb[3 * i + c];
        value = static_cast<std::uint8_t>(std::lround(value + share * (colour[c] - value)));
      }
    }
  }

 private:
  int clamp_x(double x) const { return static_cast<int>(std::clamp(x, 0.0, width_ - 1.0)); }
  int clamp_y(double y) const { return static_cast<int>(std::clamp(y, 0.0, height_ - 1.0)); }
  float& at(int x, int y) {
    return share_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(x)];
  }
  void add_span(int y, double from, double to) {
    const double low = std::max(0.0, from), high = std::min<double>(width_, to);
    for (int x = static_cast<int>(low); x < high && x < width_; ++x) {
      const double part = std::min(high, x + 1.0) - std::max(low, static_cast<double>(x));
      at(x, y) += static_cast<float>(std::max(0.0, part) / kSubLines);
    }
  }

  int width_, height_;
  std::vector<float> share_;
};

/// The parts of a line that are drawn: all of it, or every other piece of four line widths.
std::vector<std::pair<Vec2, Vec2>> pieces(const DrawnLine& line) {
  std::vector<std::pair<Vec2, Vec2>> result;
  const double dash = 4.0 * line.width_px;
  double done = 0.0;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    const Vec2 a = line.points[i - 1], way = line.points[i] - a;
    const double length = glm::length(way);
    if (!line.dashed || !(length > 0.0)) {
      result.emplace_back(a, line.points[i]);
      continue;
    }
    for (double at = 0.0; at < length;) {
      const double into = std::fmod(done + at, 2.0 * dash);
      const bool on = into < dash;
      const double next = std::min(length, at + std::max(1e-6 * dash, (on ? dash : 2.0 * dash) - into));
      if (on) result.emplace_back(a + way * (at / length), a + way * (next / length));
      at = next;
    }
    done += length;
  }
  return result;
}

void draw_text(Picture8& picture, const DrawnText& text, const TextDrawer& drawer) {
  const int width = drawer.measure(text.utf8, text.size_px).width;
  const int shift = text.anchor == TextAnchor::start    ? 0
                    : text.anchor == TextAnchor::middle ? width / 2
                                                        : width;
  drawer.draw(picture, static_cast<int>(std::lround(text.at.x)) - shift,
              static_cast<int>(std::lround(text.at.y)), text.utf8, text.size_px, text.colour);
}

}  // namespace

Picture8 rasterised(const Drawing& drawing, const TextDrawer& drawer) {
  Picture8 picture;
  picture.width = drawing.width;
  picture.height = drawing.height;
  picture.rgb.assign(3 * picture.n_pixels(), 255);
  for (const auto& area : drawing.areas) {
    Coverage coverage(drawing.width, drawing.height);
    coverage.add_area(area.outline);
    coverage.paint(picture, area.colour);
  }
  for (const auto& line : drawing.lines) {
    Coverage coverage(drawing.width, drawing.height);
    for (const auto& [a, b] : pieces(line)) coverage.add_segment(a, b, 0.5 * line.width_px);
    coverage.paint(picture, line.colour);
  }
  if (drawer.available())
    for (const auto& text : drawing.texts) draw_text(picture, text, drawer);
  return picture;
}

}  // namespace dim
