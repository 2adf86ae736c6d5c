#include "network/with_bodies.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "hemisphere/patch_mask.hpp"
#include "network/balance.hpp"
#include "network/family.hpp"
#include "network/landing.hpp"
#include "network/lying_bodies.hpp"
#include "network/ray_pattern.hpp"
#include "scene/luminaire_body.hpp"

namespace dim {
namespace {

// By how much the fates of rays change.
struct Counts {
  std::int64_t escaped = 0;
  std::int64_t back = 0;

  void add(const Landing& landing, int n) {
    escaped += landing.escaped ? n : 0;
    back += landing.back ? n : 0;
  }
  void add(const Counts& counts, int n) {
    escaped += n * counts.escaped;
    back += n * counts.back;
  }
};

struct Ball {
  Vec3 middle{0.0};
  double radius_m = 0.0;
};

Ball ball_round(const Surface& surface) {
  Ball ball{surface.polygon.centroid(), 0.0};
  for (const auto& ring : surface.polygon.corners())
    for (const auto& p : ring) ball.radius_m = std::max(ball.radius_m, glm::length(p - ball.middle));
  return ball;
}

bool reaches_before(const Surface& surface, const Frame& plane) {
  const auto corners = surface.polygon.corners();
  return std::any_of(corners.begin(), corners.end(), [&](const Ring3& ring) {
    return std::any_of(ring.begin(), ring.end(), [&](const Vec3& p) { return plane.height(p) > 0.0; });
  });
}

// The rays of a zone's network among bodies.
class RayMeetsBodies {
 public:
  // `room` has its zone and cells; `cells` and `network` are those without bodies.
  RayMeetsBodies(const BodiedRoom& room, const Cells& cells, const Network& network, std::size_t n_surfaces)
      : room_(room),
        cells_(cells),
        network_(network),
        n_surfaces_(n_surfaces),
        own_(plates_of(std::span(room.zone.surfaces).first(n_surfaces)), room.zone.diameter_m),
        bodies_(plates_of(std::span(room.zone.surfaces).subspan(n_surfaces)), room.zone.diameter_m) {
    for (std::size_t s = n_surfaces; s < room.zone.surfaces.size(); ++s) {
      // The two sides of a panel have one place.
      if (room.zone.surfaces[s].twin >= 0 && static_cast<std::size_t>(room.zone.surfaces[s].twin) < s)
        continue;
      faces_.push_back(s);
      balls_.push_back(ball_round(room.zone.surfaces[s]));
    }
    for (std::size_t s = 0; s < n_surfaces; ++s) before_.push_back(faces_before(s));
  }

  // Sinks of a zone cell's row.
  Counts cell_row(std::size_t cell, SinkTable& sinks) const {
    if (room_.cells.free_part(cell) != nullptr) {
      Counts counts = new_row(cell, sinks);
      counts.add(without_bodies(cell), -1);
      return counts;
    }
    const std::size_t surface = cells_.surface_of(cell);
    PatchMask mask(network_.patches);
    if (!before_[surface].empty()) {
      const Frame& frame = room_.zone.surfaces[surface].polygon.frame();
      const GridCell& square = cells_[cell];
      const Vec3 middle = frame.to_world((square.low + square.high) / 2.0);
      const double radius_m = glm::length(square.high - square.low) / 2.0;
      for (const std::size_t face : before_[surface]) mark(mask, frame, middle, radius_m, face);
    }
    return row(RowRays(room_.zone, cells_, cell, network_.sampling, network_.seed), network_.patches, mask,
               network_.sinks, cell, sinks);
  }

  // Sinks of a measuring point's row.
  Counts point_row(std::size_t point, SinkTable& sinks) const {
    const RowRays rays(room_.zone, point, network_.sampling, network_.seed);
    PatchMask mask(network_.point_patches);
    for (std::size_t face = 0; face < faces_.size(); ++face)
      mark(mask, rays.frame(), rays.frame().origin, 0.0, face);
    return row(rays, network_.point_patches, mask, network_.point_sinks, point, sinks);
  }

