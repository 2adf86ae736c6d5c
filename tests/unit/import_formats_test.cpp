// Readers of mesh formats: one quadrilateral or triangle each, with what the format says beside it.
#include <fmt/format.h>

#include "import_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

std::string bytes_of(std::initializer_list<float> numbers) {
  std::string bytes;
  for (const float number : numbers) bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  return bytes;
}

std::string base64(const std::string& bytes) {
  static const char* const kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i * 8 + k * 6 < bytes.size() * 8 ? kDigits[bits >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

/// A triangle of 3 m2 in the plane y = 2 (glTF's up), moved by a node.
std::string gltf(const std::string& node, const std::string& material = "{\"name\": \"oak\"}") {
  const std::string bytes = bytes_of({0, 0, 0, 0, 0, 2, 3, 0, 0});
  return fmt::format(
      R"({{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0]}}], "nodes": [{}],
"meshes": [{{"name": "top", "primitives": [{{"attributes": {{"POSITION": 0}}, "material": 0}}]}}], "materials": [{}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}}],
"bufferViews": [{{"buffer": 0, "byteLength": {}}}], "buffers": [{{"byteLength": {}, "uri": "data:x;base64,{}"}}]}})",
      node, material, bytes.size(), bytes.size(), base64(bytes));
}

std::string dae(const std::string& body, const std::string& nodes) {
  return R"(<?xml version="1.0"?><COLLADA version="1.4.1"><asset><unit meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_effects><effect id="e"><profile_COMMON><technique><lambert><diffuse><color>0.5 0.5 0.5 1</color></diffuse></lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m" name="chalk"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g" name="plate"><mesh><source id="p"><float_array count="24">0 0 0 400 0 0 400 300 0 0 300 0 100 100 0 200 100 0 200 200 0 100 200 0</float_array>
<technique_common><accessor stride="3" count="8"/></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>)" +
         body + "</mesh></geometry></library_geometries>" + nodes + "</COLLADA>";
}

const std::string kScene =
    R"(<library_visual_scenes><visual_scene id="s"><node name="slab"><matrix>1 0 0 0 0 1 0 0 0 0 1 50 0 0 0 1</matrix>
<instance_geometry url="#g"><bind_material><technique_common><instance_material symbol="a" target="#m"/></technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene>)";

const std::string kPlyHeader =
    "ply\nformat {} 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n{}element "
    "face 1\n"
    "property list uchar int vertex_indices\nend_header\n";

}  // namespace

TEST_CASE("OBJ: polygons, relative corners, continued lines, materials with their reflectance",
          "[import][unit]") {
  const std::string text =
      "mtllib own name.mtl\no table top\nusemtl oak light\nv 0 0 1\nv 2 0 1\nv 2 3 1 \\\n\nv 0 3 1\nf -4/1/1 "
      "-3//2 -2 -1\n";
  const auto result =
      import_text(text, "obj", {}, {{"own name.mtl", "newmtl oak light\nKd 0.5 0.3 0.1\nNs 10\n"}});
  const Zone zone = zone_of(result);
  CHECK(area_of(zone, "table top") == Approx(6.0));
  // 0.2126, 0.7152, 0.0722: BT.709.
  CHECK(result.zone.find("\"oak light\" = { diffuse = 0.32808 }") != std::string::npos);
  // One face encloses nothing; else there is nothing to say.
  CHECK(result.warnings.size() == 1);
}

TEST_CASE("OBJ: what is wrong is refused by its line, what is missing named", "[import][unit]") {
  CHECK(refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "obj")
            .find("model:4: corner '4' of a face is none of the 3") == 0);
  CHECK(refusal("v 0 nan 0\n", "obj").find("model:1:") == 0);
  CHECK(refusal("", "obj").find("no vertex") != std::string::npos);
  const auto result =
      import_text("mtllib gone.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\ncurv 1 2\n", "obj");
  CHECK(warns_of(result.warnings, "'gone.mtl' is not there"));
  CHECK(warns_of(result.warnings, "statement 'l'"));
  CHECK(warns_of(result.warnings, "statement 'curv'"));
  CHECK(warns_of(result.warnings, "no reflectance is stated for 'a'"));
}

TEST_CASE("OBJ: glass by its opacity, pictures named", "[import][unit]") {
  const auto result = import_text("mtllib m\nusemtl g\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "obj", {},
                                  {{"m", "newmtl g\nKd 1 1 1\nd 0.25\nmap_Kd glass.png\n"}});
  CHECK(result.zone.find("\"g\" = { transmittance = 0.75 }") != std::string::npos);
  CHECK(warns_of(result.warnings, "pictures on materials"));
}

