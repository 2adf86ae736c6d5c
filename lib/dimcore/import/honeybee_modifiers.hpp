#pragma once

#include <string>
#include <unordered_map>

#include "import/json_node.hpp"

namespace dim {

/// What kind of surface asks for its modifier: the names of Honeybee's modifier sets.
struct HoneybeeUse {
  std::string set;   ///< "wall_set", …
  std::string role;  ///< "interior_modifier", …
};

/// The modifiers of a Honeybee model: by a surface's own, its room's set, the model's, Honeybee's generic
/// ones.
class HoneybeeModifiers {
 public:
  /// @param radiance  the model's Radiance properties, or nothing
  HoneybeeModifiers(const JsonNode* radiance, const ImportInput& input, ImportedModel& model,
                    Unknowns& unknowns);

  /// Material of a face, aperture, door or shade.
  /// @param room_set  name of its room's modifier set, or empty
  int of(const JsonNode& object, const std::string& room_set, const HoneybeeUse& use);

 private:
  void add_modifiers(const JsonNode& owner);
  void add(const JsonNode& modifier);
  void add_set(const JsonNode& set, const std::string& name);
  std::string name_of(const JsonNode& modifier);
  int material(const std::string& modifier, const HoneybeeUse& use);

  const ImportInput& input_;
  ImportedModel& model_;
  Unknowns& unknowns_;
  std::unordered_map<std::string, int> materials_;
  std::unordered_map<std::string, std::string> sets_;  ///< "SET/wall_set/interior_modifier" → modifier
};

/// Name of the modifier set of a room; empty where it has none.
std::string honeybee_modifier_set(const JsonNode& room);

/// The Radiance properties of an object, where it has any.
bool has_radiance(const JsonNode& object);
JsonNode radiance_of(const JsonNode& object);

}  // namespace dim
