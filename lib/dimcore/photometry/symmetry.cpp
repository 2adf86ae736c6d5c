#include "photometry/symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace dim {
namespace {

constexpr double kSame_deg = 1e-6;

bool same(double a_deg, double b_deg) { return std::abs(a_deg - b_deg) <= kSame_deg; }

/// A plane of the whole turn: a mixture of two planes of the file.
struct Plane {
  double c_deg;
  std::size_t source;
  std::size_t other;
  double share_of_other;
};

/// To 0..360; 360 itself stays, so that a file's own closing plane is kept apart from its first.
double into_turn(double c_deg) {
  double c = c_deg;
  while (c < -kSame_deg) c += 360.0;
  while (c > 360.0 + kSame_deg) c -= 360.0;
  if (same(c, 0.0)) return 0.0;
  return same(c, 360.0) ? 360.0 : c;
}

void add_reflections(std::vector<Plane>& planes, const std::function<double(double)>& reflect) {
  const std::size_t n = planes.size();
  for (std::size_t i = 0; i < n; ++i) {
    Plane image = planes[i];
    image.c_deg = into_turn(reflect(image.c_deg));
    planes.push_back(image);
  }
}

void sort_unique(std::vector<Plane>& planes) {
  std::stable_sort(planes.begin(), planes.end(),
                   [](const Plane& a, const Plane& b) { return a.c_deg < b.c_deg; });
  const auto end = std::unique(planes.begin(), planes.end(),
                               [](const Plane& a, const Plane& b) { return same(a.c_deg, b.c_deg); });
  planes.erase(end, planes.end());
}

/// Adds the planes at 0 and 360 where they are missing.
void close_turn(std::vector<Plane>& planes) {
  const bool has_first = planes.front().c_deg == 0.0;
  const bool has_last = planes.back().c_deg == 360.0;
  Plane seam;
  if (has_first) {
    seam = planes.front();
  } else if (has_last) {
    seam = planes.back();
  } else {
    const double gap = planes.front().c_deg + 360.0 - planes.back().c_deg;
    seam = {0.0, planes.back().source, planes.front().source, (360.0 - planes.back().c_deg) / gap};
  }
  if (!has_first) {
    seam.c_deg = 0.0;
    planes.insert(planes.begin(), seam);
  }
  if (!has_last) {
    seam.c_deg = 360.0;
    planes.push_back(seam);
  }
}

std::vector<Plane> whole_turn(Symmetry symmetry, const std::vector<double>& c_deg) {
  std::vector<Plane> planes;
  if (symmetry == Symmetry::kAxial) return {{0.0, 0, 0, 0.0}, {360.0, 0, 0, 0.0}};
  for (std::size_t i = 0; i < c_deg.size(); ++i) planes.push_back({into_turn(c_deg[i]), i, i, 0.0});
  const auto in_c90 = [](double c) { return 180.0 - c; };
  const auto in_c0 = [](double c) { return 360.0 - c; };
  if (symmetry == Symmetry::kQuadrilateral || symmetry == Symmetry::kBilateral90_270)
    add_reflections(planes, in_c90);
  if (symmetry == Symmetry::kQuadrilateral || symmetry == Symmetry::kBilateral0_180)
    add_reflections(planes, in_c0);
  sort_unique(planes);
  close_turn(planes);
  return planes;
}

}  // namespace

std::optional<Symmetry> symmetry_of(const std::vector<double>& c_deg) {
  if (c_deg.size() == 1) return Symmetry::kAxial;
  const double first = c_deg.front();
  const double last = c_deg.back();
  const auto spans = [&](double from, double to) { return same(first, from) && same(last, to); };
  if (spans(0, 90)) return Symmetry::kQuadrilateral;
  if (spans(0, 180) || spans(180, 360) || spans(-180, 0)) return Symmetry::kBilateral0_180;
  if (spans(90, 270) || spans(-90, 90)) return Symmetry::kBilateral90_270;
  if (last - first > 180.0 && last - first <= 360.0 + kSame_deg) return Symmetry::kNone;
  return std::nullopt;
}

IntensityDistribution expand(Symmetry symmetry, const std::vector<double>& c_deg,
                             const std::vector<double>& gamma_deg, const std::vector<double>& intensity_cd) {
  const std::size_t n_gamma = gamma_deg.size();
  const std::vector<Plane> planes = whole_turn(symmetry, c_deg);
  IntensityDistribution whole;
  for (const double gamma : gamma_deg) whole.gamma_rad.push_back(radians(gamma));
  whole.intensity_cd.reserve(planes.size() * n_gamma);
  for (const Plane& plane : planes) {
    whole.c_rad.push_back(plane.c_deg == 360.0 ? 2 * kPi : radians(plane.c_deg));
    const double* source = intensity_cd.data() + plane.source * n_gamma;
    const double* other = intensity_cd.data() + plane.other * n_gamma;
    for (std::size_t g = 0; g < n_gamma; ++g)
      whole.intensity_cd.push_back(source[g] + (other[g] - source[g]) * plane.share_of_other);
  }
  return whole;
}

IntensityDistribution expand_about_aim(PhotometricType type, const std::vector<double>& h_deg,
                                       const std::vector<double>& v_deg,
                                       const std::vector<double>& intensity_cd) {
  struct Column {
    double h_deg;
    std::size_t source;
  };
  std::vector<Column> columns;
  if (same(h_deg.front(), 0.0))
    for (std::size_t i = h_deg.size(); i-- > 1;) columns.push_back({-h_deg[i], i});
  for (std::size_t i = 0; i < h_deg.size(); ++i) columns.push_back({h_deg[i], i});

  IntensityDistribution whole;
  whole.type = type;
  const auto value = [&](std::size_t h, std::size_t v) {
    return intensity_cd[columns[h].source * v_deg.size() + v];
  };
  if (type == PhotometricType::kA) {
    for (const Column& column : columns) whole.c_rad.push_back(radians(column.h_deg));
    for (const double v : v_deg) whole.gamma_rad.push_back(radians(v + 90.0));
    for (std::size_t h = 0; h < columns.size(); ++h)
      for (std::size_t v = 0; v < v_deg.size(); ++v) whole.intensity_cd.push_back(value(h, v));
  } else {
    for (const double v : v_deg) whole.c_rad.push_back(radians(v));
    for (const Column& column : columns) whole.gamma_rad.push_back(radians(column.h_deg + 90.0));
    for (std::size_t v = 0; v < v_deg.size(); ++v)
      for (std::size_t h = 0; h < columns.size(); ++h) whole.intensity_cd.push_back(value(h, v));
  }
  return whole;
}

}  // namespace dim
