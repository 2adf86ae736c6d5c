#include "result/luminous.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace dim {
namespace {

std::vector<double> illuminance_lx(const LuminanceDatabase& database, const Mix& mix, std::size_t n,
                                   TransferPart part) {
  std::vector<double> lx(n, 0.0);
  for (std::size_t s = 0; s < mix.size(); ++s) {
    if (mix[s] == 0.0) continue;
    const auto transfer = database.transfer(part, s);
    const auto xyz = database.sources()[s].xyz_by_class(database.classes());
    const bool one_class = transfer.size() == n;  // direct light that no mirror colours
    for (std::size_t q = 0; q < xyz.size(); ++q) {
      const float* of_class = transfer.data() + (one_class ? 0 : q * n);
      for (std::size_t i = 0; i < n; ++i) lx[i] += mix[s] * xyz[q].y * static_cast<double>(of_class[i]);
    }
  }
  return lx;
}

}  // namespace

std::vector<std::size_t> sources_named(const std::string& name, const std::vector<Source>& sources,
                                       const std::string& option) {
  std::vector<std::size_t> found;
  std::vector<std::string> names;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    names.push_back(sources[s].name);
    names.push_back(sources[s].group);
    if (sources[s].name == name || sources[s].group == name) found.push_back(s);
  }
  if (found.empty())
    throw InputError({{}, "no source or group '" + name + "' for " + option, name_cure(name, names)});
  return found;
}

Mix parse_mix(const std::vector<std::string>& texts, const std::vector<Source>& sources) {
  Mix mix(sources.size(), 1.0);
  for (const auto& text : texts) {
    const auto equals = text.rfind('=');
    char* end = nullptr;
    const std::string number = equals == std::string::npos ? "" : text.substr(equals + 1);
    const double factor = std::strtod(number.c_str(), &end);
    if (number.empty() || *end != '\0' || !(factor >= 0.0) || !std::isfinite(factor))
      throw InputError({{}, "--mix '" + text + "' is not NAME=FACTOR with a factor of at least 0", ""});
    for (const std::size_t s : sources_named(text.substr(0, equals), sources, "--mix")) mix[s] = factor;
  }
  return mix;
}

void put_into_states(const std::vector<std::string>& texts, const std::vector<Source>& sources, Mix& mix) {
  std::map<std::string, std::string> asked;
  for (const auto& text : texts) {
    const auto equals = text.find('=');
    const std::string group = text.substr(0, equals), state = text.substr(equals + 1);
    std::vector<std::string> groups, states;
    for (const auto& source : sources) {
      if (!source.daylight) continue;
      groups.push_back(source.group);
      if (source.group == group) states.push_back(source.daylight->state);
    }
    if (states.empty())
      throw InputError({{}, "no windows '" + group + "' for --state", name_cure(group, groups)});
    if (std::find(states.begin(), states.end(), state) == states.end())
      throw InputError({{}, "windows '" + group + "' have no state '" + state + "'", name_cure(state, states)});
    asked[group] = state;
  }
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const auto& daylight = sources[s].daylight;
    if (!daylight) continue;
    const auto state = asked.find(sources[s].group);
    if (state == asked.end() ? !daylight->as_it_stands : daylight->state != state->second) mix[s] = 0.0;
  }
}

std::optional<Mix> maintained(const std::vector<Source>& sources, const Mix& mix) {
  Mix kept = mix;
  bool any = false;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    if (!sources[s].maintenance) continue;
    kept[s] *= *sources[s].maintenance;
    any |= mix[s] != 0.0;
  }
  if (!any) return std::nullopt;
  return kept;
}

Mix only(const Mix& mix, std::size_t source) {
  Mix one(mix.size(), 0.0);
  one[source] = mix[source];
  return one;
}

std::vector<double> point_illuminance_lx(const LuminanceDatabase& database, const Mix& mix) {
  return illuminance_lx(database, mix, database.zone().points.size(), TransferPart::point_total);
}

