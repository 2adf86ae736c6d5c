#include "scene/room_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace dim {
namespace {

struct Side {
  const char* box_face;  ///< the face of a box that this side of the room is the inside of
  const char* name;
  const char* finish;
};
constexpr std::array<Side, 6> kSides = {{{".bottom", "floor", "floor"},
                                         {".top", "ceiling", "ceiling"},
                                         {".south", "wall-s", "walls"},
                                         {".north", "wall-n", "walls"},
                                         {".west", "wall-w", "walls"},
                                         {".east", "wall-e", "walls"}}};

}  // namespace

std::optional<Shape> read_room(const TomlTable& table) {
  bool complete = true;
  for (const char* key : {"size", "height", "floor", "walls", "ceiling"}) complete &= table.require(key);
  const auto name = table.name();
  const auto size = table.numbers("size", 2, kLength);
  const auto height = table.number("height", kLength);
  const auto corner = table.vec3("corner");
  const double turn_deg = table.number_or("turn", kAnyNumber, 0.0);
  const auto cell = table.number("cell", kLength);
  std::map<std::string, std::string> finishes;
  for (const auto& side : kSides)
    for (const char* key : {side.finish, side.name})
      if (const auto finish = table.name(key)) finishes[key] = *finish;
  table.refuse_unknown();
  if (!complete || !size || !height || (table.has("corner") && !corner) || (table.has("name") && !name))
    return std::nullopt;
  const std::string prefix = name ? *name + "." : "";
  Shape shape{name.value_or(""), {}};
  const auto box = box_faces("", corner.value_or(Vec3(0.0)), {(*size)[0], (*size)[1], *height}, turn_deg);
  for (const auto& side : kSides) {
    for (const auto& face : box) {
      if (face.name != side.box_face) continue;
      FaceSource inside = face;
      std::reverse(inside.outline.begin(), inside.outline.end());
      inside.name = prefix + side.name;
      inside.of_box = false;
      const char* key = finishes.contains(side.name) ? side.name : side.finish;
      inside.finish = finishes[key];
      inside.finish_place = table.place(key);
      inside.place = table.has("name") ? table.place("name") : table.place();
      inside.vertices_place = table.place("size");
      inside.cell = cell;
      shape.faces.push_back(std::move(inside));
    }
  }
  return shape;
}

}  // namespace dim
