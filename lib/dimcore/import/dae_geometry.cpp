#include "import/dae_geometry.hpp"

#include <fmt/format.h>

#include <cmath>

#include "import/token_line.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {
namespace {

std::string without_hash(std::string_view url) {
  return std::string(url.starts_with("#") ? url.substr(1) : url);
}

}  // namespace

void DaeGeometryReader::refuse(pugi::xml_node node, const std::string& what) const {
  throw InputError({document_.place(node), what, ""});
}

std::vector<double> DaeGeometryReader::numbers(pugi::xml_node node) const {
  std::vector<double> numbers;
  for (const std::string_view word : words_of(node.text().get())) {
    double value = 0.0;
    if (!parse_number(word, value)) refuse(node, fmt::format("{} is no finite number", dim::quoted(word)));
    numbers.push_back(value);
  }
  return numbers;
}

std::vector<std::size_t> DaeGeometryReader::indices(pugi::xml_node node) const {
  std::vector<std::size_t> indices;
  for (const double value : numbers(node)) {
    if (!(value >= 0.0 && value < 4e9) || value != std::floor(value))
      refuse(node, fmt::format("{:g} is no index", value));
    indices.push_back(static_cast<std::size_t>(value));
  }
  return indices;
}

std::vector<Vec3> DaeGeometryReader::source(pugi::xml_node node) const {
  const auto values = numbers(child_of(node, {"float_array"}));
  const auto accessor = child_of(child_of(node, {"technique_common"}), {"accessor"});
  const std::size_t stride = accessor.attribute("stride").as_uint(3),
                    offset = accessor.attribute("offset").as_uint(0);
  if (stride < 3 || stride > 64) refuse(node, fmt::format("positions of {} numbers each", stride));
  std::vector<Vec3> points;
  for (std::size_t i = offset; i + 2 < values.size(); i += stride)
    points.emplace_back(values[i], values[i + 1], values[i + 2]);
  return points;
}

std::vector<DaePolygon> DaeGeometryReader::read(pugi::xml_node geometry) {
  std::vector<DaePolygon> polygons;
  const auto mesh = child_of(geometry, {"mesh"});
  if (!mesh) {
    unknowns_.add("a geometry that is no mesh is left out", document_.place(geometry));
    return polygons;
  }
  sources_.clear();
  // Positions alone: normals and texture coordinates may be shorter and are not needed.
  for (const auto input : children_of(child_of(mesh, {"vertices"}), {"input"}))
    if (attribute_of(input, {"semantic"}) == "POSITION")
      for (const auto node : children_of(mesh, {"source"}))
        if (attribute_of(node, {"id"}) == without_hash(attribute_of(input, {"source"})))
          sources_[std::string(attribute_of(child_of(mesh, {"vertices"}), {"id"}))] = source(node);
  for (const auto child : mesh.children()) {
    const std::string_view name = local_name(child);
    if (name != "source" && name != "vertices" && name != "extra" && child.type() == pugi::node_element)
      primitive(child, polygons);
  }
  return polygons;
}

DaeGeometryReader::Layout DaeGeometryReader::layout(pugi::xml_node primitive) const {
  Layout layout;
  std::size_t n_inputs = 0;
  for (const auto input : children_of(primitive, {"input"})) {
    const std::size_t offset = input.attribute("offset").as_uint(0);
    if (offset > 64) refuse(input, fmt::format("an offset of {}", offset));
    n_inputs = std::max(n_inputs, offset + 1);
    if (attribute_of(input, {"semantic"}) != "VERTEX") continue;
    const auto found = sources_.find(without_hash(attribute_of(input, {"source"})));
    if (found == sources_.end()) refuse(input, "refers to positions that are not there");
    layout.positions = &found->second;
    layout.offset = offset;
  }
  if (!layout.positions) refuse(primitive, "has no input VERTEX");
  layout.n_inputs = n_inputs;
  return layout;
}

Ring3 DaeGeometryReader::ring(const Layout& layout, const std::vector<std::size_t>& p, std::size_t first,
                              std::size_t n, pugi::xml_node node) const {
  Ring3 ring;
  for (std::size_t i = first; i < first + n; ++i) {
    const std::size_t at = i * layout.n_inputs + layout.offset;
    if (at >= p.size() || p[at] >= layout.positions->size()) refuse(node, "names corners that are not there");
    ring.push_back((*layout.positions)[p[at]]);
  }
  return ring;
}

void DaeGeometryReader::primitive(pugi::xml_node node, std::vector<DaePolygon>& out) {
  const std::string_view kind = local_name(node);
  if (kind == "lines" || kind == "linestrips") {
    unknowns_.add("lines are left out", document_.place(node));
    return;
  }
  const bool is_known = kind == "triangles" || kind == "polylist" || kind == "polygons" ||
                        kind == "tristrips" || kind == "trifans";
  if (!is_known) {
    unknowns_.add(fmt::format("element {} of a mesh is not understood and left out", dim::quoted(kind)),
                  document_.place(node));
    return;
  }
  if (!child_of(node, {"p", "ph"})) return;
  const Layout layout = this->layout(node);
  const std::string material(attribute_of(node, {"material"}));
  const auto add = [&](Ring3 outline) { out.push_back({std::move(outline), {}, material}); };
  if (kind == "polygons") {
    polygons(node, layout, out);
    return;
  }
  for (const auto list : children_of(node, {"p"})) {
    const auto p = indices(list);
    const std::size_t n = p.size() / layout.n_inputs;
    if (kind == "triangles")
      for (std::size_t i = 0; i + 2 < n; i += 3) add(ring(layout, p, i, 3, list));
    if (kind == "polylist") {
      std::size_t first = 0;
      for (const std::size_t count : indices(child_of(node, {"vcount"}))) {
        if (count > n - std::min(first, n)) refuse(list, "has fewer corners than vcount says");
        add(ring(layout, p, first, count, list));
        first += count;
      }
    }
    const Ring3 row = kind == "tristrips" || kind == "trifans" ? ring(layout, p, 0, n, list) : Ring3{};
    for (std::size_t i = 0; i + 2 < row.size(); ++i)
      add(kind == "trifans" ? Ring3{row[0], row[i + 1], row[i + 2]}
          : i % 2 == 0      ? Ring3{row[i], row[i + 1], row[i + 2]}
                            : Ring3{row[i + 1], row[i], row[i + 2]});
  }
}

void DaeGeometryReader::polygons(pugi::xml_node node, const Layout& layout,
                                 std::vector<DaePolygon>& out) const {
  const auto whole = [&](pugi::xml_node list) {
    const auto p = indices(list);
    return ring(layout, p, 0, p.size() / layout.n_inputs, list);
  };
  const std::string material(attribute_of(node, {"material"}));
  for (const auto list : children_of(node, {"p"})) out.push_back({whole(list), {}, material});
  for (const auto with_holes : children_of(node, {"ph"})) {
    DaePolygon polygon{whole(child_of(with_holes, {"p"})), {}, material};
    for (const auto hole : children_of(with_holes, {"h"})) polygon.holes.push_back(whole(hole));
    out.push_back(std::move(polygon));
  }
}

}  // namespace dim
