#include "import/json_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace dim {
namespace {

using Json = nlohmann::json;

constexpr int kDeepest = 200;

/// How deep lists and objects are nested, told without parsing: parsers and what they make go down as deep.
int depth_of(std::string_view text) {
  int depth = 0, deepest = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++depth);
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return deepest;
}

}  // namespace

nlohmann::json parse_json_input(std::string_view text, const ImportInput& input) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (depth_of(text) > kDeepest)
    throw InputError(
        {input.place(0), fmt::format("lists and objects are nested more than {} deep", kDeepest), ""});
  try {
    return Json::parse(text.begin(), text.end());
  } catch (const Json::exception& error) {
    std::size_t byte = 0;
    if (const auto* parse = dynamic_cast<const Json::parse_error*>(&error))
      byte = std::min(parse->byte, text.size());
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(byte), '\n');
    throw InputError({input.place(static_cast<int>(line)), "the JSON is not well-formed here",
                      "the file is damaged or incomplete"});
  }
}

bool JsonNode::has(const char* key) const {
  return json_->is_object() && json_->contains(key) && !(*json_)[key].is_null();
}
bool JsonNode::is_text() const { return json_->is_string(); }
bool JsonNode::is_list() const { return json_->is_array(); }
bool JsonNode::is_object() const { return json_->is_object(); }

JsonNode JsonNode::operator[](const char* key) const {
  const std::string name = name_.empty() ? key : name_ + "." + key;
  if (!has(key)) throw InputError({input_->place(0), name + " is missing", ""});
  return {(*json_)[key], name, *input_};
}

JsonNode JsonNode::at(std::size_t i) const {
  if (i >= size()) fail(fmt::format("has only {} elements", size()));
  return {(*json_)[i], fmt::format("{}[{}]", name_, i), *input_};
}

std::size_t JsonNode::count(const char* key) const { return has(key) ? (*this)[key].size() : 0; }

std::size_t JsonNode::size() const {
  if (!json_->is_array()) fail("is no list");
  return json_->size();
}

std::string JsonNode::text() const {
  if (!json_->is_string()) fail("is no text");
  return json_->get<std::string>();
}

std::string JsonNode::text(const char* key, const std::string& otherwise) const {
  return has(key) ? (*this)[key].text() : otherwise;
}

double JsonNode::number(double low, double high) const {
  if (!json_->is_number()) fail("is no number");
  const double value = json_->get<double>();
  if (!std::isfinite(value) || !(value >= low && value <= high))
    fail(fmt::format("is {:g}, outside {:g}..{:g}", value, low, high));
  return value;
}

double JsonNode::number_or(const char* key, double otherwise, double low, double high) const {
  return has(key) ? (*this)[key].number(low, high) : otherwise;
}

bool JsonNode::flag(const char* key, bool otherwise) const {
  if (!has(key)) return otherwise;
  const JsonNode node = (*this)[key];
  if (!node.json_->is_boolean()) node.fail("is neither true nor false");
  return node.json_->get<bool>();
}

std::size_t JsonNode::index(std::size_t n) const {
  if (!json_->is_number_unsigned() || json_->get<std::uint64_t>() >= n)
    fail(fmt::format("is no whole number below {}", n));
  return json_->get<std::size_t>();
}

std::size_t JsonNode::whole(const char* key, std::size_t otherwise) const {
  return has(key) ? (*this)[key].index(std::size_t{1} << 62) : otherwise;
}

Vec3 JsonNode::vec3() const {
  if (size() != 3) fail(fmt::format("has {} numbers instead of 3", size()));
  return {at(0).number(), at(1).number(), at(2).number()};
}

void JsonNode::fail(const std::string& what) const {
  throw InputError({input_->place(0), (name_.empty() ? "the JSON" : name_) + " " + what, ""});
}

}  // namespace dim
