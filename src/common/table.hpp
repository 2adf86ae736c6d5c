#pragma once

#include <string>
#include <variant>
#include <vector>

namespace dim {

/// A table that goes out as CSV or as JSON, the same figures either way.
class Table {
 public:
  using Value = std::variant<std::string, double, long>;

  explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}
  /// @param row  one value a column
  void add(std::vector<Value> row) { rows_.push_back(std::move(row)); }

  /// Header row, `.` decimals, nine significant digits; NaN is an empty field.
  std::string csv() const;
  /// A list of objects; NaN is null.
  std::string json() const;

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<Value>> rows_;
};

/// A CSV field: in quotes where it holds a comma, a quote or a line end (RFC 4180).
std::string csv_field(const std::string& text);

}  // namespace dim
