#include "base/file_layout.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/input_file.hpp"

namespace dim {
namespace {

constexpr std::string_view kTypeNames[] = {"uint8", "uint16", "uint32", "uint64", "int32", "int64", "float32",
                                           "float64"};
constexpr std::size_t kTypeBytes[] = {1, 2, 4, 8, 4, 8, 4, 8};

std::string_view name_of(ElementType type) { return kTypeNames[static_cast<std::size_t>(type)]; }
std::size_t bytes_of(ElementType type) { return kTypeBytes[static_cast<std::size_t>(type)]; }

// The size that a term names by itself, NAME or NAME+1: the first to do so says how large it is.
std::pair<std::string_view, std::size_t> name_in(std::string_view term) {
  const std::size_t more = term.ends_with("+1") ? 1 : 0;
  if (more) term.remove_suffix(2);
  const bool plain = term.find_first_of("*+0123456789") == std::string_view::npos;
  return {plain ? term : std::string_view(), more};
}

bool is_array(const DatasetRule& rule) { return rule.type != "text" && rule.type != "strings"; }

std::string group_of(std::string_view path) { return std::string(path.substr(0, path.rfind('/'))); }

std::string in_words(const Shape& shape) { return fmt::format("[{}]", fmt::join(shape, ", ")); }

template <Element T>
bool fits(T value, Allowed allowed, std::size_t end) {
  // Sums of weights reach one but for rounding.
  constexpr double kRounding = 1e-9;
  const auto number = static_cast<double>(value);
  if (!std::isfinite(number)) return false;
  switch (allowed) {
    case Allowed::any:
    case Allowed::finite:
      return true;
    case Allowed::not_negative:
      return number >= 0.0;
    case Allowed::positive:
      return number > 0.0;
    case Allowed::share:
      return number >= -kRounding && number <= 1.0 + kRounding;
    case Allowed::flag:
      return number == 0.0 || number == 1.0;
    case Allowed::index:
      return number >= 0.0 && number < static_cast<double>(end);
    case Allowed::index_or_end:
      return number >= 0.0 && number <= static_cast<double>(end);
  }
  return false;
}

std::string range_in_words(const DatasetRule& rule, std::size_t end) {
  switch (rule.allowed) {
    case Allowed::any:
    case Allowed::finite:
      return "not finite";
    case Allowed::not_negative:
      return "not a finite number of at least 0";
    case Allowed::positive:
      return "not a finite number above 0";
    case Allowed::share:
      return "outside 0..1";
    case Allowed::flag:
      return "neither 0 nor 1";
    case Allowed::index:
      return fmt::format("not below {} ({})", end, rule.end);
    case Allowed::index_or_end:
      return fmt::format("above {} ({})", end, rule.end);
  }
  return "";
}

}  // namespace

std::vector<std::string_view> split(std::string_view text, std::string_view separator) {
  std::vector<std::string_view> parts;
  while (!text.empty()) {
    const auto at = std::min(text.find(separator), text.size());
    parts.push_back(text.substr(0, at));
    text.remove_prefix(std::min(text.size(), at + separator.size()));
  }
  return parts;
}

FileSchema& FileSchema::add(const FileSchema& more) {
  attributes.insert(attributes.end(), more.attributes.begin(), more.attributes.end());
  datasets.insert(datasets.end(), more.datasets.begin(), more.datasets.end());
  return *this;
}

FileLayout::FileLayout(const Hdf5Reader& file, const FileSchema& schema, const std::string& path,
                       std::size_t memory_limit_bytes)
    : schema_(schema), path_(path) {
  for (const auto& rule : schema.attributes) {
    if (!rule.optional || file.has(std::string(rule.path))) check_attribute(file, rule);
  }
  std::size_t whole_bytes = 0;
  for (const auto& rule : schema.datasets) {
    const std::string name(rule.path);
    if (rule.optional && !file.has(group_of(rule.path))) continue;
    const Shape shape = file.shape(name);
    if (rule.type == "text") continue;
    check_shape(rule, shape);
    if (!is_array(rule)) continue;
    const ElementType type = file.type(name);
    const auto types = split(rule.type, " or ");
    if (std::find(types.begin(), types.end(), name_of(type)) == types.end())
      fail(fmt::format("dataset '{}' holds {}, expected {}", name, name_of(type), rule.type));
    std::size_t bytes = bytes_of(type);
    for (std::size_t d = rule.by_rows ? 1 : 0; d < shape.size(); ++d) bytes *= shape[d];
    whole_bytes += bytes;
  }
  if (whole_bytes > memory_limit_bytes)
    throw LimitError(fmt::format("{}: what is read of it takes {}, {} are free", path,
                                 size_in_words(whole_bytes), size_in_words(memory_limit_bytes)));
}

void FileLayout::check_attribute(const Hdf5Reader& file, const AttributeRule& rule) {
  const std::string path(rule.path), name(rule.name);
  if (rule.type == AttributeType::text) {
    file.text_attribute(path, name);
    return;
  }
  const bool integer = rule.type == AttributeType::integer;
  const double value = integer ? static_cast<double>(file.integer_attribute(path, name))
                               : file.number_attribute(path, name);
  if (!(value >= rule.low && value <= rule.high) || !std::isfinite(value))
    fail(fmt::format("attribute '{}' of '{}' is {:g}, outside {:g}..{:g}", name, path, value, rule.low,
                     rule.high));
  if (integer) sizes_[name] = static_cast<std::size_t>(value);
}

void FileLayout::check_shape(const DatasetRule& rule, const Shape& found) {
  const auto terms = split(rule.shape, ", ");
  const auto refuse = [&] {
    fail(fmt::format("dataset '{}' has shape {}, expected [{}]", rule.path, in_words(found), rule.shape));
  };
  if (terms.size() != found.size()) refuse();
  for (std::size_t d = 0; d < terms.size(); ++d) {
    const auto [name, more] = name_in(terms[d]);
    if (!name.empty() && found[d] >= more) sizes_.try_emplace(std::string(name), found[d] - more);
    if (const std::size_t expected = evaluated(terms[d]); expected != found[d])
      fail(fmt::format("dataset '{}' has shape {}, expected [{}] with {} = {}", rule.path, in_words(found),
                       rule.shape, terms[d], expected));
  }
}

// A number, a name, NAME*NAME or NAME+1.
std::size_t FileLayout::evaluated(std::string_view term) const {
  if (const auto times = term.find('*'); times != std::string_view::npos)
    return evaluated(term.substr(0, times)) * evaluated(term.substr(times + 1));
  if (const auto plus = term.find('+'); plus != std::string_view::npos)
    return evaluated(term.substr(0, plus)) + evaluated(term.substr(plus + 1));
  std::size_t number = 0;
  const char* end = term.data() + term.size();
  const auto [stop, error] = std::from_chars(term.data(), end, number);
  return error == std::errc() && stop == end ? number : size(term);
}

std::size_t FileLayout::size(std::string_view name) const {
  const auto known = sizes_.find(name);
  if (known == sizes_.end()) throw InternalError("no dataset has a size named '" + std::string(name) + "'");
  return known->second;
}

const DatasetRule& FileLayout::rule_of(const std::string& dataset) const {
  const auto found = std::find_if(schema_.datasets.begin(), schema_.datasets.end(),
                                  [&](const DatasetRule& rule) { return rule.path == dataset; });
  if (found == schema_.datasets.end())
    throw InternalError("dataset '" + dataset + "' is in no schema: add what it may hold");
  return *found;
}

void FileLayout::fail(const std::string& what) const { throw IoError(path_, what); }

template <Element T>
void FileLayout::check(const std::string& dataset, std::span<const T> values, std::size_t first) const {
  const DatasetRule& rule = rule_of(dataset);
  const std::size_t end = rule.end.empty() ? 0 : size(rule.end);
  if (rule.allowed == Allowed::any) return;
  const std::size_t wrong = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, values.size(), 1 << 16), values.size(),
      [&](const auto& part, std::size_t found) {
        for (std::size_t i = part.begin(); i < std::min(part.end(), found); ++i)
          if (!fits(values[i], rule.allowed, end)) return i;
        return found;
      },
      [](std::size_t a, std::size_t b) { return std::min(a, b); });
  if (wrong < values.size())
    fail(fmt::format("dataset '{}': element {} is {}, {}", dataset, first + wrong, values[wrong],
                     range_in_words(rule, end)));
}

template void FileLayout::check(const std::string&, std::span<const std::uint8_t>, std::size_t) const;
template void FileLayout::check(const std::string&, std::span<const std::uint16_t>, std::size_t) const;
template void FileLayout::check(const std::string&, std::span<const std::uint32_t>, std::size_t) const;
template void FileLayout::check(const std::string&, std::span<const std::uint64_t>, std::size_t) const;
template void FileLayout::check(const std::string&, std::span<const std::int32_t>, std::size_t) const;
template void FileLayout::check(const std::string&, std::span<const std::int64_t>, std::size_t) const;
template void FileLayout::check(const std::string&, std::span<const float>, std::size_t) const;
template void FileLayout::check(const std::string&, std::span<const double>, std::size_t) const;

}  // namespace dim
