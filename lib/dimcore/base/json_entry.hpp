#pragma once

#include <cmath>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/vec.hpp"

namespace dim {

/// A value of a JSON text inside one of DIM's files, read strictly: what is missing, of another type or out of
/// range is refused by its name, `/description: sources[2].flux_lm is -1, outside 0..inf`.
/// It refers to the JSON and the texts it is made from.
/// @throws IoError  from every member
class JsonEntry {
 public:
  /// @param dataset  that the text stands in
  /// @param path     of the file
  JsonEntry(const nlohmann::json& json, const std::string& dataset, const std::string& path)
      : json_(json), dataset_(dataset), path_(path) {}

  /// A key of an object, an element of a list.
  JsonEntry operator[](const char* key) const;
  JsonEntry at(std::size_t i) const;
  bool has(const char* key) const;
  bool is_null() const;

  static constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();
  /// Elements of a list; of exactly `n` where that is asked for.
  std::size_t size(std::size_t n = kAny) const;
  std::string text() const;
  /// One of the words.
  std::size_t word(const std::vector<std::string>& words) const;
  bool flag() const;
  /// A finite number. Open ends are never reached.
  double number(double low = -HUGE_VAL, double high = HUGE_VAL) const;
  /// Not negative; null, which JSON writes for it, is infinity: no bound.
  double bound() const;
  double positive() const;
  int integer(int low, int high) const;
  /// Below `n`.
  std::size_t index(std::size_t n) const;
  std::vector<double> numbers(std::size_t n, double low = -HUGE_VAL) const;
  Vec3 vec3() const;

  [[noreturn]] void fail(const std::string& what) const;

 private:
  JsonEntry(const nlohmann::json& json, std::string name, const JsonEntry& parent)
      : json_(json), name_(std::move(name)), dataset_(parent.dataset_), path_(parent.path_) {}

  const nlohmann::json& json_;
  std::string name_;
  const std::string& dataset_;
  const std::string& path_;
};

/// The JSON of a text dataset. @throws IoError  it is not JSON
nlohmann::json parse_json(const std::string& text, const std::string& dataset, const std::string& path);
/// As text; what is not UTF-8 in a name becomes U+FFFD.
std::string dump_json(const nlohmann::json& json);

}  // namespace dim
