#include "image/shader.hpp"

#include <algorithm>
#include <cmath>

namespace dim {
namespace {

constexpr double kUnseen = 1e-3;      // of what a line of sight shows, left after mirrors: it ends there,
constexpr int kMostMirrors = 1000;    // and where nothing is taken by any
constexpr int kHighlightPaths = 144;  // from each lamp to a pixel with a lobe, over all its rays

// Outline of a luminous opening in space, empty where it has no horizontal area.
Ring3 outline_of(const ShownLuminaire& luminaire) {
  if (luminaire.opening.shape == OpeningShape::kVerticalEllipse) return {};
  Ring3 ring = outline(luminaire.opening);
  for (auto& p : ring) p = luminaire.at + p.x * luminaire.c0 + p.y * luminaire.c90;
  return ring;
}

}  // namespace

Shader::Shader(const LuminanceDatabase& database, const Cells& cells, const Mix& mix, Shading shading)
    : database_(database),
      zone_(database.zone()),
      cells_(cells),
      shading_(shading),
      channels_(database, mix),
      field_(database, cells, mix, channels_, shading),
      facets_(zone_.finishes.size()),
      mirror_(zone_.finishes.size(), false) {
  find_finishes(cells);
  for (const auto& luminaire : database.luminaires()) {
    const Ring3 ring = outline_of(luminaire);
    if (!ring.empty()) openings_.push_back({&luminaire, Polygon(ring)});
  }
  std::vector<int> mirrors;
  for (std::size_t s = 0; s < zone_.surfaces.size(); ++s) {
    if (!zone_.surfaces[s].outside && mirror_[static_cast<std::size_t>(zone_.surfaces[s].finish)])
      mirrors.push_back(static_cast<int>(s));
  }
  lamps_ = std::make_unique<Lamps>(database, mix, channels_, mirrors);
  place_light_ = std::make_unique<PlaceLight>(zone_, *lamps_, field_);
  paths_ = lamps_->integrators(1);
  auto plates = plates_of(zone_);
  for (const auto& opening : openings_) plates.push_back({&opening.polygon});
  for (const auto& plate : plates_of(lamps_->obstructions().bodies())) plates.push_back(plate);
  for (const auto& plate : plates) outlines_.push_back(plate.polygon);
  caster_ = std::make_unique<RayCaster>(std::move(plates), zone_.diameter_m);
}

void Shader::find_finishes(const Cells& cells) {
  const auto& classes = database_.classes();
  for (std::size_t f = 0; f < zone_.finishes.size(); ++f) {
    reflection_.emplace_back();
    for (const std::size_t klass : classes.of_band)
      reflection_.back().push_back(classes.at(klass, static_cast<int>(f)));
    mirror_[f] = zone_.finishes[f].specular > 0.0;
  }
  for (const auto cell : database_.off_specular_cells()) {
    const auto finish = static_cast<std::size_t>(zone_.surfaces[cells.surface_of(cell)].finish);
    mirror_[finish] = false;
    if (!facets_[finish])
      facets_[finish] = std::make_unique<Facets>(facet_distribution(zone_.finishes[finish]),
                                                 zone_.finishes[finish].roughness);
  }
}

Shader::Kind Shader::kind(const Hit& hit) const {
  if (hit.plate < 0 || hit.back || static_cast<std::size_t>(hit.plate) >= zone_.surfaces.size()) return Kind::other;
  const Surface& surface = zone_.surfaces[static_cast<std::size_t>(hit.plate)];
  if (surface.outside) return Kind::other;
  const auto finish = static_cast<std::size_t>(surface.finish);
  return mirror_[finish] ? Kind::mirror : facets_[finish] ? Kind::glossy : Kind::place;
}

bool Shader::in_one_cell(std::size_t surface, const std::array<Vec2, 4>& corners) const {
  if (shading_ != Shading::cell) return true;
  const CellGrid& grid = cells_.grid(surface);
  const int cell = grid.cell_at(corners[0]);
  return std::all_of(corners.begin() + 1, corners.end(),
                     [&](const Vec2& corner) { return grid.cell_at(corner) == cell; });
}

// An opening shows the luminance that its intensity gives in that direction.
void Shader::add_opening(std::size_t index, const Vec3& direction, const Light& tint, Light& light) const {
  const auto& luminaire = *openings_[index].luminaire;
  const double factor = lamps_->factor(static_cast<std::size_t>(&luminaire - database_.luminaires().data()));
  const Vec3 out = -direction;
  const double cosine = glm::dot(out, luminaire.aim);
  const double cd = database_.intensities()[luminaire.photometry].at(
      {glm::dot(out, luminaire.c0), glm::dot(out, luminaire.c90), cosine});
  // Towards grazing both intensity and projected area vanish; their quotient is not to.
  const double cd_m2 = factor * cd / (area_m2(luminaire.opening) * std::max(std::abs(cosine), 0.02));
  const std::size_t first = channels_.first_of(luminaire.source);
  for (std::size_t c = first; c < first + channels_.n_bands(); ++c)
    light[c] += tint[c] * cd_m2 * channels_.watts_per_lumen(c);
}

void Shader::add_highlights(std::size_t surface, const Vec2& local, const Vec3& towards, double weight,
                            std::uint64_t chance, Light& lobe) const {
  const auto finish = static_cast<std::size_t>(zone_.surfaces[surface].finish);
  Frame frame = zone_.surfaces[surface].polygon.frame();
  frame.origin = frame.to_world(local);
  const Receiver receiver = point_receiver(frame, static_cast<int>(surface), chance);
  const int n_paths = std::max(1, static_cast<int>(std::lround(kHighlightPaths * weight)));
  std::vector<double> tint;
  for (std::size_t e = 0; e < lamps_->size(); ++e) {
    const LightSource& emitter = lamps_->emitter(e);
    if (emitter.beam.misses({&frame.origin, 1}, lamps_->obstructions().caster().tolerance_m())) continue;
    lamps_->tint(e, frame.origin, tint);
    const std::size_t first = channels_.first_of(database_.luminaires()[emitter.original].source);
    const LowDiscrepancy4 points(chance ^ mix(e));
    for (int i = 0; i < n_paths; ++i) {
      const auto path = paths_[e].path(receiver, points(static_cast<std::uint64_t>(i)));
      if (!(path.lx > 0.0)) continue;
      const Vec3 in = frame.direction_to_local(path.towards);
      const LobeValue seen = lobe_value(*facets_[finish], in, towards);
      if (!(seen.value > 0.0)) continue;
      double share = 0.0;
      for (std::size_t b = 0; b < tint.size(); ++b) {
        const BandReflection& reflection = reflection_[finish][b];
        if (b == 0 || !(reflection == reflection_[finish][b - 1])) share = reflection.fresnel(seen.facing);
        lobe[first + b] +=
            path.lx / n_paths * tint[b] * channels_.watts_per_lumen(first + b) * seen.value * share;
      }
    }
  }
}

// Irradiance at a place: of the cells, the open share of their direct light replaced by that of the lamps.
void Shader::add_place(std::size_t surface, const Vec2& local, const double* lamp_lx, Light& irradiance) const {
  field_.add_irradiance(surface, local, irradiance);
  if (!lamp_lx) return;
  const double share = field_.open_share(surface, local);
  field_.take_direct(surface, local, share, irradiance);
  const Vec3 at = zone_.surfaces[surface].polygon.frame().to_world(local);
  for (std::size_t e = 0; e < lamps_->size(); ++e) lamps_->add(e, share * lamp_lx[e], at, irradiance);
}

// Adds the light that diffuse reflection leaves; returns the illuminance, lx.
double Shader::reflect(std::size_t surface, const Light& irradiance, const Light* tint, Light& light) const {
  const auto& reflection = reflection_[static_cast<std::size_t>(zone_.surfaces[surface].finish)];
  double illuminance_lx = 0.0;
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    const double seen = reflection[channels_.band(c)].diffuse * irradiance[c] / kPi;
    light[c] += tint ? (*tint)[c] * seen : seen;
    illuminance_lx += channels_.xyz(c).y * irradiance[c];
  }
  return illuminance_lx;
}

