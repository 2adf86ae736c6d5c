#pragma once

#include "dimout/commands.hpp"

namespace dim {

/// report.
class ReportCommand {
 public:
  explicit ReportCommand(Program& program);
  bool run();

 private:
  Program& program_;
  DatabaseInput input_;
  std::string require_;
  std::string shade_ = "smooth";
  std::vector<std::string> set_;
  CLI::App* report_;
};

}  // namespace dim
