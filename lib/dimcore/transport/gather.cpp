#include "transport/gather.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "transport/gather_kernel.hpp"

namespace dim {
namespace {

// Cells are summed in runs of this length and the runs in order: the same bits on any number of threads.
constexpr std::size_t kRun = 256;

// The columns [first, first + n) of the whole problem, padded with zeros to a multiple of eight.
class Block {
 public:
  Block(const Network& network, const Cells& cells, const std::vector<double>& direct,
        const std::vector<double>& reflectance, std::size_t n_columns, std::size_t first, std::size_t n,
        const GatherShine* shine)
      : network_(network),
        cells_(cells),
        n_(n),
        width_((n + kColumnsPerLane - 1) / kColumnsPerLane * kColumnsPerLane) {
    const std::size_t n_cells = cells.size();
    direct_.assign(n_cells * width_, 0.0);
    rho_.assign(cells.n_surfaces() * width_, 0.0);
    exitance_.assign((n_cells + 1) * width_, 0.0);
    gathered_.resize(n_cells * width_);
    for (std::size_t i = 0; i < n_cells; ++i)
      std::copy_n(&direct[i * n_columns + first], n, &direct_[i * width_]);
    for (std::size_t s = 0; s < cells.n_surfaces(); ++s)
      std::copy_n(&reflectance[s * n_columns + first], n, &rho_[s * width_]);
    total_ = direct_;
    if (shine)
      shine_.emplace(shine->shine, shine->zone, network, cells, shine->direct, shine->class_of_column,
                     n_columns, first, n, width_);
    add_ambient();
  }

  void solve(const GatherOptions& options, const Job& job) {
    mean_ = weighted_mean();
    for (iterations_ = 0; iterations_ < options.max_iterations; ++iterations_) {
      job.check();
      emit();
      gather();
      residual_ = update();
      if (shine_) {
        const auto change = shine_->reflect(exitance_).largest;
        for (std::size_t c = 0; c < width_; ++c) residual_[c] = std::max(residual_[c], change[c]);
      }
      // The means grow with every reflection, so that judging by the latest ones ends when it should.
      mean_ = weighted_mean();
      if (largest_relative(residual_) <= options.tolerance) {
        ++iterations_;
        break;
      }
    }
  }

  void report(std::vector<ColumnReport>& reports, std::size_t first) {
    emit();
    for (std::size_t c = 0; c < n_; ++c) {
      ColumnReport& report = reports[first + c];
      double rho_max = 0.0;
      for (std::size_t s = 0; s < cells_.n_surfaces(); ++s)
        rho_max = std::max(rho_max, rho_[s * width_ + c] + (shine_ ? shine_->largest_albedo(s, c) : 0.0));
      report.iterations = iterations_;
      report.residual = mean_[c] > 0.0 ? residual_[c] / mean_[c] : 0.0;
      report.error_bound = report.residual * rho_max / (1.0 - rho_max);
      report.dropped = in_flight_[c];
    }
    add_power(reports, first);
    if (!shine_) return;
    const auto power = shine_->power(exitance_);
    for (std::size_t c = 0; c < n_; ++c) {
      ColumnReport& report = reports[first + c];
      report.absorbed -= power.reflected[c];
      report.escaped += power.escaped[c];
      report.dropped += power.in_flight[c];
    }
  }

  void copy_psi(std::vector<float>& psi) const {
    if (shine_) shine_->copy_psi(psi, std::vector<bool>(n_, true));
  }

  void copy_cells(std::vector<double>& cell, std::size_t n_columns, std::size_t first) const {
    for (std::size_t i = 0; i < cells_.size(); ++i)
      std::copy_n(&total_[i * width_], n_, &cell[i * n_columns + first]);
  }

  // In place of solving: what was given as direct light is all there is.
  void take_as_final(const std::vector<float>& psi) {
    total_ = direct_;
    if (shine_) shine_->set_psi(psi);
    emit();
  }

