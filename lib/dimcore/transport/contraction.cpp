#include "transport/contraction.hpp"

#include <algorithm>
#include <numeric>

#include "network/balance.hpp"
#include "transport/gather_kernel.hpp"

namespace dim {
namespace {

// The largest row sums, by sending unit irradiance of every class through the network once.
std::vector<double> largest_rows(const Network& network, const Cells& cells, const Reflectances& reflectances,
                                 const GatherShine* shine) {
  Reflectances classes = reflectances;
  classes.class_of_column.resize(classes.n_classes);
  std::iota(classes.class_of_column.begin(), classes.class_of_column.end(), std::size_t{0});
  std::vector<double> largest, arriving;
  for (std::size_t first = 0; first < classes.n_classes; first += kMaxColumns) {
    const std::size_t n = std::min(kMaxColumns, classes.n_classes - first);
    Propagation block(network, cells, classes, first, n, shine);
    block.reflect(std::vector<double>(cells.size() * block.width(), 1.0), arriving);
    const auto rows = block.sums().largest<double>(1, [&](std::size_t from, std::size_t to, double* into) {
      for (std::size_t i = from; i < to; ++i) {
        for (std::size_t c = 0; c < n; ++c) into[c] = std::max(into[c], arriving[i * block.width() + c]);
      }
    });
    largest.insert(largest.end(), rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(n));
  }
  return largest;
}

// Of what cells send diffusely, the largest part that is sent on if cell i sends on of_cell[i] of what arrives.
double largest_column(const Network& network, const Cells& cells, const std::vector<double>& of_cell) {
  std::vector<double> weight_m2(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    weight_m2[i] = cells.area_m2(i) * network.row_scale[i] * of_cell[i];
  const auto columns = apply_columns(network, weight_m2);
  double largest = 0.0;
  for (std::size_t j = 0; j < cells.size(); ++j)
    largest = std::max(largest, network.column_scale[j] * columns[j] / cells.area_m2(j));
  return largest;
}

void add_in_flux(Contraction& result, const Network& network, const Cells& cells,
                 const Reflectances& reflectances, const GatherShine& shine, std::size_t klass) {
  std::vector<double> share(cells.size()), landing(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t s = cells.surface_of(i);
    const SentOn sent_on = most_sent_on(s, reflectances.of_surface[s * reflectances.n_classes + klass],
                                        &shine.shine, shine.zone, klass);
    share[i] = sent_on.share;
    landing[i] = sent_on.landing;
  }
  // What lobes send all lands; what cells send does so but for the network's imbalance.
  result.share.push_back(std::max(*std::max_element(share.begin(), share.end()),
                                  largest_column(network, cells, share)));
  result.landing.push_back(std::max(*std::max_element(landing.begin(), landing.end()),
                                    largest_column(network, cells, landing)));
}

}  // namespace

SentOn most_sent_on(std::size_t surface, double reflectance, const Shine* shine, const Zone& zone,
                    std::size_t klass) {
  if (!shine || shine->of_surface(surface) == Shininess::diffusing) return {reflectance, 1.0};
  const auto& slices = shine->slice_albedo(klass, zone.surfaces[surface].finish);
  const double albedo = *std::max_element(slices.begin(), slices.end());
  if (shine->of_surface(surface) == Shininess::off_specular) return {reflectance + albedo, 1.0};
  return {reflectance / (1.0 - albedo), 1.0 / (1.0 - albedo)};
}

Contraction contraction(const Network& network, const Cells& cells, const Reflectances& reflectances,
                        const GatherShine* shine) {
  Contraction result;
  result.in_flux = shine && shine->shine.n_states() > 0;
  if (!result.in_flux) {
    result.share = largest_rows(network, cells, reflectances, shine);
    return result;
  }
  for (std::size_t q = 0; q < reflectances.n_classes; ++q)
    add_in_flux(result, network, cells, reflectances, *shine, q);
  return result;
}

}  // namespace dim
