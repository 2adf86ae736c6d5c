#include "import/dae_materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "import/token_line.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {
namespace {

std::string without_hash(std::string_view url) {
  return std::string(url.starts_with("#") ? url.substr(1) : url);
}

pugi::xml_node with_id(pugi::xml_node root, const char* library, const std::string& id) {
  for (const auto entries : children_of(root, {library}))
    for (const auto entry : entries.children())
      if (attribute_of(entry, {"id"}) == id) return entry;
  return {};
}

}  // namespace

DaeMaterials::Binding DaeMaterials::bound_by(pugi::xml_node instance) const {
  Binding binding;
  const auto technique = child_of(child_of(instance, {"bind_material"}), {"technique_common"});
  for (const auto bound : children_of(technique, {"instance_material"}))
    binding[std::string(attribute_of(bound, {"symbol"}))] = without_hash(attribute_of(bound, {"target"}));
  return binding;
}

int DaeMaterials::of_symbol(const std::string& symbol, const Binding& bound) {
  const auto found = bound.find(symbol);
  const std::string id = found != bound.end() ? found->second : symbol;
  const auto [known, is_new] = index_.emplace(id, 0);
  if (is_new) known->second = read(id, symbol);
  return known->second;
}

int DaeMaterials::read(const std::string& id, const std::string& symbol) {
  const auto node = with_id(document_.root(), "library_materials", id);
  ImportedMaterial material;
  material.name = attribute_of(node, {"name"});
  if (material.name.empty()) material.name = node ? id : symbol;
  const auto url = attribute_of(child_of(node, {"instance_effect"}), {"url"});
  if (const auto found = with_id(document_.root(), "library_effects", without_hash(url)))
    effect(found, material);
  model_.materials.push_back(std::move(material));
  return static_cast<int>(model_.materials.size()) - 1;
}

void DaeMaterials::effect(pugi::xml_node effect, ImportedMaterial& material) {
  const auto technique = child_of(child_of(effect, {"profile_COMMON"}), {"technique"});
  const auto shading = child_of(technique, {"lambert", "phong", "blinn", "constant"});
  const auto colour_of = [&](const char* word) -> std::optional<std::array<double, 4>> {
    const auto value = child_of(shading, {word});
    const auto colour = child_of(value, {"color"});
    if (!colour) return std::nullopt;
    std::array<double, 4> rgba{0, 0, 0, 1};
    std::size_t n = 0;
    for (const std::string_view word_of_colour : words_of(colour.text().get()))
      if (n < 4) rgba[n++] = document_.number_in(colour, word_of_colour, word, {0.0, 1e6});
    return rgba;
  };
  if (const auto diffuse = colour_of("diffuse"))
    material.diffuse = luminous((*diffuse)[0], (*diffuse)[1], (*diffuse)[2]);
  if (child_of(child_of(shading, {"diffuse"}), {"texture"}))
    unknowns_.add("pictures on materials are not read: reflectances are assumed", document_.place(shading));
  if (const auto emission = colour_of("emission");
      emission && luminous((*emission)[0], (*emission)[1], (*emission)[2]) > 0.0)
    unknowns_.add(fmt::format("material {}: light of its own is left out", dim::quoted(material.name)),
                  document_.place(shading), "write luminaires in the lights file");
  const auto transparency = child_of(child_of(shading, {"transparency"}), {"float"});
  if (!transparency) return;
  const double value =
      document_.number_in(transparency, trimmed(transparency.text().get()), "transparency", {0.0, 1.0});
  // A_ONE, the default: 1 is opaque. RGB_ZERO: 0 is.
  const bool zero_is_opaque = attribute_of(child_of(shading, {"transparent"}), {"opaque"}) == "RGB_ZERO";
  const double transmittance = zero_is_opaque ? value : 1.0 - value;
  // Exporters that mean the other convention write 0 for what is opaque: nothing transmits everything.
  if (transmittance > 0.0 && transmittance < 1.0) material.transmittance = transmittance;
}

}  // namespace dim
