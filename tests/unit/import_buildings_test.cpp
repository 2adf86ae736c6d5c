// Readers of building and lighting models: Radiance, Honeybee, gbXML, ESP-r.
#include <fmt/format.h>

#include "geometry/polygon.hpp"
#include "import_support.hpp"
#include "scene/lights_reader.hpp"
#include "scene/zone_export.hpp"

using namespace dim;
using namespace dim::test;

namespace {

/// A 4 x 3 x 2.5 m room of six faces that look outwards, as `face(number, corners)` writes them: floor,
/// ceiling, south, east, north, west.
template <class Face>
std::string room_faces(Face&& face) {
  const std::string corners[8] = {"0 0 0",   "4 0 0",   "4 3 0",   "0 3 0",
                                  "0 0 2.5", "4 0 2.5", "4 3 2.5", "0 3 2.5"};
  static constexpr int kFaces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                       {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  std::string text;
  for (int f = 0; f < 6; ++f) {
    std::vector<std::string> ring;
    for (const int i : kFaces[f]) ring.push_back(corners[i]);
    text += face(f, ring);
  }
  return text;
}

std::string with_commas(std::string point) {
  std::replace(point.begin(), point.end(), ' ', ',');
  return point;
}

std::string radiance_room(const std::string& material) {
  return room_faces([&](int f, const std::vector<std::string>& ring) {
    return fmt::format("{} polygon side{}\n0\n0\n12 {}\n", material, f, fmt::join(ring, " "));
  });
}

std::string boundary(const std::vector<std::string>& ring) {
  std::string text;
  for (const std::string& point : ring) text += (text.empty() ? "[" : ", [") + with_commas(point) + "]";
  return "{\"type\": \"Face3D\", \"boundary\": [" + text + "]}";
}

/// @param more  of the south wall, behind a comma
std::string honeybee(const std::string& south, const std::string& radiance, const std::string& more = "") {
  const char* const types[] = {"Floor", "RoofCeiling", "Wall", "Wall", "Wall", "Wall"};
  std::string faces = room_faces([&](int f, const std::vector<std::string>& ring) {
    return fmt::format(
        R"({}{{"type": "Face", "identifier": "f{}", "face_type": "{}", "geometry": {}, "boundary_condition": {{"type": "Outdoors"}}{}}})",
        f > 0 ? "," : "", f, types[f], boundary(ring), f == 2 ? south : "");
  });
  return fmt::format(
      R"({{"type": "Model", "identifier": "m", "units": "Meters", "rooms": [{{"type": "Room", "identifier": "office", "faces": [{}]}}],
"properties": {{"type": "ModelProperties", "radiance": {{"type": "ModelRadianceProperties"{}}}}}{}}})",
      faces, radiance, more);
}

const std::string kWindow =
    R"(, "apertures": [{"type": "Aperture", "identifier": "win", "boundary_condition": {"type": "Outdoors"},
"geometry": {"type": "Face3D", "boundary": [[1,0,1],[3,0,1],[3,0,2],[1,0,2]]}}])";

std::string gbxml(const std::string& south, const std::string& rest = "") {
  const char* const types[] = {"SlabOnGrade",  "Roof",         "ExteriorWall",
                               "ExteriorWall", "ExteriorWall", "ExteriorWall"};
  const auto loop = [](const std::vector<std::string>& ring) {
    std::string text = "<PlanarGeometry><PolyLoop>";
    for (const std::string& point : ring) {
      std::string coordinates = point;
      for (std::size_t at; (at = coordinates.find(' ')) != std::string::npos;)
        coordinates.replace(at, 1, "</Coordinate><Coordinate>");
      text += "<CartesianPoint><Coordinate>" + coordinates + "</Coordinate></CartesianPoint>";
    }
    return text + "</PolyLoop></PlanarGeometry>";
  };
  return "<?xml version=\"1.0\"?><gbXML lengthUnit=\"Meters\"><Campus id=\"c\"><Building id=\"b\"><Space "
         "id=\"s\"><Name>office</Name></Space><Space id=\"t\"/></Building>" +
         room_faces([&](int f, const std::vector<std::string>& ring) {
           return fmt::format(
               "<Surface id=\"f{}\" surfaceType=\"{}\"><AdjacentSpaceId spaceIdRef=\"s\"/>{}{}</Surface>", f,
               types[f], loop(ring), f == 2 ? south : "");
         }) +
         rest + "</Campus></gbXML>";
}

