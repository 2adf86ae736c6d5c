#include "scene/face_source.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "database/toml_reader.hpp"
#include "scene/room_source.hpp"
#include "scene/shape_copy.hpp"

namespace dim {
namespace {

// Names of shapes seen so far, each with its place, shared by surfaces, boxes and copies.
class Names {
 public:
  explicit Names(Problems& problems) : problems_(problems) {}

  void add(const std::string& name, const Place& place) {
    const auto [it, added] = places_.emplace(name, place);
    if (!added)
      problems_.add(place,
                    fmt::format("the name '{}' is used twice, first at line {}", name, it->second.line),
                    "give each surface, box and copy its own name");
  }

 private:
  Problems& problems_;
  std::map<std::string, Place> places_;
};

void read_cells(const TomlTable& table, FaceSource& face) {
  face.cell = table.number("cell", kLength);
  face.grid = table.integers2("grid", 1, kMaxGrid);
}

// group, and states = { blind = "blind-white-45", open = "glass-clear-6" }
void read_window_keys(const TomlTable& table, FaceSource& face) {
  if (const auto group = table.name("group")) face.group = *group;
  const auto states = table.table("states", table.label() + ", states");
  if (!states) return;
  for (const auto& [key, value] : states->raw()) {
    const std::string_view name = key.str();
    if (const auto finish = states->name(name))
      face.states.push_back({std::string(name), *finish, states->place(name)});
  }
  if (states->raw().empty()) table.problem("states", "states is empty", "write states = { blind = \"FINISH\" }");
}

std::optional<Shape> read_surface(const TomlTable& table) {
  Shape shape;
  FaceSource face;
  const bool complete =
      int(table.require("name")) & int(table.require("finish")) & int(table.require("vertices"));
  const auto name = table.name();
  const auto finish = table.name("finish");
  const auto outline = table.ring("vertices");
  const auto holes = table.rings("holes");
  const auto on = table.name("on");
  const auto sides = table.integer("sides", 1, 2);
  face.outside = table.flag("outside", false);
  read_cells(table, face);
  read_window_keys(table, face);
  table.refuse_unknown();
  if (!complete || !name || !finish || !outline) return std::nullopt;
  face.name = *name;
  face.finish = *finish;
  face.outline = *outline;
  if (holes) face.holes = *holes;
  if (on) face.on = *on;
  face.two_sided = sides == 2;
  face.place = table.place("name");
  face.vertices_place = table.place("vertices");
  face.finish_place = table.place("finish");
  face.on_place = table.place("on");
  if (on && face.two_sided)
    table.problem("sides", "a feature on a parent has one side", "leave out sides, or on");
  if (on && face.outside) table.problem("outside", "an external obstruction lies on no parent");
  shape.name = *name;
  shape.faces.push_back(std::move(face));
  return shape;
}

std::optional<Shape> read_box(const TomlTable& table) {
  const bool complete = int(table.require("name")) & int(table.require("finish")) &
                        int(table.require("corner")) & int(table.require("size"));
  const auto name = table.name();
  const auto finish = table.name("finish");
  const auto corner = table.vec3("corner");
  const auto size = table.vec3("size", kLength);
  const auto turn = table.number("turn", kAnyNumber);
  FaceSource common;
  common.outside = table.flag("outside", false);
  common.cell = table.number("cell", kLength);
  table.refuse_unknown();
  if (!complete || !name || !finish || !corner || !size) return std::nullopt;
  Shape shape{*name, box_faces(*name, *corner, *size, turn.value_or(0.0))};
  for (auto& face : shape.faces) {
    face.finish = *finish;
    face.outside = common.outside;
    face.cell = common.cell;
    face.place = table.place("name");
    face.vertices_place = table.place("size");
    face.finish_place = table.place("finish");
  }
  return shape;
}

class FaceReader {
 public:
  explicit FaceReader(const TomlTable& root) : root_(root), names_(root.context().problems) {}

