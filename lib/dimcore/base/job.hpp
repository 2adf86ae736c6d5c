#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <limits>

#include "base/error.hpp"

namespace dim {

/// What a long computation gets from its caller: somewhere to report progress, a way to be stopped, and how
/// much memory it may use. All optional; the default runs silently to the end.
struct Job {
  /// Called now and then with a stage name and the fraction of it done, 0..1; may come from any thread but
  /// never from two at once.
  std::function<void(const char* stage, double fraction)> progress;
  const std::atomic<bool>* stop = nullptr;
  std::size_t memory_limit_bytes = std::numeric_limits<std::size_t>::max();

  void report(const char* stage, double fraction) const {
    if (progress) progress(stage, fraction);
  }
  bool stopped() const { return stop && stop->load(std::memory_order_relaxed); }
  /// @throws Interrupted if the caller asked to stop
  void check() const {
    if (stopped()) throw Interrupted();
  }
};

}  // namespace dim
