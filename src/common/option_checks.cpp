#include "common/option_checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "common/program.hpp"

namespace dim {
namespace {

CLI::Validator silent(std::function<std::string(std::string&)> check) {
  return CLI::Validator(std::move(check), "");
}

// NaN where the text is no number.
double number_of(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return text.empty() || *end != '\0' || !std::isfinite(value) ? std::nan("") : value;
}

}  // namespace

CLI::Validator pair_of(const std::string& form) {
  return silent([form](const std::string& text) -> std::string {
    const auto equals = text.find('=');
    if (equals != std::string::npos && equals > 0) return {};
    return fmt::format("'{}' is not {}", text, form);
  });
}

CLI::Validator pair_with_factor(const std::string& form) {
  return silent([form](const std::string& text) -> std::string {
    const auto equals = text.rfind('=');
    if (equals != std::string::npos && equals > 0 && number_of(text.substr(equals + 1)) >= 0.0) return {};
    return fmt::format("'{}' is not {} with a factor of at least 0", text, form);
  });
}

void refuse_without_effect(const CLI::App& command, std::initializer_list<const char*> options,
                           const std::string& needs) {
  for (const char* option : options)
    if (command.count(option) > 0)
      throw UsageError(fmt::format("{} has no effect {}\n        leave it out", option, needs));
}

double share_of(const std::string& text) {
  const bool percent = text.ends_with('%');
  return number_of(percent ? text.substr(0, text.size() - 1) : text) / (percent ? 100.0 : 1.0);
}

CLI::Validator share_or_percent() {
  return silent([](const std::string& text) -> std::string {
    const double share = share_of(text);
    if (share > 0.0 && share <= 0.5) return {};
    return fmt::format("'{}' is not a share of at most 50 %: write for example 2% or 0.02", text);
  });
}

double seconds_of(const std::string& text) {
  for (const auto& [unit, seconds] : {std::pair("min", 60.0), std::pair("ms", 1e-3), std::pair("h", 3600.0), std::pair("s", 1.0)}) {
    if (text.ends_with(unit)) return seconds * number_of(text.substr(0, text.size() - std::string_view(unit).size()));
  }
  return number_of(text);
}

CLI::Validator seconds_text() {
  return silent([](const std::string& text) -> std::string {
    if (seconds_of(text) > 0.0) return {};
    return fmt::format("'{}' is not a time above 0: write for example 10s or 2min", text);
  });
}

CLI::Validator number_within(double low, double high, bool low_open) {
  return silent([=](const std::string& text) -> std::string {
    const double value = number_of(text);
    if (value >= low && value <= high && !(low_open && value == low)) return {};
    if (std::isinf(high))
      return fmt::format("'{}' is not a number {} {:g}", text, low_open ? "greater than" : "of at least",
                         low);
    return fmt::format("'{}' is not a number within {:g}..{:g}", text, low, high);
  });
}

void refuse_both_on_stdout(const std::string& zone, const std::string& lights) {
  if (zone == "-" && lights == "-")
    throw UsageError("the zone and the lights cannot both go to standard output\n        give -o a name");
}

}  // namespace dim