  // Sinks of a body cell's row, or of a zone cell that bodies lie on: its rays start elsewhere.
  Counts new_row(std::size_t cell, SinkTable& sinks) const {
    const RowRays rays(room_.zone, room_.cells, cell, network_.sampling, network_.seed);
    const int body = std::max(rays.skip() - static_cast<int>(n_surfaces_), -1);
    const int own = body < 0 ? rays.skip() : -1;
    Counts counts;
    for (std::size_t patch = 0; patch < network_.patches.n_patches(); ++patch) {
      const Ray ray = rays.ray(network_.patches, patch);
      const Hit hit = own_.nearest(ray.from, ray.direction, own);
      const Hit on_body = bodies_.nearest(ray.from, ray.direction, body);
      const bool meets_body = on_body.plate >= 0 && (hit.plate < 0 || on_body.t < hit.t);
      const Landing landing = meets_body ? on_a_body(on_body, ray.direction)
                                         : landing_of(hit, ray.direction, room_.zone, room_.cells);
      counts.add(landing, 1);
      const bool beneath = body >= 0 && !meets_body && is_beneath_body(landing, hit);
      sinks.set(cell, patch, beneath ? static_cast<std::uint32_t>(cell) : landing.sink);
    }
    return counts;
  }

 private:
  // Whether a ray ends on the covered part of a cell. That part does not see the body, and so the body must not
  // see it: what little light there is between them stays with the body.
  bool is_beneath_body(const Landing& landing, const Hit& hit) const {
    if (landing.sink >= cells_.size() || room_.cells.free_part(landing.sink) == nullptr) return false;
    const Surface& surface = room_.zone.surfaces[static_cast<std::size_t>(hit.plate)];
    const Frame& plane = surface.polygon.frame();
    const Hit above = bodies_.nearest(plane.to_world(hit.local), plane.n);
    return above.plate >= 0 && above.t <= lies_within_m(surface);
  }

  // What a cell's row counted before there were bodies.
  Counts without_bodies(std::size_t cell) const {
    const RowRays rays(room_.zone, cells_, cell, network_.sampling, network_.seed);
    Counts counts;
    for (std::size_t patch = 0; patch < network_.patches.n_patches(); ++patch) {
      const Ray ray = rays.ray(network_.patches, patch);
      counts.add(landing_of(own_.nearest(ray.from, ray.direction, rays.skip()), ray.direction, room_.zone, cells_),
                 1);
    }
    return counts;
  }

  std::vector<std::size_t> faces_before(std::size_t surface) const {
    std::vector<std::size_t> before;
    for (std::size_t face = 0; face < faces_.size(); ++face) {
      if (reaches_before(room_.zone.surfaces[faces_[face]], room_.zone.surfaces[surface].polygon.frame()))
        before.push_back(face);
    }
    return before;
  }

  // Rays start within `radius_m` of `middle`.
  void mark(PatchMask& mask, const Frame& frame, const Vec3& middle, double radius_m,
            std::size_t face) const {
    const Ball& ball = balls_[face];
    mask.mark_cone(frame.direction_to_local(ball.middle - middle), ball.radius_m + radius_m);
  }

  Counts row(const RowRays& rays, const PatchGrid& patches, const PatchMask& mask, const SinkTable& from,
             std::size_t row, SinkTable& to) const {
    const auto nothing = static_cast<std::uint32_t>(room_.cells.size());
    Counts counts;
    std::size_t patch = 0;
    for (int slice = 0; slice < patches.n_slices; ++slice) {
      const PatchSlice directions(patches, slice);
      for (int sector = 0; sector < patches.n_sectors; ++sector, ++patch) {
        const std::size_t sink = from.at(row, patch);
        std::uint32_t now = sink < cells_.size() ? static_cast<std::uint32_t>(sink) : nothing;
        if (mask[patch]) meet(rays.ray(patches, directions, slice, sector), rays.skip(), sink, now, counts);
        to.set(row, patch, now);
      }
    }
    return counts;
  }

  // Changes `now` where the ray, which ends on `sink` without bodies, meets one on its way.
  void meet(const Ray& ray, int skip, std::size_t sink, std::uint32_t& now, Counts& counts) const {
    const Hit hit = bodies_.nearest(ray.from, ray.direction);
    if (hit.plate < 0) return;
    if (sink < cells_.size()) {
      if (!(hit.t < distance_to(ray, sink))) return;
    } else {
      // Rays that end nowhere may have met a back before.
      const Hit before = own_.nearest(ray.from, ray.direction, skip);
      if (before.plate >= 0 && !(hit.t < before.t)) return;
      counts.add(landing_of(before, ray.direction, room_.zone, room_.cells), -1);
    }
    const Landing landing = on_a_body(hit, ray.direction);
    counts.add(landing, 1);
    now = landing.sink;
  }

  // As the ray caster has it.
  double distance_to(const Ray& ray, std::size_t cell) const {
    const Frame& plane = room_.zone.surfaces[cells_.surface_of(cell)].polygon.frame();
    return (glm::dot(plane.n, plane.origin) - glm::dot(plane.n, ray.from)) / glm::dot(plane.n, ray.direction);
  }

