#include "import/radiance_tokens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "photometry/text_scanner.hpp"

namespace dim {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v'; }

}  // namespace

void RadianceTokens::refuse(const std::string& what) const {
  throw InputError({input_.place(line_), what, ""});
}

bool RadianceTokens::skip_blanks() {
  const std::string_view bytes = input_.bytes;
  while (at_ < bytes.size()) {
    if (bytes[at_] == '#')
      while (at_ < bytes.size() && bytes[at_] != '\n') ++at_;
    else if (is_blank(bytes[at_]))
      line_ += bytes[at_++] == '\n' ? 1 : 0;
    else
      return true;
  }
  return false;
}

std::string RadianceTokens::word(const char* what) {
  if (!skip_blanks()) refuse(fmt::format("ends where {} should stand", what));
  const std::string_view bytes = input_.bytes;
  const char quote = bytes[at_];
  std::size_t end = at_;
  if (quote == '"' || quote == '\'') {
    end = std::min(bytes.find(quote, at_ + 1), bytes.size());
    const std::string text(bytes.substr(at_ + 1, end - std::min(end, at_ + 1)));
    line_ += static_cast<int>(std::count(text.begin(), text.end(), '\n'));
    at_ = std::min(end + 1, bytes.size());
    return text;
  }
  while (end < bytes.size() && !is_blank(bytes[end])) ++end;
  const std::string text(bytes.substr(at_, end - at_));
  at_ = end;
  return text;
}

std::string RadianceTokens::line() {
  const std::size_t end = std::min(input_.bytes.find('\n', at_), input_.bytes.size());
  std::string text(trimmed(input_.bytes.substr(at_, end - at_)));
  at_ = end;
  return text;
}

std::size_t RadianceTokens::count() {
  const std::string text = word("a number of arguments");
  std::size_t n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  if (error != std::errc() || end != text.data() + text.size())
    refuse(fmt::format("{} is no number of arguments", dim::quoted(text)));
  // Every argument takes a sign and a blank at least.
  if (n > (input_.bytes.size() - at_) / 2 + 1)
    refuse(fmt::format("{} arguments, more than the file has room for", n));
  return n;
}

double RadianceTokens::number() {
  double value = 0.0;
  const std::string text = word("a number");
  if (!parse_number(text, value)) refuse(fmt::format("{} is no finite number", dim::quoted(text)));
  return value;
}

bool RadianceTokens::next(RadiancePrimitive& primitive) {
  primitive = {};
  if (!skip_blanks()) return false;
  primitive.place = input_.place(line_);
  if (input_.bytes[at_] == '!') {
    primitive.type = "!";
    primitive.name = line();
    return true;
  }
  primitive.modifier = word("a modifier");
  primitive.type = word("a type");
  primitive.name = word("a name");
  if (primitive.type == "alias") {
    primitive.texts.push_back(word("what the alias stands for"));
    return true;
  }
  for (std::size_t n = count(); n > 0; --n) primitive.texts.push_back(word("a text"));
  for (std::size_t n = count(); n > 0; --n) number();  // whole numbers, which no type uses
  for (std::size_t n = count(); n > 0; --n) primitive.numbers.push_back(number());
  return true;
}

}  // namespace dim
