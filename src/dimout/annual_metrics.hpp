#pragma once

#include <string>
#include <vector>

#include "climate/metrics.hpp"
#include "image/plane_map.hpp"
#include "scene/zone.hpp"

namespace dim {

/// A year at all measuring points of a zone. [n_points] each
struct YearAtPoints {
  std::vector<PointMetrics> metrics;
  std::vector<double> daylight_factors;  ///< 0..1
  std::vector<double> sunlight_h;
};

/// A column of `dimout annual`, and what `--map` draws.
struct MetricColumn {
  const char* name;   ///< "da_percent"
  const char* title;  ///< "Daylight autonomy"
  const char* unit;   ///< "%"
  double (*value)(const YearAtPoints& year, std::size_t point);
};

const std::vector<MetricColumn>& metric_columns();
std::vector<std::string> metric_names();

/// A metric over a measuring plane; points that no light reaches have no value.
/// @param set  of the plane's points
PlaneMap plane_map(const Zone& zone, const MeasuringPlane& plane, const PointSet& set, const MetricColumn& metric,
                   const YearAtPoints& year);

}  // namespace dim
