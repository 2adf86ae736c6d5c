#include "image/scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace dim {
namespace {

constexpr double kShareBeyond = 0.005;
constexpr double kGreatestDecades = 4.0;

// Smallest of 1, 2, 2.5, 5 times a power of ten that is at least `v` > 0.
double round_up(double v) {
  const double power = std::pow(10.0, std::floor(std::log10(v)));
  for (const double mantissa : {1.0, 2.0, 2.5, 5.0}) {
    if (mantissa * power >= v * (1 - 1e-9)) return mantissa * power;
  }
  return 10 * power;
}

// Nearest of 1, 2, 5 times a power of ten at or below (above) `v` > 0.
double one_two_five(double v, bool above) {
  const double power = std::pow(10.0, std::floor(std::log10(v)));
  constexpr std::array<double, 4> kMantissas = {1.0, 2.0, 5.0, 10.0};
  double below = power;
  for (const double mantissa : kMantissas) {
    if (above && mantissa * power >= v * (1 - 1e-6)) return mantissa * power;
    if (mantissa * power <= v * (1 + 1e-6)) below = mantissa * power;
  }
  return below;
}

double value_of_rank(std::vector<float>& values, std::size_t rank) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank), values.end());
  return static_cast<double>(values[rank]);
}

// How many values may lie beyond an end of the scale.
std::size_t n_beyond(const std::vector<float>& values) {
  return static_cast<std::size_t>(kShareBeyond * static_cast<double>(values.size()));
}

double low_end(std::vector<float>& values) { return value_of_rank(values, n_beyond(values)); }
double high_end(std::vector<float>& values) {
  return value_of_rank(values, values.size() - 1 - n_beyond(values));
}

Scale linear_over(std::vector<float>& values) {
  const double top = high_end(values);
  const double bottom = std::min(0.0, static_cast<double>(*std::min_element(values.begin(), values.end())));
  const double span = top - bottom;
  if (!(span > 0)) return {ScaleKind::linear, 0.0, 1.0};
  const double step = round_up(span / 8);
  return {ScaleKind::linear, step * std::floor(bottom / step * (1 - 1e-9)),
          step * std::ceil(top / step * (1 - 1e-6))};
}

Scale logarithmic_over(std::vector<float>& values) {
  std::erase_if(values, [](float v) { return !(v > 0); });
  if (values.empty()) return {ScaleKind::logarithmic, 0.1, 1.0};
  const double high = one_two_five(high_end(values), true);
  const double lowest = low_end(values);
  double low = one_two_five(std::max(lowest, high * std::pow(10.0, -kGreatestDecades)), false);
  if (low >= high * (1 - 1e-6)) low = high / 10;
  return {ScaleKind::logarithmic, low, high};
}

int decimals_of_step(double step) {
  for (int n = 0; n < 12; ++n) {
    const double scaled = step * std::pow(10.0, n);
    if (std::abs(scaled - std::round(scaled)) < 1e-6 * scaled) return n;
  }
  return 12;
}

std::vector<Tick> linear_ticks(const Scale& scale, int max_labels) {
  const double span = scale.high - scale.low;
  double step = round_up(span / (max_labels + 1));
  const double slack = 1e-6 * span;
  const auto count = [&](double s) {
    return std::floor((scale.high + slack) / s) - std::ceil((scale.low - slack) / s) + 1;
  };
  while (count(step) > max_labels) step = round_up(step * 1.01);
  const int decimals = decimals_of_step(step);
  const bool plain = std::max(std::abs(scale.low), std::abs(scale.high)) < 1e7 && decimals < 6;
  std::vector<Tick> result;
  for (double i = std::ceil((scale.low - slack) / step); i * step <= scale.high + slack; ++i) {
    const double v = i * step + 0.0;
    result.push_back({v, plain ? fmt::format("{:.{}f}", v, decimals) : fmt::format("{:.3g}", v)});
  }
  return result;
}

std::vector<Tick> logarithmic_ticks(const Scale& scale, int max_labels) {
  const int first = static_cast<int>(std::floor(std::log10(scale.low) - 1e-9));
  const int last = static_cast<int>(std::ceil(std::log10(scale.high) + 1e-9));
  std::vector<Tick> all;
  for (int decade = first; decade <= last; ++decade) {
    for (int mantissa = 1; mantissa <= 9; ++mantissa) {
      const double v = mantissa * std::pow(10.0, decade);
      if (v >= scale.low * (1 - 1e-6) && v <= scale.high * (1 + 1e-6)) all.push_back({v, ""});
    }
  }
  const auto labelled = [](double v, int detail) {
    const auto mantissa = std::lround(v / std::pow(10.0, std::floor(std::log10(v) + 1e-9)));
    return mantissa == 1 || (detail > 0 && (mantissa == 2 || mantissa == 5));
  };
  for (const int detail : {1, 0}) {
    const auto n =
        std::count_if(all.begin(), all.end(), [&](const Tick& t) { return labelled(t.value, detail); });
    if (n > max_labels && detail > 0) continue;
    for (Tick& tick : all) {
      if (labelled(tick.value, detail)) tick.label = fmt::format("{:.6g}", tick.value);
    }
    break;
  }
  return all;
}

}  // namespace

double Scale::position(double v) const {
  if (kind == ScaleKind::linear) return (v - low) / (high - low);
  if (!(v > 0)) return -std::numeric_limits<double>::infinity();
  return std::log(v / low) / std::log(high / low);
}

Scale automatic_scale(ScaleKind kind, std::vector<float> values) {
  if (kind == ScaleKind::logarithmic) return logarithmic_over(values);
  if (values.empty()) return {ScaleKind::linear, 0.0, 1.0};
  return linear_over(values);
}

void check_scale(const Scale& scale) {
  const bool finite = std::isfinite(scale.low) && std::isfinite(scale.high);
  if (!finite || !(scale.low < scale.high) || (scale.kind == ScaleKind::logarithmic && !(scale.low > 0))) {
    throw InputError({{},
                      fmt::format("false-colour range {}..{} is not possible", scale.low, scale.high),
                      "give two numbers in ascending order, both above 0 on a logarithmic scale"});
  }
}

std::vector<Tick> ticks(const Scale& scale, int max_labels) {
  check_scale(scale);
  const int n = std::max(2, max_labels);
  return scale.kind == ScaleKind::linear ? linear_ticks(scale, n) : logarithmic_ticks(scale, n);
}

}  // namespace dim
