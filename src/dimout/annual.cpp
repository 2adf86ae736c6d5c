#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/atomic_file.hpp"
#include "base/input_file.hpp"
#include "base/version.hpp"
#include "climate/control_file.hpp"
#include "climate/metrics.hpp"
#include "climate/occupancy.hpp"
#include "climate/sensor_year.hpp"
#include "common/in_file.hpp"
#include "common/option_checks.hpp"
#include "dimout/annual_metrics.hpp"
#include "dimout/daylight.hpp"
#include "dimout/hourly_file.hpp"
#include "image/heat_map.hpp"
#include "image/picture_module.hpp"
#include "image/writer.hpp"
#include "sky/weather_light.hpp"

namespace dim {
namespace {

constexpr std::size_t kMostPresenceBytes = 64 << 20;
/// Day of the exposure to sunlight of EN 17037.
constexpr int kSunlightMonth = 3, kSunlightDay = 21;

std::vector<bool> times_of_use(const Weather& weather, const std::string& hours, const std::string& presence,
                               const std::string& summer_time) {
  if (!presence.empty())
    return parse_presence(read_text_file(presence, kMostPresenceBytes), name_for_messages(presence),
                          weather.steps.size());
  Schedule schedule = in_file("--occupied", [&] { return parse_hours(hours); });
  if (!summer_time.empty())
    schedule.summer_time = in_file("--dst", [&] { return parse_summer_time(summer_time); });
  return occupied_steps(weather, schedule);
}

double percent(double share) { return 100.0 * share; }

/// "desk points[2]": a point of the sets.
std::size_t point_named(const Zone& zone, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& set : zone.point_sets) {
    for (std::size_t k = 0; k < set.count; ++k) {
      names.push_back(fmt::format("{}[{}]", set.name, k));
      if (names.back() == name) return set.first + k;
    }
  }
  throw InputError(Problem{{}, "no point '" + name + "' for --point", name_cure(name, names)});
}

}  // namespace

struct AnnualCommand::Year : YearAtPoints {
  std::vector<PointSet> sets;
};

AnnualCommand::AnnualCommand(Program& program) : program_(program) {
  annual_ = add_daylight_command(program, input_, "annual", "A year of daylight at the measuring points",
                                 "dimout annual room.lum --weather denver.epw --stats", true);
  annual_->add_flag("--json", input_.database.json, "JSON in place of CSV");
  add_plane_option(*annual_, planes_);
  annual_->add_flag("--stats", stats_, "Each plane as a whole: sDA, ASE, EN 17037");
  annual_->add_option("--target", target_lx_, "Illuminance of daylight autonomy, lx")
      ->type_name("LX")
      ->check(number_within(0.0, 1e6, true));
  auto* hours = annual_->add_option("--occupied", hours_, "Hours of use, of local standard time")
                    ->type_name("HH:MM-HH:MM");
  annual_
      ->add_option("--presence", presence_,
                   "Presence at every step in place of hours: CSV, last field of a row")
      ->type_name("FILE.csv")
      ->excludes(hours);
  annual_
      ->add_option("--dst", summer_time_,
                   "First and last day on which clocks are an hour ahead: hours are the clock's")
      ->type_name("MM-DD,MM-DD");
  auto* map = annual_->add_option("--heat-map", heat_map_, "Draw illuminance at a point by day and hour")
                  ->type_name("FILE.svg");
  annual_->add_option("--point", point_, "Point of the heat map, as in workplane[3]")
      ->type_name("NAME")
      ->needs(map);
  auto* plan = annual_->add_option("--map", plan_, "Draw a metric over a plane in false colours")
                   ->type_name("FILE.svg|png");
  annual_->add_option("--metric", metric_, "Column that the map shows")
      ->type_name("NAME")
      ->check(CLI::IsMember(metric_names()))
      ->needs(plan);
  annual_->add_option("--hourly", hourly_, "Write the illuminance at every step and point")->type_name("FILE.h5");
  annual_
      ->add_option("--control", control_,
                   "Operate windows by the [[blind]] tables of a control file; direct sun and daylight factors "
                   "stay those of windows as they stand")
      ->type_name("FILE.toml")
      ->group("Input");
}

