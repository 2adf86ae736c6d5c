#include "database/toml_syntax.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace dim {
namespace {

std::string_view line_of(std::string_view text, int line) {
  for (int i = 1; i < line; ++i) {
    const auto end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  return text.substr(0, text.find_first_of("\r\n"));
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c & 0x80) != 0; }

/// How many bytes a decimal number takes at the start.
std::size_t number_length(std::string_view text) {
  std::size_t n = 0;
  if (n < text.size() && (text[n] == '-' || text[n] == '+')) ++n;
  const std::size_t first = n;
  while (n < text.size() && (is_digit(text[n]) || text[n] == '.')) ++n;
  return n > first ? n : 0;
}

bool has_typographic_quotes(std::string_view line) {
  static constexpr std::array<std::string_view, 8> kQuotes = {"\u201C", "\u201D", "\u201E", "\u2018",
                                                              "\u2019", "\u201A", "\u00AB", "\u00BB"};
  return std::any_of(kQuotes.begin(), kQuotes.end(),
                     [&](std::string_view quote) { return line.find(quote) != std::string_view::npos; });
}

/// "20 %" outside quotes, as in an inline table.
bool has_bare_percent(std::string_view line) {
  char quote = 0;
  bool after_number = false;
  for (const char c : line) {
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#') {
      return false;
    } else if (c == '%' && after_number) {
      return true;
    }
    after_number = is_digit(c) || (after_number && c == ' ');
  }
  return false;
}

/// A comment is left out where no quote stands before it.
std::string_view without_comment(std::string_view value) {
  const auto mark = value.find('#');
  if (mark == std::string_view::npos || value.substr(0, mark).find_first_of("\"'") != std::string_view::npos)
    return value;
  return trimmed(value.substr(0, mark));
}

std::string number_cure(std::string_view value) {
  const std::size_t n = number_length(value);
  if (n == 0) return {};
  const std::string number(value.substr(0, n));
  const std::string_view rest = trimmed(value.substr(n));
  if (rest.empty()) return {};
  if (rest.front() == ',' && rest.size() > 1 && is_digit(rest[1]) && number.find('.') == std::string::npos)
    return fmt::format("decimals take a point: write {}.{}", number,
                       rest.substr(1, rest.find_first_not_of("0123456789", 1) - 1));
  if (is_letter(rest.front()))
    return fmt::format("numbers stand without a unit: write {}; the file's `unit` says what lengths are in",
                       number);
  return {};
}

std::string value_cure(std::string_view key, std::string_view value) {
  if (value.empty()) return fmt::format("a value is missing behind {} =", key);
  const char first = value.front();
  if (first == '"' || first == '\'') {
    const bool closed = std::count(value.begin(), value.end(), first) > 1;
    if (!closed) return fmt::format("the closing {} is missing", first);
    if (first == '"' && value.find('\\') != std::string_view::npos)
      return "in \"...\" a backslash begins a special character: write paths with / or in '...'";
    return {};
  }
  if (auto cure = number_cure(value); !cure.empty()) return cure;
  if (is_letter(first) && value != "true" && value != "false")
    return fmt::format("text stands in quotes: write {} = \"{}\"", key, value);
  return {};
}

}  // namespace

std::string syntax_cure(std::string_view text, int line) {
  const std::string_view whole = trimmed(line_of(text, line));
  if (has_typographic_quotes(whole)) return "typographic quotes: write straight ones, \" or '";
  if (has_bare_percent(whole)) return "per cent: write a fraction, 0.2, or text in quotes, \"20 %\"";
  if (whole.find("] [") != std::string_view::npos || whole.find("][") != std::string_view::npos)
    return "a comma is missing between ] and [";
  if (whole.starts_with('[') && whole.find('=') == std::string_view::npos)
    return "a heading reads [finishes], or [[surface]] with two brackets on both sides";
  const auto equals = whole.find('=');
  if (equals == std::string_view::npos)
    return whole.empty() ? ""
                         : "a line reads KEY = VALUE, or is a [heading]; is a bracket not closed above it?";
  const std::string_view key = trimmed(whole.substr(0, equals));
  if (key.find(' ') != std::string_view::npos && key.front() != '"')
    return "a key is one word, or stands in quotes";
  auto cure = value_cure(key, without_comment(trimmed(whole.substr(equals + 1))));
  if (cure.empty()) cure = "is a bracket or a quote not closed here or in the lines above?";
  return cure;
}

}  // namespace dim
