#include "dimout/hourly_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace dim {
namespace {

constexpr int kVersion = 1;

/// "2001-06-21T09:00", the end of a step; midnight is 24:00 of the day that ends.
std::string in_words(const LocalTime& time) {
  const auto minutes = static_cast<int>(std::lround(60.0 * time.hour));
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}", time.year, time.month, time.day, minutes / 60, minutes % 60);
}

void add_steps(Hdf5Series& file, const Weather& weather) {
  std::vector<double> hours;
  std::vector<std::string> ends;
  for (std::size_t i = 0; i < weather.steps.size(); ++i) {
    hours.push_back(static_cast<double>(i + 1) * weather.step_h);
    ends.push_back(in_words(weather.steps[i].end));
  }
  file.numbers("step", hours, "h", "end of the step, hours since the beginning of the first");
  file.texts("time", ends, "end of the step, local standard time");
}

void add_points(Hdf5Series& file, const Zone& zone, const std::vector<PointSet>& sets) {
  std::vector<std::string> names;
  std::array<std::vector<double>, 6> places;
  for (const auto& set : sets) {
    for (std::size_t k = 0; k < set.count; ++k) {
      names.push_back(fmt::format("{}[{}]", set.name, k));
      const MeasuringPoint& point = zone.points[set.first + k];
      const Vec3 at = point.position + zone.origin_m;
      for (int i = 0; i < 3; ++i) {
        places[static_cast<std::size_t>(i)].push_back(at[i]);
        places[static_cast<std::size_t>(i + 3)].push_back(point.normal[i]);
      }
    }
  }
  file.texts("point", names, "measuring point: plane or sensors, and its number there");
  constexpr const char* kNames[] = {"x", "y", "z", "nx", "ny", "nz"};
  for (std::size_t i = 0; i < 6; ++i)
    file.numbers(kNames[i], places[i], i < 3 ? "m" : "1", i < 3 ? "place of the point" : "normal of the point");
}

}  // namespace

HourlyFile::HourlyFile(const std::string& path, const LuminanceDatabase& database, const Weather& weather,
                       const std::vector<PointSet>& sets, const std::vector<BlindYear>& blinds, const Job& job)
    : file_(path, "hourly", kVersion, job), sets_(sets) {
  file_.attribute("zone", database.zone().name);
  file_.attribute("luminance_database", database.hash());
  file_.attribute("weather", weather.place);
  add_steps(file_, weather);
  add_points(file_, database.zone(), sets_);
  for (const auto& blind : blinds) {
    std::string name = "closed " + blind.windows;
    std::replace(name.begin(), name.end(), '/', '_');
    file_.numbers(name, std::vector<double>(blind.closed.begin(), blind.closed.end()), "1",
                  "1 where these windows are in their state '" + blind.closed_state + "'");
  }
  file_.table("illuminance", "step", "point", "lx", "by daylight, mean of the step");
}

void HourlyFile::add(const PointBlock& block) {
  std::size_t column = 0;
  for (const auto& set : sets_) {
    const std::size_t from = std::max(set.first, block.first),
                      to = std::min(set.first + set.count, block.first + block.n_points);
    if (from < to) {
      const std::size_t n = to - from;
      std::vector<float> values(block.n_steps * n);
      for (std::size_t p = 0; p < n; ++p) {
        const auto sky = block.sky(from - block.first + p), sun = block.sun(from - block.first + p);
        for (std::size_t step = 0; step < block.n_steps; ++step) values[step * n + p] = sky[step] + sun[step];
      }
      file_.columns(column + from - set.first, n, values);
    }
    column += set.count;
  }
}

}  // namespace dim
