#include "image/polar_diagram.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dim {
namespace {

constexpr Rgb8 kGrid = {205, 205, 205};
constexpr Rgb8 kWords = {60, 60, 60};
constexpr Rgb8 kFirst = {0, 82, 155};
constexpr Rgb8 kSecond = {200, 80, 0};

/// A round step (1, 2 or 5 times a power of ten) of which three to seven make `most`.
double round_step(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most / 4.0)));
  for (const double factor : {1.0, 2.0, 5.0, 10.0})
    if (factor * power * 6.0 >= most) return factor * power;
  return 10.0 * power;
}

class Diagram {
 public:
  Diagram(const IntensityTable& intensity, const std::string& title, int size_px) : intensity_(intensity) {
    drawing_.width = drawing_.height = size_px;
    drawing_.title = title;
    font_px_ = std::max(10, size_px / 45);
    radius_px_ = 0.5 * size_px - 3.2 * font_px_;
    centre_ = {0.5 * size_px, 0.5 * size_px};
    const double most = intensity.max_cd();
    step_cd_ = most > 0.0 ? round_step(most) : 1.0;
    n_rings_ = most > 0.0 ? static_cast<int>(std::ceil(most / step_cd_ - 1e-9)) : 1;
  }

  Drawing drawn() {
    grid();
    curve(0.0, kFirst, false);
    if (!intensity_.axial()) curve(kPi / 2, kSecond, true);
    words();
    return std::move(drawing_);
  }

 private:
  Vec2 spot(double gamma_rad, double share, bool left) const {
    const double across = std::sin(gamma_rad) * share * radius_px_;
    return centre_ + Vec2(left ? -across : across, std::cos(gamma_rad) * share * radius_px_);
  }

  void grid() {
    for (int ring = 1; ring <= n_rings_; ++ring) {
      DrawnLine line{{}, ring == n_rings_ ? 1.5 : 1.0, kGrid, false};
      for (int degree = 0; degree <= 360; degree += 3)
        line.points.push_back(spot(radians(degree), static_cast<double>(ring) / n_rings_, false));
      drawing_.lines.push_back(std::move(line));
    }
    for (int gamma = 0; gamma < 360; gamma += 15)
      drawing_.lines.push_back({{centre_, spot(radians(gamma), 1.0, false)}, 1.0, kGrid, false});
  }

  void curve(double c_rad, const Rgb8& colour, bool dashed) {
    DrawnLine line{{}, 2.5, colour, dashed};
    const double whole_cd = step_cd_ * n_rings_;
    for (int half_degree = 360; half_degree >= -360; --half_degree) {
      const double gamma = std::min(kPi, radians(0.5 * std::abs(half_degree)));
      const bool left = half_degree > 0;
      const double cd = intensity_.at_c_gamma(left ? c_rad + kPi : c_rad, gamma);
      line.points.push_back(spot(gamma, cd / whole_cd, left));
    }
    drawing_.lines.push_back(std::move(line));
  }

  void word(const Vec2& at, const std::string& text, TextAnchor anchor, const Rgb8& colour = kWords) {
    drawing_.texts.push_back({at, text, font_px_, anchor, colour});
  }

  void words() {
    const double drop = 0.35 * font_px_;
    for (int ring = 1; ring <= n_rings_; ++ring)
      word(spot(0.0, static_cast<double>(ring) / n_rings_, false) + Vec2(4.0, -3.0),
           fmt::format("{:g}", ring * step_cd_), TextAnchor::start);
    const double out = 1.0 + 0.8 * font_px_ / radius_px_;
    for (int gamma = 30; gamma < 180; gamma += 30)
      for (const bool left : {false, true})
        word(spot(radians(gamma), out, left) + Vec2(0.0, drop), fmt::format("{}", gamma),
             left ? TextAnchor::end : TextAnchor::start);
    const double edge = 0.6 * font_px_;
    const double bottom = drawing_.height - edge;
    word({edge, 1.4 * font_px_}, drawing_.title, TextAnchor::start);
    word({edge, bottom}, "cd", TextAnchor::start);
    if (intensity_.axial()) return;
    const double right = drawing_.width - edge;
    word({right, bottom - 1.4 * font_px_}, "C180 - C0", TextAnchor::end, kFirst);
    word({right, bottom}, "C270 - C90", TextAnchor::end, kSecond);
  }

  const IntensityTable& intensity_;
  Drawing drawing_;
  Vec2 centre_{0.0};
  int font_px_ = 14;
  int n_rings_ = 1;
  double radius_px_ = 1.0;
  double step_cd_ = 1.0;
};

}  // namespace

Drawing polar_diagram(const IntensityTable& intensity, const std::string& title, int size_px) {
  return Diagram(intensity, title, size_px).drawn();
}

}  // namespace dim
