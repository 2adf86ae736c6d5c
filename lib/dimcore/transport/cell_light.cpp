#include "transport/cell_light.hpp"

#include "light/direct_light.hpp"

namespace dim {
namespace {

constexpr std::uint64_t kMostTries = 256;  // until a path is found

}  // namespace

Vec3 middle_of(const Room& room, std::size_t cell) {
  return room.surface_of(cell).polygon.frame().to_world(room.cells[cell].centroid);
}

std::vector<PairIntegrator::Path> paths_of(const Room& room, const CellLight& light, int n) {
  const Receiver receiver = cell_receiver(room.zone, room.cells, light.cell);
  const LowDiscrepancy4 chance(receiver.stream ^ light.source().stream);
  const auto wanted = static_cast<std::uint64_t>(n);
  std::vector<PairIntegrator::Path> paths;
  double total = 0.0;
  for (std::uint64_t i = 0; i < wanted || (i < kMostTries && !(total > 0.0)); ++i) {
    const auto path = light.integrator->path(receiver, chance(i));
    if (i >= wanted && !(path.lx > 0.0)) continue;
    paths.push_back(path);
    total += path.lx;
  }
  if (!(total > 0.0)) {
    const Vec3 at = middle_of(room, light.cell), normal = receiver.frame->n;
    const Vec3 towards = glm::normalize(light.source().luminaire.at - at);
    return {{at, glm::dot(towards, normal) > 0.0 ? towards : normal, 1.0}};
  }
  for (auto& path : paths) path.lx /= total;
  return paths;
}

std::vector<double> tints_of(const Zone& zone, const ReflectanceClasses& classes, const LightSource& source,
                             const Vec3& receiver) {
  std::vector<double> tints(classes.size(), 1.0);
  tint_by_mirrors(zone, source, glm::normalize(source.luminaire.at - receiver), tints,
                  [&](std::size_t q, int finish) -> const BandReflection& { return classes.at(q, finish); });
  return tints;
}

}  // namespace dim