double Shader::shade(std::size_t surface, const Vec2& local, const double* lamp_lx, Light& light) const {
  Light irradiance(channels_.size(), 0.0);
  add_place(surface, local, lamp_lx, irradiance);
  return reflect(surface, irradiance, nullptr, light);
}

double Shader::add_surface(std::size_t surface, const Vec2& local, const Vec3& direction, double weight,
                           std::uint64_t chance, const Light& tint, Light& light) const {
  Light irradiance(channels_.size(), 0.0);
  std::vector<double> lamp_lx;
  const bool direct = wants_direct(surface, local);
  const LitPlace place{local, {}, false, weight, chance};
  if (direct) place_light_->find(surface, {&place, 1}, lamp_lx);
  add_place(surface, local, direct ? lamp_lx.data() : nullptr, irradiance);
  const double illuminance_lx = reflect(surface, irradiance, &tint, light);
  if (!facets_[static_cast<std::size_t>(zone_.surfaces[surface].finish)]) return illuminance_lx;
  Vec3 towards = -zone_.surfaces[surface].polygon.frame().direction_to_local(direction);
  towards.z = std::max(towards.z, 1e-6);
  Light lobe(channels_.size(), 0.0);
  field_.add_lobe(surface, local, towards, lobe);
  add_highlights(surface, local, towards, weight, chance, lobe);
  for (std::size_t c = 0; c < channels_.size(); ++c) light[c] += tint[c] * lobe[c];
  return illuminance_lx;
}

Shader::Seen Shader::seen(const Vec3& eye, const Vec3& direction, const Hit& first_hit, double weight,
                          std::uint64_t chance, Light& light) const {
  Seen seen;
  Light tint(channels_.size(), 1.0);
  Vec3 from = eye, along = direction;
  Hit hit = first_hit;
  for (int met = 0; met <= kMostMirrors; ++met) {
    if (hit.plate < 0) return seen;
    const auto plate = static_cast<std::size_t>(hit.plate);
    seen.anything = true;
    if (plate >= zone_.surfaces.size()) {
      // A body's light is not stored: it is shown black.
      const std::size_t opening = plate - zone_.surfaces.size();
      if (opening < openings_.size()) add_opening(opening, along, tint, light);
      return seen;
    }
    const Surface& surface = zone_.surfaces[plate];
    if (hit.back || surface.outside) return seen;
    const double illuminance_lx = add_surface(plate, hit.local, along, weight,
                                              chance ^ mix(static_cast<std::uint64_t>(met)), tint, light);
    if (met == 0) {
      seen.surface = true;
      seen.illuminance_lx = illuminance_lx;
    }
    const auto finish = static_cast<std::size_t>(surface.finish);
    if (!mirror_[finish]) return seen;
    from += hit.t * along;
    const double left = meet_mirror(
        surface.polygon.frame().n, along, tint,
        [&](std::size_t c) -> const BandReflection& { return reflection_[finish][channels_.band(c)]; });
    if (left < kUnseen) return seen;
    hit = caster_->nearest(from, along, hit.plate);
  }
  return seen;
}

}  // namespace dim
