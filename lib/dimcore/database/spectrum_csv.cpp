#include "database/spectrum_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "photometry/text_scanner.hpp"
#include "spectrum/bands.hpp"

namespace dim {
namespace {

constexpr std::size_t kMaxRows = 100000;
constexpr std::size_t kMaxColumns = 100;
constexpr double kLongestMicrometre = 100.0;

struct CsvRow {
  int line;
  std::vector<double> values;
};

char separator_of(std::string_view line) {
  for (const char c : {';', '\t', ','})
    if (line.find(c) != std::string_view::npos) return c;
  return ' ';
}

std::vector<std::string> cells_of(std::string_view line, char separator) {
  std::vector<std::string> cells;
  std::string cell;
  const auto finish = [&] {
    std::string_view text = trimmed(cell);
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
    if (separator != ' ' || !text.empty()) cells.emplace_back(text);
    cell.clear();
  };
  for (const char c : line) {
    if (c == separator)
      finish();
    else
      cell += c;
  }
  finish();
  return cells;
}

bool parse_cell(std::string cell, char separator, double& value) {
  if (separator != ',') std::replace(cell.begin(), cell.end(), ',', '.');
  if (!cell.empty() && cell.back() == '%') cell.pop_back();
  return parse_number(trimmed(cell), value);
}

class CsvReader {
 public:
  CsvReader(std::string_view text, std::string file) : file_(std::move(file)), scanner_(text, file_) {}

  void read() {
    while (!scanner_.at_end()) {
      const std::string_view line = trimmed(scanner_.take_line());
      if (line.find('\0') != std::string_view::npos)
        refuse("a zero byte: not a text file", "give a CSV file");
      if (line.empty() || line.front() == '#') continue;
      if (separator_ == 0) separator_ = separator_of(line);
      const auto cells = cells_of(line, separator_);
      if (rows_.empty() && header_.empty() && !is_row(cells)) {
        header_ = cells;
        continue;
      }
      take_row(cells);
    }
    if (rows_.size() < 2)
      throw InputError({scanner_.end_place(),
                        fmt::format("{} wavelengths: a spectrum needs two", rows_.size()),
                        "columns: wavelength, value"});
    if (rows_.front().values.front() > rows_.back().values.front()) std::reverse(rows_.begin(), rows_.end());
  }

  const std::vector<CsvRow>& rows() const { return rows_; }
  /// All header cells in capitals, for units.
  std::string header_words() const {
    std::string words;
    for (const auto& cell : header_) words += in_capitals(cell) + ' ';
    return words;
  }
  std::vector<std::string> column_names() const {
    std::vector<std::string> names(rows_.front().values.size() - 1);
    for (std::size_t i = 0; i < names.size() && i + 1 < header_.size(); ++i)
      names[i] = to_utf8(header_[i + 1]);
    return names;
  }

 private:
  bool is_row(const std::vector<std::string>& cells) const {
    double value = 0.0;
    return cells.size() >= 2 && parse_cell(cells[0], separator_, value);
  }

  void take_row(std::vector<std::string> cells) {
    while (cells.size() > 2 && cells.back().empty()) cells.pop_back();
    CsvRow row{scanner_.place().line, {}};
    for (const auto& cell : cells) {
      double value = 0.0;
      if (!parse_cell(cell, separator_, value))
        refuse(fmt::format("{} is not a finite number", quoted(cell)), "");
      row.values.push_back(value);
    }
    if (row.values.size() < 2 || row.values.size() > kMaxColumns)
      refuse(fmt::format("{} columns; a spectrum has a wavelength and one to {} values", row.values.size(),
                         kMaxColumns - 1),
             "");
    if (!rows_.empty() && row.values.size() != rows_.front().values.size())
      refuse(fmt::format("{} columns where line {} has {}", row.values.size(), rows_.front().line,
                         rows_.front().values.size()),
             "");
    if (rows_.size() >= kMaxRows) refuse(fmt::format("more than {} wavelengths", kMaxRows), "");
    rows_.push_back(std::move(row));
  }