  std::vector<FaceSource> read() {
    for (const auto& table : root_.tables("room")) add(read_room(table));
    for (const auto& table : root_.tables("surface")) add(read_surface(table));
    for (const auto& table : root_.tables("box")) add(read_box(table));
    for (const auto& table : root_.tables("copy")) read_copy(table);
    std::vector<FaceSource> faces;
    for (auto& shape : shapes_)
      for (auto& face : shape.faces) faces.push_back(std::move(face));
    return faces;
  }

 private:
  void add(std::optional<Shape> shape) {
    if (!shape) return;
    n_faces_ += shape->faces.size();
    if (n_faces_ > kMaxSurfaces)
      throw InputError({shape->faces[0].place,
                        fmt::format("'{}' is one too many: a zone has at most {} surfaces, six to a box",
                                    shape->name, kMaxSurfaces),
                        "leave out what is too small to matter for the light"});
    if (!shape->name.empty()) names_.add(shape->name, shape->faces[0].place);
    for (const auto& face : shape->faces) {
      if (face.name != shape->name) names_.add(face.name, face.place);
      if (face.two_sided) names_.add(face.name + ".back", face.place);
    }
    index_.emplace(shape->name, shapes_.size());
    shapes_.push_back(std::move(*shape));
  }

  bool is_written(const std::string& name) const {
    for (const char* key : {"room", "surface", "box"}) {
      for (const auto& table : root_.tables(key))
        if (table.raw()["name"].value<std::string>() == name) return true;
    }
    return false;
  }

  void read_copy(const TomlTable& given) {
    TomlTable table = given;
    const auto plan = read_copy_plan(table);
    if (!plan) return;
    std::vector<std::size_t> found;
    for (const auto& of : plan->of) {
      const auto original = index_.find(of);
      if (original != index_.end()) {
        found.push_back(original->second);
        continue;
      }
      if (is_written(of)) return;  // what is wrong with it is reported there
      std::vector<std::string> known;
      for (const auto& [name, i] : index_) known.push_back(name);
      table.problem("of",
                    plan->of_list ? fmt::format("no surface or box '{}' above", of)
                                  : "no surface or box of that name above",
                    did_you_mean(of, known));
      return;
    }
    for (const auto& place : plan->places) {
      std::vector<const Shape*> originals;  // looked up again: adding shapes moves them
      for (const std::size_t i : found) originals.push_back(&shapes_[i]);
      for (auto& copy : copied(originals, *plan, place)) add(std::move(copy));
    }
  }

  const TomlTable& root_;
  Names names_;
  std::vector<Shape> shapes_;
  std::map<std::string, std::size_t> index_;
  std::size_t n_faces_ = 0;
};

}  // namespace

std::vector<FaceSource> box_faces(const std::string& name, const Vec3& corner, const Vec3& size,
                                  double turn_deg) {
  // Quarter turns exactly, so that a turned box meets its neighbours to the last digit.
  const double quarters = turn_deg / 90.0;
  double c = std::cos(radians(turn_deg)), s = std::sin(radians(turn_deg));
  if (quarters == std::floor(quarters)) c = std::round(c), s = std::round(s);
  const Vec3 x = Vec3(c, s, 0) * size.x, y = Vec3(-s, c, 0) * size.y, z(0, 0, size.z);
  const Vec3 p000 = corner, p100 = corner + x, p010 = corner + y, p110 = corner + x + y;
  const Vec3 p001 = p000 + z, p101 = p100 + z, p011 = p010 + z, p111 = p110 + z;
  const std::array<std::pair<const char*, Ring3>, 6> faces = {{{".top", {p001, p101, p111, p011}},
                                                               {".bottom", {p000, p010, p110, p100}},
                                                               {".south", {p000, p100, p101, p001}},
                                                               {".north", {p110, p010, p011, p111}},
                                                               {".west", {p010, p000, p001, p011}},
                                                               {".east", {p100, p110, p111, p101}}}};
  std::vector<FaceSource> result;
  for (const auto& [suffix, ring] : faces) {
    FaceSource face;
    face.name = name + suffix;
    face.outline = ring;
    face.of_box = true;
    result.push_back(std::move(face));
  }
  return result;
}

std::vector<FaceSource> read_faces(const TomlTable& root) { return FaceReader(root).read(); }

}  // namespace dim
