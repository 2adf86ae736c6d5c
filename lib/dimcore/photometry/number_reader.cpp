#include "photometry/number_reader.hpp"

#include <fmt/format.h>

#include <cmath>

namespace dim {
namespace {

bool within(double value, const Limits& limits) { return value >= limits.least && value <= limits.greatest; }

}  // namespace

std::string outside(const Limits& limits) {
  return fmt::format("outside {:g}..{:g}", limits.least, limits.greatest);
}

double NumberReader::take(const std::string& what) {
  const std::string_view word = scanner_.take_word();
  if (word.empty())
    throw InputError({scanner_.end_place(), "the file ends before the " + what, "the file is incomplete"});
  double value = 0.0;
  if (!parse_number(word, value))
    throw InputError({scanner_.place(), what + ": " + quoted(word) + " is not a finite number", ""});
  return value;
}

double NumberReader::number(const std::string& what, const Limits& limits) {
  const double value = take(what);
  if (!within(value, limits))
    throw InputError({scanner_.place(), fmt::format("{} {} is {}", what, value, outside(limits)), ""});
  return value;
}

int NumberReader::count(const std::string& what, const Limits& limits, const std::string& cure) {
  const double value = take(what);
  if (value != std::floor(value) || !within(value, limits))
    throw InputError({scanner_.place(),
                      fmt::format("{} {} is not a whole number within {:g}..{:g}", what, value, limits.least,
                                  limits.greatest),
                      cure});
  return static_cast<int>(value);
}

double NumberReader::take_of(const std::string& what, std::size_t i, std::size_t n) {
  const std::string_view word = scanner_.take_word();
  if (word.empty())
    throw InputError({scanner_.end_place(), fmt::format("the file ends after {} of {} {}s", i, n, what),
                      "the file is incomplete, or the counts before the angles are wrong"});
  double value = 0.0;
  if (!parse_number(word, value))
    throw InputError({scanner_.place(),
                      fmt::format("{} {} of {}: {} is not a finite number", what, i + 1, n, quoted(word)),
                      ""});
  return value;
}

std::vector<double> NumberReader::list(const std::string& what, std::size_t n, const Limits& limits) {
  Problems problems;
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i) {
    values.push_back(take_of(what, i, n));
    if (!within(values.back(), limits))
      problems.add(scanner_.place(),
                   fmt::format("{} {} of {}: {} is {}", what, i + 1, n, values.back(), outside(limits)));
  }
  problems.throw_if_any();
  return values;
}

std::vector<double> NumberReader::ascending(const std::string& what, std::size_t n, const Limits& limits) {
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i) {
    const double value = take_of(what, i, n);
    if (!within(value, limits))
      throw InputError({scanner_.place(),
                        fmt::format("{} {} of {}: {} is {}", what, i + 1, n, value, outside(limits)), ""});
    if (i > 0 && value <= values.back())
      throw InputError({scanner_.place(),
                        fmt::format("{} {} of {}: {} follows {}, but they must ascend", what, i + 1, n, value,
                                    values.back()),
                        ""});
    values.push_back(value);
  }
  return values;
}

}  // namespace dim
