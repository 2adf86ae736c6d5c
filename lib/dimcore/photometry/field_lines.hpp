#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "photometry/number_reader.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {

/// Takes the fields of a text that has one a line (EULUMDAT). Every error names the field, its value, its
/// allowed range and its line. All functions throw InputError at the first thing wrong.
class FieldLines {
 public:
  explicit FieldLines(TextScanner& scanner) : scanner_(scanner) {}

  /// The line as UTF-8 without blanks at its ends.
  std::string text(const std::string& what);
  /// A number; an empty line is 0. A decimal comma counts as a point.
  double number(const std::string& what, const Limits& limits);
  /// A whole number; an empty line is 0.
  int count(const std::string& what, const Limits& limits);
  /// `n` numbers, one a line; none may be empty.
  std::vector<double> list(const std::string& what, std::size_t n, const Limits& limits);

  /// How many of the lines left are a number; takes them all.
  std::size_t count_numbers_left();

  const Place& place() const { return scanner_.place(); }

 private:
  std::string_view take(const std::string& what);
  double parsed(const std::string& what, std::string_view word, const Limits& limits) const;

  TextScanner& scanner_;
};

}  // namespace dim