const std::string kOpening =
    "<Opening id=\"win\" openingType=\"FixedWindow\" windowTypeIdRef=\"w\"><PlanarGeometry><PolyLoop>"
    "<CartesianPoint><Coordinate>1</Coordinate><Coordinate>0</Coordinate><Coordinate>1</Coordinate></"
    "CartesianPoint>"
    "<CartesianPoint><Coordinate>3</Coordinate><Coordinate>0</Coordinate><Coordinate>1</Coordinate></"
    "CartesianPoint>"
    "<CartesianPoint><Coordinate>3</Coordinate><Coordinate>0</Coordinate><Coordinate>2</Coordinate></"
    "CartesianPoint>"
    "<CartesianPoint><Coordinate>1</Coordinate><Coordinate>0</Coordinate><Coordinate>2</Coordinate></"
    "CartesianPoint></PolyLoop></PlanarGeometry></Opening>";

std::string esp_room(const std::string& blocks = "") {
  std::string text = "*Geometry 1.1,GEN,office # a zone\n*date Fri\n";
  for (const char* p : {"0,0,0", "4,0,0", "4,3,0", "0,3,0", "0,0,2.5", "4,0,2.5", "4,3,2.5", "0,3,2.5",
                        "1,0,1", "3,0,1", "3,0,2", "1,0,2"})
    text += fmt::format("*vertex,{}\n", p);
  text +=
      "*edges,4,1,4,3,2\n*edges,4,5,6,7,8\n*edges,10,1,2,6,5,1,9,12,\n11,10,9\n*edges,4,2,3,7,6\n*edges,4,3,"
      "4,8,7\n*edges,4,4,1,5,8\n*edges,4,9,10,11,12\n";
  text +=
      "*surf,floor,FLOR,-,-,-,slab,OPAQUE,GROUND,1,0\n*surf,roof,CEIL,-,-,-,slab,OPAQUE,EXTERIOR,0,0\n*surf,"
      "south,VERT,-,-,-,brick,OPAQUE,EXTERIOR,0,0\n"
      "*surf,east,VERT,-,-,-,brick,OPAQUE,EXTERIOR,0,0\n*surf,north,VERT,-,-,-,brick,OPAQUE,EXTERIOR,0,0\n*"
      "surf,west,VERT,-,-,-,brick,OPAQUE,EXTERIOR,0,0\n"
      "*surf,win,VERT,south,C-WINDOW,CLOSED,dbl_glz,DCF7671_06nb,EXTERIOR,0,0\n";
  return text + blocks;
}

}  // namespace

