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
      links_(shine.links()),
      zone_(zone),
      network_(network),
      cells_(cells),
      direct_(direct),
      n_columns_(n_columns),
      first_(first),
      n_(n),
      width_(width),
      landed_(n, 0.0) {
  for (std::size_t c = 0; c < n; ++c) {
    if (runs_.empty() || class_of_column[first + c] != runs_.back().klass)
      runs_.push_back({class_of_column[first + c], c, c});
    runs_.back().last = c + 1;
  }
  set_psi(direct.psi);
  before_ = psi_;
}

// Calls f(first, last) for runs of off-specular cells, so that what it works in is made once for many.
template <class F>
void ShineState::for_off_specular(F&& f) const {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, shine_.n_off_specular(), 16),
                    [&](const auto& range) { f(range.begin(), range.end()); });
}

// Calls f(link, run of columns, share of the receiver's hemisphere times tint).
template <class F>
void ShineState::for_seen_in_mirrors(std::size_t receiver, F&& f) const {
  for (auto l = links_.mirror_first[receiver]; l < links_.mirror_first[receiver + 1]; ++l) {
    const auto& link = links_.mirror[l];
    for (const auto& run : runs_)
      f(link, run,
        static_cast<double>(link.share) *
            static_cast<double>(links_.mirror_tint[l * links_.n_classes + run.klass]));
  }
}

// Calls f(link, run of columns, weight times tint).
template <class F>
void ShineState::for_lobes_by_mirrors(std::size_t receiver, F&& f) const {
  for (auto l = links_.lobe_by_mirror_first[receiver]; l < links_.lobe_by_mirror_first[receiver + 1]; ++l) {
    const auto& link = links_.lobe_by_mirror[l];
    for (const auto& run : runs_)
      f(link, run,
        static_cast<double>(link.weight) *
            static_cast<double>(links_.lobe_tint[l * links_.n_classes + run.klass]));
  }
}

void ShineState::add_to_cells(const std::vector<double>& exitance, std::vector<double>& gathered) const {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells_.size(), 64), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      double* sums = &gathered[i * width_];
      for_seen_in_mirrors(i, [&](const ShineLinks::Mirror& link, const Run& run, double weight) {
        weight *= links_.mirror_scale[link.cell * links_.n_classes + run.klass];
        const double* from = &exitance[link.cell * width_];
        for (std::size_t c = run.first; c < run.last; ++c) sums[c] += weight * from[c];
      });
      // The row scale belongs to what the network's rows find, not to what lobes send.
      const double unscale = 1.0 / network_.row_scale[i];
      for (auto l = links_.lobe_first[i]; l < links_.lobe_first[i + 1]; ++l) {
        const auto& link = links_.lobe[l];
        const double weight = static_cast<double>(link.weight) * unscale;
        const double* from = &psi_[link.state * n_];
        for (std::size_t c = 0; c < n_; ++c) sums[c] += weight * from[c];
      }
      for_lobes_by_mirrors(i, [&](const ShineLinks::Lobe& link, const Run& run, double weight) {
        const double* from = &psi_[link.state * n_];
        for (std::size_t c = run.first; c < run.last; ++c) sums[c] += weight * unscale * from[c];
      });
    }
  });
}

void ShineState::add_to_points(const std::vector<double>& exitance, std::vector<double>& sums) const {
  const std::size_t n_cells = cells_.size(), n_points = network_.point_sinks.n_rows();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n_points, 4), [&](const auto& range) {
    for (std::size_t p = range.begin(); p != range.end(); ++p) {
      double* sum = &sums[p * width_];
      for (std::size_t c = 0; c < n_; ++c) sum[c] += direct_.point_lobe[p * n_columns_ + first_ + c];
      for_seen_in_mirrors(n_cells + p, [&](const ShineLinks::Mirror& link, const Run& run, double weight) {
        const double* from = &exitance[link.cell * width_];
        for (std::size_t c = run.first; c < run.last; ++c) sum[c] += weight * from[c];
      });
      // What lobes make of direct light is in point_lobe already, unless seen in a mirror.
      for (auto l = links_.lobe_first[n_cells + p]; l < links_.lobe_first[n_cells + p + 1]; ++l) {
        const auto& link = links_.lobe[l];
        const double* from = &psi_[link.state * n_];
        const float* known = direct_psi(link.state);
        for (std::size_t c = 0; c < n_; ++c)
          sum[c] += static_cast<double>(link.weight) * (from[c] - static_cast<double>(known[c]));
      }
      for_lobes_by_mirrors(n_cells + p, [&](const ShineLinks::Lobe& link, const Run& run, double weight) {
        const double* from = &psi_[link.state * n_];
        for (std::size_t c = run.first; c < run.last; ++c) sum[c] += weight * from[c];
      });
    }
  });
}

