#pragma once

#include <string>
#include <unordered_map>

#include "import/imported_model.hpp"
#include "photometry/xml_document.hpp"

namespace dim {

/// Finishes of a gbXML document: by construction and by what a surface is.
class GbxmlMaterials {
 public:
  GbxmlMaterials(const XmlDocument& document, ImportedModel& model) : document_(document), model_(model) {}

  /// @param inwards  the surface's vector area, into the room
  int of_surface(pugi::xml_node surface, const Vec3& inwards, bool is_shade);
  int of_opening(pugi::xml_node opening, bool is_door);

 private:
  int add(ImportedMaterial material);
  pugi::xml_node with_id(const char* element, std::string_view id) const;

  const XmlDocument& document_;
  ImportedModel& model_;
  std::unordered_map<std::string, int> index_;
};

}  // namespace dim
