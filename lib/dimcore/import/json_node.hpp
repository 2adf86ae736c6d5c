#pragma once

#include <cmath>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "import/import_input.hpp"

namespace dim {

/// A value of a JSON file to be imported, that knows where it stands: what is missing, of another type or out
/// of range is refused by its name, `meshes[2].primitives[0].mode is 9, outside 0..6`. Refers to the JSON and
/// the input.
/// @throws InputError  from every member
class JsonNode {
 public:
  JsonNode(const nlohmann::json& json, const ImportInput& input) : json_(&json), input_(&input) {}

  bool has(const char* key) const;
  JsonNode operator[](const char* key) const;
  JsonNode at(std::size_t i) const;
  /// Elements of a list; 0 of a list that is not there: `node.count("meshes")`.
  std::size_t count(const char* key) const;
  std::size_t size() const;
  bool is_text() const;
  bool is_list() const;
  bool is_object() const;
  std::string text() const;
  std::string text(const char* key, const std::string& otherwise) const;
  double number(double low = -HUGE_VAL, double high = HUGE_VAL) const;
  double number_or(const char* key, double otherwise, double low = -HUGE_VAL, double high = HUGE_VAL) const;
  bool flag(const char* key, bool otherwise) const;
  /// Below `n`.
  std::size_t index(std::size_t n) const;
  /// A whole number of at least 0.
  std::size_t whole(const char* key, std::size_t otherwise) const;
  Vec3 vec3() const;
  const std::string& name() const { return name_; }
  const nlohmann::json& json() const { return *json_; }

  [[noreturn]] void fail(const std::string& what) const;

 private:
  JsonNode(const nlohmann::json& json, std::string name, const ImportInput& input)
      : json_(&json), name_(std::move(name)), input_(&input) {}

  const nlohmann::json* json_;
  std::string name_;
  const ImportInput* input_;
};

/// @throws InputError  no JSON, or lists and objects nested more than 200 deep
nlohmann::json parse_json_input(std::string_view text, const ImportInput& input);

}  // namespace dim