  // After report(): the exitances are those of the final irradiances, without the network's column scale.
  void gather_points(const std::vector<double>& point_direct, std::vector<double>& point,
                     std::size_t n_columns, std::size_t first) {
    const std::size_t n_points = network_.point_sinks.n_rows();
    std::vector<double> sums(n_points * width_);
    unscale();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n_points, 16), [&](const auto& rows) {
      gather_rows(network_.point_sinks, network_.point_patches, nullptr, exitance_.data(), width_,
                  rows.begin(), rows.end(), sums.data());
    });
    if (shine_) shine_->add_to_points(exitance_, sums);
    for (std::size_t p = 0; p < n_points; ++p) {
      for (std::size_t c = 0; c < n_; ++c)
        point[p * n_columns + first + c] = point_direct[p * n_columns + first + c] + sums[p * width_ + c];
    }
  }

 private:
  // A first guess of the inter-reflected part: that of an integrating sphere of the same area and
  // reflectances. It takes the slowest-settling share out of the iteration; the answer does not depend on it.
  void add_ambient() {
    std::vector<double> reflected(width_, 0.0), taken(width_, 0.0);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const double* rho = &rho_[cells_.surface_of(i) * width_];
      for (std::size_t c = 0; c < width_; ++c) {
        reflected[c] += cells_.area_m2(i) * network_.visible[i] * rho[c] * direct_[i * width_ + c];
        taken[c] += cells_.area_m2(i) * (1.0 - network_.visible[i] * rho[c]);
      }
    }
    for_cells([&](std::size_t i) {
      for (std::size_t c = 0; c < width_; ++c) {
        if (taken[c] > 0.0) total_[i * width_ + c] += network_.visible[i] * reflected[c] / taken[c];
      }
    });
  }

  void emit() {
    for_cells([&](std::size_t i) {
      const double* rho = &rho_[cells_.surface_of(i) * width_];
      for (std::size_t c = 0; c < width_; ++c)
        exitance_[i * width_ + c] = network_.column_scale[i] * rho[c] * total_[i * width_ + c];
    });
  }

  void unscale() {
    for_cells([&](std::size_t i) {
      for (std::size_t c = 0; c < width_; ++c) exitance_[i * width_ + c] /= network_.column_scale[i];
    });
  }

  void gather() {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells_.size(), 32), [&](const auto& rows) {
      gather_rows(network_.sinks, network_.patches, network_.has_family() ? &network_.extra : nullptr,
                  exitance_.data(), width_, rows.begin(), rows.end(), gathered_.data());
    });
    if (shine_) shine_->add_to_cells(exitance_, gathered_);
  }

  // Sets the new irradiances and what their change would reflect on; returns the largest change of each
  // column.
  std::vector<double> update() {
    const std::size_t n_runs = (cells_.size() + kRun - 1) / kRun;
    std::vector<double> change(n_runs * width_, 0.0), reflected(n_runs * width_, 0.0);
    tbb::parallel_for(std::size_t{0}, n_runs, [&](std::size_t run) {
      const std::size_t last = std::min(cells_.size(), (run + 1) * kRun);
      for (std::size_t i = run * kRun; i < last; ++i) {
        const double* rho = &rho_[cells_.surface_of(i) * width_];
        const double seen_m2 = cells_.area_m2(i) * network_.visible[i];
        for (std::size_t c = 0; c < width_; ++c) {
          const std::size_t at = i * width_ + c;
          const double next = direct_[at] + network_.row_scale[i] * gathered_[at];
          change[run * width_ + c] = std::max(change[run * width_ + c], std::abs(next - total_[at]));
          reflected[run * width_ + c] += seen_m2 * rho[c] * (next - total_[at]);
          total_[at] = next;
        }
      }
    });
    std::vector<double> largest(width_, 0.0);
    in_flight_.assign(width_, 0.0);
    for (std::size_t run = 0; run < n_runs; ++run) {
      for (std::size_t c = 0; c < width_; ++c) {
        largest[c] = std::max(largest[c], change[run * width_ + c]);
        in_flight_[c] += reflected[run * width_ + c];
      }
    }
    return largest;
  }

  double largest_relative(const std::vector<double>& residual) const {
    double largest = 0.0;
    for (std::size_t c = 0; c < n_; ++c) {
      if (mean_[c] > 0.0) largest = std::max(largest, residual[c] / mean_[c]);
    }
    return largest;
  }

  std::vector<double> weighted_mean() const {
    std::vector<double> sum(width_, 0.0);
    double area_m2 = 0.0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const double a = cells_.area_m2(i);
      area_m2 += a;
      for (std::size_t c = 0; c < width_; ++c) sum[c] += a * total_[i * width_ + c];
    }
    for (double& s : sum) s /= area_m2;
    return sum;
  }

  void add_power(std::vector<ColumnReport>& reports, std::size_t first) const {
    const auto& visible = network_.visible;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const double a = cells_.area_m2(i);
      const double* rho = &rho_[cells_.surface_of(i) * width_];
      for (std::size_t c = 0; c < n_; ++c) {
        const double e = total_[i * width_ + c];
        auto& report = reports[first + c];
        report.received += a * direct_[i * width_ + c];
        report.absorbed += a * (1.0 - rho[c]) * e;
        report.escaped += a * rho[c] * e * (1.0 - visible[i]);
      }
    }
  }

  template <class F>
  void for_cells(F&& f) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells_.size(), kRun), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) f(i);
    });
  }

  const Network& network_;
  const Cells& cells_;
  std::size_t n_;
  std::size_t width_;
  std::vector<double> direct_, rho_, total_, exitance_, gathered_;
  std::vector<double> mean_, residual_, in_flight_;
  int iterations_ = 0;
  std::optional<ShineState> shine_;
};

}  // namespace

