#include "image/contour_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/error.hpp"

namespace dim {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr int kMostSteps = 256;  // per square

// The values with a ring of squares around them, in part extrapolated.
class Padded {
 public:
  explicit Padded(const ValueGrid& grid) : nu_(grid.nu + 2), nv_(grid.nv + 2) {
    values_.assign(static_cast<std::size_t>(nu_) * static_cast<std::size_t>(nv_), kUnknown);
    for (int j = 0; j < grid.nv; ++j) {
      for (int i = 0; i < grid.nu; ++i) {
        at(i + 1, j + 1) = grid.values[static_cast<std::size_t>(j * grid.nu + i)];
      }
    }
    extend();
    extend();  // corners, which have neighbours only after the first round
  }

  int nu() const { return nu_; }
  int nv() const { return nv_; }
  double& at(int i, int j) { return values_[static_cast<std::size_t>(j * nu_ + i)]; }
  double at(int i, int j) const {
    return i < 0 || j < 0 || i >= nu_ || j >= nv_ ? kUnknown : values_[static_cast<std::size_t>(j * nu_ + i)];
  }

 private:
  void extend() {
    const Padded before = *this;
    for (int j = 0; j < nv_; ++j) {
      for (int i = 0; i < nu_; ++i) {
        if (std::isnan(at(i, j))) at(i, j) = before.beside(i, j);
      }
    }
  }

