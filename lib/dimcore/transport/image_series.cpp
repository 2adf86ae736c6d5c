#include "transport/image_series.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dim {
namespace {

constexpr std::size_t kLeastOrders = 6;      // that make three blocks of two
constexpr double kMostReflectance = 0.9999;  // nearer to 1 the geometric bound says nothing
constexpr double kNothingLeft = 1e-4;        // of the series, where its sum is ended
constexpr int kMostTerms = 100000;
// Doubt about a tail, as a share of it: at least, and for each unit that its blocks are irregular by. Least
// values that never told too little in 2301 series of lattices of images (rooms, lamps, receivers and four
// reflectances by chance, 2 to 40 orders).
constexpr double kLeastDoubt = 0.4, kDoubt = 4.0;

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
  const std::size_t n = by_order.size();
  if (n == 0 || !(f > 0.0)) return {};
  if (n < kLeastOrders) return {0.0, geometric(by_order[n - 1] + (n > 1 ? by_order[n - 2] : 0.0), f)};
  const std::size_t length = 2 * (n / kLeastOrders);
  const auto block = [&](std::size_t back) {  // 1: the last
    const auto orders = by_order.subspan(n - back * length, length);
    return std::accumulate(orders.begin(), orders.end(), 0.0);
  };
  const double last = block(1), before = block(2), first = block(3);
  const double flattest = std::pow(f, static_cast<double>(length));
  if (!(last > 0.0)) return {};
  const double highest = geometric(last, flattest);
  if (!(before > last / flattest)) return {highest, highest};
  const double middle = static_cast<double>(n) - 0.5 * static_cast<double>(length - 1);
  const double step = static_cast<double>(length) / middle;
  // Exponent at which a block falls to the next, whose middle is `growth` times as deep.
  const auto exponent = [&](double from, double to, double growth) {
    return std::log(flattest * from / to) / std::log(growth);
  };
  const double likely = falling(last, flattest, step, exponent(before, last, 1.0 / (1.0 - step)));
  const double bound = std::max(std::min(highest - likely, likely), likely - geometric(last, last / before));
  if (!(first > before / flattest)) return {likely, bound};
  // What the first two blocks say of the last tells how regular the series is.
  const double growth = 1.0 / (1.0 - step);
  const double told =
      before * flattest * std::pow(growth, -exponent(first, before, (1.0 - step) / (1.0 - 2.0 * step)));
  return {likely, std::min(bound, likely * std::max(kLeastDoubt, kDoubt * std::abs(told / last - 1.0)))};
}

}  // namespace dim
