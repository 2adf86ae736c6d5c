#include "transport/shine_state.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace dim {

ShineState::ShineState(const Shine& shine, const Zone& zone, const Network& network, const Cells& cells,
                       const DirectShine& direct, const std::vector<std::size_t>& class_of_column,
                       std::size_t n_columns, std::size_t first, std::size_t n, std::size_t width)
    : shine_(shine),
      zone_(zone),
      network_(network),
      cells_(cells),
      direct_(direct),
      class_(class_of_column.begin() + static_cast<std::ptrdiff_t>(first),
             class_of_column.begin() + static_cast<std::ptrdiff_t>(first + n)),
      n_columns_(n_columns),
      first_(first),
      n_(n),
      width_(width),
      psi_(shine.n_states() * width, 0.0),
      change_(shine.n_off_specular() * width, 0.0) {
  for (std::size_t s = 0; s < shine.n_states(); ++s) {
    for (std::size_t c = 0; c < n; ++c)
      psi_[s * width + c] = static_cast<double>(direct.psi[s * n_columns + first + c]);
  }
}

template <class F>
void ShineState::for_off_specular(F&& f) const {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, shine_.n_off_specular(), 4), [&](const auto& range) {
    for (std::size_t g = range.begin(); g != range.end(); ++g) f(g);
  });
}

void ShineState::add_to_cells(const std::vector<double>& exitance, std::vector<double>& gathered) const {
  const auto& mirror_first = shine_.mirror_first();
  const auto& lobe_first = shine_.lobe_first();
  const auto n_sectors = static_cast<std::size_t>(network_.patches.n_sectors);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells_.size(), 64), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      double* sums = &gathered[i * width_];
      for (auto l = mirror_first[i]; l < mirror_first[i + 1]; ++l) {
        const auto& link = shine_.mirror_links()[l];
        const double weight = network_.patches.weight_sr(static_cast<int>(link.patch / n_sectors)) / kPi;
        const double* from = &exitance[link.cell * width_];
        for (std::size_t c = 0; c < n_; ++c) sums[c] += weight * shine_.tint(link.tint, class_[c]) * from[c];
      }
      // The row scale, which belongs to the network's own rows, is still to come.
      const double unscale = 1.0 / network_.row_scale[i];
      for (auto l = lobe_first[i]; l < lobe_first[i + 1]; ++l) {
        const auto& link = shine_.lobe_links()[l];
        const double* from = &psi_[link.state * width_];
        const double weight = static_cast<double>(link.weight) * unscale;
        for (std::size_t c = 0; c < n_; ++c) sums[c] += weight * shine_.tint(link.tint, class_[c]) * from[c];
      }
    }
  });
}

void ShineState::add_to_points(const std::vector<double>& exitance, std::vector<double>& sums) const {
  const std::size_t n_cells = cells_.size();
  const auto n_sectors = static_cast<std::size_t>(network_.point_patches.n_sectors);
  for (std::size_t p = 0; p < network_.point_sinks.n_rows(); ++p) {
    double* sum = &sums[p * width_];
    for (std::size_t c = 0; c < n_; ++c) sum[c] += direct_.point_lobe[p * n_columns_ + first_ + c];
    for (auto l = shine_.mirror_first()[n_cells + p]; l < shine_.mirror_first()[n_cells + p + 1]; ++l) {
      const auto& link = shine_.mirror_links()[l];
      const double weight = network_.point_patches.weight_sr(static_cast<int>(link.patch / n_sectors)) / kPi;
      for (std::size_t c = 0; c < n_; ++c)
        sum[c] += weight * shine_.tint(link.tint, class_[c]) * exitance[link.cell * width_ + c];
    }
    for (auto l = shine_.lobe_first()[n_cells + p]; l < shine_.lobe_first()[n_cells + p + 1]; ++l) {
      const auto& link = shine_.lobe_links()[l];
      const float* known = &direct_.psi[link.state * n_columns_ + first_];
      for (std::size_t c = 0; c < n_; ++c) {
        // What lobes make of direct light is in point_lobe already, unless seen in a mirror.
        const double psi =
            psi_[link.state * width_ + c] - (link.tint == 0 ? static_cast<double>(known[c]) : 0.0);
        sum[c] += static_cast<double>(link.weight) * shine_.tint(link.tint, class_[c]) * psi;
      }
    }
  }
}