std::vector<double> direct_point_illuminance_lx(const LuminanceDatabase& database, const Mix& mix) {
  return illuminance_lx(database, mix, database.zone().points.size(), TransferPart::point_direct);
}

std::vector<double> cell_illuminance_lx(const LuminanceDatabase& database, const Mix& mix) {
  return illuminance_lx(database, mix, database.n_cells(), TransferPart::cell_total);
}

namespace {

// Lobes as seen on the mean of all directions: their exitance over pi.
void add_lobes(const LuminanceDatabase& database, std::size_t source, double factor,
               CellAppearance& appearance) {
  const auto& cells = database.off_specular_cells();
  if (cells.empty()) return;
  const auto luminance = database.transfer(TransferPart::lobe_total, source);
  const auto xyz = database.sources()[source].xyz_by_class(database.classes());
  const PatchGrid& grid = database.directional_grid();
  const std::size_t n_patches = grid.n_patches();
  for (std::size_t q = 0; q < xyz.size(); ++q) {
    for (std::size_t g = 0; g < cells.size(); ++g) {
      const float* of_patch = &luminance[(q * cells.size() + g) * n_patches];
      double exitance = 0.0;
      for (std::size_t p = 0; p < n_patches; ++p)
        exitance += static_cast<double>(of_patch[p]) *
                    grid.weight_sr(static_cast<int>(p / static_cast<std::size_t>(grid.n_sectors)));
      appearance.xyz_cd_m2[cells[g]] += factor * exitance / kPi * xyz[q];
    }
  }
}

}  // namespace

CellAppearance cell_appearance(const LuminanceDatabase& database, const Cells& cells, const Mix& mix) {
  const Zone& zone = database.zone();
  const auto& classes = database.classes();
  const std::size_t n = cells.size();
  CellAppearance appearance{std::vector<double>(n, 0.0), std::vector<Vec3>(n, Vec3(0.0))};
  for (std::size_t s = 0; s < mix.size(); ++s) {
    if (mix[s] == 0.0) continue;
    const auto transfer = database.transfer(TransferPart::cell_total, s);
    const auto xyz = database.sources()[s].xyz_by_class(classes);
    for (std::size_t q = 0; q < classes.size(); ++q) {
      for (std::size_t i = 0; i < n; ++i) {
        const Vec3 incident = mix[s] * static_cast<double>(transfer[q * n + i]) * xyz[q];
        appearance.illuminance_lx[i] += incident.y;
        appearance.xyz_cd_m2[i] +=
            classes.at(q, zone.surfaces[cells.surface_of(i)].finish).diffuse / kPi * incident;
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

GridStatistics grid_statistics(const std::vector<double>& illuminance_lx,
                               const std::vector<MeasuringPoint>& points, const PointSet& set) {
  std::vector<double> lx;
  for (std::size_t p = set.first; p < set.first + set.count; ++p) {
    if (points[p].valid) lx.push_back(illuminance_lx[p]);
  }
  GridStatistics statistics;
  statistics.n_points = set.count;
  statistics.n_left_out = set.count - lx.size();
  if (lx.empty()) {
    for (double GridStatistics::*figure : {&GridStatistics::min_lx, &GridStatistics::mean_lx,
                                           &GridStatistics::max_lx, &GridStatistics::u0, &GridStatistics::ud})
      statistics.*figure = std::numeric_limits<double>::quiet_NaN();
    return statistics;
  }
  statistics.min_lx = *std::min_element(lx.begin(), lx.end());
  statistics.max_lx = *std::max_element(lx.begin(), lx.end());
  for (const double x : lx) statistics.mean_lx += x / static_cast<double>(lx.size());
  if (statistics.mean_lx > 0.0) statistics.u0 = statistics.min_lx / statistics.mean_lx;
  if (statistics.max_lx > 0.0) statistics.ud = statistics.min_lx / statistics.max_lx;
  return statistics;
}

}  // namespace dim