TEST_CASE("Radiance: there and back keeps every area and material", "[import][unit]") {
  const std::string scene =
      "# a room\nvoid plastic white\n0\n0\n5 .6 .6 .6 .02 .05\nvoid glass pane 0 0 3 .7 .7 .7\nvoid mirror "
      "m\n0\n0\n3 .9 .9 .9\n" +
      radiance_room("white") +
      "m polygon p\n0 0 9 1 1 1  2 1 1  2 2 1.5\npane polygon seam 0 0 30 3 1 .5  3 2 .5  3 2 1.5  3 1 1.5  "
      "3 1 .5  3 1.2 .7  3 1.2 1.3  3 1.8 1.3  3 1.8 .7  3 1.2 .7\n";
  const auto there = import_text(scene, "radiance");
  // The pane hangs in the room, where DIM has no glass: its areas and numbers are what is asked for here.
  CHECK(there.zone.find(
            "\"white\" = { diffuse = 0.6, specular = 0.02, roughness = 0.05, specular_reflectance = 1 }") !=
        std::string::npos);
  CHECK(there.zone.find("specular_reflectance = 0.9") != std::string::npos);
  CHECK(there.zone.find("holes = ") != std::string::npos);
  // 0.64 of 1 m2 is left of the pane.
  CHECK(there.report.area_written_m2 == Approx(59.0 + 0.5 * std::sqrt(1.25) + 0.64).epsilon(1e-9));
  const auto opaque = import_text(radiance_room("white"), "radiance");
  Warnings lost;
  const auto back = import_text(to_radiance(zone_of(opaque), lost), "radiance");
  CHECK(back.report.area_written_m2 == Approx(59.0).epsilon(1e-9));
}

TEST_CASE("Radiance: a pane's transmittance at normal incidence is that of its formula", "[import][unit]") {
  // t = 0.96 in glass of index 1.52: r = (0.52 / 2.52)^2 = 0.04258, T = t (1 - r)^2 / (1 - r^2 t^2) =
  // 0.88146.
  const auto result =
      import_text("void glass g\n0\n0\n3 .96 .96 .96\ng polygon p\n0\n0\n9 0 0 0 1 0 0 0 1 0\n", "radiance");
  const double r = std::pow(0.52 / 2.52, 2);
  CHECK(result.zone.find(
            fmt::format("transmittance = {:.6g}", 0.96 * (1 - r) * (1 - r) / (1 - r * r * 0.96 * 0.96))) !=
        std::string::npos);
}

TEST_CASE("Radiance: lights become luminaires of their flux, where they are", "[import][unit]") {
  const std::string text =
      "void light bright\n0\n0\n3 10 10 10\nbright polygon panel\n0\n0\n12 1 1 2.4  1 1.6 2.4  2.2 1.6 2.4  "
      "2.2 1 2.4\n" +
      radiance_room("grey");
  const auto result = import_text(text, "radiance");
  // 179 lm/W, radiance 10, 0.72 m2: flux = pi L A.
  CHECK(result.lights.find(fmt::format("lumens = {:.6g}", kPi * 1790.0 * 0.72)) != std::string::npos);
  CHECK(result.lights.find("at = [1.6, 1.3, 2.4]") != std::string::npos);
  CHECK(result.lights.find("aim = [0, 0, -1]") != std::string::npos);
  CHECK(result.lights.find("opening = [0.6, 1.2]") != std::string::npos);
  const Zone zone = zone_of(result);
  CHECK(zone.surfaces.size() == 6);
  CHECK(warns_of(result.warnings, "material 'grey' is not in the file"));
  // In millimetres the area is a millionth.
  ImportOptions millimetres;
  millimetres.unit_m = 0.001;
  CHECK(import_text(text, "radiance", millimetres)
            .lights.find(fmt::format("lumens = {:.6g}", kPi * 1790.0 * 0.72e-6)) != std::string::npos);
}

TEST_CASE("Radiance: rings keep their area", "[import][unit]") {
  const auto result =
      import_text("void plastic p 0 0 5 .5 .5 .5 0 0\np ring r\n0\n0\n8 0 0 1  0 0 -1  0.5 1\n", "radiance");
  CHECK(result.report.area_written_m2 == Approx(kPi * 0.75).epsilon(1e-9));
  CHECK(warns_of(result.warnings, "ring becomes a polygon"));
}