// Flux per area that comes in through each lobe patch of a shiny cell, direct light left out. [patches,
// width]
void ShineState::incoming(std::size_t cell, const std::vector<double>& exitance,
                          std::vector<double>& phi) const {
  const auto& patches = network_.patches;
  const auto n_sectors = static_cast<std::size_t>(patches.n_sectors);
  phi.assign(shine_.grid().n_patches() * width_, 0.0);
  for (std::size_t patch = 0; patch < patches.n_patches(); ++patch) {
    const double weight =
        patches.weight_sr(static_cast<int>(patch / n_sectors)) / kPi * network_.row_scale[cell];
    const double* from = &exitance[network_.sinks.at(cell, patch) * width_];
    double* to = &phi[shine_.lobe_patch(patch) * width_];
    for (std::size_t c = 0; c < n_; ++c) to[c] += weight * from[c];
  }
  for (auto l = shine_.mirror_first()[cell]; l < shine_.mirror_first()[cell + 1]; ++l) {
    const auto& link = shine_.mirror_links()[l];
    const double weight =
        patches.weight_sr(static_cast<int>(link.patch / n_sectors)) / kPi * network_.row_scale[cell];
    double* to = &phi[shine_.lobe_patch(link.patch) * width_];
    for (std::size_t c = 0; c < n_; ++c)
      to[c] += weight * shine_.tint(link.tint, class_[c]) * exitance[link.cell * width_ + c];
  }
  for (auto l = shine_.lobe_first()[cell]; l < shine_.lobe_first()[cell + 1]; ++l) {
    const auto& link = shine_.lobe_links()[l];
    double* to = &phi[link.patch_in * width_];
    for (std::size_t c = 0; c < n_; ++c)
      to[c] += static_cast<double>(link.weight) * shine_.tint(link.tint, class_[c]) *
               psi_[link.state * width_ + c];
  }
}

std::vector<double> ShineState::reflect(const std::vector<double>& exitance) {
  const PatchGrid& grid = shine_.grid();
  const auto n_patches = grid.n_patches(), n_sectors = static_cast<std::size_t>(grid.n_sectors);
  std::vector<double> next(psi_.size()), size_of_change(change_.size(), 0.0);
  for_off_specular([&](std::size_t g) {
    const std::size_t cell = shine_.off_specular()[g];
    const int finish = zone_.surfaces[cells_.surface_of(cell)].finish;
    std::vector<double> phi;
    incoming(cell, exitance, phi);
    double* out = &next[g * n_patches * width_];
    for (std::size_t p = 0; p < n_patches; ++p) {
      for (std::size_t c = 0; c < n_; ++c)
        out[p * width_ + c] = static_cast<double>(direct_.psi[(g * n_patches + p) * n_columns_ + first_ + c]);
    }
    // Columns of one class are neighbours.
    for (std::size_t c0 = 0, c1 = 0; c0 < n_; c0 = c1) {
      for (c1 = c0; c1 < n_ && class_[c1] == class_[c0]; ++c1) {
      }
      const LobeMatrix& lobe = shine_.lobe(class_[c0], finish);
      for (std::size_t p = 0; p < n_patches; ++p) {
        const double* in = &phi[p * width_];
        const std::size_t sector = p % n_sectors;
        const int slice = static_cast<int>(p / n_sectors);
        for (const auto* entry = lobe.begin(slice); entry != lobe.end(slice); ++entry) {
          const std::size_t turned = sector + entry->turn;
          double* to =
              out +
              (entry->slice_out * n_sectors + (turned < n_sectors ? turned : turned - n_sectors)) * width_;
          for (std::size_t c = c0; c < c1; ++c) to[c] += entry->share * in[c];
        }
      }
    }
    double* change = &change_[g * width_];
    double* size = &size_of_change[g * width_];
    std::fill_n(change, width_, 0.0);
    for (std::size_t p = 0; p < n_patches; ++p) {
      for (std::size_t c = 0; c < n_; ++c) {
        const double by = out[p * width_ + c] - psi_[(g * n_patches + p) * width_ + c];
        change[c] += by;
        size[c] += std::abs(by);
      }
    }
  });
  psi_ = std::move(next);
  std::vector<double> flux(width_, 0.0);
  for (std::size_t g = 0; g < shine_.n_off_specular(); ++g) {
    const double area_m2 = cells_.area_m2(shine_.off_specular()[g]);
    for (std::size_t c = 0; c < n_; ++c) flux[c] += area_m2 * size_of_change[g * width_ + c];
  }
  return flux;
}

