#include "image/light_field.hpp"

#include <algorithm>
#include <cmath>

#include "scene/joints.hpp"

namespace dim {

LightChannels::LightChannels(const LuminanceDatabase& database, const Mix& mix)
    : n_bands_(database.bands().size()), kind_(mix.size(), 0) {
  std::vector<const BandWeights*> kinds;
  for (std::size_t s = 0; s < mix.size(); ++s) {
    const auto& weights = database.sources()[s].weights;
    const auto known =
        std::find_if(kinds.begin(), kinds.end(), [&](const BandWeights* kind) { return *kind == weights; });
    kind_[s] = static_cast<std::size_t>(known - kinds.begin());
    if (known == kinds.end()) kinds.push_back(&weights);
  }
  for (const auto* kind : kinds) {
    for (std::size_t b = 0; b < n_bands_; ++b) {
      xyz_.push_back(kMaxEfficacy_lm_W * Vec3(kind->x[b], kind->y[b], kind->z[b]));
      watts_per_lumen_.push_back(kind->share[b] / kind->efficacy_lm_W);
    }
  }
}

LightField::LightField(const LuminanceDatabase& database, const Cells& cells, const Mix& mix,
                       const LightChannels& channels, Shading shading)
    : cells_(cells),
      n_(channels.size()),
      shading_(shading),
      blend_(database.zone(), cells,
             shading == Shading::cell ? std::vector<std::vector<Segment2>>(database.zone().surfaces.size())
                                      : find_joints(database.zone())),
      irradiance_(cells.size() * n_, 0.0F),
      direct_(shading == Shading::cell ? 0 : cells.size() * n_, 0.0F),
      grid_(database.directional_grid()),
      lobe_of_(cells.size(), -1) {
  const auto& shiny = database.off_specular_cells();
  for (std::size_t g = 0; g < shiny.size(); ++g) lobe_of_[shiny[g]] = static_cast<std::int32_t>(g);
  const std::size_t n_states = shiny.size() * grid_.n_patches();
  lobes_.assign(n_states * n_, 0.0F);
  const auto add = [&](std::vector<float>& sums, const std::vector<float>& values, std::size_t n,
                       std::size_t source, double factor) {
    for (std::size_t b = 0; b < channels.n_bands(); ++b) {
      const std::size_t channel = channels.first_of(source) + b;
      for (std::size_t i = 0; i < n; ++i)
        sums[i * n_ + channel] += static_cast<float>(factor * static_cast<double>(values[b * n + i]));
    }
  };
  // What windows bring has no luminaire to be found from: it stays with the cells.
  std::vector<bool> of_luminaires(mix.size(), false);
  for (const auto& luminaire : database.luminaires()) of_luminaires[luminaire.source] = true;
  for (std::size_t s = 0; s < mix.size(); ++s) {
    if (mix[s] == 0.0) continue;
    add(irradiance_, database.cell_irradiance(s), cells.size(), s, mix[s]);
    if (shading != Shading::cell && of_luminaires[s])
      add(direct_, database.direct_cell_irradiance(s), cells.size(), s, mix[s]);
    if (n_states == 0) continue;
    add(lobes_, database.lobe_radiance(s), n_states, s, mix[s]);
    add(lobes_, database.direct_lobe_radiance(s), n_states, s, -mix[s]);
  }
  for (float& value : lobes_) value = std::max(0.0F, value);  // a difference, by rounding
  const auto lux = [&](const std::vector<float>& values) {
    std::vector<double> sums(cells.size(), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i)
      sums[i / n_] += channels.xyz(i % n_).y * static_cast<double>(values[i]);
    return sums;
  };
  if (shading == Shading::cell) return;
  lx_ = lux(irradiance_);
  if (shading == Shading::smooth) {
    find_fast_cells(lux(direct_));
    return;
  }
  for (std::size_t i = 0; i < irradiance_.size(); ++i)
    irradiance_[i] = std::max(0.0F, irradiance_[i] - direct_[i]);
  direct_ = {};
}

// Where direct light differs between cells that blend by more than a share of all the light there.
void LightField::find_fast_cells(const std::vector<double>& direct_lx) {
  constexpr double kFast = 0.4;
  fast_.assign(cells_.size(), 0);
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    blend_.visit_neighbours(c, [&](std::size_t k) {
      if (std::abs(direct_lx[k] - direct_lx[c]) > kFast * std::max(lx_[k], lx_[c])) fast_[c] = 1;
    });
  }
}

template <class Function>
void LightField::visit(std::size_t surface, const Vec2& local, Function&& f) const {
  if (shading_ == Shading::cell)
    f(cells_.first(surface) + static_cast<std::size_t>(cells_.grid(surface).cell_at(local)), 1.0);
  else
    blend_.visit(surface, local, f);
}

void LightField::add_irradiance(std::size_t surface, const Vec2& local, Light& light) const {
  visit(surface, local, [&](std::size_t cell, double weight) {
    const float* of_cell = &irradiance_[cell * n_];
    for (std::size_t c = 0; c < n_; ++c) light[c] += weight * static_cast<double>(of_cell[c]);
  });
}

double LightField::open_share(std::size_t surface, const Vec2& local) const {
  if (shading_ != Shading::smooth) return shading_ == Shading::gather ? 1.0 : 0.0;
  double share = 0.0;
  blend_.visit(surface, local, [&](std::size_t cell, double weight) { share += fast_[cell] ? weight : 0.0; });
  return share;
}

void LightField::take_direct(std::size_t surface, const Vec2& local, double share, Light& light) const {
  if (shading_ != Shading::smooth) return;
  blend_.visit(surface, local, [&](std::size_t cell, double weight) {
    const float* of_cell = &direct_[cell * n_];
    for (std::size_t c = 0; c < n_; ++c) light[c] -= share * weight * static_cast<double>(of_cell[c]);
  });
}

double LightField::illuminance_lx(std::size_t surface, const Vec2& local) const {
  return lx_[cells_.first(surface) + static_cast<std::size_t>(cells_.grid(surface).cell_at(local))];
}

void LightField::add_lobe(std::size_t surface, const Vec2& local, const Vec3& towards, Light& light) const {
  // Between the middles of patches; nearer to the normal or the horizon than the last middle, that slice.
  const double height = std::clamp(towards.z * grid_.n_slices - 0.5, 0.0, grid_.n_slices - 1.0);
  const double turn = std::atan2(towards.y, towards.x) / (2.0 * kPi);
  const double along = (turn - std::floor(turn)) * grid_.n_sectors - 0.5;
  const int slice = std::min(static_cast<int>(height), std::max(0, grid_.n_slices - 2));
  const int sector = static_cast<int>(std::floor(along));
  const double up = height - slice, on = along - sector;
  for (int k = 0; k < 4; ++k) {
    const int s = std::min(slice + (k >> 1), grid_.n_slices - 1);
    const int t = (sector + (k & 1) + grid_.n_sectors) % grid_.n_sectors;
    const double weight = (k >> 1 ? up : 1.0 - up) * (k & 1 ? on : 1.0 - on);
    if (!(weight > 0.0)) continue;
    const auto patch = static_cast<std::size_t>(s * grid_.n_sectors + t);
    visit(surface, local, [&](std::size_t cell, double share) {
      if (lobe_of_[cell] < 0) return;
      const float* of_patch =
          &lobes_[(static_cast<std::size_t>(lobe_of_[cell]) * grid_.n_patches() + patch) * n_];
      for (std::size_t c = 0; c < n_; ++c) light[c] += weight * share * static_cast<double>(of_patch[c]);
    });
  }
}

}  // namespace dim
