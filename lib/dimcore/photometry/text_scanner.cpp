#include "photometry/text_scanner.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <system_error>
#include <utility>

namespace dim {
namespace {

bool is_line_end(char c) { return c == '\n' || c == '\r'; }

bool is_separator(char c) {
  return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\f' || c == '\v' || is_line_end(c);
}

// Code points of bytes 0x80..0x9F in Windows-1252; 0 where the byte is not assigned.
constexpr std::array<std::uint16_t, 32> kCp1252 = {
    0x20AC, 0,      0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0,      0x017D, 0,      0,      0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0,      0x017E, 0x0178};

/// Length of the well-formed UTF-8 sequence at the start of `bytes`, 0 if there is none.
std::size_t utf8_length(std::string_view bytes) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t n = lead >= 0xC2 && lead < 0xE0 ? 2 : lead >= 0xE0 && lead < 0xF0 ? 3 : 4;
  if (lead < 0xC2 || lead > 0xF4 || bytes.size() < n) return 0;
  for (std::size_t i = 1; i < n; ++i)
    if ((byte(i) & 0xC0U) != 0x80) return 0;
  const unsigned second = byte(1);
  const bool overlong = (lead == 0xE0 && second < 0xA0) || (lead == 0xF0 && second < 0x90);
  const bool outside = (lead == 0xED && second >= 0xA0) || (lead == 0xF4 && second >= 0x90);
  return overlong || outside ? 0 : n;
}

bool valid_utf8(std::string_view bytes) {
  for (std::size_t i = 0; i < bytes.size();) {
    const std::size_t n = utf8_length(bytes.substr(i));
    if (n == 0) return false;
    i += n;
  }
  return true;
}

void append_code_point(std::string& text, unsigned code) {
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xC0 | (code >> 6));
    text += static_cast<char>(0x80 | (code & 0x3F));
  } else {
    text += static_cast<char>(0xE0 | (code >> 12));
    text += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
    text += static_cast<char>(0x80 | (code & 0x3F));
  }
}

}  // namespace

std::string to_utf8(std::string_view bytes) {
  const bool already = valid_utf8(bytes);
  std::string text;
  text.reserve(bytes.size());
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F) {
      text += ' ';
    } else if (already || byte < 0x80) {
      text += c;
    } else if (byte >= 0xA0) {
      append_code_point(text, byte);
    } else {
      const unsigned code = kCp1252[byte - 0x80U];
      append_code_point(text, code != 0 ? code : 0xFFFD);
    }
  }
  return text;
}

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string in_capitals(std::string_view text) {
  std::string capitals(text);
  for (char& c : capitals)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return capitals;
}

std::string quoted(std::string_view word) {
  constexpr std::size_t kMaxShown = 32;
  std::string text = "'";
  for (const char c : word.substr(0, kMaxShown)) text += c >= ' ' && c <= '~' ? c : '?';
  if (word.size() > kMaxShown) text += "...";
  return text + "'";
}

TextScanner::TextScanner(std::string_view text, std::string file)
    : text_(text), place_{std::move(file), 1, 1} {}

void TextScanner::end_line() {
  if (text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n') ++at_;
  ++at_;
  ++line_;
  line_start_ = at_;
}

std::string_view TextScanner::take_line() {
  place_.line = line_;
  place_.column = static_cast<int>(at_ - line_start_) + 1;
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_line_end(text_[at_])) ++at_;
  const std::string_view line = text_.substr(begin, at_ - begin);
  if (!at_end()) end_line();
  return line;
}

std::string_view TextScanner::take_word() {
  while (!at_end() && is_separator(text_[at_])) {
    if (is_line_end(text_[at_]))
      end_line();
    else
      ++at_;
  }
  place_.line = line_;
  place_.column = static_cast<int>(at_ - line_start_) + 1;
  const std::size_t begin = at_;
  while (!at_end() && !is_separator(text_[at_])) ++at_;
  return text_.substr(begin, at_ - begin);
}

bool parse_number(std::string_view word, double& value) {
  if (word.size() > 1 && word.front() == '+' && word[1] != '-') word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  const auto [stop, code] = std::from_chars(word.data(), end, value);
  return code == std::errc() && stop == end && std::isfinite(value);
}

}  // namespace dim