TEST_CASE("Radiance: commands, instances and meshes are refused, the rest is named", "[import][unit]") {
  CHECK(refusal("!xform -rz 90 desk.rad\n", "radiance")
            .find("model:1: the command '!xform -rz 90 desk.rad' is not run") == 0);
  CHECK(refusal("void instance i\n1 room.oct\n0\n0\n", "radiance")
            .find("instance 'i' stands for another file (room.oct)") != std::string::npos);
  CHECK(refusal("void mesh i\n1 chair.rtm\n0\n0\n", "radiance").find("chair.rtm") != std::string::npos);
  CHECK(refusal("a polygon p\n0\n0\n99999999999 0 0", "radiance").find("more than the file has room for") !=
        std::string::npos);
  CHECK(refusal("a polygon p\n0\n0\n8 0 0 0 1 0 0 0 1\n", "radiance").find("has 8 numbers") !=
        std::string::npos);
  const auto result = import_text(
      "void brightfunc f\n2 dirt .\n0\n0\nf plastic p\n0\n0\n5 .5 .5 .5 0 0\nvoid source sun\n0\n0\n4 0 0 1 "
      ".5\np sphere s\n0\n0\n4 0 0 0 1\np polygon q\n0\n0\n9 0 0 0 1 0 0 0 1 0\n",
      "radiance");
  for (const char* words :
       {"type 'brightfunc'", "source (sky or sun)", "sphere is left out", "what 'f' lays on materials"})
    CHECK(warns_of(result.warnings, words));
}

TEST_CASE("Honeybee: a room with a window, by Honeybee's generic modifiers", "[import][unit]") {
  const auto result = import_text(honeybee(kWindow, ""), "hbjson");
  Warnings warnings;
  const Zone zone = zone_of(result, &warnings);
  CHECK(warnings.empty());
  CHECK(zone.closed);
  CHECK(zone.volume_m3 == Approx(30.0));
  CHECK(area_of(zone, "win") == Approx(2.0));
  CHECK(area_of(zone, "f2") == Approx(8.0));
  CHECK(find(zone, "f2")->polygon.normal().y == Approx(1.0));
  CHECK(result.zone.find("\"generic_exterior_window_vis_0.64\" = { transmittance = 0.64 }") !=
        std::string::npos);
  CHECK(result.zone.find("\"generic_ceiling_0.80\" = { diffuse = 0.8 }") != std::string::npos);
  REQUIRE(result.report.rooms.size() == 1);
  CHECK(result.report.rooms[0].name == "office");
  CHECK(result.report.rooms[0].volume_before_m3 == Approx(30.0));
}

TEST_CASE("Honeybee: modifiers of a face, of its set, sensor grids and shades", "[import][unit]") {
  const std::string radiance =
      R"(, "modifiers": [{"type": "Plastic", "identifier": "red", "r_reflectance": 0.4, "g_reflectance": 0.1, "b_reflectance": 0.1},
{"type": "Plastic", "identifier": "pale", "r_reflectance": 0.7, "g_reflectance": 0.7, "b_reflectance": 0.7}],
"global_modifier_set": {"type": "GlobalModifierSet", "wall_set": {"exterior_modifier": "pale"}},
"sensor_grids": [{"identifier": "g", "sensors": [{"pos": [1,1,0.8], "dir": [0,0,1]}, {"pos": [2,1,0.8], "dir": [0,0,1]}]}])";
  const std::string south = kWindow + R"(, "properties": {"radiance": {"modifier": "red"}},
"outdoor_shades": [{"type": "Shade", "identifier": "awning", "geometry": {"type": "Face3D", "boundary": [[1,0,2],[3,0,2],[3,-1,2],[1,-1,2]]}}])";
  const auto result = import_text(honeybee(south, radiance), "hbjson");
  // Radiance's weights: 0.265 * 0.4 + 0.670 * 0.1 + 0.065 * 0.1.
  CHECK(result.zone.find("\"red\" = { diffuse = 0.1795 }") != std::string::npos);
  CHECK(result.zone.find("\"pale\" = { diffuse = 0.7 }") != std::string::npos);
  const Zone zone = zone_of(result);
  CHECK(zone.points.size() == 2);
  REQUIRE(find(zone, "awning"));
  CHECK(find(zone, "awning")->outside);
}

