#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {

/// Inclusive range of values an input may have.
struct Limits {
  double least;
  double greatest;
};

/// Takes checked numbers from a text; every error names the number, its value, its allowed range and its
/// line. All functions throw InputError at the first thing wrong.
class NumberReader {
 public:
  explicit NumberReader(TextScanner& scanner) : scanner_(scanner) {}

  /// @param what  name of the number for messages, e.g. "candela multiplier"
  double number(const std::string& what, const Limits& limits);
  /// A whole number ("37" or "37.0").
  int count(const std::string& what, const Limits& limits, const std::string& cure = "");
  /// `n` numbers within limits; all those outside are reported together.
  /// @param what  name of one of them, e.g. "candela value"
  std::vector<double> list(const std::string& what, std::size_t n, const Limits& limits);
  /// `n` strictly ascending numbers within limits.
  std::vector<double> ascending(const std::string& what, std::size_t n, const Limits& limits);

 private:
  double take(const std::string& what);
  double take_of(const std::string& what, std::size_t i, std::size_t n);

  TextScanner& scanner_;
};

/// "outside 0..180"
std::string outside(const Limits& limits);

}  // namespace dim
