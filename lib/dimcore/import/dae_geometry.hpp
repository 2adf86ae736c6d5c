#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "import/import_input.hpp"
#include "photometry/xml_document.hpp"

namespace dim {

/// A polygon of a COLLADA mesh: corners as they stand in its sources.
struct DaePolygon {
  Ring3 outline;
  std::vector<Ring3> holes;
  std::string material;  ///< symbol, bound to a material where the geometry is placed
};

/// Reads <geometry> elements: triangles, polylists, polygons with holes, strips and fans.
class DaeGeometryReader {
 public:
  DaeGeometryReader(const XmlDocument& document, const ImportInput& input, Unknowns& unknowns)
      : document_(document), input_(input), unknowns_(unknowns) {}

  /// @throws InputError
  std::vector<DaePolygon> read(pugi::xml_node geometry);

 private:
  struct Layout {
    const std::vector<Vec3>* positions = nullptr;
    std::size_t offset = 0;  ///< of the position's index among those of a corner
    std::size_t n_inputs = 1;
  };

  std::vector<Vec3> source(pugi::xml_node source) const;
  std::vector<double> numbers(pugi::xml_node node) const;
  std::vector<std::size_t> indices(pugi::xml_node node) const;
  Layout layout(pugi::xml_node primitive) const;
  Ring3 ring(const Layout& layout, const std::vector<std::size_t>& p, std::size_t first, std::size_t n,
             pugi::xml_node node) const;
  void primitive(pugi::xml_node node, std::vector<DaePolygon>& out);
  void polygons(pugi::xml_node node, const Layout& layout, std::vector<DaePolygon>& out) const;
  [[noreturn]] void refuse(pugi::xml_node node, const std::string& what) const;

  const XmlDocument& document_;
  const ImportInput& input_;
  Unknowns& unknowns_;
  std::unordered_map<std::string, std::vector<Vec3>> sources_;  ///< of the mesh being read, by id
};

}  // namespace dim