TEST_CASE("Honeybee: luminaires carry their IES text and stand where they are aimed", "[import][unit]") {
  const std::string radiance =
      R"(, "luminaires": [{"type": "Luminaire", "identifier": "spot 1", "ies_content": "IESNA:LM-63-2002\n…", "light_loss_factor": 0.8,
"luminaire_zone": {"type": "LuminaireZone", "instances": [{"point": {"type": "Point3D", "x": 1, "y": 1, "z": 2.4}, "spin": 0, "tilt": 0, "rotation": 0},
{"point": {"type": "Point3D", "x": 3, "y": 1, "z": 2.4}, "spin": 0, "tilt": 90, "rotation": 90}]}}])";
  const auto result = import_text(honeybee("", radiance), "hbjson");
  REQUIRE(result.files.size() == 1);
  CHECK(result.files[0].name == "spot-1.ies");
  CHECK(result.lights.find("fitting = \"spot-1.ies\"") != std::string::npos);
  CHECK(result.lights.find("dim = 0.8") != std::string::npos);
  CHECK(result.lights.find("aim = [0, 0, -1]\nc0 = [1, 0, 0]") != std::string::npos);
  // Down, tilted by 90 degrees about y points to -x; turned by 90 degrees about z to -y; c0 then points down.
  CHECK(result.lights.find("aim = [0, -1, 0]\nc0 = [0, 0, -1]") != std::string::npos);
}

TEST_CASE("Honeybee: glass between rooms and air boundaries stay open, and the volume counts",
          "[import][unit]") {
  std::string inner = kWindow;
  inner.replace(inner.find("Outdoors"), 8, "Surface");
  const auto result = import_text(honeybee(inner, ""), "hbjson");
  CHECK(warns_of(result.warnings, "glass between two rooms is left open"));
  CHECK(result.report.rooms.at(0).volume_after_m3 == Approx(30.0));
  CHECK_FALSE(find(zone_of(result), "win"));
  CHECK(refusal("{}", "hbjson").find("no Honeybee model") != std::string::npos);
  CHECK(refusal("[1, 2", "hbjson").find("not well-formed") != std::string::npos);
}

TEST_CASE("gbXML: a space with a window, and a shade outside", "[import][unit]") {
  const std::string shade = "<Surface id=\"tree\" surfaceType=\"Shade\">" +
                            kOpening.substr(kOpening.find("<PlanarGeometry>"),
                                            kOpening.find("</Opening>") - kOpening.find("<PlanarGeometry>")) +
                            "</Surface>";
  const auto result = import_text(gbxml(kOpening, shade), "gbxml");
  const Zone zone = zone_of(result);
  CHECK(zone.closed);
  CHECK(zone.volume_m3 == Approx(30.0));
  CHECK(area_of(zone, "win") == Approx(2.0));
  CHECK(find(zone, "tree")->outside);
  CHECK(find(zone, "f0")->polygon.normal().z == Approx(1.0));
  CHECK(result.zone.find("\"floor\" = { diffuse = 0.2 }  # not stated: assumed") != std::string::npos);
  CHECK(warns_of(result.warnings, "no transmittance is stated for 'window'"));
}

TEST_CASE("gbXML: a wall between two spaces is one of each", "[import][unit]") {
  std::string text = gbxml("");
  const std::string east =
      "<Surface id=\"f3\" surfaceType=\"ExteriorWall\"><AdjacentSpaceId spaceIdRef=\"s\"/>";
  text.replace(text.find(east), east.size(),
               "<Surface id=\"f3\" surfaceType=\"InteriorWall\"><AdjacentSpaceId "
               "spaceIdRef=\"s\"/><AdjacentSpaceId spaceIdRef=\"t\"/>");
  const auto result = import_text(text, "gbxml");
  CHECK(result.zone.find("name = \"f3\"") != std::string::npos);
  CHECK(result.zone.find("name = \"f3/t\"") != std::string::npos);
  CHECK(refusal("<gbXML lengthUnit=\"Cubits\"/>", "gbxml").find("'Cubits'") != std::string::npos);
  CHECK(refusal("<gbXML", "gbxml").find("not well-formed") != std::string::npos);
}

