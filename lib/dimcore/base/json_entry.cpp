#include "base/json_entry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.hpp"

namespace dim {

using Json = nlohmann::json;

JsonEntry JsonEntry::operator[](const char* key) const {
  const std::string name = name_.empty() ? key : name_ + "." + key;
  if (!has(key)) throw IoError(path_, fmt::format("'{}': {} is missing", dataset_, name));
  return {json_[key], name, *this};
}

JsonEntry JsonEntry::at(std::size_t i) const {
  return {json_.at(i), fmt::format("{}[{}]", name_, i), *this};
}

bool JsonEntry::is_null() const { return json_.is_null(); }

bool JsonEntry::has(const char* key) const { return json_.is_object() && json_.contains(key); }

std::size_t JsonEntry::size(std::size_t n) const {
  if (!json_.is_array()) fail("is no list");
  if (n != kAny && json_.size() != n) fail(fmt::format("has {} elements, expected {}", json_.size(), n));
  return json_.size();
}

std::string JsonEntry::text() const {
  if (!json_.is_string()) fail("is no text");
  return json_.get<std::string>();
}

std::size_t JsonEntry::word(const std::vector<std::string>& words) const {
  const auto found = std::find(words.begin(), words.end(), text());
  if (found == words.end()) fail(fmt::format("is '{}', not one of {}", text(), fmt::join(words, ", ")));
  return static_cast<std::size_t>(found - words.begin());
}

bool JsonEntry::flag() const {
  if (!json_.is_boolean()) fail("is neither true nor false");
  return json_.get<bool>();
}

double JsonEntry::number(double low, double high) const {
  if (!json_.is_number()) fail("is no number");
  const double value = json_.get<double>();
  if (!(value >= low && value <= high) || !std::isfinite(value))
    fail(fmt::format("is {:g}, outside {:g}..{:g}", value, low, high));
  return value;
}

double JsonEntry::bound() const {
  return json_.is_null() ? std::numeric_limits<double>::infinity() : number(0.0);
}

double JsonEntry::positive() const {
  const double value = number(0.0);
  if (!(value > 0.0)) fail("is 0, expected more");
  return value;
}

int JsonEntry::integer(int low, int high) const {
  if (!json_.is_number_integer()) fail("is no whole number");
  return static_cast<int>(number(low, high));
}

std::size_t JsonEntry::index(std::size_t n) const {
  if (!json_.is_number_unsigned() || json_.get<std::size_t>() >= n)
    fail(fmt::format("is {}, not a whole number below {}", dump_json(json_).substr(0, 40), n));
  return json_.get<std::size_t>();
}

std::vector<double> JsonEntry::numbers(std::size_t n, double low) const {
  std::vector<double> values;
  for (std::size_t i = 0; i < size(n); ++i) values.push_back(at(i).number(low));
  return values;
}

Vec3 JsonEntry::vec3() const {
  const auto v = numbers(3);
  return {v[0], v[1], v[2]};
}

void JsonEntry::fail(const std::string& what) const {
  throw IoError(path_, fmt::format("'{}': {} {}", dataset_, name_.empty() ? "it" : name_, what));
}

Json parse_json(const std::string& text, const std::string& dataset, const std::string& path) {
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) throw IoError(path, "'" + dataset + "' is not JSON");
  return json;
}

std::string dump_json(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace dim
