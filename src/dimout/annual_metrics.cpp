#include "dimout/annual_metrics.hpp"

#include <fmt/format.h>

#include <cmath>

namespace dim {
namespace {

template <double PointMetrics::*kMember>
double percent_of(const YearAtPoints& year, std::size_t point) {
  return 100.0 * year.metrics[point].*kMember;
}

template <double PointMetrics::*kMember>
double plain(const YearAtPoints& year, std::size_t point) {
  return year.metrics[point].*kMember;
}

double daylight_factor_percent(const YearAtPoints& year, std::size_t point) {
  return 100.0 * year.daylight_factors[point];
}
double exposure_klx_h(const YearAtPoints& year, std::size_t point) {
  return year.metrics[point].exposure_lx_h / 1000.0;
}
double sunlight_h(const YearAtPoints& year, std::size_t point) { return year.sunlight_h[point]; }

}  // namespace

const std::vector<MetricColumn>& metric_columns() {
  using M = PointMetrics;
  static const std::vector<MetricColumn> kColumns = {
      {"daylight_factor_percent", "Daylight factor", "%", daylight_factor_percent},
      {"da_percent", "Daylight autonomy", "%", percent_of<&M::autonomy>},
      {"cda_percent", "Continuous daylight autonomy", "%", percent_of<&M::continuous_autonomy>},
      {"udi_low_percent", "Occupied time below 100 lx", "%", percent_of<&M::useful_low>},
      {"udi_supplementary_percent", "Occupied time with 100 to 300 lx", "%", percent_of<&M::useful_supplementary>},
      {"udi_autonomous_percent", "Occupied time with 300 to 3,000 lx", "%", percent_of<&M::useful_autonomous>},
      {"udi_high_percent", "Occupied time above 3,000 lx", "%", percent_of<&M::useful_high>},
      {"exposure_klx_h", "Exposure over the year", "klx h", exposure_klx_h},
      {"half_daylight_lx", "Reached for half of the daylight hours", "lx", plain<&M::half_daylight_lx>},
      {"direct_sun_h", "Occupied hours with over 1,000 lx of direct sun", "h", plain<&M::direct_sun_h>},
      {"sunlight_h", "Hours of sunlight on 21 March", "h", sunlight_h}};
  return kColumns;
}

std::vector<std::string> metric_names() {
  std::vector<std::string> names;
  for (const auto& column : metric_columns()) names.emplace_back(column.name);
  return names;
}

PlaneMap plane_map(const Zone& zone, const MeasuringPlane& plane, const PointSet& set, const MetricColumn& metric,
                   const YearAtPoints& year) {
  PlaneMap map;
  map.title = fmt::format("{}: {}", plane.name, metric.title);
  map.unit = metric.unit;
  map.plane = plane.polygon;
  map.nu = plane.nu;
  map.nv = plane.nv;
  for (std::size_t p = set.first; p < set.first + set.count; ++p)
    map.values.emplace_back(zone.points[p].position,
                            zone.points[p].valid ? metric.value(year, p) : std::nan(""));
  return map;
}

}  // namespace dim
