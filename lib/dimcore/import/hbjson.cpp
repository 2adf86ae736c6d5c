#include "import/hbjson.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "import/honeybee_luminaires.hpp"
#include "import/honeybee_modifiers.hpp"
#include "import/json_node.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {
namespace {

double unit_of(const JsonNode& root) {
  const std::string name = root.text("units", "Meters");
  if (name == "Meters") return 1.0;
  if (name == "Millimeters") return 0.001;
  if (name == "Centimeters") return 0.01;
  if (name == "Feet") return 0.3048;
  if (name == "Inches") return 0.0254;
  root["units"].fail(fmt::format("is {}, no unit that is known", dim::quoted(name)));
}

Ring3 ring_of(const JsonNode& points) {
  Ring3 ring;
  for (std::size_t i = 0; i < points.size(); ++i) ring.push_back(points.at(i).vec3());
  return ring;
}

bool is_between_rooms(const JsonNode& object) {
  return object.has("boundary_condition") && object["boundary_condition"].text("type", "") == "Surface";
}

bool is_inner(const JsonNode& object) {
  const bool is_adiabatic =
      object.has("boundary_condition") && object["boundary_condition"].text("type", "") == "Adiabatic";
  return is_adiabatic || is_between_rooms(object);
}

class HoneybeeReader {
 public:
  HoneybeeReader(const ImportInput& input, const JsonNode& root)
      : input_(input),
        root_(root),
        radiance_(has_radiance(root) ? std::optional(radiance_of(root)) : std::nullopt),
        modifiers_(radiance_ ? &*radiance_ : nullptr, input, model_, unknowns_),
        counter_(input) {}

  ImportedModel run() {
    if (root_.text("type", "") != "Model") root_.fail("is no Honeybee model: its type is not \"Model\"");
    model_.format = "HBJSON";
    model_.unit_m = unit_of(root_);
    model_.up_stated = true;
    for_each(root_, "rooms", [&](const JsonNode& room) { this->room(room); });
    const Owner outdoors{"", "", false};
    for_each(root_, "orphaned_faces", [&](const JsonNode& face) { this->face(face, outdoors); });
    for (const char* key : {"orphaned_apertures", "orphaned_doors"})
      for_each(root_, key, [&](const JsonNode& part) { opening(part, outdoors, ""); });
    shades(root_, "orphaned_shades", outdoors);
    for_each(root_, "shade_meshes", [&](const JsonNode& mesh) { shade_mesh(mesh); });
    if (radiance_) radiance_parts();
    unknowns_.tell(model_.warnings);
    return std::move(model_);
  }

 private:
  /// What surfaces belong to.
  struct Owner {
    std::string room, modifier_set;
    bool is_indoors = true;
  };

  template <class Function>
  static void for_each(const JsonNode& node, const char* key, Function&& f) {
    for (std::size_t i = 0; i < node.count(key); ++i) f(node[key].at(i));
  }

  void room(const JsonNode& room) {
    const Owner owner{room["identifier"].text(), honeybee_modifier_set(room), true};
    for_each(room, "faces", [&](const JsonNode& face) { this->face(face, owner); });
    shades(room, "indoor_shades", owner);
    shades(room, "outdoor_shades", {"", owner.modifier_set, false});
  }

  static HoneybeeUse use_of_face(const JsonNode& face, const std::string& type) {
    const std::string set = type == "Floor"         ? "floor_set"
                            : type == "RoofCeiling" ? "roof_ceiling_set"
                                                    : "wall_set";
    return {set, is_inner(face) ? "interior_modifier" : "exterior_modifier"};
  }

  void face(const JsonNode& face, const Owner& owner) {
    const std::string name = face["identifier"].text(), type = face.text("face_type", "Wall");
    for (const char* key : {"indoor_shades", "outdoor_shades"})
      shades(face, key,
             {owner.room, owner.modifier_set, std::string(key) == "indoor_shades" && owner.is_indoors});
    if (type == "AirBoundary") {
      unknowns_.add("air boundaries are left open", input_.place(0));
      add_open(face, owner);
      return;
    }
    ImportedFace surface =
        surface_of(face, owner, modifiers_.of(face, owner.modifier_set, use_of_face(face, type)));
    for (const char* key : {"apertures", "doors"})
      for_each(face, key, [&](const JsonNode& part) {
        if (is_between_rooms(part) && is_glass(part, key)) {
          surface.holes.push_back(ring_of(part["geometry"]["boundary"]));
          add_open(part, owner);
          unknowns_.add("glass between two rooms is left open", input_.place(0),
                        "DIM's windows look outside; make it a room's own model if its glass matters");
        }
      });
    model_.faces.push_back(std::move(surface));
    for (const char* key : {"apertures", "doors"})
      for_each(face, key, [&](const JsonNode& part) {
        if (!is_between_rooms(part) || !is_glass(part, key)) opening(part, owner, name);
      });
  }

