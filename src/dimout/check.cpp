#include "judge/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/input_file.hpp"
#include "climate/sky_mix.hpp"
#include "dimout/judging.hpp"

namespace dim {

CheckInput check_input(const LuminanceDatabase& database, const Requirements& requirements, DatabaseInput asked) {
  CheckInput input;
  const bool daylight_asked =
      std::any_of(requirements.requirements.begin(), requirements.requirements.end(),
                  [](const Requirement& r) { return r.daylight_factor_percent.has_value(); });
  if (daylight_asked && database.sky()) input.outside_lx = outside_lx(database, asked);
  input.initial = mix_of(database, asked);
  if (daylight_asked && database.sky()) input.daylight = diffuse_daylight(database, input.initial);
  // What is asked of the lighting must be met at night.
  for (std::size_t s = 0; s < input.initial.size(); ++s)
    if (database.sources()[s].daylight) input.initial[s] = 0.0;
  return input;
}

CheckCommand::CheckCommand(Program& program) : program_(program) {
  check_ =
      add_command(program, input_, "check", "Holds a room against requirements: met, not met or undecided",
                  "dimout check office.lum --require office.require.toml");
  add_table_options(*check_, input_, false);
  check_->add_option("--require", require_, "Requirements file")->required()->type_name("FILE.toml");
  check_->add_option("--set", set_, "Another value in the requirements file, repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

bool CheckCommand::run(Exit& status) {
  if (!check_->parsed()) return false;
  program_.check_output(input_.output, {input_.path, require_});
  constexpr std::size_t kMostBytes = 16 << 20;
  const Requirements requirements = read_requirements(read_text_file(require_, kMostBytes), require_, set_);
  const LuminanceDatabase database = open_database(program_, input_);
  const CheckInput input = check_input(database, requirements, input_);
  const auto findings = check(database, requirements, input, program_.job());
  write_findings(findings);
  std::vector<Verdict> verdicts;
  for (const auto& finding : findings) verdicts.push_back(finding.verdict);
  const auto n = [&](Verdict v) { return std::count(verdicts.begin(), verdicts.end(), v); };
  program_.stage("");
  program_.say(fmt::format("{}: {} met, {} not met, {} undecided{}", requirements.source, n(Verdict::met),
                           n(Verdict::not_met), n(Verdict::undecided),
                           maintained_mix(database, requirements, input.initial) == input.initial
                               ? "; no maintenance factor: light as new"
                               : ""));
  status = overall(verdicts) == Verdict::met ? Exit::done : Exit::check_failed;
  return true;
}

void CheckCommand::write_findings(const std::vector<Finding>& findings) {
  Table table({"where", "requirement", "unit", "relation", "limit", "value", "initial", "error", "verdict"});
  for (const auto& f : findings)
    table.add({f.where, f.what, f.unit, std::string(f.at_most ? "at most" : "at least"), f.limit, f.value,
               f.initial, f.error, std::string(verdict_name(f.verdict))});
  write_table(program_, table, input_);
}

}  // namespace dim
