#pragma once

#include "dimout/commands.hpp"
#include "result/light_colour.hpp"

namespace dim {

/// colour: chromaticity, colour temperature, rendering and melanopic effect of the light at points or on
/// surfaces.
class ColourCommand {
 public:
  explicit ColourCommand(Program& program);
  /// True when it was asked for.
  bool run();

 private:
  void points(const LuminanceDatabase& database, const LightColours& colours);
  void surfaces(const LuminanceDatabase& database, const LightColours& colours);

  Program& program_;
  DatabaseInput input_;
  std::vector<std::string> planes_;
  bool surfaces_ = false;
  CLI::App* colour_;
};

}  // namespace dim