TEST_CASE("PLY: text and both byte orders hold the same quadrilateral", "[import][unit]") {
  const std::string text =
      fmt::format(fmt::runtime(kPlyHeader), "ascii", "") + "0 0 0\n2 0 0\n2 3 0\n0 3 0\n4 0 1 2 3\n";
  CHECK(import_text(text, "ply").report.area_written_m2 == Approx(6.0));
  std::string little = fmt::format(fmt::runtime(kPlyHeader), "binary_little_endian", "") +
                       bytes_of({0, 0, 0, 2, 0, 0, 2, 3, 0, 0, 3, 0});
  little += std::string("\4", 1) + std::string("\0\0\0\0\1\0\0\0\2\0\0\0\3\0\0\0", 16);
  CHECK(import_text(little, "ply").report.area_written_m2 == Approx(6.0));
  std::string big = fmt::format(fmt::runtime(kPlyHeader), "binary_big_endian", "");
  for (const float number : {0.f, 0.f, 0.f, 2.f, 0.f, 0.f, 2.f, 3.f, 0.f, 0.f, 3.f, 0.f}) {
    const std::string bytes = bytes_of({number});
    big += std::string(bytes.rbegin(), bytes.rend());
  }
  big += std::string("\4", 1) + std::string("\0\0\0\0\0\0\0\1\0\0\0\2\0\0\0\3", 16);
  CHECK(import_text(big, "ply").report.area_written_m2 == Approx(6.0));
}

TEST_CASE("PLY: colours are reflectances by sRGB", "[import][unit]") {
  const std::string text =
      fmt::format(fmt::runtime(kPlyHeader), "ascii",
                  "property uchar red\nproperty uchar green\nproperty uchar blue\n") +
      "0 0 0 188 188 188\n2 0 0 188 188 188\n2 3 0 188 188 188\n0 3 0 188 188 188\n4 0 1 2 3\n";
  // ((188 / 255 + 0.055) / 1.055) ^ 2.4 = 0.502886
  CHECK(import_text(text, "ply").zone.find("\"colour-bcbcbc\" = { diffuse = 0.502886 }") !=
        std::string::npos);
}

TEST_CASE("PLY: counts that the file has no room for, and indices beyond it, are refused", "[import][unit]") {
  CHECK(refusal("ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n", "ply")
            .find("more than the file has room for") != std::string::npos);
  CHECK(
      refusal(fmt::format(fmt::runtime(kPlyHeader), "ascii", "") + "0 0 0\n2 0 0\n2 3 0\n0 3 0\n4 0 1 2 4\n",
              "ply")
          .find("none of the 4") != std::string::npos);
  CHECK(refusal(fmt::format(fmt::runtime(kPlyHeader), "ascii", "") + "0 0 0\n2 0 0\n", "ply")
            .find("cut short") != std::string::npos);
  CHECK(refusal("obj\n", "ply").find("not a PLY file") != std::string::npos);
}

TEST_CASE("STL: text and binary, even where binary begins with solid", "[import][unit]") {
  const std::string text =
      "solid top\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 3 0 0\nvertex 0 2 "
      "0\nendloop\nendfacet\nendsolid top\n";
  const auto result = import_text(text, "stl");
  CHECK(result.report.area_written_m2 == Approx(3.0));
  CHECK(result.zone.find("name = \"top\"") != std::string::npos);
  std::string binary = "solid binary";
  binary.resize(80, ' ');
  binary +=
      std::string("\1\0\0\0", 4) + bytes_of({0, 0, 1, 0, 0, 0, 3, 0, 0, 0, 2, 0}) + std::string(2, '\0');
  CHECK(import_text(binary, "stl").report.area_written_m2 == Approx(3.0));
  binary.resize(binary.size() - 10);
  CHECK(refusal(binary, "stl").find("says 1 triangles and holds 0") != std::string::npos);
  CHECK(refusal("facet\n", "stl").find("not an STL file") != std::string::npos);
}

TEST_CASE("glTF: nodes move, y becomes z, names and colours are kept", "[import][unit]") {
  const auto result =
      import_text(gltf(R"({"mesh": 0, "name": "shelf", "translation": [0, 2, 0], "scale": [2, 1, 1]})",
                       R"({"name": "oak", "pbrMetallicRoughness": {"baseColorFactor": [0.4, 0.4, 0.4, 1]}})"),
                  "gltf");
  CHECK(result.zone.find("name = \"shelf\"") != std::string::npos);
  CHECK(result.zone.find("\"oak\" = { diffuse = 0.4 }") != std::string::npos);
  CHECK(result.report.area_written_m2 == Approx(6.0));
  // y = 2 becomes z = 2, and z = 2 becomes y = -2.
  CHECK(result.zone.find("[0, -2, 2]") != std::string::npos);
}

