#pragma once

#include <string>
#include <vector>

#include "common/program.hpp"
#include "geometry/view_factors.hpp"
#include "import/import.hpp"
#include "network/network.hpp"
#include "scene/zone.hpp"

namespace dim {

/// What every command of dimdis needs to read a zone.
struct ZoneInput {
  std::string path;
  std::vector<std::string> overrides;
  std::string database;
  double cell_m = 0.0;
  bool strict = false;
};

void add_zone_options(CLI::App& app, ZoneInput& input, bool required);

/// Prints warnings; with --strict they are errors.
/// @throws InputError
void warn(Program& program, const ZoneInput& input, const Warnings& warnings);

/// Reads and checks the zone and tells its warnings.
Zone read_zone(Program& program, const ZoneInput& input);

/// dimdis ZONE -o ROOM.rays
class DiscretiseCommand {
 public:
  explicit DiscretiseCommand(Program& program);
  Exit run();

 private:
  void predict(std::size_t n_cells, std::size_t n_points, const NetworkOptions& options) const;

  Program& program_;
  ZoneInput input_;
  std::string output_;
  std::string patches_ = "16x32";
  std::string accuracy_;
  std::string point_patches_ = "auto";
  std::string sampling_ = "stratified";
  bool family_ = false;
  std::uint64_t seed_ = 1;
};

/// dimdis check | areas | viewfactors | draw ZONE
class GeometryCommands {
 public:
  explicit GeometryCommands(Program& program);
  /// True when one of them was asked for; its exit status in `status`.
  bool run(Exit& status);

 private:
  Exit check();
  Exit areas();
  Exit factors();
  Exit draw();
  CLI::App* add(const std::string& name, const std::string& what, const std::string& example);

  Program& program_;
  ZoneInput input_;
  std::string output_ = "-";
  std::string view_;
  int rays_ = kViewFactorRays;
  CLI::App *check_, *areas_, *view_factors_, *draw_;
};

/// dimdis export ZONE --to radiance|obj
class ExportCommand {
 public:
  explicit ExportCommand(Program& program);
  /// True when it was asked for.
  bool run();

 private:
  Program& program_;
  ZoneInput input_;
  std::string format_, points_;
  std::string output_ = "-";
  CLI::App* command_;
};

/// dimdis import FILE -o F.zone.toml
class ImportCommand {
 public:
  explicit ImportCommand(Program& program);
  /// True when it was asked for; its exit status in `status`.
  bool run(Exit& status);

 private:
  ImportOptions options() const;
  void tell(const ImportResult& result) const;
  void write_lights(const ImportResult& result) const;
  bool is_sound(const std::string& zone) const;

  Program& program_;
  std::string input_, format_, unit_, up_, inside_, lights_;
  double gap_m_ = 0.0;
  bool strict_ = false;
  std::string output_ = "-";
  CLI::App* command_;
};

/// dimdis new box|l --size LxWxH
class NewCommand {
 public:
  explicit NewCommand(Program& program);
  /// True when it was asked for.
  bool run();

 private:
  void refuse_existing(const std::string& path) const;

  Program& program_;
  std::string shape_, size_, leg_, lights_;
  std::string output_ = "-";
  CLI::App* command_;
};

}  // namespace dim
