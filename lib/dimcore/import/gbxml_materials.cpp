#include "import/gbxml_materials.hpp"

#include <fmt/format.h>

#include "photometry/text_scanner.hpp"

namespace dim {
namespace {

/// gbXML of a share: 0 to 1, or per cent where its unit says so.
std::optional<double> visible(const XmlDocument& document, pugi::xml_node parent, const char* element) {
  for (const auto value : children_of(parent, {element})) {
    if (attribute_of(value, {"type"}) != "Visible") continue;
    const bool is_percent = attribute_of(value, {"unit"}) == "Percent";
    return document.number_in(value, trimmed(value.text().get()), element, {0.0, is_percent ? 100.0 : 1.0}) /
           (is_percent ? 100.0 : 1.0);
  }
  return std::nullopt;
}

struct Kind {
  const char* name;
  double reflectance;
};

Kind kind_of(const Vec3& inwards) {
  const double up = inwards.z / glm::length(inwards);
  if (up > 0.7) return {"floor", 0.2};
  return up < -0.7 ? Kind{"ceiling", 0.7} : Kind{"wall", 0.5};
}

}  // namespace

pugi::xml_node GbxmlMaterials::with_id(const char* element, std::string_view id) const {
  if (id.empty()) return {};
  for (const auto node : children_of(document_.root(), {element}))
    if (attribute_of(node, {"id"}) == id) return node;
  return {};
}

int GbxmlMaterials::add(ImportedMaterial material) {
  const auto [found, is_new] = index_.emplace(material.name, static_cast<int>(model_.materials.size()));
  if (is_new) model_.materials.push_back(std::move(material));
  return found->second;
}

int GbxmlMaterials::of_surface(pugi::xml_node surface, const Vec3& inwards, bool is_shade) {
  ImportedMaterial material;
  const Kind kind = is_shade || !(glm::length(inwards) > 0.0) ? Kind{"shade", 0.35} : kind_of(inwards);
  const auto construction = with_id("Construction", attribute_of(surface, {"constructionIdRef"}));
  const std::string name = text_of(construction, {"Name"});
  material.name = name.empty() ? kind.name : fmt::format("{} ({})", name, kind.name);
  material.assumed = kind.reflectance;
  material.diffuse = visible(document_, construction, "Reflectance");
  return add(std::move(material));
}

int GbxmlMaterials::of_opening(pugi::xml_node opening, bool is_door) {
  ImportedMaterial material;
  if (is_door) {
    material.name = "door";
    return add(std::move(material));
  }
  const auto type = with_id("WindowType", attribute_of(opening, {"windowTypeIdRef"}));
  material.name = text_of(type, {"Name"});
  if (material.name.empty()) material.name = type ? std::string(attribute_of(type, {"id"})) : "window";
  material.is_glass = true;
  material.transmittance = visible(document_, type, "Transmittance");
  return add(std::move(material));
}

}  // namespace dim