TEST_CASE("glTF: cycles, shared children, bad buffers and compression are refused", "[import][unit]") {
  CHECK(refusal(gltf(R"({"children": [1]}, {"children": [0]})"), "gltf")
            .find("nodes[0] is a child of two nodes") != std::string::npos);
  CHECK(refusal(gltf(R"({"children": [1, 1]}, {"mesh": 0})"), "gltf").find("is a child of two nodes") !=
        std::string::npos);
  CHECK(refusal(gltf(R"({"mesh": 7})"), "gltf").find("nodes[0].mesh is no whole number below 1") !=
        std::string::npos);
  std::string text = gltf(R"({"mesh": 0})");
  text.replace(text.find("\"count\": 3"), 10, "\"count\": 4");
  CHECK(refusal(text, "gltf").find("reaches beyond its buffer") != std::string::npos);
  CHECK(refusal(R"({"asset": {"version": "2.0"}, "extensionsRequired": ["KHR_draco_mesh_compression"]})",
                "gltf")
            .find("KHR_draco") != std::string::npos);
  CHECK(refusal(R"({"asset": {"version": "1.0"}})", "gltf").find("not 2.0") != std::string::npos);
  CHECK(refusal(std::string(100000, '[') + std::string(100000, ']'), "gltf")
            .find("nested more than 200 deep") != std::string::npos);
  CHECK(refusal("{\"asset\": ", "gltf").find("not well-formed") != std::string::npos);
  CHECK(refusal(R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "gone.bin"}]})", "gltf")
            .find("'gone.bin'") != std::string::npos);
}

TEST_CASE("COLLADA: unit, nodes, bound materials and holes", "[import][unit]") {
  const auto result = import_text(
      dae(R"(<polygons material="a"><input semantic="VERTEX" source="#v" offset="0"/><ph><p>0 1 2 3</p><h>4 5 6 7</h></ph></polygons>)",
          kScene),
      "dae");
  CHECK(result.report.area_written_m2 == Approx(11.0));
  CHECK(result.zone.find("\"chalk\" = { diffuse = 0.5 }") != std::string::npos);
  CHECK(result.zone.find("name = \"slab\"") != std::string::npos);
  CHECK(result.zone.find("[4, 0, 0.5]") != std::string::npos);
}

TEST_CASE("COLLADA: polylists, triangles and strips cover the same square", "[import][unit]") {
  const std::string input =
      R"(<input semantic="VERTEX" source="#v" offset="0"/><input semantic="NORMAL" source="#n" offset="1"/>)";
  for (const std::string& body : std::vector<std::string>{"<polylist>" + input + "<vcount>4</vcount><p>0 9 1 9 2 9 3 9</p></polylist>",
                                 "<triangles>" + input + "<p>0 9 1 9 2 9 0 9 2 9 3 9</p></triangles>",
                                 "<tristrips>" + input + "<p>0 9 1 9 3 9 2 9</p></tristrips>",
                                 "<trifans>" + input + "<p>0 9 1 9 2 9 3 9</p></trifans>"})
    CHECK(import_text(dae(body, kScene), "dae").report.area_written_m2 == Approx(12.0));
}

TEST_CASE("COLLADA: nodes that hold themselves, and links to nowhere, are refused", "[import][unit]") {
  const std::string cycle =
      R"(<library_nodes><node id="a"><instance_node url="#b"/></node><node id="b"><instance_node url="#a"/></node></library_nodes>
<library_visual_scenes><visual_scene id="s"><node><instance_node url="#a"/></node></visual_scene></library_visual_scenes>)";
  CHECK(refusal(dae("", cycle), "dae").find("nodes hold themselves") != std::string::npos);
  CHECK(
      refusal(
          dae("",
              R"(<library_visual_scenes><visual_scene><node><instance_geometry url="#x"/></node></visual_scene></library_visual_scenes>)"),
          "dae")
          .find("'#x'") != std::string::npos);
  CHECK(refusal(
            dae("<triangles><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 99</p></triangles>",
                kScene),
            "dae")
            .find("not there") != std::string::npos);
  CHECK(refusal("<html/>", "dae").find("no COLLADA") != std::string::npos);
}
