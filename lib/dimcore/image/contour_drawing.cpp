#include "image/contour_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "image/contour_labels.hpp"
#include "image/contour_levels.hpp"
#include "image/contour_lines.hpp"

namespace dim {
namespace {

constexpr Rgb8 kInk = {25, 25, 25};
constexpr Rgb8 kWords = {60, 60, 60};
constexpr double kLattice_px = 3.0;

struct Pen {
  double width_px;
  Rgb8 colour;
  bool dashed = false;
};
constexpr std::array<Pen, 4> kPens = {Pen{1.2, {120, 120, 120}}, Pen{3.0, {90, 90, 90}},
                                      Pen{4.0, {110, 170, 225}}, Pen{1.3, {190, 110, 0}}};
constexpr Pen kPlaneEdge = {1.2, {110, 110, 110}, true};

class ContourSheet {
 public:
  explicit ContourSheet(const ContourMap& map) : map_(map), n_levels_(map.levels.size()) {
    px_per_m_ = map.size_px / std::max(map.plan.width_m(), map.plan.height_m());
    font_px_ = std::clamp(map.size_px / 70, 11, 60);
    title_px_ = font_px_ * 5 / 4;
    left_ = 1.2 * font_px_;
    top_ = left_ + 2.2 * title_px_;
    right_ = left_ + px_per_m_ * map.plan.width_m();
    bottom_ = top_ + px_per_m_ * map.plan.height_m();
    drawing_.title = map.title;
  }

  Drawing drawn() {
    field_ = smooth_field(map_.values, kLattice_px / px_per_m_);
    domain_ = domain();
    if (map_.filled) fill();
    underlay();
    const auto labels = contour_lines();
    if (map_.with_values) values(labels);
    words();
    return std::move(drawing_);
  }

 private:
  Vec2 on_sheet(const Vec2& plan_m) const {
    return {left_ + px_per_m_ * (plan_m.x - map_.plan.low_m.x),
            top_ + px_per_m_ * (map_.plan.high_m.y - plan_m.y)};
  }
  Vec2 from_polygon(const Vec2& local) const {
    return on_sheet(map_.plan.to_plan(map_.polygon.frame().to_world(local)));
  }
  std::vector<Vec2> from_polygon(const std::vector<Vec2>& points) const {
    std::vector<Vec2> result;
    for (const Vec2& p : points) result.push_back(from_polygon(p));
    return result;
  }

  // The polygon without the squares whose middles lie in it but have no value.
  Region2 domain() {
    const ValueGrid& grid = map_.values;
    const Vec2 square(grid.size_m.x / grid.nu, grid.size_m.y / grid.nv);
    Region2 gaps;
    for (int j = 0; j < grid.nv; ++j) {
      for (int i = 0; i < grid.nu; ++i) {
        const Vec2 low(i * square.x, j * square.y), high = low + square;
        if (!std::isnan(grid.values[static_cast<std::size_t>(j * grid.nu + i)]) ||
            !map_.polygon.contains(0.5 * (low + high)))
          continue;
        gaps.push_back({low, {high.x, low.y}, high, {low.x, high.y}});
      }
    }
    whole_ = gaps.empty() && map_.polygon.is_rectangle();
    return gaps.empty() ? map_.polygon.rings() : clip_difference(map_.polygon.rings(), gaps);
  }

  void fill() {
    const auto colours = band_colours(n_levels_);
    add_area(region_above(field_, std::numeric_limits<double>::lowest()), colours.front());
    for (std::size_t k = 0; k < n_levels_; ++k)
      add_area(region_above(field_, map_.levels[k]), colours[k + 1]);
  }

  void add_area(const Region2& region, const Rgb8& colour) {
    const Region2 shown = whole_ ? region : clip_intersection(region, domain_);
    DrawnArea area{{}, colour};
    for (const auto& ring : shown) {
      if (area.outline.empty())
        area.outline = from_polygon(ring);
      else
        area.more_outlines.push_back(from_polygon(ring));
    }
    if (!area.outline.empty()) drawing_.areas.push_back(std::move(area));
  }

  void add_line(std::vector<Vec2> points, const Pen& pen) {
    drawing_.lines.push_back({std::move(points), pen.width_px, pen.colour, pen.dashed});
  }