ShineState::Power ShineState::power(const std::vector<double>& exitance) const {
  const PatchGrid& grid = shine_.grid();
  const auto n_patches = grid.n_patches(), n_sectors = static_cast<std::size_t>(grid.n_sectors);
  Power power{std::vector<double>(n_, 0.0), std::vector<double>(n_, 0.0), std::vector<double>(n_, 0.0)};
  const auto open_patches = [&](std::size_t cell) {
    std::vector<std::size_t> open;
    for (std::size_t patch = 0; patch < network_.patches.n_patches(); ++patch) {
      if (network_.sinks.at(cell, patch) >= cells_.size()) open.push_back(patch);
    }
    return open;
  };
  const auto share = [&](std::size_t patch) {
    const int slice = static_cast<int>(patch / static_cast<std::size_t>(network_.patches.n_sectors));
    return network_.patches.weight_sr(slice) /
           grid.weight_sr(static_cast<int>(shine_.lobe_patch(patch) / n_sectors));
  };
  for (std::size_t g = 0; g < shine_.n_off_specular(); ++g) {
    const std::size_t cell = shine_.off_specular()[g];
    const double area_m2 = cells_.area_m2(cell);
    const double* psi = &psi_[g * n_patches * width_];
    for (std::size_t c = 0; c < n_; ++c) {
      for (std::size_t p = 0; p < n_patches; ++p) power.reflected[c] += area_m2 * psi[p * width_ + c];
      power.in_flight[c] += area_m2 * change_[g * width_ + c];
    }
    for (const std::size_t patch : open_patches(cell)) {
      for (std::size_t c = 0; c < n_; ++c)
        power.escaped[c] += area_m2 * share(patch) * psi[shine_.lobe_patch(patch) * width_ + c];
    }
  }
  std::vector<double> phi;
  for (const int mirror : shine_.mirrors()) {
    const auto s = static_cast<std::size_t>(mirror);
    for (std::size_t cell = cells_.first(s); cell < cells_.first(s + 1); ++cell) {
      incoming(cell, exitance, phi);
      std::vector<bool> open(n_patches, false);
      for (const std::size_t patch : open_patches(cell)) open[shine_.lobe_patch(patch)] = true;
      for (std::size_t p = 0; p < n_patches; ++p) {
        const std::size_t slice = p / n_sectors;
        const std::size_t towards = slice * n_sectors + (p % n_sectors + n_sectors / 2) % n_sectors;
        for (std::size_t c = 0; c < n_; ++c) {
          const double reflected = cells_.area_m2(cell) * phi[p * width_ + c] *
                                   shine_.slice_albedo(class_[c], zone_.surfaces[s].finish)[slice];
          power.reflected[c] += reflected;
          if (open[towards]) power.escaped[c] += reflected;
        }
      }
    }
  }
  return power;
}

double ShineState::largest_albedo(std::size_t surface, std::size_t column) const {
  if (shine_.of_surface(surface) != Shininess::off_specular) return 0.0;
  const auto& albedo = shine_.slice_albedo(class_[column], zone_.surfaces[surface].finish);
  return *std::max_element(albedo.begin(), albedo.end());
}

void ShineState::copy_psi(std::vector<float>& psi, const std::vector<bool>& wanted) const {
  for (std::size_t s = 0; s < shine_.n_states(); ++s) {
    for (std::size_t c = 0; c < n_; ++c)
      if (wanted[c]) psi[s * n_columns_ + first_ + c] = static_cast<float>(psi_[s * width_ + c]);
  }
}

void ShineState::set_psi(const std::vector<float>& psi) {
  for (std::size_t s = 0; s < shine_.n_states(); ++s) {
    for (std::size_t c = 0; c < n_; ++c)
      psi_[s * width_ + c] = static_cast<double>(psi[s * n_columns_ + first_ + c]);
  }
}

}  // namespace dim
