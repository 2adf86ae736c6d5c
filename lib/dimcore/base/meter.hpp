#pragma once

#include <atomic>
#include <cstddef>
#include <mutex>

#include "base/job.hpp"

namespace dim {

/// Reports progress from whichever thread happens to be free to.
class Meter {
 public:
  Meter(const Job& job, const char* stage, std::size_t total) : job_(job), stage_(stage), total_(total) {}
  void add(std::size_t n) {
    const std::size_t done = done_ += n;
    if (!job_.progress) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock) job_.report(stage_, static_cast<double>(done) / static_cast<double>(total_));
  }

 private:
  const Job& job_;
  const char* stage_;
  std::size_t total_;
  std::atomic<std::size_t> done_{0};
  std::mutex mutex_;
};

}  // namespace dim
