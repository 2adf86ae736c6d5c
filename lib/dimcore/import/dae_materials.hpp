#pragma once

#include <string>
#include <unordered_map>

#include "import/import_input.hpp"
#include "photometry/xml_document.hpp"

namespace dim {

/// Materials and effects of a COLLADA document.
class DaeMaterials {
 public:
  using Binding = std::unordered_map<std::string, std::string>;  ///< symbol → material's id

  DaeMaterials(const XmlDocument& document, ImportedModel& model, Unknowns& unknowns)
      : document_(document), model_(model), unknowns_(unknowns) {}

  Binding bound_by(pugi::xml_node instance_geometry) const;
  /// Index of the material that a symbol is bound to, else of that whose id is the symbol.
  int of_symbol(const std::string& symbol, const Binding& bound);

 private:
  int read(const std::string& id, const std::string& symbol);
  void effect(pugi::xml_node effect, ImportedMaterial& material);

  const XmlDocument& document_;
  ImportedModel& model_;
  Unknowns& unknowns_;
  std::unordered_map<std::string, int> index_;  ///< by id
};

}  // namespace dim
