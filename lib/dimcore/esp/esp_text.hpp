#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace dim {

/// What an ESP-r text may hold: longer words and lines are cut by its reader without a word.
inline constexpr std::size_t kEspWord = 20;
inline constexpr std::size_t kEspLine = 124;

/// Reads a text as ESP-r's own reader does, and strictly: `#` in column 1 makes a line a comment, elsewhere
/// the rest of it; words stand apart by blanks, commas and tabs; tags start in column 1. Blank lines, words
/// over 20 and lines over 124 characters are wrong. Numbers are checked against the limits that ESP-r sets;
/// what is wrong is collected.
class EspReader {
 public:
  EspReader(std::string_view text, std::string file);

  /// The next line that is no comment, its comment taken off.
  /// @throws InputError  the text ends, with what was expected and all that was wrong before
  const std::string& line(const std::string& what);
  bool at_end() const { return at_ >= lines_.size(); }
  /// Words of the line that are not read yet.
  std::size_t n_words() const { return words_.size() - word_; }

  /// The next line must be this tag; what stands after it, a comma or blank between, is its value.
  std::string tag(const std::string& tag);

  /// The next words of the line. Out of limits: reported, and the nearest limit returned.
  int integer(const std::string& what, int least, int greatest);
  double real(const std::string& what, double least, double greatest);
  std::string word(const std::string& what);
  /// Reports words that nobody asked for.
  void end_line();

  void wrong(const std::string& what, const std::string& cure = "");
  /// @throws InputError  where anything was wrong, or text is left
  void finish();

 private:
  struct Line {
    int number;
    std::string text;
  };
  std::vector<Line> lines_;
  std::size_t at_ = 0;
  int number_ = 0;
  std::string text_;
  std::vector<std::string> words_;
  std::size_t word_ = 0;
  std::string file_;
  Problems problems_;
};

}  // namespace dim
