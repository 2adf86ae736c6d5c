#include "transport/column_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "network/balance.hpp"

namespace dim {
namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();

class Reporter {
 public:
  Reporter(Propagation& propagation, const LastReflection& last)
      : propagation_(propagation),
        last_(last),
        width_(propagation.width()),
        reports_(propagation.n_columns()) {}

  void add_energy() {
    const auto& visible = propagation_.network().visible;
    enum { kFlux, kSent, kEscaped, kDropped, kLost, kTerms };
    const auto sums = add(kTerms, [&](std::size_t i, std::size_t at, double rho, auto&& to) {
      const double area_m2 = propagation_.area_m2(i), value = last_.irradiance[at], change = last_.change[at];
      to(kFlux) += area_m2 * value;
      to(kSent) += area_m2 * rho * value;
      to(kEscaped) += area_m2 * (1.0 - visible[i]) * rho * value;
      to(kDropped) += area_m2 * visible[i] * rho * change;
      to(kLost) += last_.lost_m2[i] * rho * (value - change);
    });
    flux_.assign(sums.begin(), sums.begin() + static_cast<std::ptrdiff_t>(width_));
    for (std::size_t c = 0; c < reports_.size(); ++c) {
      const auto sum = [&](std::size_t term) { return sums[term * width_ + c]; };
      reports_[c].absorbed = sum(kFlux) - sum(kSent);
      reports_[c].escaped = sum(kEscaped);
      reports_[c].dropped = sum(kDropped);
      reports_[c].unbalanced = sum(kLost);
      reports_[c].cut = propagation_.cut_off() * sum(kSent);
    }
    ShineState* shine = propagation_.shine();
    if (!shine) return;
    const auto power = shine->power(propagation_.emit(last_.irradiance));
    for (std::size_t c = 0; c < reports_.size(); ++c) {
      reports_[c].absorbed -= power.reflected[c];
      reports_[c].escaped += power.escaped[c];
      reports_[c].dropped += power.in_flight[c];
    }
  }

  void add_bounds(const Contraction& contraction, const std::vector<std::size_t>& classes) {
    const auto extremes = largest_of_cells();
    const auto lit_m2 = add(1, [&](std::size_t i, std::size_t at, double, auto&& to) {
      to(0) += last_.irradiance[at] > 0.0 ? propagation_.area_m2(i) : 0.0;
    });
    const auto left = add(1, [&](std::size_t i, std::size_t at, double rho, auto&& to) {
      to(0) += propagation_.area_m2(i) * rho * std::abs(last_.change[at]);
    });
    for (std::size_t c = 0; c < reports_.size(); ++c) {
      if (!(flux_[c] > 0.0)) continue;
      const double share = contraction.share[classes[c]], mean = flux_[c] / lit_m2[c];
      ColumnReport& report = reports_[c];
      const double cut = bound(report.cut / flux_[c], 1.0, share);
      if (contraction.in_flux) {
        const double landing = contraction.landing[classes[c]];
        report.error_bound = cut + bound((left[c] + last_.lobes[c]) / flux_[c], landing, share);
        report.local_error_bound = report.error_bound > 0.0 ? kNoBound : 0.0;
        continue;
      }
      const double worst = bound(extremes[kChange * width_ + c], share, share);
      const double darkest = extremes[kSpread * width_ + c] > 0.0 ? 0.0 : 1.0 / extremes[kDark * width_ + c];
      report.error_bound = cut + worst / mean;
      report.local_error_bound = cut + worst / std::max(darkest, kIrradianceFloor * mean);
    }
  }

  std::vector<ColumnReport>& reports() { return reports_; }

 private:
  enum { kChange, kDark, kSpread, kExtremes };

  static double bound(double left, double times, double share) {
    if (left == 0.0 || times == 0.0) return 0.0;
    return share < 1.0 ? left * times / (1.0 - share) : kNoBound;
  }

  // The largest change of a reflecting cell; one over the least light of a lit cell; and whether the last
  // reflection reached a cell that had been dark, so that others may be yet to be reached.
  std::vector<double> largest_of_cells() const {
    return propagation_.sums().largest<double>(
        kExtremes, [&](std::size_t first, std::size_t last, double* into) {
          for_columns(first, last, [&](std::size_t, std::size_t at, std::size_t c, double rho) {
            const double value = last_.irradiance[at], change = last_.change[at];
            const auto raise = [&](std::size_t term, double x) {
              into[term * width_ + c] = std::max(into[term * width_ + c], x);
            };
            if (rho > 0.0) raise(kChange, std::abs(change));
            if (!(value > 0.0)) return;
            raise(kDark, 1.0 / value);
            if (value == change) raise(kSpread, 1.0);
          });
        });
  }

  // Calls f(cell, place in [n_cells, width], reflectance, function from term to its sum).
  template <class F>
  std::vector<double> add(std::size_t n_terms, F&& f) const {
    return propagation_.sums().add<double>(
        n_terms, [&](std::size_t first, std::size_t last, double* into) {
          for_columns(first, last, [&](std::size_t i, std::size_t at, std::size_t c, double rho) {
            f(i, at, rho, [&](std::size_t term) -> double& { return into[term * width_ + c]; });
          });
        });
  }

  template <class F>
  void for_columns(std::size_t first, std::size_t last, F&& f) const {
    for (std::size_t i = first; i < last; ++i) {
      const double* rho = propagation_.reflectance(i);
      for (std::size_t c = 0; c < width_; ++c) f(i, i * width_ + c, c, rho[c]);
    }
  }

  Propagation& propagation_;
  const LastReflection& last_;
  std::size_t width_;
  std::vector<double> flux_;  // [width] on cells
  std::vector<ColumnReport> reports_;
};

}  // namespace

std::vector<ColumnReport> report_columns(Propagation& propagation, const LastReflection& last,
                                         const Contraction& contraction,
                                         const std::vector<std::size_t>& classes) {
  Reporter reporter(propagation, last);
  reporter.add_energy();
  reporter.add_bounds(contraction, classes);
  return std::move(reporter.reports());
}

std::vector<double> lost_by_cells(const Network& network, const Cells& cells) {
  std::vector<double> row_m2(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) row_m2[i] = cells.area_m2(i) * network.row_scale[i];
  auto lost_m2 = apply_columns(network, row_m2);
  for (std::size_t j = 0; j < cells.size(); ++j)
    lost_m2[j] = cells.area_m2(j) * network.visible[j] - network.column_scale[j] * lost_m2[j];
  return lost_m2;
}

}  // namespace dim
