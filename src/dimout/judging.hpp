#pragma once

#include "dimout/commands.hpp"
#include "judge/check.hpp"

namespace dim {

/// glare.
class GlareCommand {
 public:
  explicit GlareCommand(Program& program);
  bool run();

 private:
  void of_view(const LuminanceDatabase& database);
  void of_observers(const LuminanceDatabase& database);
  void of_daylight(const LuminanceDatabase& database);

  Program& program_;
  DatabaseInput input_;
  std::string view_, observers_;
  double height_m_ = 1.2;
  int n_directions_ = 24;
  bool worst_ = false, daylight_ = false;
  CLI::App* glare_;
};

/// What requirements are held against: the luminaires of the mix asked for, and its daylight where a daylight factor
/// is required.
/// @throws InputError  a sky without light
CheckInput check_input(const LuminanceDatabase& database, const Requirements& requirements, DatabaseInput asked);

/// check.
class CheckCommand {
 public:
  explicit CheckCommand(Program& program);
  bool run(Exit& status);

 private:
  void write_findings(const std::vector<Finding>& findings);

  Program& program_;
  DatabaseInput input_;
  std::string require_;
  std::vector<std::string> set_;
  CLI::App* check_;
};

}  // namespace dim
