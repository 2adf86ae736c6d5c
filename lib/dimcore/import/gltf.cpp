#include "import/gltf.hpp"

#include <fmt/format.h>

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/gtx/transform.hpp>
#include <nlohmann/json.hpp>

#include "import/byte_reader.hpp"
#include "import/gltf_buffers.hpp"
#include "import/transform.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {
namespace {

struct Container {
  std::string_view json, binary;
};

Container container_of(const ImportInput& input) {
  constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
  std::string_view bytes = input.bytes;
  if (!bytes.starts_with("glTF")) return {bytes, {}};
  const auto word = [&](std::size_t at) { return number_at<std::uint32_t>(bytes.data() + at, false); };
  if (bytes.size() < 20 || word(4) != 2) throw InputError({input.place(0), "no .glb of version 2", ""});
  Container container;
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::size_t length = word(at), kind = word(at + 4);
    if (length > bytes.size() - at - 8) throw InputError({input.place(0), "the file is cut short", ""});
    if (kind == kJson && container.json.empty()) container.json = bytes.substr(at + 8, length);
    if (kind == kBinary && container.binary.empty()) container.binary = bytes.substr(at + 8, length);
    at += 8 + length;
  }
  return container;
}

/// Extensions that leave positions and indices as they are.
bool is_harmless(const std::string& extension) {
  return extension.starts_with("KHR_materials_") || extension.starts_with("KHR_texture_") ||
         extension == "KHR_mesh_quantization" || extension == "KHR_lights_punctual" ||
         extension == "EXT_texture_webp";
}

class GltfReader {
 public:
  GltfReader(const ImportInput& input, const nlohmann::json& json, std::string_view binary)
      : input_(input),
        root_(json, input),
        buffers_((check_version(), root_), binary, input),
        counter_(input) {
    model_.format = "glTF";
    model_.unit_m = 1.0;
    model_.up = UpAxis::y;
    model_.up_stated = true;
    model_.single_precision = true;
  }

  ImportedModel run() {
    for (std::size_t i = 0; i < root_.count("materials"); ++i) material(root_["materials"].at(i), i);
    visited_.assign(root_.count("nodes"), false);
    if (root_.count("scenes") > 0) {
      const std::size_t n = root_.count("scenes");
      const JsonNode scene = root_["scenes"].at(root_.has("scene") ? root_["scene"].index(n) : 0);
      if (n > 1)
        unknowns_.add(fmt::format("the file has {} scenes: the first or the one it names is read", n),
                      input_.place(0));
      for (std::size_t i = 0; i < scene.count("nodes"); ++i)
        node(scene["nodes"].at(i).index(visited_.size()), Transform(1.0), 0);
    } else {
      for (std::size_t i = 0; i < root_.count("meshes"); ++i) mesh(i, "", Transform(1.0));
    }
    for (const char* part : {"animations", "skins", "cameras"})
      if (root_.count(part) > 0) unknowns_.add(fmt::format("{} are not read", part), input_.place(0));
    if (root_.has("extensions") && root_["extensions"].has("KHR_lights_punctual"))
      unknowns_.add("lights are not read", input_.place(0), "write luminaires in the lights file");
    unknowns_.tell(model_.warnings);
    return std::move(model_);
  }

 private:
  void check_version() const {
    const std::string version = root_["asset"]["version"].text();
    if (!version.starts_with("2."))
      root_["asset"]["version"].fail(fmt::format("is {}, not 2.0", dim::quoted(version)));
    for (std::size_t i = 0; i < root_.count("extensionsRequired"); ++i) {
      const std::string name = root_["extensionsRequired"].at(i).text();
      if (!is_harmless(name))
        throw InputError({input_.place(0),
                          fmt::format("needs the extension {}, which is not read", dim::quoted(name)),
                          "export it without compression"});
    }
  }

  void material(const JsonNode& json, std::size_t number) {
    ImportedMaterial material;
    material.name = json.text("name", fmt::format("material {}", number));
    double opacity = 1.0, base = 1.0;
    if (json.has("pbrMetallicRoughness")) {
      const JsonNode pbr = json["pbrMetallicRoughness"];
      if (pbr.has("baseColorFactor")) {
        const JsonNode colour = pbr["baseColorFactor"];
        base = luminous(colour.at(0).number(0, 1), colour.at(1).number(0, 1), colour.at(2).number(0, 1));
        opacity = colour.size() > 3 ? colour.at(3).number(0, 1) : 1.0;
      }
      if (pbr.has("baseColorTexture"))
        unknowns_.add("pictures on materials are not read: the base colour is taken", input_.place(0));
      if (pbr.has("baseColorFactor") || !pbr.has("baseColorTexture")) material.diffuse = base;
      if (pbr.has("metallicFactor") && pbr["metallicFactor"].number(0, 1) >= 0.5) {
        const double rough = pbr.number_or("roughnessFactor", 1.0, 0, 1);
        material.specular = 1.0;
        material.roughness = rough * rough;
        material.specular_reflectance = base;
      }
    }
    if (json.text("alphaMode", "OPAQUE") == "BLEND" && opacity < 1.0) material.transmittance = 1.0 - opacity;
    if (json.has("extensions") && json["extensions"].has("KHR_materials_transmission")) {
      const double part =
          json["extensions"]["KHR_materials_transmission"].number_or("transmissionFactor", 0.0, 0, 1);
      if (part > 0.0) material.transmittance = part * base;
    }
    if (json.has("emissiveFactor") && glm::length(json["emissiveFactor"].vec3()) > 0.0)
      unknowns_.add(fmt::format("material {}: light of its own is left out", dim::quoted(material.name)),
                    input_.place(0), "write luminaires in the lights file");
    // Materials of one name are kept apart: the writer numbers them.
    model_.materials.push_back(std::move(material));
  }