void ShineState::incoming(std::size_t g, const std::vector<double>& exitance,
                          std::vector<double>& phi) const {
  const std::size_t cell = shine_.off_specular()[g];
  const double row_scale = network_.row_scale[cell];
  const auto& patches = network_.patches;
  phi.assign(shine_.grid().n_patches() * n_, 0.0);
  const auto add = [&](std::size_t patch, std::size_t from_cell, double weight) {
    const double* from = &exitance[from_cell * width_];
    double* to = &phi[patch * n_];
    for (std::size_t c = 0; c < n_; ++c) to[c] += weight * from[c];
  };
  std::size_t patch = 0;
  for (int slice = 0; slice < patches.n_slices; ++slice) {
    const double weight = row_scale * patches.weight_sr(slice) / kPi;
    for (int sector = 0; sector < patches.n_sectors; ++sector, ++patch)
      add(shine_.states().patch_of(patch), network_.sinks.at(cell, patch), weight);
  }
  if (network_.has_family()) {
    const std::uint16_t* of = &links_.family_patch[links_.family_first[g]];
    for (auto e = network_.extra.first[cell]; e < network_.extra.first[cell + 1]; ++e)
      add(*of++, network_.extra.cell[e], row_scale * network_.extra.weight[e]);
  }
  for_seen_in_mirrors(cell, [&](const ShineLinks::Mirror& link, const Run& run, double weight) {
    weight *= row_scale * links_.mirror_scale[link.cell * links_.n_classes + run.klass];
    const double* from = &exitance[link.cell * width_];
    for (std::size_t c = run.first; c < run.last; ++c) phi[link.patch * n_ + c] += weight * from[c];
  });
  for (auto l = links_.lobe_first[cell]; l < links_.lobe_first[cell + 1]; ++l) {
    const auto& link = links_.lobe[l];
    for (std::size_t c = 0; c < n_; ++c)
      phi[link.patch_in * n_ + c] += static_cast<double>(link.weight) * psi_[link.state * n_ + c];
  }
  for_lobes_by_mirrors(cell, [&](const ShineLinks::Lobe& link, const Run& run, double weight) {
    for (std::size_t c = run.first; c < run.last; ++c)
      phi[link.patch_in * n_ + c] += weight * psi_[link.state * n_ + c];
  });
}

// Writes the cell's new psi over its old one before the last (`before_`).
void ShineState::reflect_cell(std::size_t g, const std::vector<double>& phi, std::vector<double>& scratch,
                              double* change) {
  const std::size_t n_patches = shine_.grid().n_patches(), first_state = g * n_patches;
  const int finish = zone_.surfaces[cells_.surface_of(shine_.off_specular()[g])].finish;
  double* out = &before_[first_state * n_];
  for (const auto& run : runs_) {
    const auto& lobe = shine_.lobe_kernel(run.klass, finish);
    const std::size_t n_run = run.last - run.first;
    scratch.resize(std::max(scratch.size(), lobe.n_scratch(n_run)));
    lobe.apply(&phi[run.first], out + run.first, n_run, n_, scratch.data());
  }
  std::fill_n(change, n_, 0.0);
  for (std::size_t p = 0; p < n_patches; ++p) {
    const float* direct = direct_psi(first_state + p);
    for (std::size_t c = 0; c < n_; ++c) {
      out[p * n_ + c] += static_cast<double>(direct[c]);
      change[c] += std::abs(out[p * n_ + c] - psi_[(first_state + p) * n_ + c]);
    }
  }
}

std::vector<double> ShineState::reflect(const std::vector<double>& exitance) {
  std::vector<double> change(shine_.n_off_specular() * n_);
  for_off_specular([&](std::size_t first, std::size_t last) {
    std::vector<double> phi, scratch;
    for (std::size_t g = first; g < last; ++g) {
      incoming(g, exitance, phi);
      reflect_cell(g, phi, scratch, &change[g * n_]);
    }
  });
  landed_ = landed_by_mirrors(exitance, psi_);
  std::swap(psi_, before_);
  std::vector<double> flux(width_, 0.0);
  for (std::size_t g = 0; g < shine_.n_off_specular(); ++g) {
    const double area_m2 = cells_.area_m2(shine_.off_specular()[g]);
    for (std::size_t c = 0; c < n_; ++c) flux[c] += area_m2 * change[g * n_ + c];
  }
  return flux;
}

// Flux of each column that comes down on cells after mirrors.
std::vector<double> ShineState::landed_by_mirrors(const std::vector<double>& exitance,
                                                  const std::vector<double>& psi) const {
  std::vector<double> landed(n_, 0.0);
  if (!shine_.has_mirrors()) return landed;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const double area_m2 = cells_.area_m2(i);
    for (const auto& run : runs_) {
      const double passed =
          area_m2 / network_.column_scale[i] * links_.passed[i * links_.n_classes + run.klass].landed;
      for (std::size_t c = run.first; c < run.last; ++c) landed[c] += passed * exitance[i * width_ + c];
    }
    for_lobes_by_mirrors(i, [&](const ShineLinks::Lobe& link, const Run& run, double weight) {
      for (std::size_t c = run.first; c < run.last; ++c)
        landed[c] += area_m2 * weight * psi[link.state * n_ + c];
    });
  }
  return landed;
}