  Landing on_a_body(Hit hit, const Vec3& direction) const {
    hit.plate += static_cast<int>(n_surfaces_);
    return landing_of(hit, direction, room_.zone, room_.cells);
  }

  const BodiedRoom& room_;
  const Cells& cells_;
  const Network& network_;
  std::size_t n_surfaces_;
  RayCaster own_, bodies_;
  std::vector<std::size_t> faces_;                // surfaces of bodies, twins once
  std::vector<Ball> balls_;                       // [faces_]
  std::vector<std::vector<std::size_t>> before_;  // [surface] indices into faces_
};

template <class RowFunction>
Counts for_rows(std::size_t first, std::size_t last, const Job& job, RowFunction&& f) {
  std::atomic<std::int64_t> escaped{0}, back{0};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(first, last, 16), [&](const auto& rows) {
    for (std::size_t row = rows.begin(); row != rows.end() && !job.stopped(); ++row) {
      const Counts counts = f(row);
      escaped += counts.escaped;
      back += counts.back;
    }
  });
  job.check();
  return {escaped, back};
}

void trace(BodiedRoom& room, const Zone& zone, const Cells& cells, const Network& network, const Job& job) {
  const RayMeetsBodies meets(room, cells, network, zone.surfaces.size());
  Network& result = room.network;
  const Counts old_rows =
      for_rows(0, cells.size(), job, [&](std::size_t row) { return meets.cell_row(row, result.sinks); });
  const Counts new_rows = for_rows(cells.size(), room.cells.size(), job,
                                   [&](std::size_t row) { return meets.new_row(row, result.sinks); });
  const auto changed = [](std::uint64_t n, std::int64_t by) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(n) + by);
  };
  result.n_escaped_rays = changed(network.n_escaped_rays, old_rows.escaped + new_rows.escaped);
  result.n_back_rays = changed(network.n_back_rays, old_rows.back + new_rows.back);
  result.point_back_fraction.resize(zone.points.size());
  const auto n_patches = static_cast<double>(network.point_patches.n_patches());
  for_rows(0, zone.points.size(), job, [&](std::size_t point) {
    const Counts counts = meets.point_row(point, result.point_sinks);
    const double n_back = std::round(network.point_back_fraction[point] * n_patches);
    result.point_back_fraction[point] = (n_back + static_cast<double>(counts.back)) / n_patches;
    return counts;
  });
}

// The size that the zone's cells have on the average.
double mean_cell_m(const Cells& cells) {
  double area_m2 = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) area_m2 += cells.area_m2(i);
  return std::sqrt(area_m2 / static_cast<double>(cells.size()));
}

void check_size(const Network& network, std::size_t n_cells, const Job& job) {
  constexpr double kGiB = 1024.0 * 1024.0 * 1024.0;
  const std::size_t n_rays = n_cells * network.patches.n_patches() + network.point_sinks.n_rays();
  const std::size_t needed = n_rays * (SinkTable::is_wide(n_cells) ? 4 : 2);
  if (needed <= job.memory_limit_bytes) return;
  throw LimitError(
      fmt::format("the ray network with the luminaires' bodies needs {:.2f} GiB beside the one without, "
                  "{:.2f} GiB are free; use a larger --cell, fewer --patches or no 'body'",
                  static_cast<double>(needed) / kGiB, static_cast<double>(job.memory_limit_bytes) / kGiB));
}

}  // namespace

std::optional<BodiedRoom> add_bodies(const Zone& zone, const Cells& cells, const Network& network,
                                     const Lights& lights, const Job& job) {
  const std::size_t n_bodies = count_bodies(lights);
  if (n_bodies == 0) return std::nullopt;
  Zone full = with_bodies(zone, lights, mean_cell_m(cells));
  Cells all(cells, full);
  check_size(network, all.size(), job);
  leave_free_of_bodies(all, full, zone.surfaces.size());
  BodiedRoom room{std::move(full), std::move(all), {}, lights, cells.size(), n_bodies};
  for (auto& luminaire : room.lights.luminaires) luminaire.body = false;
  room.network.patches = network.patches;
  room.network.point_patches = network.point_patches;
  room.network.sampling = network.sampling;
  room.network.seed = network.seed;
  room.network.sinks = SinkTable(room.cells.size(), network.patches.n_patches(), room.cells.size());
  room.network.point_sinks =
      SinkTable(zone.points.size(), network.point_patches.n_patches(), room.cells.size());
  trace(room, zone, cells, network, job);
  if (network.has_family()) room.network.extra = find_families(room.zone, room.cells, room.network, job);
  balance(room.network, room.cells);
  return room;
}

}  // namespace dim
