#include "network/balance.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace dim {
namespace {

template <class Sink>
double row_sum(const Sink* sinks, const PatchGrid& patches, const std::vector<double>& x) {
  double sum = 0.0;
  for (int slice = 0; slice < patches.n_slices; ++slice) {
    double in_slice = 0.0;
    for (int sector = 0; sector < patches.n_sectors; ++sector) in_slice += x[*sinks++];
    sum += in_slice * patches.weight_sr(slice);
  }
  return sum / kPi;
}

template <class Sink>
void scatter_row(const Sink* sinks, const PatchGrid& patches, double y, std::vector<double>& x) {
  for (int slice = 0; slice < patches.n_slices; ++slice) {
    const double share = y * patches.weight_sr(slice) / kPi;
    for (int sector = 0; sector < patches.n_sectors; ++sector) x[*sinks++] += share;
  }
}

}  // namespace

std::vector<double> apply_rows(const Network& network, const std::vector<double>& x) {
  const std::size_t n_cells = network.sinks.n_rows(), n_patches = network.sinks.n_patches();
  std::vector<double> padded(x);
  padded.push_back(0.0);  // where rays that end nowhere read
  std::vector<double> result(n_cells);
  network.sinks.visit([&](const auto* sinks) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n_cells, 64), [&](const auto& rows) {
      for (std::size_t row = rows.begin(); row != rows.end(); ++row) {
        double sum = row_sum(sinks + row * n_patches, network.patches, padded);
        if (network.has_family()) {
          for (auto e = network.extra.first[row]; e < network.extra.first[row + 1]; ++e)
            sum += network.extra.weight[e] * x[network.extra.cell[e]];
        }
        result[row] = sum;
      }
    });
  });
  return result;
}

std::vector<double> apply_columns(const Network& network, const std::vector<double>& y) {
  const std::size_t n_cells = network.sinks.n_rows(), n_patches = network.sinks.n_patches();
  // A fixed number of parts, each summed in order and then added in order: the threads that happen to take
  // them do not matter.
  constexpr std::size_t kParts = 8;
  std::vector<std::vector<double>> parts(kParts);
  network.sinks.visit([&](const auto* sinks) {
    tbb::parallel_for(std::size_t{0}, kParts, [&](std::size_t part) {
      auto& sums = parts[part];
      sums.assign(n_cells + 1, 0.0);
      for (std::size_t row = part * n_cells / kParts; row < (part + 1) * n_cells / kParts; ++row) {
        scatter_row(sinks + row * n_patches, network.patches, y[row], sums);
        if (!network.has_family()) continue;
        for (auto e = network.extra.first[row]; e < network.extra.first[row + 1]; ++e)
          sums[network.extra.cell[e]] += y[row] * network.extra.weight[e];
      }
    });
  });
  std::vector<double> result(n_cells);
  for (std::size_t j = 0; j < n_cells; ++j) {
    for (const auto& sums : parts) result[j] += sums[j];
  }
  return result;
}

void balance(Network& network, const Cells& cells) {
  constexpr int kMaxRounds = 8;
  constexpr double kGoodEnough = 3e-4;
  const std::size_t n = cells.size();
  network.visible = apply_rows(network, std::vector<double>(n, 1.0));
  const auto& visible = network.visible;
  network.row_scale.assign(n, 1.0);
  network.column_scale.assign(n, 1.0);
  std::vector<double> sent(n);
  for (int round = 0; round < kMaxRounds; ++round) {
    for (std::size_t i = 0; i < n; ++i) sent[i] = cells.area_m2(i) * network.row_scale[i];
    const auto column = apply_columns(network, sent);
    double off_m2 = 0.0, total_m2 = 0.0;
    for (std::size_t j = 0; j < n; ++j) {
      const double due_m2 = cells.area_m2(j) * visible[j];
      total_m2 += due_m2;
      off_m2 += std::abs(column[j] * network.column_scale[j] - due_m2);
      if (column[j] > 0.0 && due_m2 > 0.0) network.column_scale[j] = due_m2 / column[j];
    }
    network.imbalance = total_m2 > 0.0 ? off_m2 / total_m2 : 0.0;
    const auto row = apply_rows(network, network.column_scale);
    for (std::size_t i = 0; i < n; ++i) {
      if (row[i] > 0.0) network.row_scale[i] = visible[i] / row[i];
    }
    if (network.imbalance < kGoodEnough) break;
  }
}

}  // namespace dim
