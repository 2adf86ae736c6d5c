#include "import/dae.hpp"

#include <fmt/format.h>

#include <array>
#include <glm/gtx/transform.hpp>

#include "import/dae_geometry.hpp"
#include "import/dae_materials.hpp"
#include "import/token_line.hpp"
#include "import/transform.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {
namespace {

constexpr std::size_t kMostNodes = 1'000'000;
constexpr int kDeepest = 200;

class DaeReader {
 public:
  explicit DaeReader(const ImportInput& input)
      : input_(input),
        document_(input.bytes, input.name),
        materials_(document_, model_, unknowns_),
        geometries_(document_, input, unknowns_),
        counter_(input) {}

  ImportedModel run() {
    if (local_name(document_.root()) != "COLLADA")
      throw InputError({input_.place(1), "is no COLLADA document", ""});
    model_.format = "COLLADA";
    asset();
    for (const auto library : document_.root().children())
      for (const auto entry : library.children())
        if (const auto id = attribute_of(entry, {"id"}); !id.empty()) by_id_.emplace(id, entry);
    // Nodes of a library may stand below others.
    for (const auto library : children_of(document_.root(), {"library_nodes", "library_visual_scenes"}))
      index_nodes(library, 0);
    scene();
    unknowns_.tell(model_.warnings);
    return std::move(model_);
  }

 private:
  void asset() {
    const auto asset = child_of(document_.root(), {"asset"});
    if (const auto unit = child_of(asset, {"unit"}); unit.attribute("meter")) {
      model_.unit_m = document_.number_in(unit, attribute_of(unit, {"meter"}), "unit", {1e-9, 1e6});
    } else {
      model_.unit_m = 1.0;  // so COLLADA has it
    }
    const std::string axis = text_of(asset, {"up_axis"});
    model_.up_stated = true;
    model_.up = axis == "Z_UP" ? UpAxis::z : UpAxis::y;
    if (axis == "X_UP")
      unknowns_.add("x points up, which is not read: y is taken to", document_.place(asset),
                    "turn the model, or give --up");
  }

  void index_nodes(pugi::xml_node parent, int depth) {
    if (depth > kDeepest) throw InputError({document_.place(parent), "nodes are nested too deep", ""});
    for (const auto node : children_of(parent, {"node", "visual_scene"})) {
      if (const auto id = attribute_of(node, {"id"}); !id.empty()) by_id_.emplace(id, node);
      index_nodes(node, depth + 1);
    }
  }

  pugi::xml_node found(pugi::xml_node instance) const {
    const std::string_view url = attribute_of(instance, {"url"});
    const auto found = by_id_.find(std::string(url.starts_with("#") ? url.substr(1) : url));
    if (found == by_id_.end())
      throw InputError({document_.place(instance),
                        fmt::format("refers to {}, which is not in the file", dim::quoted(url)), ""});
    return found->second;
  }

  void scene() {
    const auto instance = child_of(child_of(document_.root(), {"scene"}), {"instance_visual_scene"});
    const auto scene =
        instance ? found(instance)
                 : child_of(child_of(document_.root(), {"library_visual_scenes"}), {"visual_scene"});
    if (scene) {
      for (const auto child : children_of(scene, {"node"})) node(child, Transform(1.0), 0);
      return;
    }
    for (const auto geometry : children_of(child_of(document_.root(), {"library_geometries"}), {"geometry"}))
      place(geometry, {}, "", Transform(1.0));
  }

  void node(pugi::xml_node node, Transform transform, int depth) {
    if (depth > kDeepest || ++n_nodes_ > kMostNodes)
      throw InputError({document_.place(node), "nodes hold themselves, or are nested too deep", ""});
    std::string name(attribute_of(node, {"name"}));
    if (name.empty()) name = attribute_of(node, {"id"});
    for (const auto child : node.children()) {
      const std::string_view kind = local_name(child);
      if (kind == "matrix" || kind == "translate" || kind == "rotate" || kind == "scale")
        transform *= step(child, kind);
      else if (kind == "node")
        this->node(child, transform, depth + 1);
      else if (kind == "instance_node")
        this->node(found(child), transform, depth + 1);
      else if (kind == "instance_geometry")
        place(found(child), child, name, transform);
      else if (child.type() == pugi::node_element && kind != "extra" && kind != "asset")
        unknowns_.add(fmt::format("{} of a node is not read", kind), document_.place(child));
    }
  }

  Transform step(pugi::xml_node node, std::string_view kind) const {
    std::array<double, 16> v{};
    std::size_t n = 0;
    for (const std::string_view word : words_of(node.text().get()))
      if (n < v.size()) v[n++] = document_.number_in(node, word, std::string(kind), {-1e12, 1e12});
    const std::size_t needed = kind == "matrix" ? 16 : kind == "rotate" ? 4 : 3;
    if (n != needed)
      throw InputError({document_.place(node), fmt::format("{} needs {} numbers", kind, needed), ""});
    if (kind == "translate") return glm::translate(Vec3(v[0], v[1], v[2]));
    if (kind == "scale") return glm::scale(Vec3(v[0], v[1], v[2]));
    if (kind == "rotate") {
      const Vec3 axis(v[0], v[1], v[2]);
      return glm::length(axis) > 0.0 ? glm::rotate(radians(v[3]), axis) : Transform(1.0);
    }
    Transform matrix;
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column)
        matrix[column][row] = v[static_cast<std::size_t>(4 * row + column)];
    return matrix;
  }

  void place(pugi::xml_node geometry, pugi::xml_node instance, std::string name, const Transform& transform) {
    if (name.empty()) name = attribute_of(geometry, {"name"});
    const auto bound = materials_.bound_by(instance);
    const std::string id(attribute_of(geometry, {"id"}));
    auto read = polygons_.find(id);
    if (read == polygons_.end()) read = polygons_.emplace(id, geometries_.read(geometry)).first;
    const bool mirrored = mirrors(transform);
    const auto moved_ring = [&](Ring3 ring) {
      for (Vec3& p : ring) p = moved(transform, p);
      if (mirrored) std::reverse(ring.begin(), ring.end());
      return ring;
    };
    for (const DaePolygon& polygon : read->second) {
      if (polygon.outline.size() < 3) {
        unknowns_.add("face of fewer than three corners left out", document_.place(geometry));
        continue;
      }
      counter_.add(polygon.outline.size());
      ImportedFace face;
      face.outline = moved_ring(polygon.outline);
      for (const Ring3& hole : polygon.holes) face.holes.push_back(moved_ring(hole));
      face.material = materials_.of_symbol(polygon.material, bound);
      face.name = name;
      model_.faces.push_back(std::move(face));
    }
  }

  const ImportInput& input_;
  XmlDocument document_;
  ImportedModel model_;
  Unknowns unknowns_;
  DaeMaterials materials_;
  DaeGeometryReader geometries_;
  FaceCounter counter_;
  std::unordered_map<std::string, pugi::xml_node> by_id_;
  std::unordered_map<std::string, std::vector<DaePolygon>> polygons_;
  std::size_t n_nodes_ = 0;
};

}  // namespace

ImportedModel read_dae(const ImportInput& input) { return DaeReader(input).run(); }

}  // namespace dim
