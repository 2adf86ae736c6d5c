#include "result/luminous.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reflection/specular.hpp"

namespace dim {
namespace {

using Reader = std::vector<float> (LuminanceDatabase::*)(std::size_t) const;

std::vector<double> illuminance_lx(const LuminanceDatabase& database, const Mix& mix, std::size_t n,
                                   Reader read) {
  std::vector<double> lx(n, 0.0);
  for (std::size_t s = 0; s < mix.size(); ++s) {
    if (mix[s] == 0.0) continue;
    const auto irradiance = (database.*read)(s);
    for (std::size_t b = 0; b < database.bands().size(); ++b) {
      const double factor = mix[s] * kMaxEfficacy_lm_W * database.sources()[s].weights.y[b];
      for (std::size_t i = 0; i < n; ++i) lx[i] += factor * static_cast<double>(irradiance[b * n + i]);
    }
  }
  return lx;
}

}  // namespace

Mix parse_mix(const std::vector<std::string>& texts, const std::vector<Source>& sources) {
  Mix mix(sources.size(), 1.0);
  for (const auto& text : texts) {
    const auto equals = text.rfind('=');
    const std::string name = text.substr(0, equals);
    char* end = nullptr;
    const std::string number = equals == std::string::npos ? "" : text.substr(equals + 1);
    const double factor = std::strtod(number.c_str(), &end);
    if (number.empty() || *end != '\0' || !(factor >= 0.0) || !std::isfinite(factor))
      throw InputError({{}, "--mix '" + text + "' is not NAME=FACTOR with a factor of at least 0", ""});
    bool found = false;
    std::vector<std::string> names;
    for (std::size_t s = 0; s < sources.size(); ++s) {
      names.push_back(sources[s].name);
      names.push_back(sources[s].group);
      if (sources[s].name != name && sources[s].group != name) continue;
      mix[s] = factor;
      found = true;
    }
    if (!found) throw InputError({{}, "no source or group '" + name + "' for --mix", name_cure(name, names)});
  }
  return mix;
}

Mix only(const Mix& mix, std::size_t source) {
  Mix one(mix.size(), 0.0);
  one[source] = mix[source];
  return one;
}

std::vector<double> point_illuminance_lx(const LuminanceDatabase& database, const Mix& mix) {
  return illuminance_lx(database, mix, database.zone().points.size(), &LuminanceDatabase::point_irradiance);
}

std::vector<double> cell_illuminance_lx(const LuminanceDatabase& database, const Mix& mix) {
  return illuminance_lx(database, mix, database.n_cells(), &LuminanceDatabase::cell_irradiance);
}

namespace {

// Lobes as seen on the mean of all directions: their exitance over pi.
void add_lobes(const LuminanceDatabase& database, std::size_t source, double factor,
               CellAppearance& appearance) {
  const auto& cells = database.off_specular_cells();
  if (cells.empty()) return;
  const auto radiance = database.lobe_radiance(source);
  const auto& weights = database.sources()[source].weights;
  const PatchGrid& grid = database.directional_grid();
  const std::size_t n_patches = grid.n_patches();
  for (std::size_t b = 0; b < database.bands().size(); ++b) {
    const Vec3 response = factor * kMaxEfficacy_lm_W * Vec3(weights.x[b], weights.y[b], weights.z[b]);
    for (std::size_t g = 0; g < cells.size(); ++g) {
      const float* of_patch = &radiance[(b * cells.size() + g) * n_patches];
      double exitance = 0.0;
      for (std::size_t p = 0; p < n_patches; ++p)
        exitance += static_cast<double>(of_patch[p]) *
                    grid.weight_sr(static_cast<int>(p / static_cast<std::size_t>(grid.n_sectors)));
      appearance.xyz_cd_m2[cells[g]] += response * (exitance / kPi);
    }
  }
}

}  // namespace

CellAppearance cell_appearance(const LuminanceDatabase& database, const Cells& cells, const Mix& mix) {
  const Zone& zone = database.zone();
  const Bands& bands = database.bands();
  const std::size_t n = cells.size();
  CellAppearance appearance{std::vector<double>(n, 0.0), std::vector<Vec3>(n, Vec3(0.0))};
  for (std::size_t s = 0; s < mix.size(); ++s) {
    if (mix[s] == 0.0) continue;
    const auto irradiance = database.cell_irradiance(s);
    const auto& weights = database.sources()[s].weights;
    for (std::size_t b = 0; b < bands.size(); ++b) {
      std::vector<double> reflectance;
      for (const auto& finish : zone.finishes)
        reflectance.push_back(band_reflection(finish, bands.low_nm(b), bands.high_nm(b)).diffuse);
      const Vec3 response = mix[s] * kMaxEfficacy_lm_W * Vec3(weights.x[b], weights.y[b], weights.z[b]);
      for (std::size_t i = 0; i < n; ++i) {
        const double e = static_cast<double>(irradiance[b * n + i]);
        const auto finish = static_cast<std::size_t>(zone.surfaces[cells.surface_of(i)].finish);
        appearance.illuminance_lx[i] += response.y * e;
        appearance.xyz_cd_m2[i] += response * (reflectance[finish] * e / kPi);
      }
    }
    add_lobes(database, s, mix[s], appearance);
  }
  return appearance;
}

Vec3 source_xyz(const Source& source) {
  const auto& weights = source.weights;
  Vec3 xyz(0.0);
  for (std::size_t b = 0; b < weights.share.size(); ++b)
    xyz += weights.share[b] * Vec3(weights.x[b], weights.y[b], weights.z[b]);
  return xyz.y > 0.0 ? xyz / xyz.y : Vec3(1.0);
}

std::vector<SurfaceFigures> surface_figures(const Cells& cells, const CellAppearance& appearance) {
  std::vector<SurfaceFigures> figures(cells.n_surfaces());
  for (std::size_t s = 0; s < cells.n_surfaces(); ++s) {
    auto& figure = figures[s];
    if (cells.first(s) == cells.first(s + 1)) continue;
    figure.illuminance_min_lx = std::numeric_limits<double>::max();
    for (std::size_t i = cells.first(s); i < cells.first(s + 1); ++i) {
      const double area = cells.area_m2(i), lx = appearance.illuminance_lx[i];
      figure.area_m2 += area;
      figure.illuminance_mean_lx += area * lx;
      figure.xyz_mean_cd_m2 += area * appearance.xyz_cd_m2[i];
      figure.illuminance_min_lx = std::min(figure.illuminance_min_lx, lx);
      figure.illuminance_max_lx = std::max(figure.illuminance_max_lx, lx);
    }
    figure.illuminance_mean_lx /= figure.area_m2;
    figure.xyz_mean_cd_m2 /= figure.area_m2;
  }
  return figures;
}

GridStatistics grid_statistics(const std::vector<double>& illuminance_lx, const PointSet& set) {
  GridStatistics statistics;
  statistics.n_points = set.count;
  if (set.count == 0) return statistics;
  const auto first = illuminance_lx.begin() + static_cast<std::ptrdiff_t>(set.first);
  const auto last = first + static_cast<std::ptrdiff_t>(set.count);
  statistics.min_lx = *std::min_element(first, last);
  statistics.max_lx = *std::max_element(first, last);
  for (auto lx = first; lx != last; ++lx) statistics.mean_lx += *lx / static_cast<double>(set.count);
  if (statistics.mean_lx > 0.0) statistics.u0 = statistics.min_lx / statistics.mean_lx;
  if (statistics.max_lx > 0.0) statistics.ud = statistics.min_lx / statistics.max_lx;
  return statistics;
}

}  // namespace dim