Gathered gather(const Network& network, const Cells& cells, const std::vector<double>& direct,
                const std::vector<double>& point_direct, const std::vector<double>& reflectance,
                std::size_t n_columns, const GatherOptions& options, const Job& job,
                const GatherShine* shine) {
  // Off-specular cells hold a value a patch for every column.
  const std::size_t block_columns = shine && shine->shine.n_states() > 0 ? kColumnsPerLane : kMaxColumns;
  Gathered result;
  if (shine) result.psi.resize(shine->shine.n_states() * n_columns);
  result.cell.resize(cells.size() * n_columns);
  result.point.resize(network.point_sinks.n_rows() * n_columns);
  result.columns.resize(n_columns);
  for (std::size_t first = 0; first < n_columns; first += block_columns) {
    const std::size_t n = std::min(block_columns, n_columns - first);
    Block block(network, cells, direct, reflectance, n_columns, first, n, shine);
    block.solve(options, job);
    block.report(result.columns, first);
    block.copy_cells(result.cell, n_columns, first);
    block.copy_psi(result.psi);
    block.gather_points(point_direct, result.point, n_columns, first);
    job.report("solve", static_cast<double>(first + n) / static_cast<double>(n_columns));
  }
  return result;
}

std::vector<double> gather_points(const Network& network, const Cells& cells, const std::vector<double>& cell,
                                  const std::vector<float>& psi, const std::vector<double>& point_direct,
                                  const std::vector<double>& reflectance, std::size_t n_columns,
                                  const GatherShine* shine) {
  std::vector<double> point(network.point_sinks.n_rows() * n_columns);
  for (std::size_t first = 0; first < n_columns; first += kMaxColumns) {
    const std::size_t n = std::min(kMaxColumns, n_columns - first);
    Block block(network, cells, cell, reflectance, n_columns, first, n, shine);
    block.take_as_final(psi);
    block.gather_points(point_direct, point, n_columns, first);
  }
  return point;
}

}  // namespace dim
