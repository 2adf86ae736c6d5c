#include "photometry/ies_labels.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace dim {
namespace {

constexpr std::size_t kMaxLabelLines = 10000;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Year at the end of an identifier's first word ("IESNA:LM-63-2002", "IESNA91"), 0 where there is none.
int year_in(std::string_view identifier) {
  std::string_view word = identifier.substr(0, identifier.find_first_of(" \t;,"));
  std::size_t begin = word.size();
  while (begin > 0 && is_digit(word[begin - 1])) --begin;
  word.remove_prefix(begin);
  if (word.size() != 2 && word.size() != 4) return 0;
  int year = 0;
  std::from_chars(word.data(), word.data() + word.size(), year);
  if (word.size() == 4) return year;
  return year >= 80 ? 1900 + year : 2000 + year;
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

/// What follows TILT=, or nothing if the line is another.
bool is_tilt_line(std::string_view line, std::string& tilt) {
  if (in_capitals(line.substr(0, 4)) != "TILT") return false;
  const std::string_view rest = trimmed(line.substr(4));
  if (rest.empty() || rest.front() != '=') return false;
  tilt = std::string(trimmed(rest.substr(1)));
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
    if (first && in_capitals(line.substr(0, 3)) == "IES")
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
