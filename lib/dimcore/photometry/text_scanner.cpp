#include "photometry/text_scanner.hpp"

#include <fmt/format.h>
#include <iconv.h>

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

// First and second bytes of a two-byte character of Shift-JIS (JIS X 0208 rows only).
bool is_jis_lead(unsigned char c) { return (c >= 0x81 && c <= 0x9F) || (c >= 0xE0 && c <= 0xEA); }
bool is_jis_trail(unsigned char c) { return c >= 0x40 && c <= 0xFC && c != 0x7F; }
bool is_katakana(unsigned char c) { return c >= 0xA1 && c <= 0xDF; }

// Two bytes beyond ASCII in a row are rare in Windows-1252 (an accented letter stands between plain ones),
// and the rule in Shift-JIS.
bool looks_like_shift_jis(std::string_view bytes) {
  std::size_t n_pairs_beyond_ascii = 0, n_katakana = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto c = static_cast<unsigned char>(bytes[i]);
    if (c < 0x80) continue;
    if (is_jis_lead(c)) {
      if (++i == bytes.size() || !is_jis_trail(static_cast<unsigned char>(bytes[i]))) return false;
      if (static_cast<unsigned char>(bytes[i]) >= 0x80) ++n_pairs_beyond_ascii;
    } else if (is_katakana(c)) {
      ++n_katakana;
    } else {
      return false;
    }
  }
  return n_pairs_beyond_ascii > 0 && n_katakana <= 2 * n_pairs_beyond_ascii;
}

// Empty where the system cannot convert.
std::string from_shift_jis(std::string_view bytes) {
  const iconv_t converter = iconv_open("UTF-8", "CP932");
  if (converter == reinterpret_cast<iconv_t>(-1)) return {};
  std::string in(bytes), out(bytes.size() * 3, '\0');
  char* from = in.data();
  char* to = out.data();
  std::size_t n_in = in.size(), n_out = out.size();
  const bool failed = iconv(converter, &from, &n_in, &to, &n_out) == static_cast<std::size_t>(-1);
  iconv_close(converter);
  if (failed) return {};
  out.resize(out.size() - n_out);
  return out;
}

}  // namespace

std::string_view photometric_text(std::string_view bytes, const std::string& file_name) {
  if (bytes.size() > kMaxPhotometryBytes)
    throw InputError({{file_name, 0, 0},
                      fmt::format("{} bytes are more than the {} allowed for a photometric file",
                                  bytes.size(), kMaxPhotometryBytes),
                      "give an LM-63 (IES) or EULUMDAT file"});
  if (bytes.substr(0, 3) == "\xEF\xBB\xBF") return bytes.substr(3);
  if (bytes.substr(0, 2) == "\xFF\xFE" || bytes.substr(0, 2) == "\xFE\xFF")
    throw InputError(
        {{file_name, 1, 1}, "the text is UTF-16; photometric files are 8-bit text", "save it as UTF-8"});
  return bytes;
}

std::string to_utf8(std::string_view bytes) {
  if (!valid_utf8(bytes) && looks_like_shift_jis(bytes))
    if (const std::string text = from_shift_jis(bytes); !text.empty()) return to_utf8(text);
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
  // CR CR LF is what text mode makes of a CR LF of its own: one line end, not an empty line more.
  const std::string_view rest = text_.substr(at_, 3);
  at_ += rest == "\r\r\n" ? 3 : rest.substr(0, 2) == "\r\n" ? 2 : 1;
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
