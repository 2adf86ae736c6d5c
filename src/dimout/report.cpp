#include "dimout/report.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/atomic_file.hpp"
#include "base/input_file.hpp"
#include "dimout/judging.hpp"
#include "report/report.hpp"

namespace dim {

ReportCommand::ReportCommand(Program& program) : program_(program) {
  report_ = add_command(program, input_, "report",
                        "One web page with plans, figures, requirements, luminaires and pictures; its lights can be dimmed",
                        "dimout report office.lum --require office.require.toml -o office.html");
  auto& app = *report_;
  app.add_option("-o,--output", input_.output, "Page to write, - for standard output")->required()->type_name("FILE.html");
  app.add_option("--require", require_, "Requirements file")->type_name("FILE.toml");
  app.add_option("--set", set_, "Another value in the requirements file, repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->default_str("");
  app.add_option("--shade", shade_, "Light on the pictures' surfaces, as image has it")
      ->check(CLI::IsMember({"cell", "smooth", "gather"}));
}

bool ReportCommand::run() {
  if (!report_->parsed()) return false;
  if (!set_.empty() && require_.empty()) throw UsageError("--set has no effect without --require");
  program_.check_output(input_.output, {input_.path, require_});
  constexpr std::size_t kMostBytes = 16 << 20;
  ReportOptions options;
  if (!require_.empty()) options.requirements = read_requirements(read_text_file(require_, kMostBytes), require_, set_);
  const LuminanceDatabase database = open_database(program_, input_);
  options.mix = mix_of(database, input_);
  if (options.requirements) options.asked = check_input(database, *options.requirements, input_);
  options.shading = shade_ == "cell" ? Shading::cell : shade_ == "smooth" ? Shading::smooth : Shading::gather;
  options.file = std::filesystem::path(input_.path).filename().string();
  options.requirements_file = std::filesystem::path(require_).filename().string();
  program_.stage("page");
  const std::string page = report_page(database, options, program_.job());
  program_.stage(kWritingStage);
  write_file(input_.output, page, program_.job());
  return true;
}

}  // namespace dim
