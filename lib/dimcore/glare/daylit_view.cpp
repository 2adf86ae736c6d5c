#include "glare/daylit_view.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace dim {
namespace {

int subdivision_of(const LuminanceDatabase& database) {
  if (!database.sky() || database.sky()->subdivision == 0)
    throw InputError({{},
                      "holds no daylight coefficients: what is seen through the windows is not known",
                      "run dimray with [sky] model = \"tregenza\" or \"reinhart\" in the lights file"});
  return database.sky()->subdivision;
}

bool scatters(const Finish& finish) {
  return finish.angular_law == "bsdf" || (finish.angular_law == "diffusing" && finish.direct < 1.0);
}

int finish_in_state(const Surface& surface, const std::string& state) {
  const auto named = std::find_if(surface.states.begin(), surface.states.end(),
                                  [&](const WindowState& other) { return other.name == state; });
  return named == surface.states.end() ? surface.finish : named->finish;
}

}  // namespace

DaylitView::DaylitView(const LuminanceDatabase& database, const Mix& mix)
    : database_(database),
      outside_light_(SkyPatches(subdivision_of(database)),
                     database.zone().site ? radians(database.zone().site->north_deg) : 0.0),
      caster_(plates_of(database.zone()), database.zone().diameter_m) {
  Mix daylight = mix;
  for (std::size_t s = 0; s < mix.size(); ++s)
    if (!database.sources()[s].daylight) daylight[s] = 0.0;
  for (const Vec3& xyz : cell_appearance(database, database.cells(), daylight).xyz_cd_m2)
    cell_cd_m2_.push_back(static_cast<float>(xyz.y));
  find_outside(daylight);
  find_panes();
}

void DaylitView::find_outside(const Mix& mix) {
  for (std::size_t s = 0; s < mix.size(); ++s) {
    const Source& source = database_.sources()[s];
    if (!source.daylight || mix[s] == 0.0) continue;
    Outside& outside = outside_[source.group];
    outside.column_cd_m2.resize(outside_light_.n_columns(), 0.0);
    outside.column_cd_m2[column_of(*source.daylight, outside_light_.patches())] += mix[s];
    outside.state = source.daylight->state;
    outside.as_it_stands = source.daylight->as_it_stands;
    outside.class_share.clear();
    for (const Vec3& xyz : source.xyz_by_class(database_.classes())) outside.class_share.push_back(xyz.y);
  }
}

void DaylitView::find_panes() {
  const Zone& zone = database_.zone();
  panes_.resize(zone.surfaces.size());
  for (std::size_t w = 0; w < panes_.size(); ++w) {
    const Surface& surface = zone.surfaces[w];
    if (!is_window(zone, surface)) continue;
    // Solved as one, all windows are of one group.
    auto known = outside_.find(surface.group);
    if (known == outside_.end()) known = outside_.find("all");
    if (known == outside_.end()) continue;
    const Outside& outside = known->second;
    const int finish = outside.as_it_stands ? surface.finish : finish_in_state(surface, outside.state);
    const Finish& glazing = zone.finishes[static_cast<std::size_t>(finish)];
    if (scatters(glazing))
      throw InputError({{},
                        "window '" + surface.name + "' scatters light: how bright it looks is not known",
                        "ask for a state of clear glass with --state"});
    panes_[w].outside = &outside;
    for (std::size_t q = 0; q < database_.classes().size(); ++q)
      panes_[w].transmission.emplace_back(glazing, database_.classes().at(q, finish).transmittance);
  }
}

double DaylitView::through(std::size_t surface, const Vec3& at, const Vec3& direction) const {
  const Pane& pane = panes_[surface];
  if (!pane.outside) return 0.0;
  const auto& surfaces = database_.zone().surfaces;
  // What stands outside is met on its lit side; backs of the room's own surfaces hide nothing of the sky that the
  // solution saw.
  const Hit hit = caster_.nearest(at, direction, static_cast<int>(surface));
  if (hit.plate >= 0 && surfaces[static_cast<std::size_t>(hit.plate)].outside) return 0.0;
  const double cosine = std::abs(glm::dot(direction, surfaces[surface].polygon.normal()));
  double share = 0.0;
  for (std::size_t q = 0; q < pane.transmission.size(); ++q)
    share += pane.outside->class_share[q] * pane.transmission[q].at(std::min(1.0, cosine));
  double cd_m2 = 0.0;
  outside_light_.open(direction).each_column(
      [&](std::size_t column, double its_cd_m2) { cd_m2 += pane.outside->column_cd_m2[column] * its_cd_m2; });
  return share * cd_m2;
}

double DaylitView::luminance_cd_m2(const Vec3& eye, const Vec3& direction) const {
  const Hit hit = caster_.nearest(eye, direction);
  if (hit.plate < 0 || hit.back) return 0.0;
  const auto surface = static_cast<std::size_t>(hit.plate);
  const Cells& cells = database_.cells();
  double cd_m2 = through(surface, eye + hit.t * direction, direction);
  if (cells.first(surface) < cells.first(surface + 1))
    cd_m2 += static_cast<double>(cell_cd_m2_[cells.cell_hit(surface, hit.local, direction)]);
  return cd_m2;
}

void DaylitView::look(const Vec3& eye, std::span<SeenPixel> pixels) const {
  tbb::parallel_for(std::size_t{0}, pixels.size(),
                    [&](std::size_t k) { pixels[k].luminance_cd_m2 = luminance_cd_m2(eye, pixels[k].towards); });
}

}  // namespace dim
