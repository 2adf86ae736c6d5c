#include <fmt/format.h>

#include "database/toml_reader.hpp"
#include "spectrum/curve_check.hpp"

namespace dim {
namespace {

// A fraction written as percent, as catalogues have it.
std::string percent_cure(double value, const NumberRange& range) {
  constexpr double kLeast = 2.0, kHundred = 100.0;
  if (range.high > 1.0 || value < kLeast || value > kHundred) return "";
  return fmt::format("in percent? write {}", short_number(value / kHundred));
}

}  // namespace

std::optional<SpectralCurve> TomlTable::curve(std::string_view key, const NumberRange& range) const {
  const auto* value = node(key);
  if (!value) return std::nullopt;
  const std::string start = label_.empty() ? "" : label_ + ": ";
  const auto complain = [&](const toml::node& at, const std::string& what, const std::string& cure) {
    context_->problems.add(place_of(at.source(), context_->file), start + what, cure);
    return std::nullopt;
  };
  const auto* array = value->as_array();
  if (!array) {
    double constant = 0.0;
    const NumberRange any{.share = range.share};
    if (!number_in(*value, key, any, constant)) return std::nullopt;
    if (range.contains(constant)) return SpectralCurve(constant);
    return complain(*value, fmt::format("{} must be {}, not {}", key, range.text(), short_number(constant)),
                    percent_cure(constant, range));
  }
  if (array->empty())
    return complain(*value, fmt::format("{} is empty", key), "write a number or [[nm, value], ...]");
  std::vector<std::pair<double, double>> points;
  std::vector<double> row;
  for (const auto& element : *array) {
    if (!numbers_in(element, key, 2, kAnyNumber, row)) return std::nullopt;
    points.emplace_back(row[0], row[1]);
  }
  if (const auto fault = find_fault(points))
    return complain((*array)[fault->point], fmt::format("{}: {}", key, fault->what), fault->cure);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [nm, quantity] = points[i];
    if (range.contains(quantity)) continue;
    return complain(*(*array)[i].as_array()->get(1),
                    fmt::format("{} must be {}, not {} at {} nm", key, range.text(), short_number(quantity),
                                short_number(nm)),
                    percent_cure(quantity, range));
  }
  return SpectralCurve(std::move(points));
}

}  // namespace dim
