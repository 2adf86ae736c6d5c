#include "database/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace dim {
namespace {

const char* type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "text";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

std::string shown(const std::string& text) {
  constexpr std::size_t kLongest = 60;
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

}  // namespace

std::string short_number(double value) { return fmt::format("{:.6g}", value == 0.0 ? 0.0 : value); }

std::string short_point(const Vec3& p) {
  return fmt::format("({}, {}, {})", short_number(p.x), short_number(p.y), short_number(p.z));
}

bool NumberRange::contains(double value) const {
  return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

std::string NumberRange::text() const {
  const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
  const std::string above = fmt::format("{} {}", low_open ? "greater than" : "at least", short_number(low));
  const std::string below = fmt::format("{} {}", high_open ? "less than" : "at most", short_number(high));
  if (has_low && has_high)
    return low_open || high_open ? above + " and " + below
                                 : fmt::format("{} to {}", short_number(low), short_number(high));
  return has_low ? above : has_high ? below : "any finite number";
}

Place place_of(const toml::source_region& region, const std::string& file) {
  if (region.path && region.path->starts_with("--set ")) return {*region.path, 0, 0};
  return {file, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

TomlTable::TomlTable(const toml::table& table, std::string label, TomlContext& context)
    : table_(&table),
      label_(std::move(label)),
      context_(&context),
      asked_(std::make_shared<std::set<std::string, std::less<>>>()) {}

const toml::node* TomlTable::node(std::string_view key) const {
  asked_->emplace(key);
  return table_->get(key);
}

bool TomlTable::has(std::string_view key) const { return node(key) != nullptr; }

Place TomlTable::place(std::string_view key) const {
  const auto* value = table_->get(key);
  return value ? place_of(value->source(), context_->file) : place();
}

void TomlTable::problem(std::string_view key, const std::string& what, const std::string& cure) const {
  context_->problems.add(place(key), label_.empty() ? what : label_ + ": " + what, cure);
}

bool TomlTable::require(std::string_view key, const std::string& cure) const {
  if (has(key)) return true;
  problem(key, fmt::format("'{}' is missing", key), cure);
  return false;
}

const toml::node* TomlTable::typed(std::string_view key, toml::node_type type, const char* wanted) const {
  const auto* value = node(key);
  if (!value) return nullptr;
  if (value->type() == type) return value;
  problem(key, fmt::format("{} must be {}, not {}", key, wanted, type_name(*value)));
  return nullptr;
}

std::optional<double> percentage(std::string_view text) {
  const auto mark = text.find_last_not_of(' ');
  if (mark == std::string_view::npos || text[mark] != '%') return std::nullopt;
  text = text.substr(0, mark);
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value / 100.0;
}

bool TomlTable::number_in(const toml::node& node, std::string_view key, const NumberRange& range,
                          double& out) const {
  const auto complain = [&](const std::string& what) {
    context_->problems.add(place_of(node.source(), context_->file),
                           (label_.empty() ? "" : label_ + ": ") + what);
    return false;
  };
  const auto percent = range.share && node.is_string() ? percentage(node.as_string()->get()) : std::nullopt;
  const auto value = percent ? percent : node.value<double>();
  if (!(node.is_number() || percent) || !value)
    return complain(fmt::format("{} must be a number, not {}", key, type_name(node)));
  if (!std::isfinite(*value)) return complain(fmt::format("{} must be finite, not {}", key, *value));
  if (!range.contains(*value))
    return complain(fmt::format("{} must be {}, not {}", key, range.text(), short_number(*value)));
  out = *value;
  return true;
}

bool TomlTable::numbers_in(const toml::node& node, std::string_view key, std::size_t size,
                           const NumberRange& range, std::vector<double>& out) const {
  const auto* array = node.as_array();
  if (!array || array->size() != size) {
    context_->problems.add(
        place_of(node.source(), context_->file),
        fmt::format("{}{}{} must be {} numbers, not {}", label_, label_.empty() ? "" : ": ", key, size,
                    array ? fmt::format("{}", array->size()) : type_name(node)));
    return false;
  }
  out.resize(size);
  for (std::size_t i = 0; i < size; ++i) {
    if (!number_in((*array)[i], key, range, out[i])) return false;
  }
  return true;
}

std::optional<double> TomlTable::number(std::string_view key, const NumberRange& range) const {
  const auto* value = node(key);
  double result = 0.0;
  if (!value || !number_in(*value, key, range, result)) return std::nullopt;
  return result;
}

double TomlTable::number_or(std::string_view key, const NumberRange& range, double otherwise) const {
  return number(key, range).value_or(otherwise);
}

std::optional<int> TomlTable::integer(std::string_view key, int low, int high) const {
  const auto value = number(key, {static_cast<double>(low), static_cast<double>(high)});
  if (!value) return std::nullopt;
  if (*value == std::floor(*value)) return static_cast<int>(*value);
  problem(key, fmt::format("{} must be a whole number, not {}", key, short_number(*value)));
  return std::nullopt;
}

std::optional<std::string> TomlTable::text(std::string_view key) const {
  const auto* value = typed(key, toml::node_type::string, "text");
  if (!value) return std::nullopt;
  return value->as_string()->get();
}

std::optional<std::string> TomlTable::word(std::string_view key,
                                           const std::vector<std::string>& words) const {
  auto value = text(key);
  if (!value || std::count(words.begin(), words.end(), *value)) return value;
  std::string all;
  for (const auto& one : words) all += (all.empty() ? "" : ", ") + one;
  const auto suggestion = did_you_mean(*value, words);
  problem(key, fmt::format("{} must be one of {}, not '{}'", key, all, shown(*value)), suggestion);
  return std::nullopt;
}

std::optional<std::string> TomlTable::name(std::string_view key) const {
  constexpr std::size_t kLongestName = 200;
  auto value = text(key);
  if (!value) return std::nullopt;
  const bool printable = std::none_of(
      value->begin(), value->end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
  if (!value->empty() && value->size() <= kLongestName && printable) return value;
  problem(key, fmt::format("{} must be 1 to {} printable characters", key, kLongestName));
  return std::nullopt;
}

bool TomlTable::flag(std::string_view key, bool otherwise) const {
  const auto* value = typed(key, toml::node_type::boolean, "true or false");
  return value ? value->as_boolean()->get() : otherwise;
}

std::optional<std::vector<std::string>> TomlTable::texts(std::string_view key) const {
  const auto* value = typed(key, toml::node_type::array, "an array of texts");
  if (!value) return std::nullopt;
  std::vector<std::string> result;
  for (const auto& element : *value->as_array()) {
    const auto* string = element.as_string();
    if (!string) {
      context_->problems.add(
          place_of(element.source(), context_->file),
          fmt::format("{}: {} must be an array of texts, not of {}", label_, key, type_name(element)));
      return std::nullopt;
    }
    result.push_back(string->get());
  }
  return result;
}

std::optional<std::vector<double>> TomlTable::numbers(std::string_view key, std::size_t size,
                                                      const NumberRange& range) const {
  const auto* value = node(key);
  std::vector<double> result;
  if (!value || !numbers_in(*value, key, size, range, result)) return std::nullopt;
  return result;
}

std::optional<Vec3> TomlTable::vec3(std::string_view key, const NumberRange& range) const {
  const auto values = numbers(key, 3, range);
  if (!values) return std::nullopt;
  return Vec3((*values)[0], (*values)[1], (*values)[2]);
}

std::optional<std::pair<int, int>> TomlTable::integers2(std::string_view key, int low, int high) const {
  const auto values = numbers(key, 2, {static_cast<double>(low), static_cast<double>(high)});
  if (!values) return std::nullopt;
  if ((*values)[0] == std::floor((*values)[0]) && (*values)[1] == std::floor((*values)[1]))
    return std::pair{static_cast<int>((*values)[0]), static_cast<int>((*values)[1])};
  problem(key, fmt::format("{} must be two whole numbers", key));
  return std::nullopt;
}

std::optional<std::vector<std::vector<double>>> TomlTable::rows(std::string_view key, std::size_t size,
                                                                const NumberRange& range) const {
  const auto* value = typed(key, toml::node_type::array, "an array of arrays of numbers");
  if (!value) return std::nullopt;
  std::vector<std::vector<double>> result;
  for (const auto& element : *value->as_array()) {
    result.emplace_back();
    if (!numbers_in(element, key, size, range, result.back())) return std::nullopt;
  }
  return result;
}

bool TomlTable::ring_in(const toml::node& node, std::string_view key, std::vector<Vec3>& out) const {
  const auto* array = node.as_array();
  if (!array) {
    context_->problems.add(
        place_of(node.source(), context_->file),
        fmt::format("{}: {} must be an array of points [x, y, z], not {}", label_, key, type_name(node)));
    return false;
  }
  out.reserve(array->size());
  std::vector<double> p;
  for (const auto& element : *array) {
    if (!numbers_in(element, key, 3, kCoordinate, p)) return false;
    out.emplace_back(p[0], p[1], p[2]);
  }
  return true;
}

std::optional<std::vector<Vec3>> TomlTable::ring(std::string_view key) const {
  const auto* value = node(key);
  std::vector<Vec3> result;
  if (!value || !ring_in(*value, key, result)) return std::nullopt;
  return result;
}

std::optional<std::vector<std::vector<Vec3>>> TomlTable::rings(std::string_view key) const {
  const auto* value = typed(key, toml::node_type::array, "an array of outlines");
  if (!value) return std::nullopt;
  std::vector<std::vector<Vec3>> result;
  for (const auto& element : *value->as_array()) {
    result.emplace_back();
    if (!ring_in(element, key, result.back())) return std::nullopt;
  }
  return result;
}

std::optional<TomlTable> TomlTable::table(std::string_view key, std::string label) const {
  const auto* value = typed(key, toml::node_type::table, "a table");
  if (!value) return std::nullopt;
  return TomlTable(*value->as_table(), std::move(label), *context_);
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
  std::vector<TomlTable> result;
  const auto* value = node(key);
  if (!value) return result;
  const auto* array = value->as_array();
  if (!array) {
    problem(key, fmt::format("{} must be a list of tables", key),
            fmt::format("write [[{}]] before each", key));
    return result;
  }
  for (std::size_t i = 0; i < array->size(); ++i) {
    const toml::node& element = (*array)[i];
    if (const auto* table = element.as_table()) {
      const auto name = (*table)["name"].value<std::string>();
      result.emplace_back(*table,
                          name ? fmt::format("{} '{}'", key, shown(*name)) : fmt::format("{} {}", key, i + 1),
                          *context_);
    } else {
      context_->problems.add(place_of(element.source(), context_->file),
                             fmt::format("{} must be a list of tables, not of {}", key, type_name(element)),
                             fmt::format("write [[{}]] before each", key));
    }
  }
  return result;
}

void TomlTable::refuse_unknown() const {
  const std::vector<std::string> known(asked_->begin(), asked_->end());
  for (const auto& [key, value] : *table_) {
    if (asked_->contains(key.str())) continue;
    const std::string word(key.str());
    context_->problems.add(
        place_of(key.source(), context_->file),
        fmt::format("{}{}unknown key '{}'", label_, label_.empty() ? "" : ": ", shown(word)),
        did_you_mean(word, known));
  }
}

}  // namespace dim
