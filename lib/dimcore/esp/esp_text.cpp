#include "esp/esp_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace dim {
namespace {

constexpr std::string_view kBetween = " ,\t";

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  while (true) {
    const auto first = text.find_first_not_of(kBetween);
    if (first == std::string_view::npos) return words;
    const auto end = std::min(text.find_first_of(kBetween, first), text.size());
    words.emplace_back(text.substr(first, end - first));
    text.remove_prefix(end);
  }
}

template <typename Number>
bool reads(const std::string& word, Number& value) {
  const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
  const auto [stop, error] = std::from_chars(begin, word.data() + word.size(), value);
  return error == std::errc{} && stop == word.data() + word.size();
}

}  // namespace

EspReader::EspReader(std::string_view text, std::string file) : file_(std::move(file)) {
  for (int number = 1; !text.empty(); ++number) {
    const auto end = std::min(text.find('\n'), text.size());
    std::string line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.ends_with('\r')) line.pop_back();
    if (line.starts_with('#')) continue;
    if (line.size() > kEspLine)
      problems_.add({file_, number},
                    fmt::format("{} characters, ESP-r reads {} of a line", line.size(), kEspLine));
    line.resize(std::min(line.find('#'), line.size()));
    if (line.find_first_not_of(kBetween) == std::string::npos)
      problems_.add({file_, number}, "a blank line", "take it out: ESP-r's reader stops at it");
    else
      lines_.push_back({number, line});
  }
}

const std::string& EspReader::line(const std::string& what) {
  if (at_end()) {
    problems_.add({file_, number_}, fmt::format("the file ends before {}", what), "is it complete?");
    problems_.throw_if_any();
  }
  number_ = lines_[at_].number;
  text_ = lines_[at_++].text;
  words_ = words_of(text_);
  word_ = 0;
  for (const auto& word : words_)
    if (word.size() > kEspWord && !text_.starts_with('*'))
      wrong(fmt::format("'{}' has {} characters, ESP-r reads {} of a word", word, word.size(), kEspWord));
  return text_;
}

std::string EspReader::tag(const std::string& tag) {
  line(tag);
  word_ = words_.size();
  if (!text_.starts_with(tag) ||
      (text_.size() > tag.size() && kBetween.find(text_[tag.size()]) == std::string::npos)) {
    wrong(fmt::format("'{}' stands where {} should, in column 1", text_, tag));
    problems_.throw_if_any();
  }
  const auto first = text_.find_first_not_of(kBetween, tag.size());
  return first == std::string::npos ? "" : text_.substr(first, text_.find_last_not_of(kBetween) - first + 1);
}

std::string EspReader::word(const std::string& what) {
  if (n_words() > 0) return words_[word_++];
  wrong(fmt::format("{} is missing", what));
  problems_.throw_if_any();
  return "";
}

int EspReader::integer(const std::string& what, int least, int greatest) {
  int value = least;
  const std::string text = word(what);
  if (!reads(text, value))
    wrong(fmt::format("{} '{}' is not a whole number", what, text));
  else if (value < least || value > greatest)
    wrong(fmt::format("{} {} is outside {}..{}", what, value, least, greatest));
  return std::clamp(value, least, greatest);
}

double EspReader::real(const std::string& what, double least, double greatest) {
  double value = least;
  const std::string text = word(what);
  if (!reads(text, value) || !std::isfinite(value)) {
    wrong(fmt::format("{} '{}' is not a number", what, text));
    return least;
  }
  if (value < least || value > greatest)
    wrong(fmt::format("{} {} is outside {}..{}", what, value, least, greatest));
  return std::clamp(value, least, greatest);
}

void EspReader::end_line() {
  if (n_words() > 0) wrong(fmt::format("'{}' is one word too many", words_[word_]));
  word_ = words_.size();
}

void EspReader::wrong(const std::string& what, const std::string& cure) {
  problems_.add({file_, number_}, what, cure);
}

void EspReader::finish() {
  if (!at_end())
    problems_.add({file_, lines_[at_].number}, fmt::format("'{}' after the end", lines_[at_].text));
  problems_.throw_if_any();
}

}  // namespace dim
