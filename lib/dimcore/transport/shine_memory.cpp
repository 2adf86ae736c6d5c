#include "transport/shine_memory.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "network/row_parts.hpp"
#include "transport/gather_kernel.hpp"
#include "transport/shine_links.hpp"

namespace dim {
namespace {

constexpr std::size_t kSampledRows = 512;
constexpr double kMargin = 1.25;  // over what the sample says of mirrors
constexpr std::size_t kGrowth =
    3;  // a vector that outgrows its room exists twice, the second time twice as large
constexpr std::size_t kOfChunk = 16u << 20;

// Rays by what they meet first.
struct Counts {
  double into_lobes = 0.0, into_mirrors = 0.0, from_lobes = 0.0, from_lobes_into_mirrors = 0.0;
};

class Counter {
 public:
  Counter(const Zone& zone, const Cells& cells, const Network& network, std::size_t n_classes,
          const std::vector<Shininess>& of_surface, const MirrorRays& mirrors)
      : zone_(zone),
        cells_(cells),
        network_(network),
        n_classes_(n_classes),
        of_surface_(of_surface),
        mirrors_(mirrors) {}

  Counts count() const {
    std::vector<Counts> of_row(cells_.size() + zone_.points.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, of_row.size(), 64), [&](const auto& range) {
      for (std::size_t row = range.begin(); row != range.end(); ++row) of_row[row] = count(row);
    });
    Counts total;
    for (const auto& row : of_row) {
      total.into_lobes += row.into_lobes;
      total.into_mirrors += row.into_mirrors;
      total.from_lobes += row.from_lobes;
      total.from_lobes_into_mirrors += row.from_lobes_into_mirrors;
    }
    return total;
  }

  // Cells that a ray comes down on after its first mirror, the mean of a sample.
  double landings_of_ray() const {
    const std::size_t n_rows = cells_.size() + zone_.points.size();
    const std::size_t step = std::max<std::size_t>(1, n_rows / kSampledRows), n = (n_rows + step - 1) / step;
    std::vector<std::size_t> rays(n, 0), landings(n, 0);
    tbb::parallel_for(std::size_t{0}, n,
                      [&](std::size_t sample) { follow(sample * step, rays[sample], landings[sample]); });
    std::size_t n_rays = 0, n_landings = 0;
    for (std::size_t sample = 0; sample < n; ++sample) {
      n_rays += rays[sample];
      n_landings += landings[sample];
    }
    return n_rays > 0 ? static_cast<double>(n_landings) / static_cast<double>(n_rays) : 1.0;
  }

 private:
  Shininess kind(std::size_t cell) const { return of_surface_[cells_.surface_of(cell)]; }

  Counts count(std::size_t row) const {
    const bool point = row >= cells_.size(), lobe = !point && kind(row) == Shininess::off_specular;
    const SinkTable& sinks = point ? network_.point_sinks : network_.sinks;
    Counts counts;
    for (std::size_t patch = 0; patch < sinks.n_patches(); ++patch) {
      const std::size_t sink = sinks.at(point ? row - cells_.size() : row, patch);
      if (sink >= cells_.size()) continue;
      const bool mirror = kind(sink) == Shininess::mirror;
      counts.into_mirrors += mirror;
      counts.into_lobes += point && kind(sink) == Shininess::off_specular;
      counts.from_lobes += lobe;
      counts.from_lobes_into_mirrors += lobe && mirror;
    }
    if (!point && network_.has_family()) {
      const auto members = static_cast<double>(network_.extra.first[row + 1] - network_.extra.first[row]);
      counts.into_mirrors += members;
      if (lobe) counts.from_lobes += members;
    }
    return counts;
  }

  void follow(std::size_t row, std::size_t& n_rays, std::size_t& n_landings) const {
    const bool point = row >= cells_.size();
    const RowParts parts =
        point ? RowParts(zone_, network_, row - cells_.size()) : RowParts(zone_, cells_, network_, row);
    std::vector<double> tint(n_classes_);
    for (const auto& part : parts.parts()) {
      if (part.cell >= cells_.size() || kind(part.cell) != Shininess::mirror) continue;
      std::fill(tint.begin(), tint.end(), 1.0);
      ++n_rays;
      mirrors_.follow(parts.ray(part), cells_.surface_of(part.cell), tint,
                      [&](std::size_t, const Vec3&) { ++n_landings; });
    }
  }

  const Zone& zone_;
  const Cells& cells_;
  const Network& network_;
  std::size_t n_classes_;
  const std::vector<Shininess>& of_surface_;
  const MirrorRays& mirrors_;
};

std::size_t bytes(double n, std::size_t each) { return static_cast<std::size_t>(n) * each; }

}  // namespace

ShineMemory shine_memory(const Zone& zone, const Cells& cells, const Network& network,
                         const ReflectanceClasses& classes, const RayCaster& caster,
                         const MirrorRayOptions& mirror_rays, std::size_t n_columns) {
  const PatchGrid grid = lobe_grid(network.patches);
  const auto of_surface = shininess_of_surfaces(zone, classes, grid);
  ShineMemory memory;
  memory.n_patches = grid.n_patches();
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
    if (of_surface[s] == Shininess::off_specular)
      memory.n_off_specular += cells.first(s + 1) - cells.first(s);
  }
  const bool any_mirror = std::count(of_surface.begin(), of_surface.end(), Shininess::mirror) > 0;
  if (memory.n_off_specular == 0 && !any_mirror) return memory;

  const MirrorRays mirrors(zone, cells, classes, of_surface, caster, mirror_rays);
  const Counter counter(zone, cells, network, classes.size(), of_surface, mirrors);
  const Counts counts = counter.count();
  const double landings = any_mirror ? kMargin * counter.landings_of_ray() : 0.0;
  const std::size_t tint = classes.size() * sizeof(float), lobe = sizeof(ShineLinks::Lobe);
  const std::size_t sent = lobe + sizeof(std::uint32_t);
  memory.links = kOfChunk +
                 bytes(kGrowth * landings * counts.into_mirrors, sizeof(ShineLinks::Mirror) + tint) +
                 bytes(counts.from_lobes + counts.into_lobes, kGrowth * sent + lobe) +
                 bytes(landings * (counts.from_lobes_into_mirrors + counts.into_lobes),
                       kGrowth * (sent + tint) + lobe + tint);
  if (any_mirror)
    memory.links += cells.size() * classes.size() * (sizeof(double) + sizeof(ShineLinks::Passed));

  // Of direct light (and apart what rays carried on from mirrors), solved, and both once more as they are
  // stored.
  const std::size_t copies = any_mirror ? 5 : 4, solved_at_once = std::min(n_columns, kColumnsPerLane);
  memory.light = memory.n_off_specular * memory.n_patches *
                 (copies * n_columns * sizeof(float) + 2 * solved_at_once * sizeof(double));
  return memory;
}

}  // namespace dim