  Transform transform_of(const JsonNode& node) const {
    if (node.has("matrix")) {
      if (node["matrix"].size() != 16) node["matrix"].fail("has not 16 numbers");
      Transform matrix;
      for (int i = 0; i < 16; ++i)
        matrix[i / 4][i % 4] = node["matrix"].at(static_cast<std::size_t>(i)).number();
      return matrix;
    }
    Transform transform(1.0);
    if (node.has("translation")) transform = glm::translate(transform, node["translation"].vec3());
    if (node.has("rotation")) {
      const JsonNode q = node["rotation"];
      if (q.size() != 4) q.fail("has not 4 numbers");
      transform *= glm::mat4_cast(
          glm::normalize(glm::dquat(q.at(3).number(), q.at(0).number(), q.at(1).number(), q.at(2).number())));
    }
    if (node.has("scale")) transform = glm::scale(transform, node["scale"].vec3());
    return transform;
  }

  void node(std::size_t index, const Transform& above, int depth) {
    constexpr int kDeepest = 500;
    const JsonNode node = root_["nodes"].at(index);
    if (visited_[index]) node.fail("is a child of two nodes, or of its own descendants");
    if (depth > kDeepest) node.fail("lies too deep in the tree of nodes");
    visited_[index] = true;
    const Transform transform = above * transform_of(node);
    if (node.has("mesh")) mesh(node["mesh"].index(root_.count("meshes")), node.text("name", ""), transform);
    for (std::size_t i = 0; i < node.count("children"); ++i)
      this->node(node["children"].at(i).index(visited_.size()), transform, depth + 1);
  }

  void mesh(std::size_t index, const std::string& node_name, const Transform& transform) {
    const JsonNode mesh = root_["meshes"].at(index);
    const std::string name = node_name.empty() ? mesh.text("name", fmt::format("mesh {}", index)) : node_name;
    for (std::size_t i = 0; i < mesh.count("primitives"); ++i)
      primitive(mesh["primitives"].at(i), name, transform);
  }

  void primitive(const JsonNode& primitive, const std::string& name, const Transform& transform) {
    constexpr int kTriangles = 4, kFan = 6;  // 5: a strip
    const int mode = static_cast<int>(primitive.number_or("mode", kTriangles, 0, kFan));
    if (mode < kTriangles) {
      unknowns_.add("points and lines are left out", input_.place(0));
      return;
    }
    if (primitive.has("extensions") && primitive["extensions"].has("KHR_draco_mesh_compression"))
      primitive.fail("is compressed (Draco), which is not read");
    if (primitive.has("targets")) unknowns_.add("morph targets are not read", input_.place(0));
    const std::size_t n_accessors = root_.count("accessors");
    std::vector<Vec3> positions = buffers_.positions(primitive["attributes"]["POSITION"].index(n_accessors));
    for (Vec3& p : positions) p = moved(transform, p);
    std::vector<std::uint32_t> corners;
    if (primitive.has("indices"))
      corners = buffers_.indices(primitive["indices"].index(n_accessors));
    else
      for (std::uint32_t i = 0; i < positions.size(); ++i) corners.push_back(i);
    for (const std::uint32_t i : corners)
      if (i >= positions.size())
        primitive.fail(fmt::format("has the index {}, and {} positions", i, positions.size()));
    int material = 0;
    if (primitive.has("material"))
      material = static_cast<int>(primitive["material"].index(root_.count("materials")));
    else
      material = material_named(model_, "");
    const bool mirrored = mirrors(transform);
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      counter_.add(3);
      ImportedFace face;
      face.outline = {positions[corners[a]], positions[corners[mirrored ? c : b]],
                      positions[corners[mirrored ? b : c]]};
      face.material = material;
      face.name = name;
      model_.faces.push_back(std::move(face));
    };
    if (mode == kTriangles)
      for (std::size_t i = 0; i + 2 < corners.size(); i += 3) add(i, i + 1, i + 2);
    else
      for (std::size_t i = 0; i + 2 < corners.size(); ++i)
        mode == kFan ? add(0, i + 1, i + 2) : i % 2 == 0 ? add(i, i + 1, i + 2) : add(i + 1, i, i + 2);
  }

  const ImportInput& input_;
  JsonNode root_;
  GltfBuffers buffers_;
  ImportedModel model_;
  FaceCounter counter_;
  Unknowns unknowns_;
  std::vector<bool> visited_;
};

}  // namespace

ImportedModel read_gltf(const ImportInput& input) {
  const Container container = container_of(input);
  const nlohmann::json json = parse_json_input(container.json, input);
  return GltfReader(input, json, container.binary).run();
}

}  // namespace dim
