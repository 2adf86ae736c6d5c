#include "import/placing.hpp"

#include <fmt/format.h>

#include <cmath>

#include "geometry/box_tree.hpp"
#include "scene/length_unit.hpp"

namespace dim {
namespace {

/// y up: x stays, so that plans are not mirrored.
Vec3 z_up(const Vec3& p) { return {p.x, -p.z, p.y}; }

template <class Point, class Direction>
void for_places(ImportedModel& model, Point&& point, Direction&& direction) {
  for (ImportedFace& face : model.faces) {
    for (Vec3& p : face.outline) point(p);
    for (Ring3& hole : face.holes)
      for (Vec3& p : hole) point(p);
  }
  for (ImportedLuminaire& luminaire : model.luminaires) {
    point(luminaire.at);
    direction(luminaire.aim);
    if (luminaire.c0) direction(*luminaire.c0);
  }
  for (ImportedSensors& sensors : model.sensors) {
    for (Vec3& p : sensors.positions) point(p);
    for (Vec3& n : sensors.normals) direction(n);
  }
}

Box3 box_of(const ImportedModel& model) {
  Box3 box;
  for (const ImportedFace& face : model.faces)
    for (const Vec3& p : face.outline) box.add(p);
  return box;
}

bool is_size_of_room(double diagonal_m) { return diagonal_m >= 1.0 && diagonal_m <= 500.0; }

}  // namespace

void place_model(ImportedModel& model, std::optional<double> unit_m, std::optional<UpAxis> up) {
  constexpr double kFarthest_m = 1e9;
  const double scale = unit_m.value_or(model.unit_m.value_or(1.0));
  const bool turn = up.value_or(model.up) == UpAxis::y;
  const auto direction = [&](Vec3& d) {
    if (turn) d = z_up(d);
  };
  for_places(
      model,
      [&](Vec3& p) {
        direction(p);
        p *= scale;
        if (!is_finite(p) || std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > kFarthest_m)
          throw InputError({{},
                            fmt::format("a corner at {:g}, {:g}, {:g} m", p.x, p.y, p.z),
                            "coordinates must be finite and within 1e9 m; is the unit right?"});
      },
      direction);
  for (ImportedLuminaire& luminaire : model.luminaires) {
    luminaire.lumens *= scale * scale;
    if (luminaire.opening)
      for (double& length : *luminaire.opening) length *= scale;
  }
}

void warn_of_improbable_size(const ImportedModel& model, double unit_m, Warnings& warnings) {
  if (model.faces.empty()) return;
  const Box3 box = box_of(model);
  const Vec3 size_m = box.high - box.low;
  const double diagonal_m = glm::length(size_m);
  if (is_size_of_room(diagonal_m)) return;
  std::string cure = "give --unit, the length of one unit of the file: mm, cm, m, in or ft";
  for (const LengthUnit& unit : kLengthUnits)
    if (is_size_of_room(diagonal_m / unit_m * unit.metres)) {
      const Vec3 in_unit = size_m / unit_m * unit.metres;
      cure = fmt::format("--unit {} makes it {:.3g} x {:.3g} x {:.3g} m", unit.name, in_unit.x, in_unit.y,
                         in_unit.z);
      break;
    }
  warnings.push_back(
      {{},
       fmt::format("the model is {:.3g} x {:.3g} x {:.3g} m: hardly a room", size_m.x, size_m.y, size_m.z),
       cure});
}

}  // namespace dim
