#include "dimray/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/input_file.hpp"
#include "common/database_option.hpp"
#include "common/in_file.hpp"
#include "common/option_checks.hpp"
#include "database/surface_entry.hpp"
#include "dimray/band_option.hpp"
#include "dimray/explain.hpp"
#include "dimray/report.hpp"
#include "result/lum_file.hpp"
#include "result/to_accuracy.hpp"
#include "scene/lights_at_points.hpp"
#include "scene/lights_reader.hpp"

namespace dim {
namespace {

// NAME=ENTRY, or NAME=0.7 for a grey.
void replace_finish(Zone& zone, const std::string& text, const DatabaseSearch& search) {
  const auto equals = text.find('=');
  const std::string name = text.substr(0, equals), entry = text.substr(equals + 1);
  std::vector<std::string> names;
  for (auto& finish : zone.finishes) {
    names.push_back(finish.name);
    if (finish.name != name) continue;
    char* end = nullptr;
    const double grey = std::strtod(entry.c_str(), &end);
    if (!entry.empty() && *end == '\0') {
      if (!(grey >= 0.0 && grey <= 1.0))
        throw UsageError("--finish '" + text + "': a reflectance is within 0..1");
      finish = Finish{};
      finish.diffuse = SpectralCurve(grey);
      finish.source = "command line";
    } else {
      finish = in_file("--finish " + text, [&] { return find_surface_entry(search, entry); });
    }
    finish.name = name;
    return;
  }
  throw InputError(
      {{"--finish " + text, 0, 0}, "the zone has no finish '" + name + "'", name_cure(name, names)});
}

}  // namespace

SolveCommand::SolveCommand(Program& program) : program_(program) {
  auto& app = program.app();
  app.add_option("ROOM.rays", rays_, "Ray network made by dimdis, - for standard input")
      ->required()
      ->type_name("");
  app.add_option("LIGHTS.toml", lights_, "Lights file, - for standard input")->required()->type_name("");
  app.add_option("-o,--output", output_, "Luminance database to write, - for standard output")
      ->required()
      ->type_name("FILE");
  app.add_option("--set", overrides_, "Override a value of the lights file: KEY=VALUE, repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->check(pair_of("KEY=VALUE"))
      ->default_str("")
      ->group("Input");
  app.add_option("--finish", finishes_,
                 "Use another database entry, or a grey 0..1, for a finish of the zone")
      ->type_name("NAME=ENTRY")
      ->allow_extra_args(false)
      ->check(pair_of("NAME=ENTRY"))
      ->default_str("")
      ->group("Input");
  add_database_option(app, database_);
  app.add_option("--combine", combine_,
                 "What is solved and stored apart: each luminaire, group, or all as one")
      ->check(CLI::IsMember({"each", "group", "all"}))
      ->group("Accuracy");
  app.add_option("--tolerance", tolerance_, "Stop when a reflection changes no cell by more than this share of its own")
      ->check(number_within(1e-12, 0.5))
      ->type_name("SHARE")
      ->group("Accuracy");
  app.add_option("--accuracy", accuracy_,
                 "Refine cells, rays and tolerance until the stated error of 95 % of the measuring points is no more "
                 "than this share of their illuminance; exit 1 where that is not reached")
      ->check(share_or_percent())
      ->type_name("P%")
      ->default_str("")
      ->group("Accuracy");
  app.add_option("--budget", budget_,
                 "Refine in the same way as far as dimray ends within these seconds on this machine")
      ->check(seconds_text())
      ->type_name("SECONDS")
      ->default_str("")
      ->group("Accuracy")
      ->excludes("--accuracy");
  add_bands_option(app, bands_);
  app.add_option("--solver", solver_,
                 "gather: from all cells at once; track: the paper's, ray by ray from a stack")
      ->check(CLI::IsMember({"gather", "track"}))
      ->group("Accuracy");
  app.add_option("--threshold", threshold_, "track: drop light below this share of the source's flux")
      ->check(number_within(1e-12, 0.5))
      ->type_name("SHARE")
      ->group("Accuracy");
  app.add_option(
         "--mirror-depth", mirror_depth_,
         "Mirrors one after the other that luminaires are imaged in, in place of as many as --tolerance "
         "asks for")
      ->check(CLI::Range(0, 1000))
      ->default_str("")
      ->group("Accuracy");
  app.add_flag("--explain", explain_, "Say what the scene requires of the model, and what is left out")
      ->group("Model");
  app.add_option(
         "--full", full_,
         "Do not leave out: visibility (tests where nothing is in the way), bands (that reflect alike)")
      ->check(CLI::IsMember({"visibility", "bands"}))
      ->type_name("WHAT")
      ->allow_extra_args(false)
      ->default_str("")
      ->group("Model");
  program.add_common_options(app);
}

SimulationOptions SolveCommand::options(const Bands& bands) const {
  SimulationOptions options;
  options.bands = bands;
  options.combine =
      combine_ == "each" ? Combine::each : (combine_ == "group" ? Combine::group : Combine::all);
  options.gather.tolerance = tolerance_;
  options.solver = solver_ == "track" ? Solver::track : Solver::gather;
  options.track.threshold = threshold_;
  if (mirror_depth_ >= 0) options.mirror_depth = mirror_depth_;
  const auto kept = [&](const char* what) {
    return std::find(full_.begin(), full_.end(), what) != full_.end();
  };
  options.always_test_visibility = kept("visibility");
  options.solve_every_band = kept("bands");
  return options;
}

Lights SolveCommand::lights(const Zone& zone, const DatabaseSearch& search) {
  constexpr std::size_t kMaxLightsBytes = 64 << 20;
  Warnings warnings;
  const std::string text = read_text_file(lights_, kMaxLightsBytes, program_.job());
  std::vector<std::string> read;
  const FileLoader load = [&](const std::string& path) {
    read.push_back(path);
    return load_from_disk()(path);
  };
  Lights lights =
      read_lights(text, lights_ == "-" ? "<stdin>" : lights_, overrides_, zone, search, warnings, load);
  program_.warn(warnings);
  program_.warn(warn_of_lights_at_points(zone, lights));
  // Before the work: an output that would replace what the lights file names.
  program_.check_output(output_, read);
  refuse_database_file(output_, search);
  return lights;
}

Exit SolveCommand::run() {
  if (rays_ == "-" && lights_ == "-") throw UsageError("only one of the two inputs can be standard input");
  refuse_terminal(output_, "a luminance database");
  if (solver_ != "track") refuse_without_effect(program_.app(), {"--threshold"}, "without --solver track");
  if (solver_ == "track") refuse_without_effect(program_.app(), {"--tolerance", "--accuracy", "--budget"}, "with --solver track");
  program_.check_output(output_, {rays_, lights_});
  program_.stage("read");
  RaysFile rays = load_rays(rays_, program_.job());
  const DatabaseSearch search = database_search(database_, lights_);
  for (const auto& finish : finishes_) replace_finish(rays.zone, finish, search);
  const Lights all_lights = lights(rays.zone, search);
  const Cells& cells = rays.cells;

  program_.stage("solve");
  const Job job = program_.job();
  Warnings warnings;
  const BandChoice bands = chosen_bands(program_, bands_, rays.zone, all_lights);
  SimulationOptions chosen = options(bands.bands);
  const double share = accuracy_.empty() ? rays.network.accuracy : share_of(accuracy_);
  const Exit accurate = refine(rays, all_lights, chosen, budget_.empty() ? share : 0.0);
  const Solution solution = in_file(
      rays_, [&] { return simulate(rays.zone, cells, rays.network, all_lights, chosen, job, warnings); });
  program_.warn(warnings);
  program_.stage(kWritingStage);
  const std::string hash = save_lum(output_, rays.zone, cells, all_lights, solution, rays.hash, job);
  program_.stage("");
  auto& stats = program_.stats();
  stats["zone"] = rays.zone.name;
  stats["solver"] = solver_;
  stats["input_hash"] = rays.hash;
  stats["output_hash"] = hash;
  const Exit judged = report(program_, solution, {solver_ == "track", chosen.gather.tolerance});
  if (explain_) explain(program_, solution, bands);
  return judged == Exit::done ? accurate : judged;
}

Exit SolveCommand::refine(RaysFile& rays, const Lights& lights, SimulationOptions& options, double share) {
  const bool timed = !budget_.empty();
  if (options.solver != Solver::gather || (!timed && share == 0.0)) return Exit::done;
  const ToAccuracy result = in_file(rays_, [&] {
    return timed ? refine_within(rays, lights, options, {seconds_of(budget_), [&] { return program_.elapsed_s(); }},
                                 program_.job())
                 : refine_to_accuracy(rays, lights, options, share, program_.job());
  });
  const auto& patches = rays.network.patches;
  const auto& point_patches = rays.network.point_patches;
  const std::string asked =
      timed ? fmt::format("{} asked for", budget_) : fmt::format("{:.2g} % asked for", 100.0 * share);
  const std::string text = fmt::format(
      "accuracy: {:.2g} % stated at 95 % of the points, {}; cells {:.2f} times as large as the file's, "
      "{}x{} patches, {}x{} at points, tolerance {:.1e}",
      100.0 * result.stated, asked, result.cell_size, patches.n_slices, patches.n_sectors,
      point_patches.n_slices, point_patches.n_sectors, result.tolerance);
  program_.say(text);
  auto& stats = program_.stats();
  if (timed)
    stats["budget_s"] = seconds_of(budget_);
  else
    stats["accuracy_asked"] = share;
  stats["accuracy_stated"] = result.stated;
  stats["accuracy_networks"] = result.n_networks;
  if (result.reached) return Exit::done;
  program_.warn({{{rays_}, fmt::format("the accuracy asked for was not reached: {:.2g} % in place of {:.2g} %",
                                       100.0 * result.stated, 100.0 * share),
                  "it takes more than a billion rays or more memory than there is; ask for less"}});
  return Exit::check_failed;
}

}  // namespace dim