  void underlay() {
    for (const auto& line : map_.below) {
      std::vector<Vec2> points;
      for (const Vec2& p : line.points_m) points.push_back(on_sheet(p));
      add_cropped(points, kPens[static_cast<std::size_t>(line.stroke)]);
    }
    for (auto ring : map_.polygon.rings()) {
      ring.push_back(ring.front());
      add_line(from_polygon(ring), kPlaneEdge);
    }
  }

  // What of the room lies beyond the plan is not drawn.
  void add_cropped(const std::vector<Vec2>& points, const Pen& pen) {
    const Region2 sheet = {{{left_, top_}, {right_, top_}, {right_, bottom_}, {left_, bottom_}}};
    const bool inside = std::all_of(points.begin(), points.end(), [&](const Vec2& p) {
      return p.x >= left_ && p.x <= right_ && p.y >= top_ && p.y <= bottom_;
    });
    if (inside) return add_line(points, pen);
    for (auto& part : clipped({points, false}, sheet)) add_line(std::move(part.points), pen);
  }

  std::vector<LabelBox> contour_lines() {
    std::vector<LabelledLine> lines;
    for (const double level : map_.levels) {
      for (const auto& whole : isolines(field_, level)) {
        const auto parts = whole_ ? std::vector<Isoline>{whole} : clipped(whole, domain_);
        for (const auto& part : parts)
          if (part.closed || length_m(part) * px_per_m_ > font_px_)
            lines.push_back({from_polygon(part.points), part.closed, fmt::format("{:g}", level)});
      }
    }
    const LabelBox within{{left_, top_}, {right_, bottom_}};
    return draw_labelled(lines, within, font_px_, std::max(1.3, font_px_ / 9.0), kInk, drawing_);
  }

  // Of an open line; those too short for a word are specks at an edge.
  static double length_m(const Isoline& line) {
    double sum = 0.0;
    for (std::size_t i = 1; i < line.points.size(); ++i)
      sum += glm::length(line.points[i] - line.points[i - 1]);
    return sum;
  }

  void values(const std::vector<LabelBox>& labels) {
    const ValueGrid& grid = map_.values;
    const Vec2 square(grid.size_m.x / grid.nu, grid.size_m.y / grid.nv);
    const int small_px = std::max(9, font_px_ * 4 / 5);
    const Vec2 right = from_polygon(Vec2(square.x, 0.0)) - from_polygon(Vec2(0.0)),
               up = from_polygon(Vec2(0.0, square.y)) - from_polygon(Vec2(0.0));
    double widest = 0.0;
    for (const double v : grid.values)
      if (!std::isnan(v)) widest = std::max(widest, text_width_px(figure(v), small_px));
    const Vec2 room(widest + 1.6 * small_px, 2.4 * small_px);
    const int stride_u = stride(right, room), stride_v = stride(up, room);
    for (int j = stride_v / 2; j < grid.nv; j += stride_v) {
      for (int i = stride_u / 2; i < grid.nu; i += stride_u) {
        const double v = grid.values[static_cast<std::size_t>(j * grid.nu + i)];
        if (std::isnan(v)) continue;
        const Vec2 at = from_polygon(Vec2((i + 0.5) * square.x, (j + 0.5) * square.y));
        const Vec2 half(0.5 * text_width_px(figure(v), small_px), 0.5 * small_px);
        const LabelBox box{at - half, at + half};
        if (std::any_of(labels.begin(), labels.end(), [&](const LabelBox& l) { return l.overlaps(box); }))
          continue;
        drawing_.texts.push_back(
            {at + Vec2(0.0, 0.36 * small_px), figure(v), small_px, TextAnchor::middle, {0, 70, 140}, true});
      }
    }
  }

  // Every how manieth point has room for its figure, points being a step apart.
  static int stride(const Vec2& step, const Vec2& room) {
    for (int n = 1;; ++n)
      if (n * std::abs(step.x) >= room.x || n * std::abs(step.y) >= room.y) return n;
  }

  static std::string figure(double v) {
    return std::abs(v) >= 100.0 ? fmt::format("{:.0f}", v) : fmt::format("{:.3g}", v);
  }

  void text(const Vec2& at, const std::string& words, int size_px, TextAnchor anchor = TextAnchor::start) {
    drawing_.texts.push_back({at, words, size_px, anchor, kWords});
    widest_ = std::max(widest_, anchor == TextAnchor::start ? at.x + text_width_px(words, size_px) : at.x);
  }