TEST_CASE("ESP-r: a zone with a window whose wall walks round it, and obstruction blocks", "[import][unit]") {
  const auto result = import_text(
      esp_room("*block_start,20,20\n*obs,10,0,0,1,2,3,90,1.00,tower,brick # block\n*obsp,8,6,1.00,hut,NONE\n"
               "0,10,0,1,10,0,1,11,0,0,11,0\n0,10,2,1,10,2,1,11,2,0,11,2\n*end_block\n"),
      "esp-r");
  const Zone zone = zone_of(result);
  CHECK(zone.closed);
  CHECK(zone.volume_m3 == Approx(30.0));
  CHECK(area_of(zone, "south") == Approx(8.0));
  CHECK(area_of(zone, "win") == Approx(2.0));
  CHECK(is_window(zone, *find(zone, "win")));
  // Turned by 90 degrees its length of 1 m runs north: the front looks east.
  CHECK(find(zone, "tower.front")->polygon.normal().x == Approx(1.0));
  CHECK(area_of(zone, "tower.front") == Approx(3.0));
  CHECK(find(zone, "hut.top")->polygon.normal().z == Approx(1.0));
  CHECK(find(zone, "hut.top")->outside);
}

TEST_CASE("ESP-r: the older form of geometry, turned", "[import][unit]") {
  std::string text = "# geometry\nGEN  office  an office  # type\n 8 6 90.0\n";
  for (const char* p : {"0 0 0", "4 0 0", "4 3 0", "0 3 0", "0 0 2.5", "4 0 2.5", "4 3 2.5", "0 3 2.5"})
    text += std::string("  ") + p + " # vert\n";
  text +=
      " 4, 1, 4, 3, 2,\n 4, 5, 6, 7, 8\n 4, 1, 2, 6, 5\n 4, 2, 3, 7, 6\n 4, 3, 4, 8, 7\n 4, 4, 1, 5, "
      "8\n0,0,0,0,0,0\n0 0 0 0 0 0\n1 0 0 0 # insolation\n";
  for (const char* surface : {"1, floor OPAQ FLOR slab GROUND", "2, roof OPAQ CEIL slab EXTERIOR",
                              "3, south OPAQ VERT brick EXTERIOR", "4, east TRAN VERT glass EXTERIOR",
                              "5, north OPAQ VERT brick EXTERIOR", "6, west OPAQ VERT brick EXTERIOR"})
    text += std::string(surface) + "\n";
  const auto result = import_text(text + " 6 0 0 0 0 0 12.00 0\n", "esp-r");
  const Zone zone = zone_of(result);
  CHECK(zone.volume_m3 == Approx(30.0));
  // What looked north into the room looks west once it is turned by 90 degrees.
  CHECK(find(zone, "south")->polygon.normal().x == Approx(-1.0));
  CHECK(is_window(zone, *find(zone, "east")));
}

TEST_CASE("ESP-r: what is no geometry, or breaks off, is refused", "[import][unit]") {
  CHECK(refusal("*Geometry 2.0,GEN,x\n", "esp-r").find("version that is not known") != std::string::npos);
  CHECK(refusal("REC x\n1 1 1\n", "esp-r").find("type REC") != std::string::npos);
  CHECK(refusal("hello\n", "esp-r").find("no zone geometry of ESP-r") != std::string::npos);
  CHECK(refusal("*Geometry 1.1,GEN,x\n*vertex,0,0,0\n*edges,3,1,2,3\n", "esp-r")
            .find("no whole number within 0..1") != std::string::npos);
  CHECK(refusal("*Geometry 1.1,GEN,x\n*vertex,0,0,0\n*edges,3,1,1\n", "esp-r").find("has too few") !=
        std::string::npos);
}
