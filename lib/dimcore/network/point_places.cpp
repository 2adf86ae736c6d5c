#include "network/point_places.hpp"

#include <fmt/format.h>

#include "database/toml_reader.hpp"

namespace dim {

void judge_points(const Network& network, Zone& zone) {
  const std::size_t n_patches = network.point_patches.n_patches(), nothing = network.sinks.n_rows();
  for (std::size_t p = 0; p < zone.points.size(); ++p) {
    std::size_t n_lit = 0;
    for (std::size_t k = 0; k < n_patches; ++k) n_lit += network.point_sinks.at(p, k) < nothing;
    // What looks all around sees lit sides all around: on a face, half of its rays pass into that.
    const std::size_t least = zone.points[p].quantity == Quantity::planar ? (n_patches + 1) / 2 : 3 * n_patches / 4;
    zone.points[p].valid = zone.closed ? n_lit >= least : network.point_back_fraction[p] <= 0.5;
  }
}

Warnings left_out_warnings(const Zone& zone) {
  constexpr std::size_t kMostShown = 3;
  Warnings warnings;
  for (const auto& set : zone.point_sets) {
    std::size_t n = 0;
    std::string places;
    for (std::size_t p = set.first; p < set.first + set.count; ++p) {
      if (zone.points[p].valid) continue;
      if (++n > kMostShown) continue;
      places += n > 1 ? ", " : "";
      places += short_point((zone.points[p].position + zone.origin_m) / zone.unit_m);
    }
    if (n == 0) continue;
    warnings.push_back(
        {set.place,
         fmt::format(
             "'{}': {} of {} points lie outside the zone or inside something, and are left out of its "
             "statistics: {}{}",
             set.name, n, set.count, places, n > kMostShown ? ", ..." : ""),
         n == set.count ? "no point is left: move it into the zone" : "move or shrink it to leave out none"});
  }
  return warnings;
}

}  // namespace dim
