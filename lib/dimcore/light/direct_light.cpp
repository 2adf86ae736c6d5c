#include "light/direct_light.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <map>

#include "network/stream_key.hpp"

namespace dim {
namespace {

// Neighbouring cells of a surface, up to this many along each of its axes, that share the search for what is
// in the way.
constexpr double kCellsPerTile = 8.0;

struct Tile {
  std::vector<std::size_t> cells;
  Vec2 low{0.0}, high{0.0};
};

// All cells in tiles, each within one surface.
std::vector<Tile> make_tiles(const Zone& zone, const Cells& cells) {
  std::vector<Tile> tiles;
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
    const CellGrid& grid = cells.grid(s);
    const Vec2 step = zone.surfaces[s].polygon.size_m() * kCellsPerTile / Vec2(grid.nu(), grid.nv());
    std::map<std::pair<int, int>, std::size_t> tile_at;
    for (std::size_t i = cells.first(s); i < cells.first(s + 1); ++i) {
      const GridCell& cell = cells[i];
      const std::pair at(static_cast<int>(cell.centroid.y / step.y), static_cast<int>(cell.centroid.x / step.x));
      const auto [known, is_new] = tile_at.try_emplace(at, tiles.size());
      if (is_new) tiles.push_back({{}, cell.low, cell.high});
      Tile& tile = tiles[known->second];
      tile.cells.push_back(i);
      tile.low = glm::min(tile.low, cell.low);
      tile.high = glm::max(tile.high, cell.high);
    }
  }
  return tiles;
}

Receiver tile_receiver(const Zone& zone, const Cells& cells, const Tile& tile) {
  const auto surface = cells.surface_of(tile.cells.front());
  const Frame& frame = zone.surfaces[surface].polygon.frame();
  Receiver region{&frame, {}, static_cast<int>(surface), 0};
  for (const Vec2& p : {tile.low, Vec2(tile.high.x, tile.low.y), tile.high, Vec2(tile.low.x, tile.high.y)})
    region.ring.add(frame.to_world(p));
  return region;
}

}  // namespace

Receiver cell_receiver(const Zone& zone, const Cells& cells, std::size_t cell) {
  const auto surface = cells.surface_of(cell);
  const Frame& frame = zone.surfaces[surface].polygon.frame();
  Receiver receiver{&frame, {}, static_cast<int>(surface), cell_key(zone, cells, cell)};
  Ring2 corners;
  cells.outline(cell, corners);
  for (const Vec2& p : corners) receiver.ring.add(frame.to_world(p));
  return receiver;
}

std::vector<PairIntegrator> make_integrators(const Zone& zone, const std::vector<LightSource>& sources,
                                             const Obstructions& obstructions, const PairOptions& options) {
  std::vector<PairIntegrator> integrators;
  integrators.reserve(sources.size());
  for (const auto& source : sources) {
    PairOptions own = options;
    own.typical_lx = obstructions.typical_lx(source.original);
    integrators.emplace_back(zone, obstructions.caster(), obstructions.shadows(), source, own);
  }
  return integrators;
}

void direct_light(const Zone& zone, const Cells& cells, const std::vector<PairIntegrator>& integrators,
                  const DirectSink& on_cell, const DirectSink& on_point, const Job& job) {
  const auto scaled = [&](DirectEstimate direct, std::size_t e) {
    const double factor = integrators[e].source().luminaire.factor;
    return DirectEstimate{factor * direct.lx, factor * factor * direct.variance_lx2};
  };
  const auto tiles = make_tiles(zone, cells);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size(), 1), [&](const auto& range) {
    for (std::size_t t = range.begin(); t != range.end(); ++t) {
      const Receiver region = tile_receiver(zone, cells, tiles[t]);
      std::vector<PlatesBetween> between(integrators.size(), PlatesBetween{region});
      for (const std::size_t i : tiles[t].cells) {
        if (job.stopped()) return;
        const Receiver receiver = cell_receiver(zone, cells, i);
        for (std::size_t e = 0; e < integrators.size(); ++e)
          on_cell(i, e, scaled(integrators[e].mean(receiver, between[e]), e));
      }
    }
  });
  job.check();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, zone.points.size(), 4), [&](const auto& range) {
    if (job.stopped()) return;
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Frame frame = frame_at(zone.points[i]);
      const Receiver receiver = point_receiver(frame, -1, point_key(zone, i), zone.points[i].quantity);
      for (std::size_t e = 0; e < integrators.size(); ++e)
        on_point(i, e, scaled(integrators[e].mean(receiver), e));
    }
  });
  job.check();
}

DirectLight direct_light(const Zone& zone, const Cells& cells, const Lights& lights,
                         const std::vector<std::size_t>& source_of, std::size_t n_sources, const Job& job) {
  const Obstructions obstructions(zone, lights);
  DirectLight result;
  result.cell_lx.assign(cells.size() * n_sources, 0.0);
  result.point_lx.assign(zone.points.size() * n_sources, 0.0);
  const auto add_to = [&](std::vector<double>& sums) {
    return [&](std::size_t i, std::size_t e, const DirectEstimate& direct) {
      sums[i * n_sources + source_of[e]] += direct.lx;
    };
  };
  const auto sources = own_sources(zone, lights);
  direct_light(zone, cells, make_integrators(zone, sources, obstructions), add_to(result.cell_lx),
               add_to(result.point_lx), job);
  return result;
}

}  // namespace dim
