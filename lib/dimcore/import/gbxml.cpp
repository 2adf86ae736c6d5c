#include "import/gbxml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "import/gbxml_materials.hpp"
#include "photometry/text_scanner.hpp"
#include "photometry/xml_document.hpp"

namespace dim {
namespace {

constexpr std::size_t kMostRings = 100'000;

class GbxmlReader {
 public:
  explicit GbxmlReader(const ImportInput& input)
      : input_(input), document_(input.bytes, input.name), materials_(document_, model_), counter_(input) {}

  ImportedModel run() {
    if (local_name(document_.root()) != "gbXML")
      throw InputError({input_.place(1), "is no gbXML document", ""});
    model_.format = "gbXML";
    model_.unit_m = unit();
    model_.up_stated = true;
    const auto campus = child_of(document_.root(), {"Campus"});
    for (const auto building : children_of(campus, {"Building"}))
      for (const auto space : children_of(building, {"Space"})) this->space(space);
    for (const auto surface : children_of(campus, {"Surface"})) this->surface(surface);
    for (const auto part : campus.children())
      if (part.type() == pugi::node_element && !is_read(local_name(part)))
        unknowns_.add(fmt::format("{} of the campus is not read", local_name(part)), document_.place(part));
    unknowns_.tell(model_.warnings);
    return std::move(model_);
  }

 private:
  static bool is_read(std::string_view part) {
    for (const char* known : {"Building", "Surface", "Location", "Name", "Description", "DaylightSavings"})
      if (part == known) return true;
    return false;
  }

  double unit() const {
    const std::string_view name = attribute_of(document_.root(), {"lengthUnit"});
    struct Unit {
      const char* name;
      double length_m;
    };
    static constexpr Unit kUnits[] = {{"Meters", 1.0},        {"Millimeters", 0.001}, {"Centimeters", 0.01},
                                      {"Kilometers", 1000.0}, {"Feet", 0.3048},       {"Inches", 0.0254},
                                      {"Yards", 0.9144},      {"Miles", 1609.344}};
    for (const Unit& unit : kUnits)
      if (name == unit.name) return unit.length_m;
    throw InputError({document_.place(document_.root()),
                      fmt::format("lengthUnit is {}, no unit that is known", dim::quoted(name)),
                      "Meters, Millimeters, Centimeters, Feet or Inches"});
  }

  void space(pugi::xml_node space) {
    const std::string id(attribute_of(space, {"id"}));
    std::string name = text_of(space, {"Name"});
    if (name.empty() || name_taken(name)) name = id;
    rooms_[id] = name;
    for (const auto lighting : children_of(space, {"Lighting"}))
      unknowns_.add("lighting of spaces is not read", document_.place(lighting),
                    "write luminaires in the lights file");
  }

  bool name_taken(const std::string& name) const {
    return std::any_of(rooms_.begin(), rooms_.end(), [&](const auto& room) { return room.second == name; });
  }

  Ring3 loop(pugi::xml_node loop) const {
    Ring3 ring;
    for (const auto point : children_of(loop, {"CartesianPoint"})) {
      const auto coordinates = children_of(point, {"Coordinate"});
      if (coordinates.size() != 3)
        throw InputError({document_.place(point),
                          fmt::format("a point of {} coordinates instead of 3", coordinates.size()), ""});
      Vec3 p;
      for (int i = 0; i < 3; ++i) {
        const auto node = coordinates[static_cast<std::size_t>(i)];
        p[i] = document_.number_in(node, trimmed(node.text().get()), "Coordinate", {-1e12, 1e12});
      }
      ring.push_back(p);
    }
    return ring;
  }

  Ring3 outline(pugi::xml_node object) const {
    const auto loops = children_of(child_of(object, {"PlanarGeometry"}), {"PolyLoop"});
    if (loops.empty())
      throw InputError({document_.place(object), "has no PlanarGeometry with a PolyLoop", ""});
    return loop(loops[0]);
  }

