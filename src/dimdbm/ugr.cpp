#include <fmt/format.h>

#include <cmath>

#include "base/atomic_file.hpp"
#include "common/database_option.hpp"
#include "dimdbm/commands.hpp"
#include "glare/ugr_table.hpp"

namespace dim {
namespace {

constexpr double kTable_lm = 1000.0;  // of the lamps, uncorrected

}  // namespace

UgrCommand::UgrCommand(Program& program) : program_(program) {
  ugr_ = program.add_command(
      "ugr", "Tabular unified glare rating of a fitting (CIE 190): 19 rooms, 5 sets of reflectances",
      "  dimdbm ugr troffer-3600\n  dimdbm ugr panel.ldt --spacing 1");
  ugr_->add_option("ENTRY|FILE", what_, "Fitting, or an .ies, .ldt or .xml file")->required()->type_name("");
  ugr_->add_option("--spacing", spacing_h_, "Of the luminaires, over their height above the eye: 0.25 or 1")
      ->check(CLI::IsMember({0.25, 1.0}))
      ->type_name("SHR");
  ugr_->add_option("-o,--output", output_, "File to write, - for standard output")->type_name("FILE");
  ugr_->add_flag("--json", json_, "JSON in place of CSV");
  add_database_option(*ugr_, db_);
  program.add_common_options(*ugr_);
}

bool UgrCommand::run() {
  if (!ugr_->parsed()) return false;
  program_.check_output(output_, {what_});
  Warnings warnings;
  const Found found = find_entry_or_file(database_search(db_, "-"), what_, warnings);
  program_.warn(warnings);
  const auto* record = found.fitting();
  if (!record) throw InputError({{what_, 0, 0}, "is no fitting: only fittings have a glare rating", ""});
  const Photometry& photometry = record->photometry;
  if (!(photometry.flux_lm > 0.0)) throw InputError({{what_, 0, 0}, "has no light to rate", ""});
  const double lamps_lm = photometry.declared_lamp_flux_lm.value_or(photometry.flux_lm);
  // Uncorrected values belong to lamps of 1000 lm.
  const double correction = 8.0 * std::log10(lamps_lm / kTable_lm);
  Table table({"room_x_h", "room_y_h", "ceiling", "walls", "floor", "ugr_crosswise", "ugr_endwise",
               "ugr_crosswise_1000lm", "ugr_endwise_1000lm"});
  for (const auto& e : ugr_table(IntensityTable(photometry.distribution), photometry.opening, spacing_h_))
    table.add({static_cast<long>(e.room.x_h), static_cast<long>(e.room.y_h), e.reflectances.ceiling,
               e.reflectances.walls, e.reflectances.floor, e.crosswise, e.endwise, e.crosswise - correction,
               e.endwise - correction});
  program_.stage(kWritingStage);
  write_file(output_, json_ ? table.json() : table.csv());
  return true;
}

}  // namespace dim
