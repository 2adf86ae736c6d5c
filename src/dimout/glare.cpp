#include <fmt/format.h>

#include <cmath>

#include "common/in_file.hpp"
#include "common/option_checks.hpp"
#include "dimout/judging.hpp"
#include "glare/daylit_view.hpp"
#include "glare/observers.hpp"

namespace dim {
namespace {

constexpr int kMostDirections = 360;
constexpr int kFisheye_px = 600;

double whole_degrees(double rad) { return std::round(degrees(rad) * 1e6) / 1e6; }

}  // namespace

GlareCommand::GlareCommand(Program& program) : program_(program) {
  glare_ = add_command(program, input_, "glare",
                       "Unified glare rating (UGR) of a view, or of eyes over a measuring plane",
                       "dimout glare office.lum --view door\n"
                       "  dimout glare office.lum --observers workplane --worst");
  auto& app = *glare_;
  add_table_options(app, input_, false);
  auto* view =
      app.add_option("--view", view_, "View of the zone file; its first one unless said")->type_name("NAME");
  auto* observers = app.add_option("--observers", observers_,
                                   "Eyes over the points of this measuring plane or these sensors")
                        ->type_name("PLANE")
                        ->excludes(view);
  app.add_option("--height", height_m_, "Of the eyes above the floor, m: 1.2 sitting, 1.65 standing")
      ->check(number_within(0.0, 1000.0, true))
      ->needs(observers)
      ->type_name("M");
  app.add_option("--directions", n_directions_,
                 "Level directions each eye looks in, the first along +x; 4: along the axes")
      ->check(CLI::Range(1, kMostDirections))
      ->needs(observers)
      ->type_name("N");
  app.add_flag("--daylight", daylight_,
               "Daylight glare probability, DGP and DGPs, of the sky that --sky asks for, luminaires left out")
      ->excludes(observers);
  app.add_flag("--worst", worst_, "Only the worst eye and direction")->needs(observers);
}

bool GlareCommand::run() {
  if (!glare_->parsed()) return false;
  program_.check_output(input_.output, {input_.path});
  const LuminanceDatabase database = open_database(program_, input_);
  if (daylight_) {
    of_daylight(database);
    return true;
  }
  if (database.luminaires().empty()) program_.say("the room has no luminaires: nothing glares");
  observers_.empty() ? of_view(database) : of_observers(database);
  return true;
}

void GlareCommand::of_view(const LuminanceDatabase& database) {
  const View& view = in_file(input_.path, [&]() -> const View& { return find_view(database.zone(), view_); });
  const GlareField field(database, mix_of(database, input_));
  const auto rating = glare_at(field.at(view.eye), LineOfSight::along(view.focus - view.eye, view.up));
  Table table({"view", "ugr", "background_cd_m2", "sources", "large_sources"});
  table.add({view.name, rating.ugr, rating.background_cd_m2, static_cast<long>(rating.n_sources),
             static_cast<long>(rating.n_large)});
  write_table(program_, table, input_);
}

void GlareCommand::of_daylight(const LuminanceDatabase& database) {
  if (database.sky() && database.sky()->subdivision > 0 && input_.sky.empty())
    throw UsageError("--daylight needs a sky: --sky cie-12:15000@40,150, for example");
  const View& view = in_file(input_.path, [&]() -> const View& { return find_view(database.zone(), view_); });
  const LineOfSight sight = LineOfSight::along(view.focus - view.eye, view.up);
  auto pixels = fisheye_pixels(sight, kFisheye_px);
  in_file(input_.path, [&] { DaylitView(database, mix_of(database, input_)).look(view.eye, pixels); });
  const DaylightGlare glare = daylight_glare(pixels, sight);
  Table table({"view", "dgp", "dgps", "vertical_lx", "sources"});
  table.add({view.name, glare.dgp, glare.dgps, glare.vertical_lx, static_cast<long>(glare.n_sources)});
  write_table(program_, table, input_);
}

void GlareCommand::of_observers(const LuminanceDatabase& database) {
  const Zone& zone = database.zone();
  const PointSet set = chosen_sets(zone, {observers_}, input_.path).front();
  const GlareField field(database, mix_of(database, input_));
  const auto ratings = observer_ratings(zone, field, set, {height_m_, n_directions_}, program_.job());
  Table table({"plane", "point", "x_m", "y_m", "z_m", "direction_deg", "ugr", "background_cd_m2", "sources",
               "large_sources"});
  const auto add = [&](const ObserverRating& r) {
    const Vec3 at = r.eye + zone.origin_m;
    table.add({set.name, static_cast<long>(r.point), at.x, at.y, at.z, whole_degrees(r.direction_rad),
               r.rating.ugr, r.rating.background_cd_m2, static_cast<long>(r.rating.n_sources),
               static_cast<long>(r.rating.n_large)});
  };
  if (!worst_)
    for (const auto& rating : ratings) add(rating);
  else if (const auto* worst = worst_of(ratings))
    add(*worst);
  else
    program_.say("no eye there has a glare rating");
  write_table(program_, table, input_);
}

}  // namespace dim
