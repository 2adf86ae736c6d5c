#include "import/token_line.hpp"

#include <algorithm>

namespace dim {
namespace {

constexpr const char* kBlanks = " \t\r\n\f\v";

}  // namespace

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  std::size_t i = 0;
  while (true) {
    i = text.find_first_not_of(kBlanks, i);
    if (i == std::string_view::npos) return words;
    const std::size_t end = std::min(text.find_first_of(kBlanks, i), text.size());
    words.push_back(text.substr(i, end - i));
    i = end;
  }
}

bool LineReader::next(std::string_view& line) {
  if (at_ >= text_.size()) return false;
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  line = text_.substr(at_, end - at_);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  at_ = end + 1;
  ++n_;
  return true;
}

}  // namespace dim
