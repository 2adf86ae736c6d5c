#pragma once

#include <initializer_list>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "photometry/number_reader.hpp"

namespace dim {

/// An XML text in memory that knows the line of each of its elements. Nothing else is read: entities and
/// includes of other files are not followed. Elements are found by name whatever their namespace prefix.
class XmlDocument {
 public:
  /// @throws InputError  not well-formed, with line and column
  XmlDocument(std::string_view bytes, std::string file_name);

  pugi::xml_node root() const { return document_.document_element(); }
  Place place(pugi::xml_node node) const;

  /// The number that is an element's text, or nothing where the element is not there or empty.
  /// @throws InputError  not a finite number, or outside the limits
  std::optional<double> number(pugi::xml_node parent, std::initializer_list<const char*> names,
                               const Limits& limits) const;
  /// The number of a required element's text or attribute `word`.
  double number_in(pugi::xml_node node, std::string_view word, const std::string& what,
                   const Limits& limits) const;

 private:
  Place place_of_byte(std::ptrdiff_t offset) const;

  std::string file_name_;
  std::vector<std::ptrdiff_t> line_starts_;
  pugi::xml_document document_;
};

/// Name without its namespace prefix.
std::string_view local_name(pugi::xml_node node);
/// The first child element that has one of the names; null where none has.
pugi::xml_node child_of(pugi::xml_node parent, std::initializer_list<const char*> names);
std::vector<pugi::xml_node> children_of(pugi::xml_node parent, std::initializer_list<const char*> names);
/// Text of such a child as UTF-8 on one line, or empty.
std::string text_of(pugi::xml_node parent, std::initializer_list<const char*> names);
/// Value of the first of these attributes, or empty.
std::string_view attribute_of(pugi::xml_node node, std::initializer_list<const char*> names);

}  // namespace dim