  void add_open(const JsonNode& object, const Owner& owner) {
    ImportedFace opening = surface_of(object, owner, 0);
    opening.lit = Lit::open;
    model_.faces.push_back(std::move(opening));
  }

  static bool is_glass(const JsonNode& part, const std::string& key) {
    return key == "apertures" || part.flag("is_glass", false);
  }

  void opening(const JsonNode& part, const Owner& owner, const std::string& parent) {
    const bool is_door = part.text("type", "Aperture") == "Door", inner = is_inner(part);
    HoneybeeUse use{"aperture_set", inner                             ? "interior_modifier"
                                    : part.flag("is_operable", false) ? "operable_modifier"
                                                                      : "window_modifier"};
    if (is_door) {
      use.set = "door_set";
      use.role = inner ? "interior_modifier" : "exterior_modifier";
      if (part.flag("is_glass", false))
        use.role = inner ? "interior_glass_modifier" : "exterior_glass_modifier";
    }
    ImportedFace surface = surface_of(part, owner, modifiers_.of(part, owner.modifier_set, use));
    surface.on = parent;
    model_.faces.push_back(std::move(surface));
    for (const char* key : {"indoor_shades", "outdoor_shades"})
      shades(part, key,
             {owner.room, owner.modifier_set, std::string(key) == "indoor_shades" && owner.is_indoors});
  }

  /// Honeybee's faces look out of their room.
  ImportedFace surface_of(const JsonNode& object, const Owner& owner, int material) {
    const JsonNode geometry = object["geometry"];
    ImportedFace surface;
    surface.outline = ring_of(geometry["boundary"]);
    counter_.add(surface.outline.size());
    if (owner.is_indoors) std::reverse(surface.outline.begin(), surface.outline.end());
    for_each(geometry, "holes", [&](const JsonNode& hole) { surface.holes.push_back(ring_of(hole)); });
    surface.name = object["identifier"].text();
    surface.room = owner.room;
    surface.material = material;
    surface.lit = owner.is_indoors ? Lit::front : Lit::outside_sheet;
    return surface;
  }

  void shades(const JsonNode& parent, const char* key, const Owner& owner) {
    for_each(parent, key, [&](const JsonNode& shade) {
      const HoneybeeUse use{"shade_set", owner.is_indoors ? "interior_modifier" : "exterior_modifier"};
      ImportedFace surface = surface_of(shade, owner, modifiers_.of(shade, owner.modifier_set, use));
      surface.lit = owner.is_indoors ? Lit::both : Lit::outside_sheet;
      surface.room.clear();
      model_.faces.push_back(std::move(surface));
    });
  }

  void shade_mesh(const JsonNode& mesh) {
    const int material = modifiers_.of(mesh, "", {"shade_set", "exterior_modifier"});
    const JsonNode geometry = mesh["geometry"];
    const Ring3 vertices = ring_of(geometry["vertices"]);
    for_each(geometry, "faces", [&](const JsonNode& corners) {
      ImportedFace face;
      counter_.add(corners.size());
      for (std::size_t i = 0; i < corners.size(); ++i)
        face.outline.push_back(vertices[corners.at(i).index(vertices.size())]);
      face.name = mesh["identifier"].text();
      face.material = material;
      face.lit = Lit::outside_sheet;
      model_.faces.push_back(std::move(face));
    });
  }

  void radiance_parts() {
    for_each(*radiance_, "sensor_grids", [&](const JsonNode& grid) {
      ImportedSensors sensors;
      sensors.name = grid.text("display_name", grid["identifier"].text());
      for_each(grid, "sensors", [&](const JsonNode& sensor) {
        sensors.positions.push_back(sensor["pos"].vec3());
        sensors.normals.push_back(sensor["dir"].vec3());
        if (!(glm::length(sensors.normals.back()) > 0.0)) sensor["dir"].fail("has no length");
      });
      if (!sensors.positions.empty()) model_.sensors.push_back(std::move(sensors));
    });
    for_each(*radiance_, "luminaires", [&](const JsonNode& luminaire) {
      add_honeybee_luminaire(luminaire, model_, unknowns_, input_);
    });
    if (radiance_->count("views") > 0) unknowns_.add("views are not read", input_.place(0));
  }

  const ImportInput& input_;
  JsonNode root_;
  std::optional<JsonNode> radiance_;
  ImportedModel model_;
  Unknowns unknowns_;
  HoneybeeModifiers modifiers_;
  FaceCounter counter_;
};

}  // namespace

ImportedModel read_hbjson(const ImportInput& input) {
  const nlohmann::json json = parse_json_input(input.bytes, input);
  return HoneybeeReader(input, JsonNode(json, input)).run();
}

}  // namespace dim
