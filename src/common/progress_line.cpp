#include "common/progress_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

namespace dim {

void ProgressLine::show(const std::string& stage, double fraction) {
  const auto now = Clock::now();
  if (stage != stage_) {
    stage_ = stage;
    stage_start_ = now;
  }
  const double elapsed_s = std::chrono::duration<double>(now - stage_start_).count();
  if (!at_once_ && elapsed_s < 1.0) return;
  if (std::chrono::duration<double>(now - last_drawn_).count() < 0.1) return;
  last_drawn_ = now;
  shown_ = true;
  constexpr int kWidth = 30;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const int filled = static_cast<int>(fraction * kWidth);
  const double left_s = fraction > 0.0 ? elapsed_s * (1.0 - fraction) / fraction : 0.0;
  std::cerr << fmt::format("\r{}: {:<8} [{:#<{}}{:.<{}}] {:3.0f} %  {:.0f} s left \033[K", program_, stage,
                           "", filled, "", kWidth - filled, 100.0 * fraction, left_s)
            << std::flush;
}

void ProgressLine::clear() {
  if (shown_) std::cerr << "\r\033[K" << std::flush;
  shown_ = false;
}

}  // namespace dim