  [[noreturn]] void refuse(const std::string& what, const std::string& cure) const {
    throw InputError({{file_, scanner_.place().line, 1}, what, cure});
  }

  std::string file_;
  TextScanner scanner_;
  char separator_ = 0;
  std::vector<std::string> header_;
  std::vector<CsvRow> rows_;
};

bool in_micrometres(const CsvReader& csv, WavelengthUnit unit) {
  if (unit != WavelengthUnit::found) return unit == WavelengthUnit::micrometre;
  const std::string words = csv.header_words();
  if (words.find("NM") != std::string::npos || words.find("NANOMET") != std::string::npos) return false;
  for (const char* name : {"UM", "\xC2\xB5m", "\xC2\xB5M", "\xCE\xBCM", "MICRO", "\xB5M"})
    if (words.find(name) != std::string::npos) return true;
  return csv.rows().back().values.front() < kLongestMicrometre;
}

bool in_percent(const CsvReader& csv, ValueUnit unit, const std::string& file) {
  if (unit != ValueUnit::found) return unit == ValueUnit::percent;
  const std::string words = csv.header_words();
  if (words.find('%') != std::string::npos || words.find("PERCENT") != std::string::npos) return true;
  const CsvRow* highest = &csv.rows().front();
  double most = -1.0;
  for (const auto& row : csv.rows())
    for (std::size_t i = 1; i < row.values.size(); ++i)
      if (row.values[i] > most) most = row.values[i], highest = &row;
  if (most > 1.0 && most <= 1.5)
    throw InputError(
        {{file, highest->line, 1},
         fmt::format("largest value {}: a fraction above 1, or a very dark finish in per cent?", most),
         "say which with --values fraction or --values percent"});
  return most > 1.5;
}

}  // namespace

SpectrumTable read_spectrum_csv(std::string_view text, const std::string& file_name,
                                WavelengthUnit wavelengths, ValueUnit values) {
  CsvReader csv(photometric_text(text, file_name), file_name);
  csv.read();
  SpectrumTable table;
  table.names = csv.column_names();
  table.micrometres = in_micrometres(csv, wavelengths);
  table.percent = in_percent(csv, values, file_name);
  std::vector<std::vector<std::pair<double, double>>> points(table.names.size());
  double last_nm = 0.0;
  for (const CsvRow& row : csv.rows()) {
    const Place place = {file_name, row.line, 1};
    const double nm = table.micrometres ? std::round(row.values[0] * 1e9) / 1e6 : row.values[0];
    if (!(nm >= 1.0 && nm <= 1e5))
      throw InputError({place, fmt::format("wavelength {} nm is outside 1..100000", nm), ""});
    if (nm <= last_nm)
      throw InputError(
          {place, fmt::format("wavelengths are not in order: {} nm beside {} nm", nm, last_nm), ""});
    last_nm = nm;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double value = row.values[i + 1] * (table.percent ? 0.01 : 1.0);
      if (values == ValueUnit::relative) {
        points[i].emplace_back(nm, std::max(0.0, value));
        continue;
      }
      if (!(value >= 0.0 && value <= 1.0))
        throw InputError(
            {place, fmt::format("value {} is outside 0..{}", row.values[i + 1], table.percent ? 100 : 1),
             "a passive surface cannot reflect more than it receives"});
      points[i].emplace_back(nm, value);
    }
  }
  if (points.front().front().first > kVisibleHigh_nm || points.front().back().first < kVisibleLow_nm)
    throw InputError({{file_name, 0, 0},
                      fmt::format("wavelengths {} to {} nm are not visible (380..780 nm)",
                                  points.front().front().first, points.front().back().first),
                      "check the unit: --wavelengths nm or um"});
  for (auto& curve : points) table.curves.emplace_back(std::move(curve));
  return table;
}

}  // namespace dim
