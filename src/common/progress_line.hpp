#pragma once

#include <chrono>
#include <string>

namespace dim {

/// One line on stderr with a bar and the time left, redrawn in place; shown once the work has taken a second.
struct ProgressLine {
 public:
  ProgressLine(std::string program, bool at_once) : program_(std::move(program)), at_once_(at_once) {}
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const std::string& stage, double fraction);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::string program_;
  bool at_once_ = false;
  bool shown_ = false;
  std::string stage_;
  Clock::time_point stage_start_ = Clock::now();
  Clock::time_point last_drawn_{};
};

}  // namespace dim
