#include "import/honeybee_modifiers.hpp"

#include <fmt/format.h>

#include <array>

#include "import/radiance_material.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {
namespace {

constexpr const char* kModel = "";

/// Honeybee's generic modifiers, where a model names none: reflectances, and the visible transmittance of
/// windows.
ImportedMaterial generic(const HoneybeeUse& use) {
  ImportedMaterial material;
  const bool is_interior = use.role.starts_with("interior");
  if (use.set == "aperture_set" || use.role.find("glass") != std::string::npos) {
    material.name = is_interior ? "generic_interior_window_vis_0.88" : "generic_exterior_window_vis_0.64";
    material.transmittance = is_interior ? 0.88 : 0.64;
    return material;
  }
  const auto opaque = [&](const char* name, double reflectance) {
    material.name = name;
    material.diffuse = reflectance;
    return material;
  };
  if (use.set == "floor_set") return opaque("generic_floor_0.20", 0.2);
  if (use.set == "roof_ceiling_set") return opaque("generic_ceiling_0.80", 0.8);
  if (use.set == "door_set") return opaque("generic_opaque_door_0.50", 0.5);
  if (use.set == "shade_set")
    return is_interior ? opaque("generic_interior_shade_0.50", 0.5)
                       : opaque("generic_exterior_shade_0.35", 0.35);
  return opaque("generic_wall_0.50", 0.5);
}

}  // namespace

bool has_radiance(const JsonNode& object) {
  return object.has("properties") && object["properties"].has("radiance");
}

JsonNode radiance_of(const JsonNode& object) { return object["properties"]["radiance"]; }

std::string honeybee_modifier_set(const JsonNode& room) {
  return has_radiance(room) ? radiance_of(room).text("modifier_set", "") : "";
}

HoneybeeModifiers::HoneybeeModifiers(const JsonNode* radiance, const ImportInput& input, ImportedModel& model,
                                     Unknowns& unknowns)
    : input_(input), model_(model), unknowns_(unknowns) {
  if (!radiance) return;
  add_modifiers(*radiance);
  if (radiance->has("global_modifier_set") && (*radiance)["global_modifier_set"].is_object()) {
    add_modifiers((*radiance)["global_modifier_set"]);
    add_set((*radiance)["global_modifier_set"], kModel);
  }
  for (std::size_t i = 0; i < radiance->count("modifier_sets"); ++i) {
    const JsonNode set = (*radiance)["modifier_sets"].at(i);
    add_set(set, set["identifier"].text());
  }
}

void HoneybeeModifiers::add_modifiers(const JsonNode& owner) {
  for (std::size_t i = 0; i < owner.count("modifiers"); ++i) add(owner["modifiers"].at(i));
}

void HoneybeeModifiers::add(const JsonNode& modifier) {
  const std::string name = modifier["identifier"].text();
  if (materials_.count(name) > 0) return;
  RadiancePrimitive primitive;
  primitive.type = modifier["type"].text();
  for (char& c : primitive.type)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  primitive.name = name;
  primitive.place = input_.place(0);
  const char* const stems[] = {"reflectance", "transmissivity", "emittance"};
  for (const char* stem : stems)
    for (const char* colour : {"r_", "g_", "b_"})
      if (const std::string key = std::string(colour) + stem; modifier.has(key.c_str()))
        primitive.numbers.push_back(modifier[key.c_str()].number(0.0));
  const auto more = [&](const char* key, double otherwise) {
    primitive.numbers.push_back(modifier.number_or(key, otherwise, 0.0));
  };
  if (primitive.type == "glass") {
    more("refraction_index", 1.52);
  } else if (primitive.type != "mirror") {
    more("specularity", 0.0);
    more("roughness", 0.0);
    more("transmitted_diff", 0.0);
    more("transmitted_spec", 0.0);
  }
  auto material = radiance_material(primitive);
  if (!material) {
    unknowns_.add(fmt::format("modifier {} of type {} is not understood", dim::quoted(name),
                              dim::quoted(primitive.type)),
                  input_.place(0), "surfaces that use it get an assumed reflectance");
    material.emplace();
    material->name = name;
  }
  materials_[name] = static_cast<int>(model_.materials.size());
  model_.materials.push_back(std::move(*material));
}

/// Modifiers stand in place, or by their name.
std::string HoneybeeModifiers::name_of(const JsonNode& modifier) {
  if (modifier.is_text()) return modifier.text();
  add(modifier);
  return modifier["identifier"].text();
}

void HoneybeeModifiers::add_set(const JsonNode& set, const std::string& name) {
  for (const char* part :
       {"wall_set", "floor_set", "roof_ceiling_set", "aperture_set", "door_set", "shade_set"}) {
    if (!set.has(part)) continue;
    for (const char* role :
         {"interior_modifier", "exterior_modifier", "window_modifier", "skylight_modifier",
          "operable_modifier", "overhead_modifier", "interior_glass_modifier", "exterior_glass_modifier"})
      if (set[part].has(role)) sets_[fmt::format("{}/{}/{}", name, part, role)] = name_of(set[part][role]);
  }
}

int HoneybeeModifiers::of(const JsonNode& object, const std::string& room_set, const HoneybeeUse& use) {
  if (has_radiance(object)) {
    const JsonNode radiance = radiance_of(object);
    if (radiance.has("modifier")) return material(name_of(radiance["modifier"]), use);
    if (radiance.count("states") > 0)
      unknowns_.add("states of dynamic windows and shades are not read: the first is taken", input_.place(0),
                    "write them as `states` of the surface");
  }
  const std::string own = fmt::format("{}/{}/{}", room_set, use.set, use.role);
  const std::string model = fmt::format("{}/{}/{}", kModel, use.set, use.role);
  for (const std::string& key : {own, model})
    if (const auto found = sets_.find(key); found != sets_.end()) return material(found->second, use);
  return material("", use);
}

int HoneybeeModifiers::material(const std::string& modifier, const HoneybeeUse& use) {
  const auto known = materials_.find(modifier);
  if (known != materials_.end()) return known->second;
  // A name that the model does not explain is one of Honeybee's library, or a user's.
  ImportedMaterial material = generic(use);
  if (!modifier.empty() && modifier != material.name) {
    unknowns_.add(fmt::format("modifier {} is not in the model: {} is taken", dim::quoted(modifier),
                              dim::quoted(material.name)),
                  input_.place(0));
    material.name = modifier;
  }
  const auto [placed, is_new] = materials_.emplace(material.name, static_cast<int>(model_.materials.size()));
  if (is_new) model_.materials.push_back(std::move(material));
  return placed->second;
}

}  // namespace dim