Weather AnnualCommand::weather() {
  Weather weather = read_epw(input_.weather, program_.job());
  program_.warn(weather.warnings);
  program_.warn(beam_without_sun(weather, name_for_messages(input_.weather)));
  return weather;
}

void AnnualCommand::check_outputs() const {
  const std::vector<std::string> inputs = {input_.database.path, input_.weather, control_, presence_};
  for (const auto& output : {input_.database.output, heat_map_, plan_, hourly_})
    if (!output.empty()) program_.check_output(output, inputs);
  const bool png = picture_format_of(plan_) == PictureFormat::png;
  if (!plan_.empty() && !png && !plan_.ends_with(".svg") && !plan_.ends_with(".SVG"))
    throw UsageError("--map '" + plan_ + "': the name must end in .svg or .png");
  if (hourly_ == "-") throw UsageError("--hourly: HDF5 cannot be written to standard output, name a file");
}

bool AnnualCommand::run() {
  if (!annual_->parsed()) return false;
  check_outputs();
  program_.stage("read");
  const DaylitRoom room(program_, input_);
  const Weather weather = this->weather();
  MetricTimes times;
  times.occupied = times_of_use(weather, hours_, presence_, summer_time_);
  times.step_h = weather.step_h;
  program_.stage("sky");
  const AnnualSky sky = annual_sky(weather, room.coefficients.subdivision,
                                   room.coefficients.ground_reflectance, program_.job());
  times.daylight = daylight_steps(sky);
  program_.stage("year");
  Year year;
  year.sets = planar_sets(room.database.zone(), planes_, input_.database.path, "a year of daylight");
  const OperatedWindows windows = operated(room, sky);
  std::optional<HourlyFile> hourly;
  if (!hourly_.empty())
    hourly.emplace(hourly_, room.database, weather, year.sets, windows.blinds, program_.job());
  const auto add = [&](const PointBlock& block) {
    const auto metrics = block_metrics(block, times, target_lx_);
    year.metrics.insert(year.metrics.end(), metrics.begin(), metrics.end());
    if (hourly) hourly->add(block);
  };
  if (windows.parts.empty())
    annual_illuminance(sky, room.coefficients, room.sun, add, program_.job());
  else
    annual_illuminance(sky, windows.parts, add, program_.job());
  year.daylight_factors = daylight_factors(room.coefficients);
  const LocalTime day{weather.steps.front().end.year, kSunlightMonth, kSunlightDay, 0.0};
  year.sunlight_h = sunlight_hours(weather, day, room.sun, room.coefficients.n_points);
  program_.stage(kWritingStage);
  if (hourly) hourly->commit();
  if (!heat_map_.empty()) heat_map(room, windows, sky);
  if (!plan_.empty()) plan(room, year);
  if (stats_)
    planes(room, year);
  else
    points(room, year);
  return true;
}

OperatedWindows AnnualCommand::operated(const DaylitRoom& room, const AnnualSky& sky) {
  if (control_.empty()) return {};
  const ControlPlan plan = read_control(read_text_file(control_, kMostControlBytes), name_for_messages(control_));
  OperatedWindows windows = operate(room.database, room.states, plan.blinds, sky, program_.job());
  say_operated(program_, windows.blinds, sky);
  return windows;
}

void AnnualCommand::points(const DaylitRoom& room, const Year& year) {
  const Zone& zone = room.database.zone();
  std::vector<std::string> columns = {"plane", "point", "x_m", "y_m", "z_m", "nx", "ny", "nz"};
  for (const auto& name : metric_names()) columns.push_back(name);
  Table table(std::move(columns));
  for (const auto& set : year.sets) {
    for (std::size_t p = set.first; p < set.first + set.count; ++p) {
      const Vec3 at = zone.points[p].position + zone.origin_m, n = zone.points[p].normal;
      std::vector<Table::Value> row = {
          set.name, static_cast<long>(p - set.first), at.x, at.y, at.z, n.x, n.y, n.z};
      for (const auto& column : metric_columns()) row.emplace_back(column.value(year, p));
      table.add(std::move(row));
    }
  }
  write_table(program_, table, input_.database);
}

