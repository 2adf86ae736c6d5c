#include "geometry/line_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "base/xml_text.hpp"

namespace dim {
namespace {

constexpr double kStraight_px = 1e-3;
constexpr double kSamePlace_px = 1e-4;

bool precedes(const Segment2& p, const Segment2& q) {
  return std::tie(p.a.x, p.a.y, p.b.x, p.b.y) < std::tie(q.a.x, q.a.y, q.b.x, q.b.y);
}

void put_left_first(Segment2& s) {
  const bool level = std::abs(s.a.x - s.b.x) < kSamePlace_px;
  if (level ? s.b.y < s.a.y : s.b.x < s.a.x) std::swap(s.a, s.b);
}

// Joins segments through a table of their ends.
class Joiner {
 public:
  explicit Joiner(std::vector<Segment2> segments) : segments_(std::move(segments)), gone_(segments_.size()) {
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      at_[key(segments_[i].a, 0, 0)].push_back(i);
      at_[key(segments_[i].b, 0, 0)].push_back(i);
    }
  }

  std::vector<Segment2> run() {
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      if (gone_[i]) continue;
      while (extend(i)) continue;
      std::swap(segments_[i].a, segments_[i].b);
      while (extend(i)) continue;
    }
    std::vector<Segment2> result;
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      if (!gone_[i]) result.push_back(segments_[i]);
    }
    return result;
  }

 private:
  static std::uint64_t key(const Vec2& p, int dx, int dy) {
    const auto x = std::llround(p.x / kSamePlace_px) + dx, y = std::llround(p.y / kSamePlace_px) + dy;
    return (static_cast<std::uint64_t>(x) << 32) ^ (static_cast<std::uint64_t>(y) & 0xFFFFFFFFULL);
  }

  // Makes segment i longer by the one that runs straight on from its end b.
  bool extend(std::size_t i) {
    Segment2& self = segments_[i];
    double least = kStraight_px;
    std::size_t best = i;
    Vec2 end(0.0);
    for (int cell = 0; cell < 9; ++cell) {
      const auto found = at_.find(key(self.b, cell % 3 - 1, cell / 3 - 1));
      if (found == at_.end()) continue;
      for (const std::size_t other : found->second) {
        if (other == i || gone_[other]) continue;
        const Segment2& o = segments_[other];
        const Vec2 far = glm::length(o.a - self.b) < glm::length(o.b - self.b) ? o.b : o.a;
        const double bend = bend_px(self.a, self.b, far);
        if (bend >= least) continue;
        least = bend;
        best = other;
        end = far;
      }
    }
    if (best == i) return false;
    gone_[best] = true;
    self.b = end;
    at_[key(end, 0, 0)].push_back(i);
    return true;
  }

  // How far b lies off the straight way from a to c, infinite where c turns back.
  static double bend_px(const Vec2& a, const Vec2& b, const Vec2& c) {
    if (!(glm::dot(b - a, c - b) > 0.0)) return HUGE_VAL;
    const Vec2 way = c - a;
    return std::abs(way.x * (b.y - a.y) - way.y * (b.x - a.x)) / glm::length(way);
  }

  std::vector<Segment2> segments_;
  std::vector<bool> gone_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> at_;
};

}  // namespace

std::vector<Segment2> joined(std::vector<Segment2> segments) {
  std::sort(segments.begin(), segments.end(), precedes);
  auto result = Joiner(std::move(segments)).run();
  for (auto& segment : result) put_left_first(segment);
  std::sort(result.begin(), result.end(), precedes);
  return result;
}

std::string to_svg(const std::vector<Segment2>& segments, int width, int height, const std::string& title) {
  const double stroke_px = std::max(0.5, std::max(width, height) / 1000.0);
  std::string svg = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n"
      "<title>{2}</title>\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n"
      "<path fill=\"none\" stroke=\"#000\" stroke-width=\"{3:.2f}\" stroke-linecap=\"round\" d=\"",
      width, height, xml_text(title), stroke_px);
  for (const auto& s : segments)
    fmt::format_to(std::back_inserter(svg), "\nM{:.2f} {:.2f}L{:.2f} {:.2f}", s.a.x, s.a.y, s.b.x, s.b.y);
  return svg + "\"/>\n</svg>\n";
}

}  // namespace dim
