#include "photometry/xml_document.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "photometry/text_scanner.hpp"

namespace dim {
namespace {

bool named(pugi::xml_node node, std::initializer_list<const char*> names) {
  const std::string_view own = local_name(node);
  return std::any_of(names.begin(), names.end(), [&](const char* name) { return own == name; });
}

}  // namespace

XmlDocument::XmlDocument(std::string_view bytes, std::string file_name) : file_name_(std::move(file_name)) {
  line_starts_.push_back(0);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    if (bytes[i] == '\n') line_starts_.push_back(static_cast<std::ptrdiff_t>(i) + 1);
  const auto result = document_.load_buffer(bytes.data(), bytes.size());
  if (!result)
    throw InputError({place_of_byte(result.offset),
                      std::string("the XML is not well-formed: ") + result.description(),
                      "the file is damaged or incomplete"});
}

Place XmlDocument::place_of_byte(std::ptrdiff_t offset) const {
  if (offset < 0) return {file_name_, 0, 0};
  const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  const auto line = next - line_starts_.begin();
  return {file_name_, static_cast<int>(line), static_cast<int>(offset - *(next - 1)) + 1};
}

Place XmlDocument::place(pugi::xml_node node) const { return place_of_byte(node.offset_debug()); }

double XmlDocument::number_in(pugi::xml_node node, std::string_view word, const std::string& what,
                              const Limits& limits) const {
  double value = 0.0;
  if (!parse_number(word, value))
    throw InputError({place(node), fmt::format("{}: {} is not a finite number", what, quoted(word)), ""});
  if (value < limits.least || value > limits.greatest)
    throw InputError({place(node), fmt::format("{} {} is {}", what, value, outside(limits)), ""});
  return value;
}

std::optional<double> XmlDocument::number(pugi::xml_node parent, std::initializer_list<const char*> names,
                                          const Limits& limits) const {
  const auto node = child_of(parent, names);
  const std::string text = node ? to_utf8(node.text().get()) : "";
  const auto word = trimmed(text);
  if (word.empty()) return std::nullopt;
  return number_in(node, word, std::string(local_name(node)), limits);
}

std::string_view local_name(pugi::xml_node node) {
  const std::string_view name = node.name();
  const auto colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

pugi::xml_node child_of(pugi::xml_node parent, std::initializer_list<const char*> names) {
  for (const auto child : parent.children())
    if (named(child, names)) return child;
  return {};
}

std::vector<pugi::xml_node> children_of(pugi::xml_node parent, std::initializer_list<const char*> names) {
  std::vector<pugi::xml_node> found;
  for (const auto child : parent.children())
    if (named(child, names)) found.push_back(child);
  return found;
}

std::string text_of(pugi::xml_node parent, std::initializer_list<const char*> names) {
  return std::string(trimmed(to_utf8(child_of(parent, names).text().get())));
}

std::string_view attribute_of(pugi::xml_node node, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (const auto attribute = node.attribute(name)) return trimmed(attribute.value());
  return {};
}

}  // namespace dim
