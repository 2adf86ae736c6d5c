#pragma once

#include <string_view>
#include <vector>

namespace dim {

/// Words of a text, separated by blanks, tabs and line ends.
std::vector<std::string_view> words_of(std::string_view text);

/// Goes through a text by lines that end in LF or CR LF.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : text_(text) {}

  /// The next line without its end; false at the end of the text, which `line` is a part of.
  bool next(std::string_view& line);
  int line_number() const { return n_; }  ///< of the line taken, from 1

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  int n_ = 0;
};

}  // namespace dim
