#include "photometry/ies_labels.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace dim {
namespace {

constexpr std::size_t kMaxLabelLines = 10000;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The number of two or four digits that text begins with, as a year; 0 where there is none.
int leading_year(std::string_view text) {
  std::size_t n = 0;
  while (n < text.size() && is_digit(text[n])) ++n;
  if (n != 2 && n != 4) return 0;
  int year = 0;
  std::from_chars(text.data(), text.data() + n, year);
  if (n == 4) return year;
  return year >= 80 ? 1900 + year : 2000 + year;
}

/// Year of an identifier: "IESNA:LM-63-2002", "IESNA: LM-63-1991", "ANSI/IES LM-63-19", "IESNA91",
/// "IESNA 91"; 0 where there is none.
int year_in(std::string_view identifier) {
  const std::string capitals = in_capitals(identifier);
  std::string_view rest = capitals;
  if (const auto standard = rest.find("63"); rest.find("LM") < standard) {
    if (standard == std::string_view::npos) return 0;
    rest.remove_prefix(std::min(rest.size(), rest.find_first_not_of(" -:/", standard + 2)));
    return leading_year(rest);
  }
  for (const std::string_view name : {"IESNA", "IES"}) {
    if (!rest.starts_with(name)) continue;
    rest.remove_prefix(std::min(rest.size(), rest.find_first_not_of(" -:", name.size())));
    return leading_year(rest);
  }
  return 0;
}

void take_identifier(IesLabels& labels, std::string_view line, const Place& place, Warnings& warnings) {
  static constexpr std::array<int, 5> kYears = {1986, 1991, 1995, 2002, 2019};
  labels.identifier = to_utf8(line);
  labels.format_year = year_in(line);
  if (std::find(kYears.begin(), kYears.end(), labels.format_year) != kYears.end()) return;
  const bool newer = labels.format_year > 2019 && labels.format_year < 2100;
  labels.format_year = newer ? 2019 : 2002;
  warnings.push_back({place,
                      "format " + quoted(line) + " is not one of LM-63-1986, 1991, 1995, 2002 and 2019",
                      "read as LM-63-" + std::to_string(labels.format_year)});
}

/// Forms that occur: `NONE;`, `FILE lamp.tlt`, `"lamp.tlt"`.
std::string_view without_decoration(std::string_view tilt) {
  while (!tilt.empty() && (tilt.back() == ';' || tilt.back() == ','))
    tilt = trimmed(tilt.substr(0, tilt.size() - 1));
  for (const char* word : {"FILE ", "FILE="})
    if (in_capitals(tilt.substr(0, 5)) == word) tilt = trimmed(tilt.substr(5));
  if (tilt.size() > 1 && tilt.front() == '"' && tilt.back() == '"') tilt = tilt.substr(1, tilt.size() - 2);
  return tilt;
}

/// What follows TILT=, or nothing if the line is another.
bool is_tilt_line(std::string_view line, std::string& tilt) {
  if (in_capitals(line.substr(0, 4)) != "TILT") return false;
  const std::string_view rest = trimmed(line.substr(4));
  if (rest.empty() || rest.front() != '=') return false;
  tilt = std::string(without_decoration(trimmed(rest.substr(1))));
  return true;
}

void take_label(IesLabels& labels, std::string_view bytes) {
  auto& keywords = labels.keywords;
  // Decoded first: the second byte of a Shift-JIS character may be a bracket's.
  const std::string text = to_utf8(bytes);
  const std::string_view line = text;
  const std::size_t close = line.find(']');
  if (line.front() != '[' || close == std::string_view::npos) {
    keywords.emplace_back("", text);
    return;
  }
  const std::string key = in_capitals(trimmed(line.substr(1, close - 1)));
  const std::string value(trimmed(line.substr(close + 1)));
  if (key == "MORE" && !keywords.empty()) {
    keywords.back().second += ' ' + value;
    return;
  }
  keywords.emplace_back(key, value);
}

void refuse_binary(std::string_view line, const Place& place) {
  const std::size_t nul = line.find('\0');
  if (nul == std::string_view::npos) return;
  const Place at = {place.file, place.line, static_cast<int>(nul) + 1};
  throw InputError({at, "a zero byte: not a text file, so not an LM-63 (IES) file",
                    "give a file that starts with IESNA:LM-63-... or IES:LM-63-..., as plain text"});
}

}  // namespace

IesLabels read_ies_labels(TextScanner& scanner, Warnings& warnings) {
  IesLabels labels;
  bool first = true;
  std::size_t n_lines = 0;
  while (!scanner.at_end()) {
    const std::string_view whole = scanner.take_line();
    refuse_binary(whole, scanner.place());
    const std::string_view line = trimmed(whole);
    if (line.empty()) continue;
    if (is_tilt_line(line, labels.tilt)) {
      labels.tilt_place = scanner.place();
      return labels;
    }
    const std::string capitals = first ? in_capitals(line.substr(0, 80)) : "";
    if (capitals.starts_with("IES") ||
        (capitals.starts_with("ANSI") && capitals.find("LM") != std::string::npos))
      take_identifier(labels, line, scanner.place(), warnings);
    else
      take_label(labels, line);
    first = false;
    if (++n_lines > kMaxLabelLines) break;
  }
  if (first) throw InputError({scanner.end_place(), "the file is empty", "give an LM-63 (IES) file"});
  throw InputError({scanner.end_place(), "no TILT= line: not an LM-63 (IES) file, or cut short",
                    "the line TILT=NONE or TILT=INCLUDE stands between the labels and the numbers"});
}

}  // namespace dim
