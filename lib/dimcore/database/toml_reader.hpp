#pragma once

#include <toml++/toml.h>

#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/vec.hpp"
#include "spectrum/curve.hpp"

/// Typed reading of TOML text, shared by zone, lights and database files: every problem is reported with its
/// place in the file and collected, so that a file's problems come out together.
namespace dim {

/// Largest text accepted, bytes.
inline constexpr std::size_t kMaxTomlBytes = 64u << 20;
/// Largest magnitude of a coordinate or length in the file's unit; beyond it areas and volumes lose meaning.
inline constexpr double kMaxCoordinate = 1e12;

/// Where a value may lie; infinite limits are never reached because values must be finite.
struct NumberRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool high_open = false;
  bool share = false;  ///< "14 %" is another way to write 0.14

  bool contains(double value) const;
  /// "greater than 0", "0 to 1", "at least 0", "any finite number"
  std::string text() const;
};

inline constexpr NumberRange kAnyNumber{};
inline constexpr NumberRange kPositive{0.0, std::numeric_limits<double>::infinity(), true, false};
inline constexpr NumberRange kNotNegative{0.0, std::numeric_limits<double>::infinity(), false, false};
inline constexpr NumberRange kFraction{0.0, 1.0, false, false, true};
inline constexpr NumberRange kReflectance{0.0, 1.0, false, true, true};
inline constexpr NumberRange kCoordinate{-kMaxCoordinate, kMaxCoordinate, false, false};
inline constexpr NumberRange kLength{0.0, kMaxCoordinate, true, false};

/// The fraction that "14 %" stands for; nothing for another text.
std::optional<double> percentage(std::string_view text);

/// What the readers share: the name errors start with, and where they go.
struct TomlContext {
  std::string file;
  Problems& problems;
};

/// Place of a node or key; a value that came from `--set` says so in place of file and line.
Place place_of(const toml::source_region& region, const std::string& file);

/// One table of the file with a label for messages ("surface 'floor'"). Getters return nothing (and report)
/// where the value is missing though required, of the wrong type, not finite or out of range; nothing (and
/// silently) where it is absent and optional. `refuse_unknown` reports keys that no getter asked for.
class TomlTable {
 public:
  TomlTable(const toml::table& table, std::string label, TomlContext& context);

  const std::string& label() const { return label_; }
  void relabel(std::string label) { label_ = std::move(label); }
  Place place() const { return place_of(table_->source(), context_->file); }
  /// Place of the key's value, or of the table where there is none.
  Place place(std::string_view key) const;
  bool has(std::string_view key) const;
  TomlContext& context() const { return *context_; }

  /// Reports `what` (after "label: ") at the place of `key`'s value.
  void problem(std::string_view key, const std::string& what, const std::string& cure = "") const;
  /// Reports "label: key is missing" unless the key is there.
  bool require(std::string_view key, const std::string& cure = "") const;

  std::optional<double> number(std::string_view key, const NumberRange& range) const;
  double number_or(std::string_view key, const NumberRange& range, double otherwise) const;
  std::optional<int> integer(std::string_view key, int low, int high) const;
  std::optional<std::string> text(std::string_view key) const;
  /// One of the words given; reports others with the nearest.
  std::optional<std::string> word(std::string_view key, const std::vector<std::string>& words) const;
  /// A name for people and tables: not empty, at most 200 bytes, no control characters.
  std::optional<std::string> name(std::string_view key = "name") const;
  bool flag(std::string_view key, bool otherwise) const;
  std::optional<std::vector<std::string>> texts(std::string_view key) const;
  /// Array of exactly `size` numbers.
  std::optional<std::vector<double>> numbers(std::string_view key, std::size_t size,
                                             const NumberRange& range) const;
  std::optional<Vec3> vec3(std::string_view key, const NumberRange& range = kCoordinate) const;
  std::optional<std::pair<int, int>> integers2(std::string_view key, int low, int high) const;
  /// Array of rows of `size` numbers each.
  std::optional<std::vector<std::vector<double>>> rows(std::string_view key, std::size_t size,
                                                       const NumberRange& range) const;
  std::optional<std::vector<Vec3>> ring(std::string_view key) const;
  std::optional<std::vector<std::vector<Vec3>>> rings(std::string_view key) const;
  /// A number (the same at every wavelength) or [[nm, value], ...] without the faults of find_fault.
  std::optional<SpectralCurve> curve(std::string_view key, const NumberRange& range) const;

  std::optional<TomlTable> table(std::string_view key, std::string label) const;
  /// An array of tables, `[[key]]`; each labelled "key 'name'" or "key number i".
  std::vector<TomlTable> tables(std::string_view key) const;
  const toml::table& raw() const { return *table_; }
  const toml::node* node(std::string_view key) const;

  void refuse_unknown() const;

 private:
  const toml::node* typed(std::string_view key, toml::node_type type, const char* wanted) const;
  bool number_in(const toml::node& node, std::string_view key, const NumberRange& range, double& out) const;
  bool numbers_in(const toml::node& node, std::string_view key, std::size_t size, const NumberRange& range,
                  std::vector<double>& out) const;
  bool ring_in(const toml::node& node, std::string_view key, std::vector<Vec3>& out) const;

  const toml::table* table_;
  std::string label_;
  TomlContext* context_;
  // Copies of a reader share what was asked for, so that a table may be handed on by value.
  std::shared_ptr<std::set<std::string, std::less<>>> asked_;
};

/// What kind of file to expect and how `--set` finds its way in it.
struct TomlKind {
  std::string kind;  ///< "zone" for `dim = "zone/1"`
  int version = 1;   ///< newest that is understood
  bool header_required = true;
  std::vector<std::string> named_tables;  ///< tables whose keys are the user's own names: "finishes"
};

/// Parses text and applies `--set KEY=VALUE` overrides. KEY is a path of table names and keys; an element of
/// an array of tables is chosen by its name: `surface.floor.finish=x`. VALUE is read as a TOML value, else as
/// text. In a named table, a text or number that gets a key set in it becomes the table `{ entry = text }` or
/// `{ diffuse = number }` first, so that `finishes.wall.diffuse=0.7` works however the finish is written.
/// @throws InputError for syntax, encoding, size, nesting, the wrong kind or a newer version
toml::table parse_toml(std::string_view text, const std::string& file, const TomlKind& kind,
                       const std::vector<std::string>& overrides = {});

/// A number for messages: up to six significant digits.
std::string short_number(double value);
std::string short_point(const Vec3& p);

}  // namespace dim
