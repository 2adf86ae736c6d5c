#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/atomic_file.hpp"
#include "base/version.hpp"
#include "climate/sky_mix.hpp"
#include "common/option_checks.hpp"
#include "dimout/commands.hpp"
#include "image/contour_levels.hpp"
#include "image/contour_values.hpp"
#include "image/picture_module.hpp"

namespace dim {
namespace {

constexpr double kSymbol_px = 16.0;  // of luminaires that are smaller on the plan

// Ascending; each once.
std::vector<double> parse_levels(const std::string& text) {
  std::vector<double> levels;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    char* rest = nullptr;
    const double level = std::strtod(part.c_str(), &rest);
    if (part.empty() || *rest != '\0' || !std::isfinite(level))
      throw UsageError("--levels '" + text + "' are not numbers with commas between");
    levels.push_back(level);
    begin = end + 1;
  }
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  return levels;
}

std::string capitalised(std::string word) {
  word.front() = static_cast<char>(word.front() - 'a' + 'A');
  return word;
}

std::string rounded(double v) { return v >= 1000.0 ? fmt::format("{:.0f}", v) : fmt::format("{:.3g}", v); }

void add_figures(double mean, double min, double max, ContourMap& map) {
  const std::string unit = map.unit.empty() ? "" : " " + map.unit;
  map.figures = {{"mean", rounded(mean) + unit}, {"min", rounded(min) + unit}, {"max", rounded(max) + unit}};
  if (mean > 0.0) map.figures.emplace_back("U0", fmt::format("{:.2f}", min / mean));
}

// What the error is stated not to exceed: of 95 % of the points, or of a surface's mean.
void add_stated(double share, ContourMap& map) {
  if (share > 0.0) map.figures.emplace_back("error", fmt::format("{:.2g} %", 100.0 * share));
}

}  // namespace

ContourCommand::ContourCommand(Program& program) : program_(program) {
  contour_ = add_command(program, input_, "contour",
                         "Isolines on the plan of a measuring plane or a surface: SVG or PNG",
                         "dimout contour office.lum --plane workplane --filled -o workplane.svg");
  auto& app = *contour_;
  app.add_option("-o,--output", input_.output,
                 "Picture; its ending says the format: svg, png; - for SVG on standard output")
      ->required()
      ->type_name("FILE");
  auto* plane = app.add_option("--plane", plane_, "Measuring plane; the zone's first one unless said")
                    ->type_name("NAME");
  app.add_option("--surface", surface_, "Surface, from its cells, in place of a measuring plane")
      ->type_name("NAME")
      ->excludes(plane);
  app.add_option("--levels", levels_, "Levels in place of the customary series")->type_name("L1,L2,...");
  app.add_flag("--filled", filled_, "Colours between the lines, with a legend");
  app.add_flag("--values", values_, "Figures at the points, as many as can be read");
  app.add_flag("--daylight-factor", daylight_factor_,
               "Daylight over the illuminance outside, %: luminaires and the sun's beam left out");
  app.add_option("--size", size_px_, "Longer side of the plan, pixels")
      ->check(CLI::Range(kLeastPlan_px, kMostPlan_px))
      ->type_name("PX");
}

bool ContourCommand::run() {
  if (!contour_->parsed()) return false;
  draw();
  return true;
}

std::vector<double> ContourCommand::chosen_levels(const std::vector<double>& values) const {
  if (!levels_.empty()) return parse_levels(levels_);
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  for (const double v : values) {
    if (std::isnan(v)) continue;
    least = std::min(least, v);
    greatest = std::max(greatest, v);
  }
  return least < greatest ? customary_levels(least, greatest) : std::vector<double>{};
}

void ContourCommand::set_shared(const LuminanceDatabase& database, const std::string& name, ContourMap& map) {
  map.levels = chosen_levels(map.values.values);
  map.plan = plan_frame(database.zone(), map.polygon);
  map.north = north_in_plan(database.zone(), map.plan);
  map.title = fmt::format("{}: {} on {}", database.zone().name,
                          static_cast<char>(map.quantity.front() - 'A' + 'a') + map.quantity.substr(1), name);
  map.filled = filled_;
  map.with_values = values_;
  map.size_px = size_px_;
}

