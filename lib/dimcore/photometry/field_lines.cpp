#include "photometry/field_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dim {
namespace {

/// "1,5" as "1.5"; anything with a point or several commas stays as it is.
std::string with_point(std::string_view word) {
  std::string number(word);
  if (number.find('.') == std::string::npos && std::count(number.begin(), number.end(), ',') == 1)
    std::replace(number.begin(), number.end(), ',', '.');
  return number;
}

}  // namespace

std::string_view FieldLines::take(const std::string& what) {
  if (scanner_.at_end())
    throw InputError({scanner_.end_place(), "the file ends before the " + what,
                      "the file is incomplete, or not EULUMDAT (one field a line)"});
  const std::string_view line = scanner_.take_line();
  if (const std::size_t nul = line.find('\0'); nul != std::string_view::npos)
    throw InputError({{place().file, place().line, static_cast<int>(nul) + 1},
                      "a zero byte: not a text file, so not a photometric file",
                      "give an IES LM-63 or EULUMDAT file, as plain text"});
  return trimmed(line);
}

std::string FieldLines::text(const std::string& what) { return to_utf8(take(what)); }

double FieldLines::parsed(const std::string& what, std::string_view word, const Limits& limits) const {
  double value = 0.0;
  if (!parse_number(with_point(word), value))
    throw InputError({place(), fmt::format("{}: {} is not a finite number", what, quoted(word)),
                      "in EULUMDAT every field has its own line"});
  if (value < limits.least || value > limits.greatest)
    throw InputError({place(), fmt::format("{} {} is {}", what, value, outside(limits)), ""});
  return value;
}

double FieldLines::number(const std::string& what, const Limits& limits) {
  const std::string_view word = take(what);
  return word.empty() ? 0.0 : parsed(what, word, limits);
}

int FieldLines::count(const std::string& what, const Limits& limits) {
  const double value = number(what, limits);
  if (value != std::floor(value) || value < limits.least || value > limits.greatest)
    throw InputError({place(),
                      fmt::format("{} {} is not a whole number within {:g}..{:g}", what, value, limits.least,
                                  limits.greatest),
                      ""});
  return static_cast<int>(value);
}

std::vector<double> FieldLines::list(const std::string& what, std::size_t n, const Limits& limits) {
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i)
    values.push_back(parsed(fmt::format("{} {} of {}", what, i + 1, n),
                            take(fmt::format("{} {} of {}", what, i + 1, n)), limits));
  return values;
}

std::size_t FieldLines::count_numbers_left() {
  std::size_t n = 0;
  double value = 0.0;
  while (!scanner_.at_end()) n += parse_number(with_point(trimmed(scanner_.take_line())), value);
  return n;
}

}  // namespace dim
