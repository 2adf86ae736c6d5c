#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/program.hpp"
#include "common/table.hpp"
#include "database/entry_text.hpp"
#include "database/fitting_record.hpp"
#include "database/search.hpp"
#include "dimdbm/entries.hpp"

namespace dim {

/// list, show and check.
class LookCommands {
 public:
  explicit LookCommands(Program& program);
  /// True when one of them was asked for.
  bool run(Exit& status);

 private:
  void list();
  void show();
  Exit check();
  void show_fitting(const FittingRecord& record);
  void show_surface(const Finish& finish);
  void show_spectrum(const SpectrumEntry& spectrum);
  void write_table(const Table& table);

  Program& program_;
  std::string db_, what_, output_ = "-", kind_ = "all";
  bool json_ = false, csv_ = false;
  CLI::App *list_, *show_, *check_;
};

/// plot.
class PlotCommand {
 public:
  explicit PlotCommand(Program& program);
  bool run();

 private:
  Program& program_;
  std::string db_, what_, output_;
  CLI::App* plot_;
};

/// ugr.
class UgrCommand {
 public:
  explicit UgrCommand(Program& program);
  bool run();

 private:
  Program& program_;
  std::string db_, what_, output_ = "-";
  double spacing_h_ = 0.25;
  bool json_ = false;
  CLI::App* ugr_;
};

/// add.
class AddCommand {
 public:
  explicit AddCommand(Program& program);
  bool run();

 private:
  void refuse_idle_options(const std::string& extension) const;
  void add_photometry();
  void add_spectrum();
  void add_lamp_spectrum();
  void add_entry();
  void store(const std::string& kind, const std::string& name, std::vector<StoredFile> files);
  std::string new_name() const;

  Program& program_;
  std::string db_, file_, name_, title_, source_, licence_, spectrum_;
  std::string kind_ = "opaque", wavelengths_ = "found", values_ = "found";
  std::optional<double> watts_, lumens_, lamp_factor_, maintenance_factor_;
  int column_ = 1;
  bool force_ = false;
  CLI::App* add_;
};

/// remove.
class RemoveCommand {
 public:
  explicit RemoveCommand(Program& program);
  bool run();

 private:
  Program& program_;
  std::string db_, kind_ = "any";
  std::vector<std::string> names_;
  CLI::App* remove_;
};

/// export.
class ExportCommand {
 public:
  explicit ExportCommand(Program& program);
  bool run();

 private:
  Program& program_;
  std::string text_of(const FittingRecord& record, const std::string& format, Warnings& warnings) const;

  std::string db_, what_, output_ = "-", format_;
  bool as_used_ = false;
  CLI::App* export_;
};

}  // namespace dim