  static std::string name_of(pugi::xml_node object) {
    const std::string id(attribute_of(object, {"id"}));
    return id.empty() ? text_of(object, {"Name"}) : id;
  }

  void surface(pugi::xml_node node) {
    const std::string type(attribute_of(node, {"surfaceType"}));
    const auto adjacent = children_of(node, {"AdjacentSpaceId"});
    ImportedFace surface;
    surface.outline = outline(node);
    surface.name = name_of(node);
    if (surface.outline.size() < 3) {
      unknowns_.add("surface of fewer than three corners left out", document_.place(node));
      return;
    }
    if (adjacent.empty()) {
      surface.lit = Lit::outside_sheet;
      surface.material = materials_.of_surface(node, newell(surface.outline), true);
      add(std::move(surface));
      for (const auto opening : children_of(node, {"Opening"}))
        unknowns_.add("openings of shading surfaces are left out", document_.place(opening));
      return;
    }
    if (adjacent.size() > 2)
      unknowns_.add("a surface of more than two spaces is read for two", document_.place(node));
    // Seen from outside of the first space it runs counter-clockwise.
    for (std::size_t i = 0; i < std::min<std::size_t>(adjacent.size(), 2); ++i) {
      const auto room = rooms_.find(std::string(attribute_of(adjacent[i], {"spaceIdRef"})));
      if (room == rooms_.end())
        throw InputError({document_.place(adjacent[i]),
                          fmt::format("refers to the space {}, which is not in the file",
                                      dim::quoted(attribute_of(adjacent[i], {"spaceIdRef"}))),
                          ""});
      side_of(node, type, room->second, i == 0, adjacent.size() > 1, surface);
    }
  }

  /// @param is_outward  the outline runs counter-clockwise seen from outside the room
  void side_of(pugi::xml_node node, const std::string& type, const std::string& room, bool is_outward,
               bool is_between, ImportedFace surface) {
    const auto inwards = [&](Ring3 ring) {
      if (is_outward) std::reverse(ring.begin(), ring.end());
      return ring;
    };
    surface.room = room;
    surface.outline = inwards(std::move(surface.outline));
    surface.lit = type == "Air" ? Lit::open : Lit::front;
    if (!is_outward) surface.name += "/" + room;
    surface.material = materials_.of_surface(node, newell(surface.outline), false);
    if (type == "Air") unknowns_.add("surfaces of air are left open", document_.place(node));
    std::vector<ImportedFace> openings;
    for (const auto part : children_of(node, {"Opening"})) {
      const std::string kind(attribute_of(part, {"openingType"}));
      const bool is_door = kind == "SlidingDoor" || kind == "NonSlidingDoor";
      ImportedFace opening;
      opening.outline = inwards(outline(part));
      opening.name = name_of(part) + (is_outward ? "" : "/" + room);
      opening.room = room;
      opening.lit = Lit::front;
      opening.on = surface.name;
      opening.material = materials_.of_opening(part, is_door);
      if (kind == "Air" || (is_between && !is_door)) {
        if (surface.holes.size() < kMostRings) surface.holes.push_back(opening.outline);
        opening.lit = Lit::open;
        opening.on.clear();
        unknowns_.add(
            kind == "Air" ? "openings of air are left open" : "glass between two spaces is left open",
            document_.place(part));
      }
      openings.push_back(std::move(opening));
    }
    add(std::move(surface));
    for (ImportedFace& opening : openings) add(std::move(opening));
  }

  void add(ImportedFace face) {
    counter_.add(face.outline.size());
    model_.faces.push_back(std::move(face));
  }

  const ImportInput& input_;
  XmlDocument document_;
  ImportedModel model_;
  GbxmlMaterials materials_;
  FaceCounter counter_;
  Unknowns unknowns_;
  std::unordered_map<std::string, std::string> rooms_;  ///< id → name
};

}  // namespace

ImportedModel read_gbxml(const ImportInput& input) { return GbxmlReader(input).run(); }

}  // namespace dim
