#include "transport/conjugate_residuals.hpp"

#include <algorithm>
#include <cmath>

#include "transport/gather_kernel.hpp"

namespace dim {
namespace {

// Residuals reduced by more than this are made of rounding.
constexpr double kLeastOfCycle = 1e-6;
// A step that takes less than this share of the residual's square is none.
constexpr double kLeastGain = 1e-3;

double ratio(double a, double b) { return b > 0.0 ? a / b : 0.0; }

std::vector<float> floats(const std::vector<double>& values) {
  std::vector<float> result;
  result.reserve(values.size());
  for (const double value : values) result.push_back(static_cast<float>(value));
  return result;
}

}  // namespace

ConjugateResiduals::ConjugateResiduals(Propagation& propagation)
    : propagation_(propagation),
      width_(propagation.width()),
      rho_(floats(propagation.reflectances())),
      row_scale_(floats(propagation.network().row_scale)),
      column_scale_(floats(propagation.network().column_scale)),
      unit_(width_),
      floor_(width_) {
  for (std::size_t i = 0; i < propagation.surfaces().size(); ++i)
    area_m2_.push_back(static_cast<float>(propagation.area_m2(i)));
}

void ConjugateResiduals::improve(std::vector<double>& x, const std::vector<double>& residual,
                                 std::vector<Goal>& goals) {
  const auto any = [&] {
    return std::any_of(goals.begin(), goals.end(), [](const Goal& goal) { return goal.active; });
  };
  if (!any()) return;
  start(x, residual, goals);
  const CellSums& sums = propagation_.sums();
  std::vector<double> reduced2(width_, 0.0), first2;
  std::vector<float> back(width_), step(width_);
  while (any()) {
    const auto along = reduce();
    for (std::size_t c = 0; c < width_; ++c) back[c] = static_cast<float>(ratio(along[c], reduced2[c]));
    const auto products = sums.add<float>(3, [&](std::size_t first, std::size_t last, float* into) {
      turn(rows(first, last), back.data(), into);
    });
    const std::vector<double> left2(products.end() - static_cast<std::ptrdiff_t>(width_), products.end());
    if (first2.empty()) first2 = left2;
    for (std::size_t c = 0; c < width_; ++c) {
      reduced2[c] = products[c];
      step[c] = goals[c].active ? static_cast<float>(ratio(products[width_ + c], reduced2[c])) : 0.0F;
    }
    const auto worst = sums.largest<float>(1, [&](std::size_t first, std::size_t last, float* into) {
      go(rows(first, last), step.data(), start_.data(), floor_.data(), column_scale_.data(), exitance_.data(),
         into);
    });
    for (std::size_t c = 0; c < width_; ++c) {
      Goal& goal = goals[c];
      if (!goal.active) continue;
      const double gain2 = static_cast<double>(step[c]) * products[width_ + c];
      goal.active = ++goal.sweeps < goal.most_sweeps && worst[c] > goal.local &&
                    gain2 > kLeastGain * left2[c] &&
                    left2[c] - gain2 > kLeastOfCycle * kLeastOfCycle * first2[c];
    }
  }
  sums.each([&](std::size_t i) {
    for (std::size_t c = 0; c < width_; ++c) {
      if (goals[c].sweeps > 0) x[i * width_ + c] += unit_[c] * static_cast<double>(change_[i * width_ + c]);
    }
  });
}

void ConjugateResiduals::start(const std::vector<double>& x, const std::vector<double>& residual,
                               std::vector<Goal>& goals) {
  const CellSums& sums = propagation_.sums();
  const auto largest = sums.largest<double>(1, [&](std::size_t first, std::size_t last, double* into) {
    for (std::size_t i = first; i < last; ++i) {
      for (std::size_t c = 0; c < width_; ++c)
        into[c] = std::max(into[c], propagation_.reflectance(i)[c] * std::abs(residual[i * width_ + c]));
    }
  });
  for (std::size_t c = 0; c < width_; ++c) {
    goals[c].active = goals[c].active && largest[c] > 0.0;
    unit_[c] = goals[c].active ? std::ldexp(1.0, std::ilogb(largest[c])) : 1.0;
    floor_[c] = static_cast<float>(goals[c].floor / unit_[c]);
  }
  start_.resize(x.size());
  residual_.resize(x.size());
  exitance_.resize(x.size() + width_, 0.0F);
  reduced_residual_.resize(x.size());
  change_.assign(x.size(), 0.0F);
  direction_.assign(x.size(), 0.0F);
  reduced_.assign(x.size(), 0.0F);
  sums.each([&](std::size_t i) {
    for (std::size_t c = 0; c < width_; ++c) {
      const std::size_t at = i * width_ + c;
      const double left = goals[c].active ? residual[at] / unit_[c] : 0.0;
      start_[at] = static_cast<float>(x[at] / unit_[c]);
      residual_[at] = static_cast<float>(left);
      exitance_[at] =
          static_cast<float>(propagation_.network().column_scale[i] * propagation_.reflectance(i)[c] * left);
    }
  });
}

CycleRows ConjugateResiduals::rows(std::size_t first, std::size_t last) {
  return {width_,         first,          last,
          propagation_.surfaces().data(),  rho_.data(),     area_m2_.data(),
          change_.data(), residual_.data(), direction_.data(), reduced_.data(), reduced_residual_.data()};
}

// (1 - K R) r, and its products with (1 - K R) p.
std::vector<double> ConjugateResiduals::reduce() {
  const Network& network = propagation_.network();
  if (propagation_.has_mirrors() && !propagation_.has_lobes()) propagation_.send(exitance_, arriving_);
  return propagation_.sums().add<float>(1, [&](std::size_t first, std::size_t last, float* into) {
    std::vector<double> of_run;
    const double* arriving = nullptr;
    if (!arriving_.empty()) {
      arriving = arriving_.data() + first * width_;
    } else {
      of_run.resize((last - first) * width_);
      gather_rows(network.sinks, network.patches, network.has_family() ? &network.extra : nullptr,
                  exitance_.data(), width_, first, last, of_run.data());
      arriving = of_run.data();
    }
    take_arriving(rows(first, last), arriving, row_scale_.data(), into);
  });
}

}  // namespace dim