// @param change  of what arrives without a mirror
void ShineState::add_power_of_lobe(std::size_t g, double* reflected, double* escaped, double* change) const {
  const std::size_t cell = shine_.off_specular()[g], n_patches = shine_.grid().n_patches();
  const double area_m2 = cells_.area_m2(cell);
  const double* now = &psi_[g * n_patches * n_];
  const double* before = &before_[g * n_patches * n_];
  for (std::size_t p = 0; p < n_patches; ++p) {
    for (std::size_t c = 0; c < n_; ++c) {
      reflected[c] += area_m2 * now[p * n_ + c];
      change[c] += area_m2 * (now[p * n_ + c] - before[p * n_ + c]);
    }
  }
  for (std::size_t patch = 0; patch < network_.patches.n_patches(); ++patch) {
    if (network_.sinks.at(cell, patch) < cells_.size()) continue;
    const double out_m2 = area_m2 * shine_.states().share_of(patch);
    const std::size_t p = shine_.states().patch_of(patch);
    for (std::size_t c = 0; c < n_; ++c) {
      escaped[c] += out_m2 * now[p * n_ + c];
      change[c] -= out_m2 * (now[p * n_ + c] - before[p * n_ + c]);
    }
  }
}

void ShineState::add_power_of_mirrors(const std::vector<double>& exitance, Power& power) const {
  const auto add = [&](std::size_t c, double flux, bool escapes) {
    (escapes ? power.escaped : power.cut)[c] += flux;
    power.reflected[c] += flux;
  };
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    for (const auto& run : runs_) {
      const auto& passed = links_.passed[i * links_.n_classes + run.klass];
      for (std::size_t c = run.first; c < run.last; ++c) {
        const double sent = cells_.area_m2(i) / network_.column_scale[i] * exitance[i * width_ + c];
        add(c, sent * passed.escaped, true);
        add(c, sent * passed.cut, false);
      }
    }
  }
  for (std::size_t l = 0; l < links_.lobe_loss.size(); ++l) {
    const auto& loss = links_.lobe_loss[l];
    for (const auto& run : runs_) {
      const double weight_m2 = static_cast<double>(loss.weight_m2) *
                               static_cast<double>(links_.lobe_loss_tint[l * links_.n_classes + run.klass]);
      for (std::size_t c = run.first; c < run.last; ++c)
        add(c, weight_m2 * psi_[loss.state * n_ + c], loss.escaped);
    }
  }
  const auto landed = landed_by_mirrors(exitance, psi_);
  for (std::size_t c = 0; c < n_; ++c) {
    power.reflected[c] += landed[c];
    power.in_flight[c] += landed[c] - landed_[c] + power.cut[c];
  }
}

ShineState::Power ShineState::power(const std::vector<double>& exitance) const {
  const std::size_t n_lobes = shine_.n_off_specular();
  std::vector<double> parts(3 * n_lobes * n_, 0.0);  // by cell, so that they are added in order
  for_off_specular([&](std::size_t first, std::size_t last) {
    for (std::size_t g = first; g < last; ++g) {
      double* part = &parts[3 * g * n_];
      add_power_of_lobe(g, part, part + n_, part + 2 * n_);
    }
  });
  const std::vector<double> none(n_, 0.0);
  Power power{none, none, none, none};
  for (std::size_t g = 0; g < n_lobes; ++g) {
    for (std::size_t c = 0; c < n_; ++c) {
      power.reflected[c] += parts[3 * g * n_ + c];
      power.escaped[c] += parts[(3 * g + 1) * n_ + c];
      power.in_flight[c] += parts[(3 * g + 2) * n_ + c];
    }
  }
  if (shine_.has_mirrors()) add_power_of_mirrors(exitance, power);
  return power;
}

double ShineState::largest_albedo(std::size_t surface, std::size_t column) const {
  if (shine_.of_surface(surface) != Shininess::off_specular) return 0.0;
  const auto run = std::find_if(runs_.begin(), runs_.end(), [&](const Run& r) { return column < r.last; });
  if (run == runs_.end()) return 0.0;
  const auto& albedo = shine_.slice_albedo(run->klass, zone_.surfaces[surface].finish);
  return *std::max_element(albedo.begin(), albedo.end());
}

void ShineState::copy_psi(std::vector<float>& psi, const std::vector<bool>& wanted) const {
  const std::size_t n_patches = shine_.grid().n_patches();
  for_off_specular([&](std::size_t first, std::size_t last) {
    for (std::size_t s = first * n_patches; s < last * n_patches; ++s) {
      for (std::size_t c = 0; c < n_; ++c)
        if (wanted[c]) psi[s * n_columns_ + first_ + c] = static_cast<float>(psi_[s * n_ + c]);
    }
  });
}

void ShineState::set_psi(const std::vector<float>& psi) {
  const std::size_t n_patches = shine_.grid().n_patches();
  psi_.resize(shine_.n_states() * n_);
  for_off_specular([&](std::size_t first, std::size_t last) {
    for (std::size_t s = first * n_patches; s < last * n_patches; ++s) {
      for (std::size_t c = 0; c < n_; ++c)
        psi_[s * n_ + c] = static_cast<double>(psi[s * n_columns_ + first_ + c]);
    }
  });
}

}  // namespace dim
