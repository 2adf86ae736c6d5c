#include "light/outside.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "light/sun_disc.hpp"
#include "network/cell_points.hpp"
#include "network/stream_key.hpp"

namespace dim {
namespace {

constexpr int kRaysPerCell = 1024;
constexpr int kSunRays = 64;
constexpr double kMostCellsPerSurface = 100.0;
constexpr double kTolerance = 1e-5;  // of a cell's light: what one more reflection may change
constexpr int kMostReflections = 200;

double lowest_corner_m(const Zone& zone) {
  double lowest = 1e300;
  for (const auto& surface : zone.surfaces)
    for (const auto& ring : surface.polygon.corners())
      for (const Vec3& p : ring) lowest = std::min(lowest, p.z);
  return lowest;
}

Vec3 cosine_direction(double a, double b) {
  const double r = std::sqrt(a), turn = 2.0 * kPi * b;
  return {r * std::cos(turn), r * std::sin(turn), std::sqrt(1.0 - a)};
}

}  // namespace

// Rays of outside cells: what they meet of columns, and which cells.
struct Outside::Links {
  std::vector<double> direct_lx;  // [n_cells, n_columns]
  std::vector<std::map<int, double>> share;  // [n_cells] of the hemisphere, by cell seen
};

Outside::Outside(const Zone& zone, const RayCaster& caster, const OutsideLight& light,
                 const std::vector<std::vector<double>>& reflectance, const Job& job)
    : caster_(caster), light_(light), around_of_(zone.surfaces.size(), -1) {
  ground_m_ = zone.site && zone.site->ground_m ? *zone.site->ground_m : lowest_corner_m(zone);
  around_.finishes = zone.finishes;
  around_.diameter_m = zone.diameter_m;
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
    if (!zone.surfaces[s].outside) continue;
    around_of_[s] = static_cast<int>(around_.surfaces.size());
    surface_of_.push_back(static_cast<int>(s));
    Surface surface = zone.surfaces[s];
    surface.outside = false;
    surface.cell_m = std::max(surface.cell_m, std::sqrt(surface.polygon.area_m2() / kMostCellsPerSurface));
    around_.surfaces.push_back(std::move(surface));
  }
  if (around_.surfaces.empty()) return;
  cells_ = Cells(around_);
  Links found = links(job);
  add_sun(found);
  const std::size_t n_columns = light_.n_columns();
  luminance_cd_m2_.assign(reflectance.size() * n_cells() * n_columns, 0.0);
  for (std::size_t q = 0; q < reflectance.size(); ++q) {
    double* luminance = &luminance_cd_m2_[q * n_cells() * n_columns];
    for (int reflection = 0; reflection < kMostReflections; ++reflection) {
      const std::vector<double> before(luminance, luminance + n_cells() * n_columns);
      std::vector<double> change(n_cells(), 0.0);
      tbb::parallel_for(std::size_t{0}, n_cells(), [&](std::size_t i) {
        const double rho =
            reflectance[q][static_cast<std::size_t>(surface_of_[cells_.surface_of(i)])] / kPi;
        std::vector<double> lx(&found.direct_lx[i * n_columns], &found.direct_lx[(i + 1) * n_columns]);
        for (const auto& [j, share] : found.share[i])
          for (std::size_t c = 0; c < n_columns; ++c)
            lx[c] += kPi * share * before[static_cast<std::size_t>(j) * n_columns + c];
        for (std::size_t c = 0; c < n_columns; ++c) {
          const double cd_m2 = rho * lx[c];
          change[i] = std::max(change[i], cd_m2 > 0.0 ? (cd_m2 - before[i * n_columns + c]) / cd_m2 : 0.0);
          luminance[i * n_columns + c] = cd_m2;
        }
      });
      job.check();
      if (*std::max_element(change.begin(), change.end()) < kTolerance) break;
    }
  }
}

OutsideSeen Outside::seen(const Vec3& from, const Vec3& direction, int skip) const {
  return seen(from, direction, caster_.nearest(from, direction, skip));
}

OutsideSeen Outside::seen(const Vec3& from, const Vec3& direction, const Hit& hit) const {
  const double fall_m = from.z - ground_m_;
  const bool on_ground = direction.z < 0.0 && (hit.plate < 0 || -direction.z * hit.t > fall_m);
  if (on_ground) return light_.ground();
  if (hit.plate < 0) return light_.open(direction);
  const int around = hit.back || static_cast<std::size_t>(hit.plate) >= around_of_.size()
                         ? -1
                         : around_of_[static_cast<std::size_t>(hit.plate)];
  if (around < 0) return {};
  return {-1, 0.0, static_cast<int>(cells_.cell_hit(static_cast<std::size_t>(around), hit.local, direction))};
}

Outside::Links Outside::links(const Job& job) const {
  const std::size_t n_columns = light_.n_columns();
  Links found{std::vector<double>(n_cells() * n_columns, 0.0), std::vector<std::map<int, double>>(n_cells())};
  tbb::parallel_for(std::size_t{0}, n_cells(), [&](std::size_t i) {
    if (job.stopped()) return;
    const Frame& frame = around_.surfaces[cells_.surface_of(i)].polygon.frame();
    const int skip = surface_of_[cells_.surface_of(i)];
    const CellPoints in_cell(around_, cells_, i);
    const LowDiscrepancy4 points(mix(cell_key(around_, cells_, i)));
    for (std::uint64_t k = 0; k < kRaysPerCell; ++k) {
      const auto x = points(k);
      const Vec3 from = frame.to_world(in_cell(x[2], x[3]));
      const Vec3 direction = frame.direction_to_world(cosine_direction(x[0], x[1]));
      const OutsideSeen met = seen(from, direction, skip);
      if (met.cell >= 0) found.share[i][met.cell] += 1.0 / kRaysPerCell;
      met.each_column(
          [&](std::size_t c, double cd_m2) { found.direct_lx[i * n_columns + c] += kPi * cd_m2 / kRaysPerCell; });
    }
  });
  job.check();
  return found;
}

void Outside::add_sun(Links& links) const {
  if (!light_.sun()) return;
  const SunDisc disc(*light_.sun());
  tbb::parallel_for(std::size_t{0}, n_cells(), [&](std::size_t i) {
    const Frame& frame = around_.surfaces[cells_.surface_of(i)].polygon.frame();
    const CellPoints in_cell(around_, cells_, i);
    const LowDiscrepancy4 points(mix(~cell_key(around_, cells_, i)));
    double sum = 0.0;
    for (std::uint64_t k = 0; k < kSunRays; ++k) {
      const auto x = points(k);
      const Vec3 direction = disc.direction(x[0], x[1]);
      const double cosine = glm::dot(frame.n, direction);
      if (!(cosine > 0.0) || !(direction.z > 0.0)) continue;
      const Vec3 from = frame.to_world(in_cell(x[2], x[3]));
      if (caster_.nearest(from, direction, surface_of_[cells_.surface_of(i)]).plate < 0) sum += cosine;
    }
    links.direct_lx[i * light_.n_columns() + light_.sun_column()] += light_.sun()->normal_lx * sum / kSunRays;
  });
}

}  // namespace dim
