#include <algorithm>
#include <cmath>

#include "image/drawing.hpp"

namespace dim {
namespace {

constexpr int kSubLines = 4;

/// Share of each pixel that shapes cover, 0..1; one for all of a picture, cleared after each shape where it was
/// touched.
class Coverage {
 public:
  Coverage(int width, int height)
      : width_(width),
        height_(height),
        share_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0F) {}

  /// Even-odd area: exact along each of a few lines a pixel row.
  void add_area(const DrawnArea& area) {
    const int n_lines = height_ * kSubLines;
    std::vector<std::vector<double>> crossings(static_cast<std::size_t>(n_lines));
    add_crossings(area.outline, crossings);
    for (const auto& ring : area.more_outlines) add_crossings(ring, crossings);
    for (int sub = 0; sub < n_lines; ++sub) {
      auto& on_line = crossings[static_cast<std::size_t>(sub)];
      std::sort(on_line.begin(), on_line.end());
      for (std::size_t i = 0; i + 1 < on_line.size(); i += 2)
        add_span(sub / kSubLines, on_line[i], on_line[i + 1]);
    }
  }

  void add_segment(const Vec2& a, const Vec2& b, double half_width_px) {
    const double reach = half_width_px + 1.0;
    const int x0 = clamp_x(std::floor(std::min(a.x, b.x) - reach)), x1 = clamp_x(std::max(a.x, b.x) + reach);
    const int y0 = clamp_y(std::floor(std::min(a.y, b.y) - reach)), y1 = clamp_y(std::max(a.y, b.y) + reach);
    touch(x0, x1, y0, y1);
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

  /// Paints what is covered and forgets it.
  void paint(Picture8& picture, const Rgb8& colour) {
    for (int y = y0_; y <= y1_; ++y) {
      for (int x = x0_; x <= x1_; ++x) {
        float& covered = at(x, y);
        if (covered > 0.0F) blend(picture, x, y, std::min(1.0, static_cast<double>(covered)), colour);
        covered = 0.0F;
      }
    }
    x0_ = width_, x1_ = -1, y0_ = height_, y1_ = -1;
  }

 private:
  static void add_crossings(const std::vector<Vec2>& ring, std::vector<std::vector<double>>& crossings) {
    const int n_lines = static_cast<int>(crossings.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
      // The lines (sub + 0.5) / kSubLines between the ends.
      const auto line_at = [&](double y) {
        return static_cast<int>(std::clamp(std::ceil(y * kSubLines - 0.5), 0.0, static_cast<double>(n_lines)));
      };
      for (int sub = line_at(std::min(a.y, b.y)); sub < line_at(std::max(a.y, b.y)); ++sub) {
        const double y = (sub + 0.5) / kSubLines;
        crossings[static_cast<std::size_t>(sub)].push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
      }
    }
  }
  void blend(Picture8& picture, int x, int y, double share, const Rgb8& colour) const {
    const std::size_t pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    for (std::size_t c = 0; c < 3; ++c) {
      std::uint8_t& value = picture.rgb[3 * pixel + c];
      value = static_cast<std::uint8_t>(std::lround(value + share * (colour[c] - value)));
    }
  }
  void touch(int x0, int x1, int y0, int y1) {
    x0_ = std::min(x0_, x0), x1_ = std::max(x1_, x1);
    y0_ = std::min(y0_, y0), y1_ = std::max(y1_, y1);
  }
  int clamp_x(double x) const { return static_cast<int>(std::clamp(x, 0.0, width_ - 1.0)); }
  int clamp_y(double y) const { return static_cast<int>(std::clamp(y, 0.0, height_ - 1.0)); }
  float& at(int x, int y) {
    return share_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(x)];
  }
  void add_span(int y, double from, double to) {
    const double low = std::max(0.0, from), high = std::min<double>(width_, to);
    if (low < high) touch(static_cast<int>(low), clamp_x(high), y, y);
    for (int x = static_cast<int>(low); x < high && x < width_; ++x) {
      const double part = std::min(high, x + 1.0) - std::max(low, static_cast<double>(x));
      at(x, y) += static_cast<float>(std::max(0.0, part) / kSubLines);
    }
  }

  int width_, height_;
  int x0_ = width_, x1_ = -1, y0_ = height_, y1_ = -1;  // touched
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
  const int x = static_cast<int>(std::lround(text.at.x)) - shift, y = static_cast<int>(std::lround(text.at.y));
  constexpr Rgb8 kPaper = {255, 255, 255};
  for (int turn = 0; text.halo && turn < 9; ++turn)
    drawer.draw(picture, x + turn % 3 - 1, y + turn / 3 - 1, text.utf8, text.size_px, kPaper);
  drawer.draw(picture, x, y, text.utf8, text.size_px, text.colour);
}

}  // namespace

Picture8 rasterised(const Drawing& drawing, const TextDrawer& drawer) {
  Picture8 picture;
  picture.width = drawing.width;
  picture.height = drawing.height;
  picture.rgb.assign(3 * picture.n_pixels(), 255);
  Coverage coverage(drawing.width, drawing.height);
  for (const auto& area : drawing.areas) {
    coverage.add_area(area);
    coverage.paint(picture, area.colour);
  }
  for (const auto& line : drawing.lines) {
    for (const auto& [a, b] : pieces(line)) coverage.add_segment(a, b, 0.5 * line.width_px);
    coverage.paint(picture, line.colour);
  }
  if (drawer.available())
    for (const auto& text : drawing.texts) draw_text(picture, text, drawer);
  return picture;
}

}  // namespace dim
