#include "transport/daylight_columns.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "light/direct_light.hpp"
#include "network/stream_key.hpp"

namespace dim {
namespace {

std::unique_ptr<const OutsideLight> outside_light(const Zone& zone, const SkyLight& sky) {
  const double north_rad = zone.site ? radians(zone.site->north_deg) : 0.0;
  if (sky.now) return std::make_unique<const OutsideLight>(*sky.now, north_rad, sky.ground_reflectance);
  return std::make_unique<const OutsideLight>(SkyPatches(sky.subdivision), north_rad);
}

// One group of them all, where there are no states to choose from.
void merge_groups(Windows& windows) {
  const bool plain = !windows.dome && std::all_of(windows.groups.begin(), windows.groups.end(),
                                                  [](const WindowGroup& group) { return group.states.size() == 1; });
  if (!plain || windows.groups.size() < 2) return;
  WindowGroup all{"all", windows.groups.front().states, {}};
  for (std::size_t w = 0; w < windows.windows.size(); ++w) {
    windows.windows[w].group = 0;
    all.windows.push_back(w);
  }
  windows.groups = {all};
}

const char* word_of(DaylightPart part) {
  switch (part) {
    case DaylightPart::sky:
      return "sky";
    case DaylightPart::ground:
      return "ground";
    case DaylightPart::sun:
      return "sun";
    case DaylightPart::ramp:
      break;
  }
  return "ramp";
}

// Of patches and ramps among their like; -1 for the ground.
int index_of(DaylightPart part, std::size_t column, const SkyPatches& patches) {
  if (part == DaylightPart::ground) return -1;
  return static_cast<int>(part == DaylightPart::ramp ? column - patches.ramp(0) : column);
}

ReceiverArea area_of(const Receiver& receiver) {
  return {receiver.response(), receiver.ring, receiver.skip, receiver.stream};
}

// Columns of one class for all classes.
void spread(std::vector<double>& rows, std::size_t n_sources, std::size_t n_classes) {
  std::vector<double> all;
  all.reserve(rows.size() * n_classes);
  for (std::size_t at = 0; at < rows.size(); at += n_sources)
    for (std::size_t q = 0; q < n_classes; ++q)
      all.insert(all.end(), rows.begin() + static_cast<std::ptrdiff_t>(at),
                 rows.begin() + static_cast<std::ptrdiff_t>(at + n_sources));
  rows = std::move(all);
}

}  // namespace

DaylightSources::DaylightSources(const Room& room, const ModelPlan& plan, const SimulationOptions& options,
                                 const Job& job)
    : room_(room),
      first_(plan.n_sources()),
      n_classes_(plan.n_classes()),
      classes_(plan.classes),
      windows_(find_windows(room.zone)),
      light_(outside_light(room.zone, *room.lights.sky)) {
  const Zone& zone = room.zone;
  const SkyLight& sky = *room.lights.sky;
  const RayCaster& caster = room.obstructions.caster();
  if (options.combine == Combine::all) merge_groups(windows_);
  panes_ = std::make_unique<const Panes>(zone, windows_, classes_.of_finish);
  outside_ = std::make_unique<const Outside>(zone, caster, *light_, panes_->outside_reflectance(), job);
  flux_ = std::make_unique<const WindowFlux>(zone, windows_, *panes_, *outside_, caster, job);
  window_light_ =
      std::make_unique<const WindowLight>(zone, windows_, *panes_, *outside_, caster, room.obstructions.shadows());
  sun_light_ = std::make_unique<const SunLight>(zone, windows_, *panes_, *outside_, room.obstructions);
  record_.subdivision = sky.now ? 0 : sky.subdivision;
  record_.horizontal_lx = sky.now ? sky.now->sky.horizontal_lx() : 0.0;
  record_.ground_reflectance = sky.ground_reflectance;
  make_sources(sky, options.bands);
}

void DaylightSources::make_sources(const SkyLight& sky, const Bands& bands) {
  const BandWeights of_sky = band_weights(sky.sky_spectrum, bands), of_sun = band_weights(sky.sun_spectrum, bands);
  for (std::size_t g = 0; g < windows_.groups.size(); ++g) {
    const WindowGroup& group = windows_.groups[g];
    for (std::size_t s = 0; s < group.states.size(); ++s) {
      for (std::size_t c = 0; c < n_outside_columns(); ++c) {
        const DaylightPart part = light_->part(c);
        const int index = light_->by_patches() ? index_of(part, c, light_->patches()) : -1;
        Source source;
        source.name = index < 0 ? word_of(part) : fmt::format("{}[{}]", word_of(part), index);
        source.group = group.name;
        source.weights = part == DaylightPart::sun ? of_sun : of_sky;
        source.daylight = DaylightOrigin{part, index, group.states[s], s == 0};
        origin_.push_back({g, s, c});
        sources_.push_back(std::move(source));
      }
    }
  }
}

double DaylightSources::luminous_flux_lm(const Source& source, const std::vector<double>& class_flux_lm) const {
  const auto xyz = source.xyz_by_class(classes_);
  double lm = 0.0;
  for (std::size_t q = 0; q < n_classes_; ++q) lm += xyz[q].y * class_flux_lm[q];
  return lm;
}

void DaylightSources::append_to(ModelPlan& plan, Warnings& warnings) const {
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    plan.sources.push_back(sources_[s]);
    plan.sources.back().flux_lm = luminous_flux_lm(sources_[s], class_flux_lm(s));
  }
  plan.daylight = in_words();
  const auto shines = [](Shininess kind) { return kind != Shininess::diffusing; };
  if (std::any_of(plan.of_surface.begin(), plan.of_surface.end(), shines))
    warnings.push_back({{},
                        "finishes that shine absorb what they would reflect of direct daylight like a mirror; their "
                        "diffuse part and all light of luminaires are complete",
                        "--finish NAME=ENTRY with a diffuse finish shows how much it matters"});
}

