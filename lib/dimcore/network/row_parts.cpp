#include "network/row_parts.hpp"

namespace dim {

RowParts::RowParts(const Zone& zone, const Cells& cells, const Network& network, std::size_t cell)
    : zone_(zone),
      cells_(&cells),
      patches_(network.patches),
      rays_(zone, cells, cell, network.sampling, network.seed),
      middle_(rays_.frame().to_world(cells[cell].centroid)) {
  add_rays(patches_, network.sinks, cell);
  for (const auto& link : family_links(zone, cells, network, cell)) {
    if (link.weight < 0.0)
      parts_[link.patch].share += link.weight;
    else
      parts_.push_back({link.patch, link.cell, link.weight, true});
  }
}

RowParts::RowParts(const Zone& zone, const Network& network, std::size_t point)
    : zone_(zone), patches_(network.point_patches), rays_(zone, point, network.sampling, network.seed) {
  add_rays(patches_, network.point_sinks, point);
}

void RowParts::add_rays(const PatchGrid& patches, const SinkTable& sinks, std::size_t row) {
  const auto n_sectors = static_cast<std::size_t>(patches.n_sectors);
  parts_.reserve(patches.n_patches());
  for (std::size_t patch = 0; patch < patches.n_patches(); ++patch)
    parts_.push_back({static_cast<std::uint32_t>(patch), sinks.at(row, patch),
                      patches.weight_sr(static_cast<int>(patch / n_sectors)) / kPi, false});
}

Ray RowParts::ray(const Part& part) const {
  if (!part.member) return rays_.ray(patches_, part.patch);
  const Vec3 to =
      zone_.surfaces[cells_->surface_of(part.cell)].polygon.frame().to_world((*cells_)[part.cell].centroid);
  return {middle_, glm::normalize(to - middle_)};
}

}  // namespace dim
