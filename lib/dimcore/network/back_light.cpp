#include "network/back_light.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace dim {
namespace {

constexpr double kWhole = 1ull << 60;  // all light, in the units of the sums

}  // namespace

BackLight::BackLight(const Zone& zone, const Cells& cells, const PatchGrid& patches)
    : zone_(zone), cells_(cells), patches_(patches), per_m2_(0.0), sums_(zone.surfaces.size()) {
  double sending_m2 = 0.0;
  for (const auto& surface : zone.surfaces) sending_m2 += surface.bounding ? surface.polygon.area_m2() : 0.0;
  if (sending_m2 > 0.0) per_m2_ = kWhole / sending_m2;
}

void BackLight::add(std::size_t cell, std::size_t patch, std::size_t surface) {
  if (!zone_.surfaces[cells_.surface_of(cell)].bounding) return;
  const double share = patches_.weight_sr(static_cast<int>(patch) / patches_.n_sectors) / kPi;
  sums_[surface] += static_cast<std::uint64_t>(per_m2_ * cells_.area_m2(cell) * share);
}

std::vector<double> BackLight::shares() const {
  std::vector<double> shares;
  for (const auto& sum : sums_) shares.push_back(static_cast<double>(sum) / kWhole);
  return shares;
}

Warnings back_warnings(const std::vector<double>& back_share, const Zone& zone) {
  constexpr double kSeen = 1e-5, kWorthSaying = 1e-4;  // rays that slip past an edge are fewer
  constexpr std::size_t kMostNamed = 5;
  const double all = std::accumulate(back_share.begin(), back_share.end(), 0.0);
  if (!(all > kWorthSaying)) return {};
  std::vector<std::size_t> seen;
  for (std::size_t s = 0; s < back_share.size(); ++s)
    if (back_share[s] > kSeen) seen.push_back(s);
  if (seen.empty()) seen.push_back(static_cast<std::size_t>(
      std::max_element(back_share.begin(), back_share.end()) - back_share.begin()));
  std::string names;
  for (std::size_t k = 0; k < std::min(seen.size(), kMostNamed); ++k)
    names += fmt::format("{}'{}'", k > 0 ? ", " : "", zone.surfaces[seen[k]].name);
  if (seen.size() > kMostNamed) names += fmt::format(" and {} more", seen.size() - kMostNamed);
  return {{zone.surfaces[seen[0]].place,
           fmt::format("{} {} seen from behind inside the zone, where {} dark: the back{} swallow{} {:.2g} % of the "
                       "light that the zone's surfaces send out",
                       names, seen.size() == 1 ? "is" : "are", seen.size() == 1 ? "it is" : "they are",
                       seen.size() == 1 ? "" : "s", seen.size() == 1 ? "s" : "", 100.0 * all),
           "a thin panel that is lit on both sides is written sides = 2; else list the corners the other way round"}};
}

}  // namespace dim
