#include "transport/propagation.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "network/half_of_rays.hpp"
#include "transport/gather_kernel.hpp"

namespace dim {

Propagation::Propagation(const Network& network, const Cells& cells, const Reflectances& reflectances,
                         std::size_t first, std::size_t n, const GatherShine* shine)
    : network_(network),
      n_(n),
      width_((n + kColumnsPerLane - 1) / kColumnsPerLane * kColumnsPerLane),
      sums_(cells.size(), width_),
      rho_(cells.n_surfaces() * width_, 0.0),
      exitance_((cells.size() + 1) * width_, 0.0) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    area_m2_.push_back(cells.area_m2(i));
    surface_.push_back(static_cast<std::uint32_t>(cells.surface_of(i)));
  }
  for (std::size_t s = 0; s < cells.n_surfaces(); ++s) {
    for (std::size_t c = 0; c < n; ++c)
      rho_[s * width_ + c] =
          reflectances.of_surface[s * reflectances.n_classes + reflectances.class_of_column[first + c]];
  }
  if (!shine) return;
  shine_.emplace(shine->shine, shine->zone, network, cells, shine->direct, reflectances.class_of_column,
                 reflectances.n_columns(), first, n, width_);
  has_mirrors_ = shine->shine.has_mirrors();
  has_lobes_ = shine->shine.n_states() > 0;
}

const std::vector<double>& Propagation::emit(const std::vector<double>& irradiance) {
  sums_.each([&](std::size_t i) {
    const double* rho = reflectance(i);
    const double* from = &irradiance[i * width_];
    double* to = &exitance_[i * width_];
    for (std::size_t c = 0; c < width_; ++c) to[c] = network_.column_scale[i] * rho[c] * from[c];
  });
  return exitance_;
}

void Propagation::reflect(const std::vector<double>& irradiance, std::vector<double>& arriving) {
  emit(irradiance);
  send(arriving);
  scale_rows(arriving);
}

void Propagation::scale_rows(std::vector<double>& arriving) const {
  sums_.each([&](std::size_t i) {
    double* sums = &arriving[i * width_];
    for (std::size_t c = 0; c < width_; ++c) sums[c] *= network_.row_scale[i];
  });
}

void Propagation::send(const std::vector<float>& exitance, std::vector<double>& arriving) {
  std::copy(exitance.begin(), exitance.end(), exitance_.begin());
  send(arriving);
}

void Propagation::send(std::vector<double>& arriving) {
  arriving.resize(exitance_.size() - width_);
  sums_.runs([&](std::size_t first, std::size_t last) {
    gather_rows(network_.sinks, network_.patches, network_.has_family() ? &network_.extra : nullptr,
                exitance_.data(), width_, first, last, &arriving[first * width_]);
  });
  if (shine_) shine_->add_to_cells(exitance_, arriving);
}

void Propagation::reflect_by_half(const std::vector<double>& irradiance, std::vector<double>& arriving) {
  emit(irradiance);
  arriving.resize(exitance_.size() - width_);
  const std::size_t n_cells = arriving.size() / width_;
  sums_.runs([&](std::size_t first, std::size_t last) {
    const SinkTable sinks = half_of_rays(network_.sinks, network_.patches, n_cells, first, last);
    gather_rows(sinks, half_of(network_.patches), nullptr, exitance_.data(), width_, 0, last - first,
                &arriving[first * width_]);
  });
  if (shine_) shine_->add_to_cells(exitance_, arriving);
  scale_rows(arriving);
}

// Points have rows of their own, which the column scales do not belong to.
void Propagation::emit_to_points(const std::vector<double>& irradiance) {
  emit(irradiance);
  sums_.each([&](std::size_t i) {
    double* exitance = &exitance_[i * width_];
    for (std::size_t c = 0; c < width_; ++c) exitance[c] /= network_.column_scale[i];
  });
}

std::vector<double> Propagation::along(const SinkTable& sinks, const PatchGrid& patches) const {
  std::vector<double> arriving(sinks.n_rows() * width_);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sinks.n_rows(), 16), [&](const auto& rows) {
    gather_rows(sinks, patches, nullptr, exitance_.data(), width_, rows.begin(), rows.end(),
                &arriving[rows.begin() * width_]);
  });
  return arriving;
}

std::vector<double> Propagation::to_points(const std::vector<double>& irradiance) {
  emit_to_points(irradiance);
  auto arriving = along(network_.point_sinks, network_.point_patches);
  if (shine_) shine_->add_to_points(exitance_, arriving);
  return arriving;
}

std::vector<double> Propagation::to_points_by_half(const std::vector<double>& irradiance) {
  emit_to_points(irradiance);
  const auto& sinks = network_.point_sinks;
  auto less = along(half_of_rays(sinks, network_.point_patches, exitance_.size() / width_ - 1, 0, sinks.n_rows()),
                    half_of(network_.point_patches));
  const auto all = along(sinks, network_.point_patches);
  for (std::size_t k = 0; k < less.size(); ++k) less[k] -= all[k];
  return less;
}

}  // namespace dim