  void words() {
    text({left_, left_ + title_px_}, map_.title, title_px_);
    double y = top_ + font_px_;
    const double x = right_ + 1.5 * font_px_, line = 1.5 * font_px_;
    for (const auto& [name, value] : map_.figures) {
      text({x, y}, name, font_px_);
      text({x + 5.5 * font_px_, y}, value, font_px_);
      y += line;
    }
    y += 0.6 * line;
    if (map_.filled) y = legend(x, y, line);
    const double below = std::max(bottom_, map_.north ? north(x + 2.0 * font_px_, y) : 0.0);
    scale_bar(below + 2.2 * font_px_);
    drawing_.width = static_cast<int>(std::ceil(widest_ + left_));
    drawing_.height = static_cast<int>(std::ceil(std::max(below + 2.2 * font_px_, y) + 1.6 * font_px_));
  }

  double legend(double x, double y, double line) {
    const auto colours = band_colours(n_levels_);
    text({x, y}, map_.quantity + (map_.unit.empty() ? "" : ", " + map_.unit), font_px_);
    const double side = 1.15 * font_px_;
    for (std::size_t k = n_levels_ + 1; k-- > 0;) {
      y += line;
      const double low = y - 0.9 * font_px_;
      drawing_.areas.push_back(
          {{{x, low}, {x + 1.6 * side, low}, {x + 1.6 * side, low + side}, {x, low + side}}, colours[k]});
      std::string words = "all";
      if (n_levels_ > 0)
        words = k == 0           ? fmt::format("< {:g}", map_.levels.front())
                : k == n_levels_ ? fmt::format("> {:g}", map_.levels.back())
                                 : fmt::format("{:g} - {:g}", map_.levels[k - 1], map_.levels[k]);
      text({x + 2.2 * side, y}, words, font_px_);
    }
    return y + line;
  }

  // An arrow with its letter; returns where it ends.
  double north(double x, double y) {
    const double reach = 1.8 * font_px_;
    const Vec2 middle(x, y + reach), way(map_.north->x, -map_.north->y), side(-way.y, way.x);
    const Vec2 tip = middle + reach * way, tail = middle - reach * way;
    add_line({tail, tip}, {1.5, kWords});
    drawing_.areas.push_back(
        {{tip, tip - 0.8 * reach * way + 0.3 * reach * side, tip - 0.8 * reach * way - 0.3 * reach * side},
         kWords});
    const Vec2 letter = middle + (reach + 0.8 * font_px_) * way + Vec2(0.0, 0.36 * font_px_);
    drawing_.texts.push_back({letter, "N", font_px_, TextAnchor::middle, kWords});
    widest_ = std::max(widest_, middle.x + reach + 2.0 * font_px_);
    return middle.y + reach + 2.0 * font_px_;
  }

  void scale_bar(double y) {
    const double wanted_m = 0.3 * map_.plan.width_m();
    const double power = std::pow(10.0, std::floor(std::log10(wanted_m)));
    const double factor = wanted_m < 2.0 * power ? 1.0 : wanted_m < 5.0 * power ? 2.0 : 5.0;
    const double length_m = factor * power, length = length_m * px_per_m_, high = 0.45 * font_px_;
    constexpr int kParts = 4;
    for (int part = 0; part < kParts; ++part) {
      const double x0 = left_ + length * part / kParts, x1 = left_ + length * (part + 1) / kParts;
      const std::vector<Vec2> box = {{x0, y - high}, {x1, y - high}, {x1, y}, {x0, y}};
      if (part % 2 == 0) drawing_.areas.push_back({box, kWords});
      add_line({box[0], box[1], box[2], box[3], box[0]}, {1.0, kWords});
    }
    text({left_ + length + 0.7 * font_px_, y}, fmt::format("{:g} m", length_m), font_px_);
  }

  const ContourMap& map_;
  std::size_t n_levels_;
  Drawing drawing_;
  Lattice field_;
  Region2 domain_;
  bool whole_ = true;
  double px_per_m_ = 1.0, left_ = 0.0, top_ = 0.0, right_ = 0.0, bottom_ = 0.0, widest_ = 0.0;
  int font_px_ = 14, title_px_ = 18;
};

}  // namespace

Drawing contour_drawing(const ContourMap& map) {
  if (map.size_px < kLeastPlan_px || map.size_px > kMostPlan_px)
    throw LimitError(
        fmt::format("a plan of {} pixels is outside {}..{}", map.size_px, kLeastPlan_px, kMostPlan_px));
  return ContourSheet(map).drawn();
}

}  // namespace dim
