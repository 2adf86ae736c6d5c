#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/program.hpp"
#include "common/table.hpp"
#include "image/contour_drawing.hpp"
#include "image/writer.hpp"
#include "result/luminous.hpp"
#include "result/point_error.hpp"

namespace dim {

/// What every command of dimout takes.
struct DatabaseInput {
  std::string path;
  std::vector<std::string> mix;
  std::vector<std::string> spectra;
  std::vector<std::string> states;
  std::string sky;
  std::string output = "-";
  bool by_source = false;
  bool json = false;
};

/// Adds a subcommand with ROOM.lum, --mix and the common options.
CLI::App* add_command(Program& program, DatabaseInput& input, const std::string& name,
                      const std::string& what, const std::string& example);
void add_table_options(CLI::App& command, DatabaseInput& input, bool by_source);

/// The database, its sources' spectra replaced where --spectrum asks for it.
LuminanceDatabase open_database(Program& program, const DatabaseInput& input);

/// The factors that --mix, --state and --sky ask for.
Mix mix_of(const LuminanceDatabase& database, const DatabaseInput& input);

/// Calls `each` once with all sources mixed, or with --by source once a source; the name is empty for the
/// mix.
void for_sources(const LuminanceDatabase& database, const DatabaseInput& input,
                 const std::function<void(const std::string& source, const Mix& mix)>& each);

void write_table(Program& program, const Table& table, const DatabaseInput& input);

/// A column list with `source` in front where --by source asks for it.
std::vector<std::string> columns_with_source(const DatabaseInput& input, std::vector<std::string> columns);

/// A row of such a table: the source in front where there is one.
std::vector<Table::Value> row_with_source(const std::string& source, std::vector<Table::Value> values);

/// --plane, repeatable.
CLI::Option* add_plane_option(CLI::App& command, std::vector<std::string>& planes);

/// The measuring planes and sensors of those names, in their order; all where none is named.
/// @throws InputError  no such name, about the file of that path
std::vector<PointSet> chosen_sets(const Zone& zone, const std::vector<std::string>& names, const std::string& path);
/// Of these the planar ones, where nothing else has what is asked for.
/// @throws InputError  a named one measures something else: `what` is of planar illuminance
std::vector<PointSet> planar_sets(const Zone& zone, const std::vector<std::string>& names, const std::string& path,
                                  const std::string& what);

/// Where daylight factors are asked for: the illuminance outside, of the sky alone, unobstructed. Coefficients
/// stand under a CIE overcast sky unless --sky says another, which is put into `input`.
/// @throws InputError  no daylight, or a black sky
double outside_lx(const LuminanceDatabase& database, DatabaseInput& input);

/// info, surfaces, cells and grid.
class TableCommands {
 public:
  explicit TableCommands(Program& program);
  /// True when one of them was asked for.
  bool run();

 private:
  void info();
  std::string planes_info(const LuminanceDatabase& database, nlohmann::ordered_json& planes) const;
  void surfaces();
  void cells();
  void grid();
  void grid_stats(const LuminanceDatabase& database, const std::vector<PointSet>& sets);
  double stated_lx(const PointError& error) const;
  std::vector<double> point_lx(const LuminanceDatabase& database, const Mix& mix) const;
  std::vector<double> maintained_lx(const LuminanceDatabase& database, const Mix& mix) const;

  Program& program_;
  DatabaseInput input_;
  std::vector<std::string> planes_;
  bool stats_ = false;
  bool direct_ = false;
  bool daylight_factor_ = false;
  CLI::App *info_, *surfaces_, *cells_, *grid_;
};

/// image.
class ImageCommand {
 public:
  explicit ImageCommand(Program& program);
  bool run();

 private:
  void render();
  void refuse_idle_options(PictureFormat format) const;
  View chosen_view(const Zone& zone) const;

  Program& program_;
  DatabaseInput input_;
  std::string view_;
  std::string size_;
  std::string shade_ = "smooth";
  std::string tone_ = "linear";
  std::string quantity_ = "illuminance";
  std::string range_;
  bool logarithmic_ = false;
  bool spectral_ = false;
  double white_cd_m2_ = 0.0;
  double screen_white_cd_m2_ = 100.0;
  int samples_ = 3;
  CLI::App* image_;
};

/// contour.
class ContourCommand {
 public:
  explicit ContourCommand(Program& program);
  bool run();

 private:
  void draw();
  std::vector<double> chosen_levels(const std::vector<double>& values) const;
  ContourMap map_of_plane(const LuminanceDatabase& database);
  ContourMap map_of_surface(const LuminanceDatabase& database);
  void set_shared(const LuminanceDatabase& database, const std::string& name, ContourMap& map);

  Program& program_;
  DatabaseInput input_;
  std::string plane_, surface_, levels_;
  bool filled_ = false, values_ = false, daylight_factor_ = false;
  int size_px_ = 1000;
  CLI::App* contour_;
};

}  // namespace dim