ContourMap ContourCommand::map_of_plane(const LuminanceDatabase& database) {
  const Zone& zone = database.zone();
  if (zone.planes.empty())
    throw InputError({{input_.path, 0, 0},
                      "the zone has no measuring plane",
                      "add a [[plane]] to the zone file, or use --surface"});
  const std::string name = plane_.empty() ? zone.planes.front().name : plane_;
  const PointSet set = chosen_sets(zone, {name}, input_.path).front();
  const auto found =
      std::find_if(zone.planes.begin(), zone.planes.end(), [&](const auto& p) { return p.name == name; });
  if (found == zone.planes.end())
    throw InputError({{input_.path, 0, 0},
                      "'" + name + "' are single sensors: isolines need a measuring plane",
                      "add a [[plane]] to the zone file"});
  if (daylight_factor_) planar_sets(zone, {name}, input_.path, "the daylight factor");
  const Quantity quantity = quantity_of(zone, set);
  const double outside = daylight_factor_ ? outside_lx(database, input_) : 0.0;
  const Mix asked = mix_of(database, input_);
  auto values = point_illuminance_lx(database, daylight_factor_ ? diffuse_daylight(database, asked) : asked);
  if (daylight_factor_)
    for (double& v : values) v *= 100.0 / outside;
  ContourMap map;
  map.polygon = found->polygon;
  map.values = values_on_plane(zone, static_cast<std::size_t>(found - zone.planes.begin()), values);
  map.quantity = daylight_factor_                ? "Daylight factor"
                 : quantity == Quantity::planar ? "Illuminance"
                                                : capitalised(quantity_word(quantity)) + " illuminance";
  map.unit = daylight_factor_ ? "%" : "lx";
  set_shared(database, name, map);
  const auto statistics = grid_statistics(values, zone.points, set);
  if (std::isnan(statistics.mean_lx))
    throw InputError(
        {{input_.path, 0, 0}, "no point of '" + name + "' is inside the room", "move the plane"});
  add_figures(statistics.mean_lx, statistics.min_lx, statistics.max_lx, map);
  map.figures.emplace_back("points", fmt::format("{}", statistics.n_points - statistics.n_left_out));
  if (const auto errors = point_errors(database, asked))
    add_stated(stated_share(*errors, values, zone.points, set).total, map);
  map.below = plan_of_room(zone, database.luminaires(), map.plan, program_.job());
  const double px_per_m = size_px_ / std::max(map.plan.width_m(), map.plan.height_m());
  const auto symbols = luminaire_symbols(database.luminaires(), map.plan, kSymbol_px / px_per_m);
  map.below.insert(map.below.end(), symbols.begin(), symbols.end());
  return map;
}

ContourMap ContourCommand::map_of_surface(const LuminanceDatabase& database) {
  const Zone& zone = database.zone();
  std::vector<std::string> names;
  for (const auto& surface : zone.surfaces)
    if (!surface.outside) names.push_back(surface.name);
  const auto found = std::find_if(zone.surfaces.begin(), zone.surfaces.end(),
                                  [&](const auto& s) { return s.name == surface_ && !s.outside; });
  if (found == zone.surfaces.end())
    throw InputError({{input_.path, 0, 0}, "no surface '" + surface_ + "'", name_cure(surface_, names)});
  const auto index = static_cast<std::size_t>(found - zone.surfaces.begin());
  const Mix mix = mix_of(database, input_);
  const auto appearance = cell_appearance(database, database.cells(), mix);
  ContourMap map;
  map.polygon = found->polygon;
  map.values = values_on_surface(database.cells(), found->polygon, index, appearance.illuminance_lx);
  map.quantity = "Illuminance";
  map.unit = "lx";
  set_shared(database, surface_, map);
  const auto of_all = surface_figures(database.cells(), appearance);
  const auto& figures = of_all[index];
  add_figures(figures.illuminance_mean_lx, figures.illuminance_min_lx, figures.illuminance_max_lx, map);
  const auto errors = surface_errors(database, mix, of_all);
  if (errors && figures.illuminance_mean_lx > 0.0)
    add_stated((*errors)[index].total_lx() / figures.illuminance_mean_lx, map);
  map.below = plan_of_surface(zone, index, map.plan);
  return map;
}

void ContourCommand::draw() {
  const bool png = picture_format_of(input_.output) == PictureFormat::png;
  const bool svg = input_.output == "-" || input_.output.ends_with(".svg") || input_.output.ends_with(".SVG");
  if (!png && !svg) throw UsageError("-o '" + input_.output + "': the name must end in .svg or .png");
  if (!surface_.empty()) refuse_without_effect(*contour_, {"--daylight-factor"}, "with --surface");
  if (!levels_.empty()) parse_levels(levels_);
  program_.check_output(input_.output, {input_.path});
  program_.stage("read");
  const LuminanceDatabase database = open_database(program_, input_);
  program_.stage("lines");
  const Drawing drawing =
      contour_drawing(surface_.empty() ? map_of_plane(database) : map_of_surface(database));
  program_.stage(kWritingStage);
  if (svg) {
    write_file(input_.output, svg_text(drawing));
    return;
  }
  const PictureModule module(executable_folder() + "/../lib/dim");
  if (!module.available()) program_.warn({{{}, "no words on the picture: " + module.no_font_reason(), ""}});
  write_file(input_.output, module.png(rasterised(drawing, module), {"DIM " + version(), drawing.title, ""}));
}

}  // namespace dim
