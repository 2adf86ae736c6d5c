#pragma once

#include <string>
#include <utility>
#include <vector>

#include "climate/annual.hpp"
#include "climate/blinds.hpp"
#include "climate/circuits.hpp"
#include "climate/control_file.hpp"
#include "climate/lighting_year.hpp"
#include "climate/stored_coefficients.hpp"
#include "dimout/commands.hpp"
#include "dimout/esp_export.hpp"

namespace dim {

/// What the commands of a year take: the database, its windows' states, the weather.
struct DaylightInput {
  DatabaseInput database;
  std::string weather;
  std::vector<std::string> states;
};

/// Adds a subcommand with these options, ROOM.lum needed or not.
CLI::App* add_daylight_command(Program& program, DaylightInput& input, const std::string& name,
                               const std::string& what, const std::string& example, bool weather_required);

/// A solved zone with coefficients, opened for a year.
struct DaylitRoom {
  DaylitRoom(Program& program, const DaylightInput& input);

  LuminanceDatabase database;
  WindowStates states;
  DaylightCoefficients coefficients;
  SunFactors sun;
};

inline constexpr std::size_t kMostControlBytes = 64 << 20;

/// Light through the windows at some points: as they are operated, or as they stand where nobody operates them.
std::vector<WindowPart> parts_at(const DaylitRoom& room, const OperatedWindows& windows,
                                 const std::vector<std::size_t>& points);

/// Says how long windows are closed while it is light.
void say_operated(const Program& program, const std::vector<BlindYear>& blinds, const AnnualSky& sky);

/// annual.
class AnnualCommand {
 public:
  explicit AnnualCommand(Program& program);
  bool run();

 private:
  struct Year;
  Weather weather();
  void points(const DaylitRoom& room, const Year& year);
  void planes(const DaylitRoom& room, const Year& year);
  void heat_map(const DaylitRoom& room, const OperatedWindows& windows, const AnnualSky& sky);
  void plan(const DaylitRoom& room, const Year& year);
  void check_outputs() const;
  OperatedWindows operated(const DaylitRoom& room, const AnnualSky& sky);

  Program& program_;
  DaylightInput input_;
  std::vector<std::string> planes_;
  std::string hours_ = "08:00-18:00";
  std::string presence_;
  std::string summer_time_;
  std::string heat_map_;
  std::string point_;
  std::string plan_;
  std::string metric_ = "da_percent";
  std::string hourly_;
  std::string control_;
  double target_lx_ = 300.0;
  bool stats_ = false;
  CLI::App* annual_;
};

/// levels: zone lighting levels, ESP-r's files, the strict check of these.
class LevelsCommand {
 public:
  explicit LevelsCommand(Program& program);
  bool run();

 private:
  struct Room;
  void check() const;
  void at_moment();
  void levels();
  Weather weather();
  struct Sensed {
    std::vector<SensorYear> years;
    std::vector<BlindYear> blinds;
  };
  static OperatedWindows operate(const Room& room, const AnnualSky& sky, const Job& job);
  Sensed sensed(const Room& room, const Weather& weather);
  void say_energy(const Room& room, const std::vector<Circuit>& circuits,
                  const std::vector<CircuitYear>& years, const Weather& weather) const;

  Program& program_;
  DaylightInput input_;
  std::string control_;
  std::vector<std::string> set_;
  std::string method_ = "daylight-coefficients";
  std::string format_ = "csv";
  std::string from_, to_;
  int steps_per_hour_ = 0;
  std::vector<double> at_;
  std::string check_;
  EspOptions esp_;
  CLI::App* levels_;
};

}  // namespace dim
