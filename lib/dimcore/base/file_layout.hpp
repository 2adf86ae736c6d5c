#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/hdf5_file.hpp"

/// The layout of a kind of file as data: what is in it, of which type and size, and what values may be there.
/// A file is laid against it before anything of it is read; docs/formats.md shows the same as tables.
namespace dim {

/// What values may be. All but `any` also ask for finite numbers.
enum class Allowed {
  any,
  finite,
  not_negative,
  positive,
  share,        ///< 0..1
  flag,         ///< 0 or 1
  index,        ///< below the size named by `end`
  index_or_end  ///< that size as well: none
};

struct DatasetRule {
  std::string_view path;
  std::string_view type;   ///< "float64", "uint16 or uint32"; "strings", a list of names; "text", a long one
  std::string_view shape;  ///< "cells, slices*sectors, 3": sizes by name or number, products, or one + 1
  std::string_view unit = "1";
  Allowed allowed = Allowed::any;
  std::string_view end = {};
  bool optional = false;  ///< there with its group or not at all
  bool by_rows = false;   ///< never read whole but row by row
};

enum class AttributeType { text, integer, number };

/// An integer attribute is a size of its name.
struct AttributeRule {
  std::string_view path, name;
  AttributeType type;
  double low = 0.0, high = 0.0;  ///< of numbers
  bool optional = false;         ///< there with its group or not at all
};

struct FileSchema {
  std::vector<AttributeRule> attributes;
  std::vector<DatasetRule> datasets;  ///< the first that names a size says how large it is

  FileSchema& add(const FileSchema& more);
};

/// A file laid against a schema.
class FileLayout {
 public:
  /// @param schema  kept by reference
  /// @throws IoError     naming the dataset or attribute that is missing, of another type, rank or size
  /// @throws LimitError  what is read whole does not fit `memory_limit_bytes`
  FileLayout(const Hdf5Reader& file, const FileSchema& schema, const std::string& path,
             std::size_t memory_limit_bytes);

  /// A size as found in the file: "cells". @throws InternalError  the schema names no such size
  std::size_t size(std::string_view name) const;

  /// Values as read from a dataset, or part of it.
  /// @param first  number of the first of them in the dataset, for the message
  /// @throws IoError        naming the dataset, the element and its value
  /// @throws InternalError  a dataset that the schema does not know
  template <Element T>
  void check(const std::string& dataset, std::span<const T> values, std::size_t first) const;

 private:
  void check_attribute(const Hdf5Reader& file, const AttributeRule& rule);
  void check_shape(const DatasetRule& rule, const Shape& found);
  std::size_t evaluated(std::string_view term) const;
  const DatasetRule& rule_of(const std::string& dataset) const;
  [[noreturn]] void fail(const std::string& what) const;

  const FileSchema& schema_;
  std::string path_;
  std::map<std::string, std::size_t, std::less<>> sizes_;
};

/// The parts of a rule's shape or type: "a, b" at ", " and "a or b" at " or ".
std::vector<std::string_view> split(std::string_view text, std::string_view separator);

}  // namespace dim
