#include "reflection/lobe.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>

#include "base/low_discrepancy.hpp"

namespace dim {
namespace {

constexpr std::size_t kAlbedoSteps = 64;
constexpr std::size_t kSamples = 1 << 19;  // over all slices
constexpr std::size_t kLeastSamplesPerSlice = 1024;
constexpr double kNoticeable = 1e-4;  // of the largest flux of either patch
constexpr int kBalanceRounds = 100;

using BinKey = std::uint64_t;  // slice_in, slice_out, turn
BinKey key_of(std::uint64_t in, std::uint64_t out, std::uint64_t turn) { return in << 48 | out << 32 | turn; }

}  // namespace

AlbedoTable::AlbedoTable(const BandReflection& reflection, const Facets* facets) {
  for (std::size_t i = 0; i <= kAlbedoSteps; ++i)
    values_.push_back(specular_albedo(reflection, facets, static_cast<double>(i) / kAlbedoSteps));
}

double AlbedoTable::at(double cos_incidence) const {
  if (values_.empty()) return 0.0;
  const double x = std::clamp(cos_incidence, 0.0, 1.0) * kAlbedoSteps;
  const auto i = std::min(static_cast<std::size_t>(x), kAlbedoSteps - 1);
  return values_[i] + (x - static_cast<double>(i)) * (values_[i + 1] - values_[i]);
}

std::vector<double> AlbedoTable::of_slices(const PatchGrid& grid) const {
  constexpr int kPoints = 8;
  std::vector<double> result;
  for (int slice = 0; slice < grid.n_slices; ++slice) {
    double sum = 0.0;
    for (int i = 0; i < kPoints; ++i)
      sum += at(PatchSlice(grid, slice).direction(0, (i + 0.5) / kPoints, 0.5).z);
    result.push_back(sum / kPoints);
  }
  return result;
}

FacetSample sample_facet(const Facets& facets, const Vec3& in, double u, double v) {
  const double tilt = facets.tilt_rad(u), sine = std::sin(tilt);
  const Vec2 azimuth = cos_sin_of_turn(v);
  const Vec3 half(sine * azimuth.x, sine * azimuth.y, std::cos(tilt));
  const double facing = glm::dot(in, half);
  const Vec3 out = 2.0 * facing * half - in;
  return {out, facet_weight(half, in, out), std::clamp(facing, 0.0, 1.0)};
}

namespace {

struct Total {
  double flux = 0.0, facing = 0.0;  // facing is weighted with flux
};

std::unordered_map<BinKey, Total> sampled_bins(const PatchGrid& grid, const Facets& facets) {
  std::unordered_map<BinKey, Total> totals;
  const std::size_t n = std::max(kLeastSamplesPerSlice, kSamples / static_cast<std::size_t>(grid.n_slices));
  const auto n_sectors = static_cast<std::uint64_t>(grid.n_sectors);
  const LowDiscrepancy4 points(1);
  for (int slice = 0; slice < grid.n_slices; ++slice) {
    const PatchSlice directions(grid, slice);
    const double w = grid.weight_sr(slice) / kPi / static_cast<double>(n);
    for (std::size_t i = 0; i < n; ++i) {
      const auto x = points(i);
      const auto facet = sample_facet(facets, directions.direction(0, x[0], x[1]), x[2], x[3]);
      if (!(facet.weight > 0.0)) continue;
      const std::uint64_t patch = grid.patch_of(facet.out);
      Total& total = totals[key_of(static_cast<std::uint64_t>(slice), patch / n_sectors, patch % n_sectors)];
      total.flux += w * facet.weight;
      total.facing += w * facet.weight * facet.facing;
    }
  }
  return totals;
}

// Each way round, and from out to in as well: the law is symmetric in all of these, samples are not.
std::map<BinKey, Total> symmetric(const std::unordered_map<BinKey, Total>& sampled, std::uint64_t n_sectors) {
  std::vector<std::pair<BinKey, Total>> bins;
  for (const auto& [key, total] : sampled) {
    const std::uint64_t in = key >> 48, out = key >> 32 & 0xffff, turn = key & 0xffffffff;
    const std::uint64_t back = (n_sectors - turn) % n_sectors;
    for (const auto other :
         {key_of(in, out, turn), key_of(in, out, back), key_of(out, in, back), key_of(out, in, turn)})
      bins.push_back({other, {total.flux / 4.0, total.facing / 4.0}});
  }
  // The order of a hash table is nobody's; that of the sums must be fixed.
  std::sort(bins.begin(), bins.end(), [](const auto& a, const auto& b) {
    return std::tie(a.first, a.second.flux, a.second.facing) <
           std::tie(b.first, b.second.flux, b.second.facing);
  });
  std::map<BinKey, Total> result;
  for (const auto& [key, total] : bins) {
    Total& sum = result.try_emplace(result.end(), key)->second;
    sum.flux += total.flux;
    sum.facing += total.facing;
  }
  return result;
}

}  // namespace

LobeShape lobe_shape(const PatchGrid& grid, const Facets& facets) {
  const auto totals = symmetric(sampled_bins(grid, facets), static_cast<std::uint64_t>(grid.n_sectors));
  std::vector<double> largest(static_cast<std::size_t>(grid.n_slices), 0.0);
  for (const auto& [key, total] : totals) {
    auto& most = largest[key >> 48];
    most = std::max(most, total.flux);
  }
  LobeShape shape;
  shape.grid = grid;
  for (const auto& [key, total] : totals) {
    const std::size_t in = key >> 48, out = key >> 32 & 0xffff;
    if (total.flux < kNoticeable * std::max(largest[in], largest[out])) continue;
    shape.bins.push_back({static_cast<std::uint16_t>(in), static_cast<std::uint16_t>(out),
                          static_cast<std::uint32_t>(key), total.flux, total.facing / total.flux});
  }
  return shape;
}

LobeMatrix::LobeMatrix(const LobeShape& shape, const BandReflection& reflection,
                       const std::vector<double>& slice_albedo) {
  const auto n_slices = static_cast<std::size_t>(shape.grid.n_slices);
  std::vector<double> flux;
  for (const auto& bin : shape.bins) flux.push_back(bin.flux * reflection.fresnel(bin.facing));
  // Symmetric scaling (Sinkhorn) to the exact albedo of every slice keeps the matrix reciprocal.
  std::vector<double> scale(n_slices, 1.0), due(n_slices), sum(n_slices);
  for (std::size_t a = 0; a < n_slices; ++a)
    due[a] = slice_albedo[a] * shape.grid.weight_sr(static_cast<int>(a)) / kPi;
  for (int round = 0; round < kBalanceRounds; ++round) {
    std::fill(sum.begin(), sum.end(), 0.0);
    for (std::size_t i = 0; i < flux.size(); ++i)
      sum[shape.bins[i].slice_in] += scale[shape.bins[i].slice_in] * flux[i] * scale[shape.bins[i].slice_out];
    for (std::size_t a = 0; a < n_slices; ++a) {
      if (sum[a] > 0.0) scale[a] *= std::sqrt(due[a] / sum[a]);
    }
  }
  first_.assign(n_slices + 1, 0);
  std::fill(sum.begin(), sum.end(), 0.0);
  for (std::size_t i = 0; i < flux.size(); ++i) {
    const auto& bin = shape.bins[i];
    const double value = scale[bin.slice_in] * flux[i] * scale[bin.slice_out];
    entries_.push_back({bin.slice_out, bin.turn, value});
    sum[bin.slice_in] += value;
    first_[bin.slice_in + 1] = entries_.size();
  }
  for (std::size_t a = 0; a < n_slices; ++a) {
    first_[a + 1] = std::max(first_[a + 1], first_[a]);
    for (std::size_t i = first_[a]; i < first_[a + 1]; ++i)
      entries_[i].share = sum[a] > 0.0 ? entries_[i].share * slice_albedo[a] / sum[a] : 0.0;
  }
}

}  // namespace dim