std::vector<double> DaylightSources::class_flux_lm(std::size_t s) const {
  std::vector<double> lm;
  for (std::size_t q = 0; q < n_classes_; ++q) lm.push_back(flux_->flux_lm(slot(s, q))[origin_[s].column]);
  return lm;
}

void DaylightSources::add_flights(std::vector<FirstFlight>& flights) const {
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    const double flux_lm = flux_->flux_lm(slot(s, 0))[origin_[s].column];
    if (!(flux_lm > 0.0)) continue;
    flights[first_ + s].escaped = flux_->escaped_lm(slot(s, 0))[origin_[s].column] / flux_lm;
    flights[first_ + s].lost = flux_->lost_lm(slot(s, 0))[origin_[s].column] / flux_lm;
  }
}

void DaylightSources::take_flux(std::vector<Source>& sources, std::vector<std::vector<double>>& class_flux_lm,
                                const std::vector<ColumnReport>& columns) const {
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    auto& flux_lm = class_flux_lm[first_ + s] = this->class_flux_lm(s);
    if (!windows_.groups[origin_[s].group].windows.empty()) continue;
    for (std::size_t q = 0; q < n_classes_; ++q) flux_lm[q] = columns[q * sources.size() + first_ + s].received;
    sources[first_ + s].flux_lm = luminous_flux_lm(sources[first_ + s], flux_lm);
  }
}

std::vector<std::string> DaylightSources::in_words() const {
  std::size_t n_states = 0;
  for (const auto& group : windows_.groups) n_states += group.states.size();
  std::vector<std::string> words;
  words.emplace_back(fmt::format("light from outside: windows {}, groups {}, states of all groups {}, each with {}",
                              windows_.windows.size(), windows_.groups.size(), n_states,
                              light_->by_patches() ? fmt::format("{} patches and {} ramps of the sky and the ground",
                                                                 light_->patches().size(), light_->patches().n_ramps())
                              : light_->sun()      ? "sky, ground and sun"
                                                   : "sky and ground"));
  words.emplace_back(tinted() ? "panes or surfaces outside colour the light: it is kept by class of bands"
                           : "panes let all wavebands pass alike: direct daylight is kept once");
  words.emplace_back("inside, panes reflect evenly in all directions, not as mirrors");
  words.emplace_back(n_outside_cells() > 0
                      ? fmt::format("outside surfaces reflect evenly, on {} cells", n_outside_cells())
                      : std::string("no outside surface: rays that leave meet sky or ground"));
  if (windows_.dome) words.emplace_back("the zone is open in ways only rays know: the whole sky is sampled");
  return words;
}

