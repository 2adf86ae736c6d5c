#include "network/family.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace dim {
namespace {

Vec3 centre(const Zone& zone, const Cells& cells, std::size_t cell) {
  return zone.surfaces[cells.surface_of(cell)].polygon.frame().to_world(cells[cell].centroid);
}

// Patch of cell i's hemisphere that cell j's middle is back-projected to.
std::size_t patch_towards(const Zone& zone, const Cells& cells, const PatchGrid& patches, std::size_t i,
                          std::size_t j) {
  const Frame& frame = zone.surfaces[cells.surface_of(i)].polygon.frame();
  return patches.patch_of(
      frame.direction_to_local(glm::normalize(centre(zone, cells, j) - centre(zone, cells, i))));
}

struct Members {
  std::vector<std::pair<std::uint32_t, double>> links;  // cell, weight
};

class FamilyFinder {
 public:
  FamilyFinder(const Zone& zone, const Cells& cells, const Network& network)
      : zone_(zone), cells_(cells), network_(network), caster_(plates_of(zone), zone.diameter_m) {
    centre_.reserve(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) centre_.push_back(centre(zone, cells, i));
  }

  Members of(std::size_t i) const {
    const std::size_t n_patches = network_.patches.n_patches();
    std::vector<bool> hit(cells_.size() + 1, false);
    for (std::size_t k = 0; k < n_patches; ++k) hit[network_.sinks.at(i, k)] = true;
    std::vector<std::pair<std::size_t, std::uint32_t>> joined;  // patch, cell
    for (std::size_t j = 0; j < cells_.size(); ++j) {
      if (hit[j] || !faces(i, j) || caster_.blocked(centre_[i], centre_[j], surface(i))) continue;
      const std::size_t patch = patch_towards(zone_, cells_, network_.patches, i, j);
      if (network_.sinks.at(i, patch) < cells_.size())
        joined.emplace_back(patch, static_cast<std::uint32_t>(j));
    }
    std::sort(joined.begin(), joined.end());
    return shares(i, joined);
  }

 private:
  const Polygon& polygon(std::size_t cell) const { return zone_.surfaces[cells_.surface_of(cell)].polygon; }
  int surface(std::size_t cell) const { return static_cast<int>(cells_.surface_of(cell)); }

  bool faces(std::size_t i, std::size_t j) const {
    const Vec3 path = centre_[j] - centre_[i];
    return glm::dot(path, polygon(i).normal()) > caster_.tolerance_m() &&
           glm::dot(path, polygon(j).normal()) < -caster_.tolerance_m();
  }

  Members shares(std::size_t i, const std::vector<std::pair<std::size_t, std::uint32_t>>& joined) const {
    Members members;
    for (std::size_t begin = 0; begin < joined.size();) {
      const std::size_t patch = joined[begin].first;
      std::size_t end = begin;
      const std::uint32_t sink = network_.sinks.at(i, patch);
      double area = cells_.area_m2(sink);
      for (; end < joined.size() && joined[end].first == patch; ++end)
        area += cells_.area_m2(joined[end].second);
      const int slice = static_cast<int>(patch / static_cast<std::size_t>(network_.patches.n_sectors));
      const double weight = network_.patches.weight_sr(slice) / kPi;
      members.links.emplace_back(sink, weight * (cells_.area_m2(sink) / area - 1.0));
      for (; begin < end; ++begin)
        members.links.emplace_back(joined[begin].second,
                                   weight * cells_.area_m2(joined[begin].second) / area);
    }
    return members;
  }

  const Zone& zone_;
  const Cells& cells_;
  const Network& network_;
  RayCaster caster_;
  std::vector<Vec3> centre_;
};

}  // namespace

ExtraLinks find_families(const Zone& zone, const Cells& cells, const Network& network, const Job& job) {
  const FamilyFinder finder(zone, cells, network);
  std::vector<Members> of_cell(cells.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size(), 16), [&](const auto& rows) {
    if (job.stopped()) return;
    for (std::size_t i = rows.begin(); i != rows.end(); ++i) of_cell[i] = finder.of(i);
  });
  job.check();
  ExtraLinks extra;
  extra.first.push_back(0);
  for (const auto& members : of_cell) {
    for (const auto& [cell, weight] : members.links) {
      extra.cell.push_back(cell);
      extra.weight.push_back(weight);
    }
    extra.first.push_back(extra.cell.size());
  }
  return extra;
}

std::vector<FamilyLink> family_links(const Zone& zone, const Cells& cells, const Network& network,
                                     std::size_t row) {
  std::vector<FamilyLink> links;
  if (!network.has_family()) return links;
  const auto& extra = network.extra;
  for (auto e = extra.first[row]; e < extra.first[row + 1]; ++e) {
    // Every patch's links begin with what is taken back from its sink; the cells that join it follow.
    const std::size_t member = extra.weight[e] < 0.0 ? extra.cell[e + 1] : extra.cell[e];
    links.push_back({static_cast<std::uint32_t>(patch_towards(zone, cells, network.patches, row, member)),
                     extra.cell[e], extra.weight[e]});
  }
  return links;
}

}  // namespace dim
