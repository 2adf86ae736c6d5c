#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace dim {

/// Larger files are refused unread; the largest real ones are a few hundred kilobytes.
inline constexpr std::size_t kMaxPhotometryBytes = std::size_t{64} << 20;

/// The text of a photometric file without its byte order mark.
/// @throws InputError  larger than kMaxPhotometryBytes, or UTF-16
std::string_view photometric_text(std::string_view bytes, const std::string& file_name);

/// Bytes as UTF-8: unchanged where they are valid UTF-8; Shift-JIS where that fits (every byte beyond ASCII
/// belongs to a two-byte character or a katakana, and some character has two such bytes in a row); else read
/// as Windows-1252 (of which Latin-1 is a part). Control characters become blanks, so that the text is safe
/// to print.
std::string to_utf8(std::string_view bytes);

/// Without blanks and tabs at both ends.
std::string_view trimmed(std::string_view text);

/// ASCII letters in capitals, all else unchanged.
std::string in_capitals(std::string_view text);

/// A word of the input for a message: quoted, cut to a readable length, unprintable bytes as '?'.
std::string quoted(std::string_view word);

/// Reads lines and numbers from a text in memory, keeping the place. Lines end in LF, CR LF, CR or
/// CR CR LF (a file that went through text mode twice); numbers
/// are separated by blanks, tabs, commas, semicolons and line ends, in any mixture.
class TextScanner {
 public:
  /// @param text  must outlive the scanner
  TextScanner(std::string_view text, std::string file);

  bool at_end() const { return at_ >= text_.size(); }
  std::size_t n_left() const { return text_.size() - at_; }
  /// Where the last line or word taken began.
  const Place& place() const { return place_; }
  /// The place now, for errors about the end of the text.
  Place end_place() const { return {place_.file, line_, 0}; }

  /// The next line without its end; call only if not at_end().
  std::string_view take_line();
  /// The next word, or empty at the end of the text.
  std::string_view take_word();

 private:
  void end_line();

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_start_ = 0;
  int line_ = 1;
  Place place_;
};

/// A finite decimal number that takes up the whole word ("10450.", ".5", "+1", "1e3"), or no value.
bool parse_number(std::string_view word, double& value);

}  // namespace dim
