#include "image/contour_labels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace dim {
namespace {

constexpr double kCell_px = 3.0;       // of the map of what is where
constexpr double kCandidate_px = 6.0;  // between places tried
constexpr double kApart_px = 420.0;    // between labels of one line

using Box = LabelBox;

// Which line passes where; what labels cover belongs to nobody.
class Occupancy {
 public:
  explicit Occupancy(const Box& within)
      : low_(within.low), high_(within.high), nx_(cells(high_.x - low_.x)), ny_(cells(high_.y - low_.y)) {
    owner_.assign(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_), kFree);
  }

  void add_line(const LabelledLine& line, int owner) {
    const std::size_t n = line.points.size();
    for (std::size_t i = 1; i < n + (line.closed ? 1 : 0); ++i) {
      const Vec2 a = line.points[i - 1], way = line.points[i % n] - a;
      const int pieces = 1 + static_cast<int>(glm::length(way) / kCell_px * 2.0);
      for (int k = 0; k <= pieces; ++k) mark(a + way * (static_cast<double>(k) / pieces), owner);
    }
  }
  void add_box(const Box& box) {
    for_cells(box, [&](std::int32_t& cell) {
      cell = kTaken;
      return true;
    });
  }
  bool free_for(const Box& box, int owner) {
    if (box.low.x < low_.x || box.low.y < low_.y || box.high.x > high_.x || box.high.y > high_.y)
      return false;
    return for_cells(box, [&](std::int32_t& cell) { return cell == kFree || cell == owner; });
  }

 private:
  static constexpr std::int32_t kFree = -1, kTaken = -2;
  static int cells(double extent_px) { return std::max(1, static_cast<int>(extent_px / kCell_px) + 1); }

  int column(double x) const { return std::clamp(static_cast<int>((x - low_.x) / kCell_px), 0, nx_ - 1); }
  int row(double y) const { return std::clamp(static_cast<int>((y - low_.y) / kCell_px), 0, ny_ - 1); }
  std::int32_t& at(int i, int j) { return owner_[static_cast<std::size_t>(j * nx_ + i)]; }
  void mark(const Vec2& p, std::int32_t owner) {
    std::int32_t& cell = at(column(p.x), row(p.y));
    cell = cell == kFree || cell == owner ? owner : kTaken;
  }
  template <class Visit>
  bool for_cells(const Box& box, Visit&& visit) {
    for (int j = row(box.low.y); j <= row(box.high.y); ++j)
      for (int i = column(box.low.x); i <= column(box.high.x); ++i)
        if (!visit(at(i, j))) return false;
    return true;
  }

  Vec2 low_, high_;
  int nx_, ny_;
  std::vector<std::int32_t> owner_;
};

// A line by the way along it.
class Way {
 public:
  explicit Way(const LabelledLine& line) : points_(line.points), closed_(line.closed) {
    if (closed_) points_.push_back(points_.front());
    along_.push_back(0.0);
    for (std::size_t i = 1; i < points_.size(); ++i)
      along_.push_back(along_.back() + glm::length(points_[i] - points_[i - 1]));
  }
  double length_px() const { return along_.back(); }
  bool closed() const { return closed_; }
  Vec2 at(double s) const {
    const double length = length_px();
    if (closed_) s -= length * std::floor(s / length);
    s = std::clamp(s, 0.0, length);
    const auto after = std::lower_bound(along_.begin() + 1, along_.end() - 1, s);
    const auto i = static_cast<std::size_t>(after - along_.begin());
    const double piece = along_[i] - along_[i - 1];
    return points_[i - 1] + (piece > 0.0 ? (s - along_[i - 1]) / piece : 0.0) * (points_[i] - points_[i - 1]);
  }
  /// How much longer than straight the way is for `reach_px` to both sides of s, 0 where straight.
  double bend(double s, double reach_px) const {
    return 1.0 - glm::length(at(s + reach_px) - at(s - reach_px)) / (2.0 * reach_px);
  }

 private:
  std::vector<Vec2> points_;
  std::vector<double> along_;
  bool closed_;
};

class Labels {
 public:
  Labels(const std::vector<LabelledLine>& lines, const Box& within, int font_px)
      : lines_(lines), font_px_(font_px), occupancy_(within), boxes_(lines.size()) {
    for (std::size_t i = 0; i < lines.size(); ++i) occupancy_.add_line(lines[i], static_cast<int>(i));
    std::vector<std::pair<double, std::size_t>> by_length;
    for (std::size_t i = 0; i < lines.size(); ++i) by_length.emplace_back(-Way(lines[i]).length_px(), i);
    std::sort(by_length.begin(), by_length.end());
    for (const auto& [length, i] : by_length) label(i);
  }

  const std::vector<Box>& boxes(std::size_t line) const { return boxes_[line]; }

