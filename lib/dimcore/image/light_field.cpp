#include "image/light_field.hpp"

#include <algorithm>
#include <cmath>

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
                       const LightChannels& channels, bool smooth, bool indirect)
    : zone_(database.zone()),
      cells_(cells),
      n_(channels.size()),
      smooth_(smooth),
      irradiance_(cells.size() * n_, 0.0F),
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
  for (std::size_t s = 0; s < mix.size(); ++s) {
    if (mix[s] == 0.0) continue;
    add(irradiance_, database.cell_irradiance(s), cells.size(), s, mix[s]);
    if (indirect) add(irradiance_, database.direct_cell_irradiance(s), cells.size(), s, -mix[s]);
    if (n_states == 0) continue;
    add(lobes_, database.lobe_radiance(s), n_states, s, mix[s]);
    add(lobes_, database.direct_lobe_radiance(s), n_states, s, -mix[s]);
  }
  for (auto* values : {&irradiance_, &lobes_}) {
    for (float& value : *values) value = std::max(0.0F, value);  // a difference, by rounding
  }
}

std::size_t LightField::cells_at(std::size_t surface, const Vec2& local, Weighted (&found)[4]) const {
  const CellGrid& grid = cells_.grid(surface);
  const std::size_t first = cells_.first(surface);
  const int own = grid.cell_at(local), square = grid.square_at(local);
  found[0] = {first + static_cast<std::size_t>(own), 1.0};
  // A part cut off from its square's middle keeps to itself.
  if (!smooth_ || grid.middle_cell(square, 0, 0) != own) return 1;
  const Vec2 size = zone_.surfaces[surface].polygon.size_m();
  const double u = local.x / size.x * grid.nu() - (square % grid.nu() + 0.5);
  const double v = local.y / size.y * grid.nv() - (square / grid.nu() + 0.5);
  const double au = std::min(std::abs(u), 0.5), av = std::min(std::abs(v), 0.5);
  std::size_t n = 0;
  double total = 0.0;
  for (int k = 0; k < 4; ++k) {
    const int di = k & 1 ? (u < 0.0 ? -1 : 1) : 0, dj = k >> 1 ? (v < 0.0 ? -1 : 1) : 0;
    const int cell = grid.middle_cell(square, di, dj);
    const double weight = (di != 0 ? au : 1.0 - au) * (dj != 0 ? av : 1.0 - av);
    if (cell < 0 || !(weight > 0.0)) continue;
    found[n++] = {first + static_cast<std::size_t>(cell), weight};
    total += weight;
  }
  for (std::size_t k = 0; k < n; ++k) found[k].weight /= total;
  return n;
}

void LightField::add_irradiance(std::size_t surface, const Vec2& local, Light& light) const {
  Weighted found[4];
  const std::size_t n = cells_at(surface, local, found);
  for (std::size_t k = 0; k < n; ++k) {
    const float* of_cell = &irradiance_[found[k].cell * n_];
    for (std::size_t c = 0; c < n_; ++c) light[c] += found[k].weight * static_cast<double>(of_cell[c]);
  }
}

void LightField::add_lobe(std::size_t surface, const Vec2& local, const Vec3& towards, Light& light) const {
  Weighted found[4];
  const std::size_t n = cells_at(surface, local, found);
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
    for (std::size_t m = 0; m < n; ++m) {
      if (lobe_of_[found[m].cell] < 0) continue;
      const float* of_patch =
          &lobes_[(static_cast<std::size_t>(lobe_of_[found[m].cell]) * grid_.n_patches() + patch) * n_];
      for (std::size_t c = 0; c < n_; ++c)
        light[c] += weight * found[m].weight * static_cast<double>(of_patch[c]);
    }
  }
}

}  // namespace dim
