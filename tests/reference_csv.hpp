#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

/// The reference data that tests compare with: comma-separated tables with a header row.
namespace dim::test {

/// $DIM_SHARED_DATA, else ../shared/data beside the repository; may not exist.
inline std::filesystem::path shared_data() {
  const char* given = std::getenv("DIM_SHARED_DATA");
  return given ? std::filesystem::path(given) : std::filesystem::path(DIM_SOURCE_DIR) / "../shared/data";
}

struct ReferenceTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  std::size_t index(const std::string& column) const {
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (columns[i] == column) return i;
    throw std::out_of_range(column);
  }
  double number(std::size_t row, const std::string& column) const {
    return std::stod(rows.at(row).at(index(column)));
  }
  /// {first column, column} of every row.
  std::vector<std::pair<double, double>> points(const std::string& column) const {
    std::vector<std::pair<double, double>> result;
    for (std::size_t r = 0; r < rows.size(); ++r)
      result.emplace_back(std::stod(rows[r][0]), number(r, column));
    return result;
  }
};

/// Empty where there is no such file. Fields in quotes are not understood.
inline ReferenceTable read_reference(const std::filesystem::path& path) {
  ReferenceTable table;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    if (table.columns.empty())
      table.columns = fields;
    else
      table.rows.push_back(fields);
  }
  return table;
}

}  // namespace dim::test
