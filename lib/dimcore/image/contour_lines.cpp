#include "image/contour_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace dim {
namespace {

constexpr double kNothing = -std::numeric_limits<double>::infinity();

// The sides of a square: below, right, above, left of its middle; side k runs from corner k to corner k + 1.
using Corners = std::array<double, 4>;  // counter-clockwise from the lower left

// Marching squares over a lattice in which -infinity stands for "no field here".
class Marching {
 public:
  /// @param bounded  the field's edge bounds what lies above the level; else squares without field are left
  ///                 out and lines end there
  Marching(const Lattice& field, double level, bool bounded)
      : field_(field), level_(level), bounded_(bounded), margin_(bounded ? 1 : 0) {
    nx_ = field.nx + 2 * margin_;
    ny_ = field.ny + 2 * margin_;
    next_.assign(2 * static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_), -1);
    entered_.assign(next_.size(), false);
    for (int j = 0; j + 1 < ny_; ++j)
      for (int i = 0; i + 1 < nx_; ++i) add_square(i, j);
  }

  std::vector<Isoline> lines() {
    std::vector<Isoline> result;
    for (std::size_t e = 0; e < next_.size(); ++e)
      if (next_[e] >= 0 && !entered_[e]) result.push_back(follow(e));
    for (std::size_t e = 0; e < next_.size(); ++e)
      if (next_[e] >= 0) result.push_back(follow(e));
    std::erase_if(result, [](const Isoline& line) { return line.points.size() < (line.closed ? 3U : 2U); });
    return result;
  }

 private:
  double value(int i, int j) const {
    const int x = i - margin_, y = j - margin_;
    if (x < 0 || y < 0 || x >= field_.nx || y >= field_.ny) return kNothing;
    const double v = field_.at(x, y);
    return std::isnan(v) ? kNothing : v;
  }

  std::size_t level_edge(int i, int j) const { return 2 * static_cast<std::size_t>(j * nx_ + i); }
  std::size_t upright_edge(int i, int j) const { return level_edge(i, j) + 1; }

  void add_square(int i, int j) {
    const Corners v{value(i, j), value(i + 1, j), value(i + 1, j + 1), value(i, j + 1)};
    if (!bounded_ && std::any_of(v.begin(), v.end(), [](double x) { return x == kNothing; })) return;
    const std::array<std::size_t, 4> edge{level_edge(i, j), upright_edge(i + 1, j), level_edge(i, j + 1),
                                          upright_edge(i, j)};
    std::array<bool, 4> high{};
    int n_high = 0;
    for (std::size_t k = 0; k < 4; ++k) n_high += high[k] = v[k] >= level_;
    const bool saddle = n_high == 2 && high[0] == high[2];
    const bool joined = saddle && middle(v) >= level_;
    // Counter-clockwise round the square, a line leaves where high turns low and enters where low turns high;
    // the high side is on its left.
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t corner = k, after = (k + 1) % 4;
      if (!high[corner] || high[after]) continue;  // side k: high to low
      // The line that starts here ends on the side where this run of high corners begins, or, where high
      // corners are joined through the middle, where the other one does.
      std::size_t side = k;
      if (joined)
        side = after;
      else
        do side = (side + 3) % 4;
        while (high[side]);
      connect(edge[k], edge[side]);
    }
  }

  // Height of the bilinear saddle point.
  static double middle(const Corners& v) {
    if (std::any_of(v.begin(), v.end(), [](double x) { return x == kNothing; })) return kNothing;
    return (v[0] * v[2] - v[1] * v[3]) / (v[0] + v[2] - v[1] - v[3]);
  }

  void connect(std::size_t from, std::size_t to) {
    next_[from] = static_cast<std::int64_t>(to);
    entered_[to] = true;
  }

  Isoline follow(std::size_t start) {
    Isoline line;
    std::size_t at = start;
    add_point(line, at);
    while (next_[at] >= 0) {
      const auto to = static_cast<std::size_t>(next_[at]);
      next_[at] = -1;
      at = to;
      if (at == start) {
        line.closed = true;
        if (line.points.size() > 1 && line.points.back() == line.points.front()) line.points.pop_back();
        return line;
      }
      add_point(line, at);
    }
    return line;
  }

  void add_point(Isoline& line, std::size_t edge) const {
    const int node = static_cast<int>(edge / 2), i = node % nx_, j = node / nx_;
    const bool upright = edge % 2 == 1;
    const int k = upright ? i : i + 1, l = upright ? j + 1 : j;
    const double a = value(i, j), b = value(k, l);
    const double t = a == kNothing ? 1.0 : b == kNothing ? 0.0 : (level_ - a) / (b - a);
    const Vec2 from = field_.place(i - margin_, j - margin_), to = field_.place(k - margin_, l - margin_);
    const Vec2 p = t == 0.0 ? from : t == 1.0 ? to : from + t * (to - from);
    if (line.points.empty() || line.points.back() != p) line.points.push_back(p);
  }

  const Lattice& field_;
  double level_;
  bool bounded_;
  int margin_, nx_ = 0, ny_ = 0;
  std::vector<std::int64_t> next_;  // [edges] where a line goes on, -1: nowhere
  std::vector<bool> entered_;
};

}  // namespace

std::vector<Isoline> isolines(const Lattice& field, double level) {
  return Marching(field, level, false).lines();
}

Region2 region_above(const Lattice& field, double level) {
  Region2 region;
  for (auto& line : Marching(field, level, true).lines()) region.push_back(std::move(line.points));
  return region;
}

bool contains(const Region2& region, const Vec2& p) {
  bool inside = false;
  for (const auto& ring : region) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const Vec2 &a = ring[j], &b = ring[i];
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
  }
  return inside;
}

std::vector<Isoline> clipped(const Isoline& line, const Region2& region) {
  std::vector<Isoline> parts;
  bool open = false, whole = true;
  const auto cut = [&] { open = false, whole = false; };
  const auto add = [&](const Vec2& a, const Vec2& b) {
    if (!contains(region, (a + b) / 2.0)) return cut();
    if (!open) parts.push_back({{a}, false});
    open = true;
    parts.back().points.push_back(b);
  };
  const std::size_t n = line.points.size(), n_segments = line.closed ? n : n - 1;
  std::vector<double> cuts;
  for (std::size_t s = 0; s < n_segments; ++s) {
    const Vec2 &a = line.points[s], &b = line.points[(s + 1) % n];
    cuts.clear();
    for (const auto& ring : region) {
      for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        const Vec2 r = b - a, v = ring[i] - ring[j], gap = ring[j] - a;
        const double determinant = r.x * v.y - r.y * v.x;
        if (determinant == 0.0) continue;
        const double t = (gap.x * v.y - gap.y * v.x) / determinant;
        const double u = (gap.x * r.y - gap.y * r.x) / determinant;
        if (t > 0.0 && t < 1.0 && u >= 0.0 && u <= 1.0) cuts.push_back(t);
      }
    }
    std::sort(cuts.begin(), cuts.end());
    Vec2 from = a;
    for (const double t : cuts) {
      add(from, a + t * (b - a));
      from = a + t * (b - a);
    }
    add(from, b);
  }
  if (line.closed && whole) return {line};
  // A closed line that was cut starts inside: its first and last part are one.
  if (line.closed && parts.size() > 1 && parts.back().points.back() == parts.front().points.front()) {
    parts.back().points.insert(parts.back().points.end(), parts.front().points.begin() + 1,
                               parts.front().points.end());
    parts.front() = std::move(parts.back());
    parts.pop_back();
  }
  return parts;
}

}  // namespace dim