  // The mean of what the values on each side come to; NaN where there is none on any.
  double beside(int i, int j) const {
    double sum = 0.0;
    int n = 0;
    constexpr int kSides[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    for (const auto& [di, dj] : kSides) {
      double f[4];
      for (int k = 0; k < 4; ++k) f[k] = at(i + (k + 1) * di, j + (k + 1) * dj);
      if (std::isnan(f[0])) continue;
      sum += f[0] + change(f);
      ++n;
    }
    return n > 0 ? sum / n : kUnknown;
  }

  // From the first value outwards. Where curvature does not go on alike, as at a shadow's edge, no further
  // than both steps before agree on.
  static double change(const double (&f)[4]) {
    if (std::isnan(f[1])) return 0.0;
    const double step = f[0] - f[1];
    if (std::isnan(f[2])) return step;
    const double before = f[1] - f[2], bend = step - before;
    const double bend_before = std::isnan(f[3]) ? bend : before - (f[2] - f[3]);
    constexpr double kAlike = 4.0, kGentle = 0.5;
    const bool alike = bend * bend_before >= 0.0 && std::abs(bend) <= kAlike * std::abs(bend_before);
    if (alike || std::abs(bend) <= kGentle * std::abs(step)) {
      const double most = std::max(std::abs(bend), 0.5 * kGentle * std::abs(step));
      return step + bend + std::clamp(bend - bend_before, -most, most);
    }
    if (step * before <= 0.0) return 0.0;
    return std::abs(step) < std::abs(before) ? step : before;
  }

  int nu_, nv_;
  std::vector<double> values_;
};

// The number nearest 0 of those of one sign; 0 where they differ in it.
double minmod(double a, double b, double c) {
  if (!(a * b > 0.0) || !(b * c > 0.0)) return 0.0;
  return std::copysign(std::min({std::abs(a), std::abs(b), std::abs(c)}), a);
}

double bend(std::span<const double> f, std::size_t k) { return f[k + 1] - 2.0 * f[k] + f[k - 1]; }

// Slope at the end f[0], by forward differences as far as they are of one kind.
double end_slope(std::span<const double> f) {
  const double step = f[1] - f[0];
  if (f.size() == 2) return step;
  const double first = bend(f, 1), second = f.size() > 3 ? bend(f, 2) : first;
  const double half_bend = 0.5 * minmod(first, second, first), most = std::abs(half_bend);
  return step - half_bend + std::clamp((second - first) / 3.0, -most, most);
}

// Slope within, of fourth order, next to an end of third.
double unlimited_slope(std::span<const double> f, std::size_t i) {
  const std::size_t n = f.size();
  if (n < 4) return 0.5 * (f[i + 1] - f[i - 1]);
  if (i == 1) return (-2.0 * f[0] - 3.0 * f[1] + 6.0 * f[2] - f[3]) / 6.0;
  if (i == n - 2) return (2.0 * f[i + 1] + 3.0 * f[i] - 6.0 * f[i - 1] + f[i - 2]) / 6.0;
  return (8.0 * (f[i + 1] - f[i - 1]) - (f[i + 2] - f[i - 2])) / 12.0;
}

// Slope at f[i], per step; f without gaps. A continuous function of all values: what changes little from one
// line of the lattice to the next gives slopes that do.
double slope(std::span<const double> f, std::size_t i) {
  const std::size_t n = f.size();
  if (n < 2) return 0.0;
  if (i == 0) return end_slope(f);
  if (i == n - 1) {
    const std::vector<double> turned(f.rbegin(), f.rend());
    return -end_slope(turned);
  }
  const double down = f[i] - f[i - 1], up = f[i + 1] - f[i];
  // No overshoot (Hyman 1983), but room for a maximum between points where the curvature is of one sign.
  double most = down * up > 0.0 ? 3.0 * std::min(std::abs(down), std::abs(up)) : 0.0;
  const std::size_t before = std::max<std::size_t>(i - 1, 1), after = std::min(i + 1, n - 2);
  most = std::max(most, 2.0 * std::abs(minmod(bend(f, before), bend(f, i), bend(f, after))));
  return std::clamp(unlimited_slope(f, i), -most, most);
}

// Cubic Hermite interpolation through one row of values with gaps. Steps between them are divided in `k`
// (even); the result starts and ends half a step inside the row: [(n - 2) k + 1].
std::vector<double> refined(const std::vector<double>& row, int k) {
  const std::size_t n = row.size(), steps = static_cast<std::size_t>(k);
  std::vector<double> result((n - 2) * steps + 1, kUnknown);
  const auto put = [&](std::size_t interval, std::size_t part, double value) {
    const std::size_t at = interval * steps + part;  // from the first value of the row
    if (at >= steps / 2 && at - steps / 2 < result.size()) result[at - steps / 2] = value;
  };
  for (std::size_t begin = 0; begin < n;) {
    if (std::isnan(row[begin])) {
      ++begin;
      continue;
    }
    std::size_t end = begin;
    while (end < n && !std::isnan(row[end])) ++end;
    const std::span<const double> run(row.data() + begin, end - begin);
    put(begin, 0, run[0]);
    for (std::size_t i = 0; i + 1 < run.size(); ++i) {
      const double m0 = slope(run, i), m1 = slope(run, i + 1), step = run[i + 1] - run[i];
      for (std::size_t part = 0; part <= steps; ++part) {
        const double t = static_cast<double>(part) / k;
        put(begin + i, part,
            run[i] + t * (m0 + t * (3.0 * step - 2.0 * m0 - m1 + t * (m0 + m1 - 2.0 * step))));
      }
    }
    begin = end;
  }
  return result;
}

int divisions(double square_m, double step_m) {
  const double n = std::ceil(square_m / step_m);
  const int k = static_cast<int>(std::clamp(n, 2.0, static_cast<double>(kMostSteps)));
  return k + k % 2;
}

}  // namespace

Lattice smooth_field(const ValueGrid& grid, double step_m) {
  if (grid.nu < 1 || grid.nv < 1 ||
      grid.values.size() != static_cast<std::size_t>(grid.nu) * static_cast<std::size_t>(grid.nv) ||
      !(grid.size_m.x > 0.0) || !(grid.size_m.y > 0.0) || !(step_m > 0.0))
    throw InternalError("a field was asked of a grid that is none");
  const Padded padded(grid);
  const int ku = divisions(grid.size_m.x / grid.nu, step_m), kv = divisions(grid.size_m.y / grid.nv, step_m);
  Lattice lattice{grid.nu * ku + 1,
                  grid.nv * kv + 1,
                  {grid.size_m.x / (grid.nu * ku), grid.size_m.y / (grid.nv * kv)},
                  {}};
  std::vector<std::vector<double>> rows;
  std::vector<double> line(static_cast<std::size_t>(padded.nu()));
  for (int j = 0; j < padded.nv(); ++j) {
    for (int i = 0; i < padded.nu(); ++i) line[static_cast<std::size_t>(i)] = padded.at(i, j);
    rows.push_back(refined(line, ku));
  }
  lattice.values.resize(static_cast<std::size_t>(lattice.nx) * static_cast<std::size_t>(lattice.ny));
  line.resize(rows.size());
  for (int i = 0; i < lattice.nx; ++i) {
    for (std::size_t j = 0; j < rows.size(); ++j) line[j] = rows[j][static_cast<std::size_t>(i)];
    const auto column = refined(line, kv);
    for (int j = 0; j < lattice.ny; ++j)
      lattice.values[static_cast<std::size_t>(j * lattice.nx + i)] = column[static_cast<std::size_t>(j)];
  }
  const bool none_below_0 =
      std::none_of(grid.values.begin(), grid.values.end(), [](double v) { return v < 0.0; });
  for (double& v : lattice.values)
    if (v < 0.0 && none_below_0) v = 0.0;
  return lattice;
}

}  // namespace dim
