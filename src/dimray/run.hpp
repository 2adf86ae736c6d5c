#pragma once

#include <string>
#include <vector>

#include "common/program.hpp"
#include "database/search.hpp"
#include "network/network_storage.hpp"
#include "transport/simulate.hpp"

namespace dim {

/// dimray ROOM.rays LIGHTS.toml -o ROOM.lum
class SolveCommand {
 public:
  explicit SolveCommand(Program& program);
  Exit run();

 private:
  SimulationOptions options(const Bands& bands) const;
  Lights lights(const Zone& zone, const DatabaseSearch& search);
  Exit refine(RaysFile& rays, const Lights& lights, SimulationOptions& options, double share);

  Program& program_;
  std::string rays_;
  std::string lights_;
  std::string output_;
  std::vector<std::string> overrides_;
  std::vector<std::string> finishes_;
  std::string database_;
  std::string combine_ = "each";
  std::string accuracy_, budget_;
  double tolerance_ = GatherOptions{}.tolerance;
  std::string bands_ = "auto";
  std::string solver_ = "gather";
  double threshold_ = TrackOptions{}.threshold;
  int mirror_depth_ = -1;
  bool explain_ = false;
  std::vector<std::string> full_;
};

}  // namespace dim