void AnnualCommand::plan(const DaylitRoom& room, const Year& year) {
  const Zone& zone = room.database.zone();
  if (zone.planes.empty())
    throw InputError(Problem{{input_.database.path}, "the zone has no measuring plane to be drawn", ""});
  const auto plane = std::find_if(zone.planes.begin(), zone.planes.end(), [&](const MeasuringPlane& p) {
    return std::any_of(year.sets.begin(), year.sets.end(), [&](const PointSet& set) { return set.name == p.name; });
  });
  if (plane == zone.planes.end()) throw UsageError("--map: sensors have no map, it needs a measuring plane");
  const auto set = std::find_if(zone.point_sets.begin(), zone.point_sets.end(),
                                [&](const PointSet& s) { return s.name == plane->name; });
  const auto metric = std::find_if(metric_columns().begin(), metric_columns().end(),
                                   [&](const MetricColumn& column) { return column.name == metric_; });
  const Drawing drawing = plane_map_drawing(plane_map(zone, *plane, *set, *metric, year));
  if (picture_format_of(plan_) != PictureFormat::png) return write_file(plan_, svg_text(drawing));
  const PictureModule module(executable_folder() + "/../lib/dim");
  if (!module.available()) program_.warn({{{}, "no words on the picture: " + module.no_font_reason(), ""}});
  write_file(plan_, module.png(rasterised(drawing, module), {"DIM " + version(), drawing.title, ""}));
}

void AnnualCommand::planes(const DaylitRoom& room, const Year& year) {
  const Zone& zone = room.database.zone();
  Table table({"plane", "points", "daylight_factor_mean_percent", "daylight_factor_median_percent",
               "da_mean_percent", "cda_mean_percent", "udi_low_percent", "udi_supplementary_percent",
               "udi_autonomous_percent", "udi_high_percent", "sda_percent", "ase_percent",
               "exposure_mean_klx_h", "en17037_target_lx", "en17037_minimum_lx", "en17037", "left_out"});
  for (const auto& set : year.sets) {
    std::vector<PointMetrics> metrics;
    std::vector<double> factors;
    for (std::size_t p = set.first; p < set.first + set.count; ++p) {
      if (!zone.points[p].valid) continue;
      metrics.push_back(year.metrics[p]);
      factors.push_back(year.daylight_factors[p]);
    }
    const PlaneMetrics plane = plane_metrics(metrics);
    double mean = 0.0;
    for (const double factor : factors) mean += factor / static_cast<double>(factors.size());
    std::sort(factors.begin(), factors.end());
    const double median = factors.empty()
                              ? std::nan("")
                              : 0.5 * (factors[(factors.size() - 1) / 2] + factors[factors.size() / 2]);
    table.add({set.name, static_cast<long>(set.count), percent(mean), percent(median),
               percent(plane.mean.autonomy), percent(plane.mean.continuous_autonomy),
               percent(plane.mean.useful_low), percent(plane.mean.useful_supplementary),
               percent(plane.mean.useful_autonomous), percent(plane.mean.useful_high),
               percent(plane.spatial_autonomy), percent(plane.sun_exposure),
               plane.mean.exposure_lx_h / 1000.0, plane.target_lx, plane.minimum_lx,
               std::string(word_of(plane.provision)), static_cast<long>(set.count - metrics.size())});
  }
  write_table(program_, table, input_.database);
}

void AnnualCommand::heat_map(const DaylitRoom& room, const OperatedWindows& windows, const AnnualSky& sky) {
  const Zone& zone = room.database.zone();
  if (zone.points.empty())
    throw InputError(Problem{{input_.database.path}, "the zone has no measuring points", ""});
  const std::string name = point_.empty() ? zone.point_sets.front().name + "[0]" : point_;
  const std::size_t point = in_file(input_.database.path, [&] { return point_named(zone, name); });
  const auto years = sensor_years({name}, sky, parts_at(room, windows, {point}), program_.job());
  HeatMap map;
  map.title = fmt::format("{}: illuminance by daylight", name);
  map.unit = "lx";
  map.steps_per_day = static_cast<int>(std::lround(24.0 / sky.step_h));
  for (std::size_t i = 0; i < sky.n_steps; ++i) map.values.push_back(years[0].total_lx(i));
  write_file(heat_map_, svg_text(heat_map_drawing(map)));
}

}  // namespace dim
