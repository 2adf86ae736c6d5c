#include "transport/image_series.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dim {
namespace {

constexpr std::size_t kLeastOrders = 4;      // from which a ratio is taken
constexpr double kMostReflectance = 0.9999;  // nearer to 1 the geometric bound says nothing
constexpr double kNothingLeft = 1e-4;        // of the series, where its sum is ended
constexpr int kMostTerms = 100000;

double geometric(double first, double ratio) { return first * ratio / (1.0 - ratio); }

// Sum of last * ratio^j (1 + j step)^-exponent over j = 1, 2, ...
double falling(double last, double ratio, double step, double exponent) {
  double sum = 0.0, power = last;
  for (int j = 1; j < kMostTerms; ++j) {
    power *= ratio;
    const double term = power * std::pow(1.0 + j * step, -exponent);
    sum += term;
    if (term < kNothingLeft * (1.0 - ratio) * sum) break;
  }
  return sum;
}

}  // namespace

ImageTail tail_of_images(std::span<const double> by_order, double reflectance) {
  const double f = std::min(reflectance, kMostReflectance);
  if (by_order.empty() || !(f > 0.0)) return {};
  if (by_order.size() < kLeastOrders) return {0.0, geometric(by_order.back(), f)};
  const std::size_t block = 2 * std::max<std::size_t>(1, by_order.size() / 6);
  const auto sum = [&](std::size_t blocks_back) {
    const auto end = by_order.end() - static_cast<std::ptrdiff_t>(block * (blocks_back - 1));
    return std::accumulate(end - static_cast<std::ptrdiff_t>(block), end, 0.0);
  };
  const double last = sum(1), before = sum(2), flattest = std::pow(f, static_cast<double>(block));
  if (!(last > 0.0)) return {};
  const double highest = geometric(last, flattest);
  if (!(before > last / flattest)) return {highest, highest};
  const double ratio = last / before;
  const double middle = static_cast<double>(by_order.size()) - 0.5 * static_cast<double>(block - 1);
  const double step = static_cast<double>(block) / middle;
  const double exponent = std::log(flattest / ratio) / -std::log(1.0 - step);
  const double lowest = geometric(last, ratio), likely = falling(last, flattest, step, exponent);
  return {likely, std::max(std::min(highest - likely, likely), likely - lowest)};
}

}  // namespace dim