 private:
  void label(std::size_t index) {
    const LabelledLine& line = lines_[index];
    const Way way(line);
    const Vec2 half(0.5 * text_width_px(line.label, font_px_) + 3.0, 0.5 * font_px_);
    const double length = way.length_px();
    if (length < 5.0 * half.x) return;
    const int wanted = std::clamp(static_cast<int>(length / kApart_px), 1, 6);
    for (int k = 0; k < wanted; ++k) {
      // Each label in its own part of the line, as near its middle as the line is straight there.
      const double begin = length * k / wanted, end = length * (k + 1) / wanted;
      double best = std::numeric_limits<double>::max(), best_s = -1.0;
      for (double s = begin; s < end; s += kCandidate_px) {
        if (!way.closed() && (s < 1.5 * half.x || s > length - 1.5 * half.x)) continue;
        const double off_middle = std::abs(s - 0.5 * (begin + end)) / (end - begin);
        const double badness = 8.0 * way.bend(s, half.x + 4.0) + 0.3 * off_middle;
        if (badness < best && occupancy_.free_for(box_at(way.at(s), half), static_cast<int>(index)))
          best = badness, best_s = s;
      }
      if (best_s < 0.0) continue;
      boxes_[index].push_back(box_at(way.at(best_s), half));
      occupancy_.add_box(boxes_[index].back());
    }
  }

  static Box box_at(const Vec2& middle, const Vec2& half) { return {middle - half, middle + half}; }

  const std::vector<LabelledLine>& lines_;
  int font_px_;
  Occupancy occupancy_;
  std::vector<std::vector<Box>> boxes_;
};

// Where a straight piece is outside the boxes, as parts of it.
std::vector<std::pair<double, double>> outside(const Vec2& a, const Vec2& b, const std::vector<Box>& boxes) {
  std::vector<std::pair<double, double>> parts{{0.0, 1.0}};
  for (const Box& box : boxes) {
    double enter = 0.0, leave = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
      const double way = b[axis] - a[axis];
      if (way == 0.0) {
        if (a[axis] <= box.low[axis] || a[axis] >= box.high[axis]) leave = -1.0;
        continue;
      }
      const double t = (box.low[axis] - a[axis]) / way, u = (box.high[axis] - a[axis]) / way;
      enter = std::max(enter, std::min(t, u));
      leave = std::min(leave, std::max(t, u));
    }
    if (enter >= leave) continue;
    std::vector<std::pair<double, double>> left;
    for (const auto& [from, to] : parts) {
      if (from < std::min(to, enter)) left.emplace_back(from, std::min(to, enter));
      if (std::max(from, leave) < to) left.emplace_back(std::max(from, leave), to);
    }
    parts = std::move(left);
  }
  return parts;
}

void add_broken(const LabelledLine& line, const std::vector<Box>& boxes, double width_px, const Rgb8& colour,
                Drawing& drawing) {
  DrawnLine piece{{}, width_px, colour, false};
  const auto finish = [&] {
    if (piece.points.size() > 1) drawing.lines.push_back(piece);
    piece.points.clear();
  };
  const std::size_t n = line.points.size();
  for (std::size_t i = 1; i < n + (line.closed ? 1 : 0); ++i) {
    const Vec2 a = line.points[i - 1], b = line.points[i % n];
    for (const auto& [from, to] : outside(a, b, boxes)) {
      if (from > 0.0) finish();
      if (piece.points.empty()) piece.points.push_back(a + from * (b - a));
      piece.points.push_back(a + to * (b - a));
      if (to < 1.0) finish();
    }
  }
  finish();
}

}  // namespace

double text_width_px(const std::string& utf8, int size_px) {
  double widths = 0.0;  // of Helvetica, in sizes
  for (const char c : utf8) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0) == 0x80) continue;
    widths += c == '.' || c == ',' || c == ' ' || c == 'l' || c == 'i' || c == '\'' ? 0.28
              : c >= 'A' && c <= 'Z'                                                ? 0.69
                                                                                    : 0.556;
  }
  return widths * size_px;
}

std::vector<LabelBox> draw_labelled(const std::vector<LabelledLine>& lines, const LabelBox& within,
                                    int font_px, double width_px, const Rgb8& colour, Drawing& drawing) {
  const Labels labels(lines, within, font_px);
  std::vector<LabelBox> boxes;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    add_broken(lines[i], labels.boxes(i), width_px, colour, drawing);
    for (const Box& box : labels.boxes(i)) {
      boxes.push_back(box);
      const Vec2 middle = 0.5 * (box.low + box.high);
      drawing.texts.push_back(
          {middle + Vec2(0.0, 0.36 * font_px), lines[i].label, font_px, TextAnchor::middle, colour});
    }
  }
  return boxes;
}

}  // namespace dim