void DaylightSources::add_to(DirectColumns& direct, const ModelPlan& plan, const Job& job) const {
  const std::size_t n_sources = plan.n_sources();
  if (tinted() && direct.n_columns == n_sources) {
    spread(direct.cell, n_sources, n_classes_);
    spread(direct.point, n_sources, n_classes_);
    spread(direct.point_variance_lx2, n_sources, n_classes_);
    spread(direct.surface_variance_lx2, n_sources, n_classes_);
    direct.n_columns = n_sources * n_classes_;
  }
  const std::size_t n_tints = direct.n_columns / n_sources;
  tbb::enumerable_thread_specific<SlotSums> of_thread(
      [&] { return SlotSums(windows_, *panes_, *outside_, *flux_); });
  const auto add = [&](const Receiver& receiver, double free_share, double* row) {
    SlotSums& sums = of_thread.local();
    sums.clear();
    const ReceiverArea area = area_of(receiver);
    window_light_->add(area, sums);
    sun_light_->add(area, sums);
    const auto& lx = sums.finish();
    for (std::size_t q = 0; q < n_tints; ++q)
      for (std::size_t s = 0; s < origin_.size(); ++s)
        row[q * n_sources + first_ + s] +=
            lx[panes_->slot(origin_[s].group, origin_[s].state, q) * n_outside_columns() + origin_[s].column] / free_share;
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, room_.cells.size(), 8), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end() && !job.stopped(); ++i)
      add(cell_receiver(room_.zone, room_.cells, i), room_.cells.free_share(i), &direct.cell[i * direct.n_columns]);
  });
  job.check();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, room_.n_points(), 1), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end() && !job.stopped(); ++i) {
      const MeasuringPoint& point = room_.zone.points[i];
      const Frame frame = frame_at(point);
      add(point_receiver(frame, -1, point_key(room_.zone, i), point.quantity), 1.0, &direct.point[i * direct.n_columns]);
    }
  });
  job.check();
  if (light_->by_patches() && room_.zone.closed) balance(direct, n_sources);
}

// Brings what cells receive from each patch to the flux that the patch sends in. All patches together are right to some
// tenths of a percent, but a single one is met by few of the rays of each cell and may be off by a quarter.
void DaylightSources::balance(DirectColumns& direct, std::size_t n_sources) const {
  constexpr double kMost = 4.0;
  std::vector<double> factor(direct.n_columns, 0.0);
  for (std::size_t i = 0; i < room_.cells.size(); ++i)
    for (std::size_t c = 0; c < direct.n_columns; ++c)
      factor[c] += room_.cells[i].area_m2 * direct.cell[i * direct.n_columns + c];
  for (std::size_t c = 0; c < direct.n_columns; ++c) {
    const std::size_t q = c / n_sources, source = c % n_sources;
    if (source < first_ || windows_.groups[origin_[source - first_].group].windows.empty()) {
      factor[c] = 1.0;
      continue;
    }
    const Origin& origin = origin_[source - first_];
    const std::size_t slot = panes_->slot(origin.group, origin.state, q);
    const double stays_lm = flux_->flux_lm(slot)[origin.column] - flux_->escaped_lm(slot)[origin.column] -
                            flux_->lost_lm(slot)[origin.column];
    factor[c] = factor[c] > 0.0 ? std::clamp(stays_lm / factor[c], 1.0 / kMost, kMost) : 1.0;
  }
  tbb::parallel_for(std::size_t{0}, room_.cells.size(), [&](std::size_t i) {
    for (std::size_t c = 0; c < direct.n_columns; ++c) direct.cell[i * direct.n_columns + c] *= factor[c];
  });
}

}  // namespace dim
