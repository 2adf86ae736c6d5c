#include "scene/openings.hpp"

#include <algorithm>
#include <optional>

#include "scene/zone_shell.hpp"

namespace dim {
namespace {

// Takes the loop that the first edge begins out of the list; nothing where it does not come back.
std::optional<Ring3> take_loop(std::vector<LeakingEdge>& edges, double touch_m) {
  Ring3 loop{edges.front().from};
  Vec3 end = edges.front().to;
  edges.erase(edges.begin());
  while (glm::length(end - loop.front()) > touch_m) {
    const auto next = std::find_if(edges.begin(), edges.end(),
                                   [&](const LeakingEdge& edge) { return glm::length(edge.from - end) <= touch_m; });
    if (next == edges.end()) return std::nullopt;
    loop.push_back(next->from);
    end = next->to;
    edges.erase(next);
  }
  return loop;
}

bool is_closed_by(std::vector<Surface> surfaces, const std::vector<Polygon>& openings, double touch_m) {
  for (const auto& opening : openings) {
    Surface lid;
    lid.name = "opening";
    lid.polygon = opening;
    surfaces.push_back(std::move(lid));
  }
  Problems problems;
  Warnings warnings;
  return check_shell(surfaces, {}, touch_m, problems, warnings).closed && problems.empty();
}

}  // namespace

std::vector<Polygon> find_openings(const std::vector<Surface>& surfaces, const std::vector<LeakingEdge>& leaking,
                                   double touch_m) {
  std::vector<LeakingEdge> edges = leaking;
  std::vector<Polygon> openings;
  while (!edges.empty()) {
    auto loop = take_loop(edges, touch_m);
    if (!loop || loop->size() < 3 || planarity_error_m(*loop) > touch_m) return {};
    // What meets an edge of a consistent shell runs the other way along it.
    std::reverse(loop->begin(), loop->end());
    if (!(glm::length(newell(*loop)) > touch_m * touch_m)) return {};
    openings.emplace_back(*loop);
  }
  return is_closed_by(surfaces, openings, touch_m) ? openings : std::vector<Polygon>{};
}

}  // namespace dim
