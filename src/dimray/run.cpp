#include "dimray/run.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/input_file.hpp"
#include "common/database_option.hpp"
#include "common/in_file.hpp"
#include "common/option_checks.hpp"
#include "database/surface_entry.hpp"
#include "dimray/band_option.hpp"
#include "dimray/explain.hpp"
#include "result/database.hpp"
#include "scene/lights_reader.hpp"

namespace dim {
namespace {

constexpr double kGoodBalance = 2e-3;

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
  app.add_option("--tolerance", tolerance_, "Stop when no cell changes by more than this share of the mean")
      ->check(number_within(1e-12, 0.5))
      ->type_name("SHARE")
      ->group("Accuracy");
  add_bands_option(app, bands_);
  app.add_option("--solver", solver_,
                 "gather: from all cells at once; track: the paper's, ray by ray from a stack")
      ->check(CLI::IsMember({"gather", "track"}))
      ->group("Accuracy");
  app.add_option("--threshold", threshold_, "track: drop light below this share of the source's flux")
      ->check(number_within(1e-12, 0.5))
      ->type_name("SHARE")
      ->group("Accuracy");
  app.add_option("--mirror-depth", mirror_depth_, "Mirrors one after the other that luminaires are imaged in")
      ->check(CLI::Range(0, 16))
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

SimulationOptions SolveCommand::options(const Zone& zone, const Lights& lights) {
  SimulationOptions options;
  options.bands = chosen_bands(program_, bands_, zone, lights);
  options.combine =
      combine_ == "each" ? Combine::each : (combine_ == "group" ? Combine::group : Combine::all);
  options.gather.tolerance = tolerance_;
  options.solver = solver_ == "track" ? Solver::track : Solver::gather;
  options.track.threshold = threshold_;
  options.mirror_depth = mirror_depth_;
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
  // Before the work: an output that would replace what the lights file names.
  program_.check_output(output_, read);
  refuse_database_file(output_, search);
  return lights;
}

Exit SolveCommand::run() {
  if (rays_ == "-" && lights_ == "-") throw UsageError("only one of the two inputs can be standard input");
  refuse_terminal(output_, "a luminance database");
  if (solver_ != "track") refuse_without_effect(program_.app(), {"--threshold"}, "without --solver track");
  if (solver_ == "track") refuse_without_effect(program_.app(), {"--tolerance"}, "with --solver track");
  program_.check_output(output_, {rays_, lights_});
  program_.stage("read");
  RaysFile rays = load_rays(rays_, program_.job());
  const DatabaseSearch search = database_search(database_, lights_);
  for (const auto& finish : finishes_) replace_finish(rays.zone, finish, search);
  const Lights all_lights = lights(rays.zone, search);
  const Cells cells(rays.zone);
  if (cells.size() != rays.network.sinks.n_rows())
    throw IoError(rays_, "its network does not fit its zone; make it again with this version of dimdis");

  program_.stage("solve");
  const Job job = program_.job();
  Warnings warnings;
  const SimulationOptions chosen = options(rays.zone, all_lights);
  const Solution solution = in_file(
      rays_, [&] { return simulate(rays.zone, cells, rays.network, all_lights, chosen, job, warnings); });
  program_.warn(warnings);
  program_.stage(kWritingStage);
  const std::string hash = save_lum(output_, rays.zone, cells, all_lights, solution, rays.hash, job);
  program_.stage("");
  return report(rays, solution, hash);
}

Exit SolveCommand::report(const RaysFile& rays, const Solution& solution, const std::string& hash) {
  EnergyBalance sum;
  double flux_lm = 0.0, bound = 0.0, residual = 0.0, worst = 0.0;
  int iterations = 0;
  auto& stats = program_.stats();
  stats["sources"] = nlohmann::json::array();
  for (const auto& source : solution.sources) {
    flux_lm += source.flux_lm;
    bound = std::max(bound, source.error_bound);
    residual = std::max(residual, source.residual);
    iterations = std::max(iterations, source.iterations);
    double source_worst = 0.0;
    for (const auto& e : source.energy) {
      sum.emitted_W += e.emitted_W;
      sum.absorbed_W += e.absorbed_W;
      sum.escaped_W += e.escaped_W;
      sum.lost_W += e.lost_W;
      sum.dropped_W += e.dropped_W;
      source_worst = std::max(source_worst, std::abs(e.imbalance));
    }
    worst = std::max(worst, source_worst);
    stats["sources"].push_back({{"name", source.name},
                                {"flux_lm", source.flux_lm},
                                {"imbalance", source_worst},
                                {"error_bound", source.error_bound}});
  }
  const double scale = sum.emitted_W > 0.0 ? 100.0 / sum.emitted_W : 0.0;
  const double imbalance =
      1e-2 * scale * (sum.emitted_W - sum.absorbed_W - sum.escaped_W - sum.lost_W - sum.dropped_W);
  program_.say(fmt::format(
      "{} sources, {:.6g} lm; absorbed {:.3f} %, escaped {:.3f} %, lost {:.3f} %, dropped {:.4f} %, "
      "imbalance {:+.4f} % (worst source {:.4f} %)",
      solution.sources.size(), flux_lm, sum.absorbed_W * scale, sum.escaped_W * scale, sum.lost_W * scale,
      sum.dropped_W * scale, 100.0 * imbalance, 100.0 * worst));
  program_.say(
      solver_ == "track"
          ? fmt::format("inter-reflection tracked, {:.2g} % of the light dropped", 100.0 * residual)
          : fmt::format("inter-reflection cut after {} iterations, error at most {:.2g} % of a source's mean",
                        iterations, 100.0 * bound));
  if (explain_) explain(program_, solution.plan);
  stats["zone"] = rays.zone.name;
  stats["solver"] = solver_;
  stats["luminaire_images"] = solution.plan.n_images;
  stats["mirror_rays_cut_off"] = solution.plan.mirror_rays_cut_off;
  stats["cells"] = solution.n_cells;
  stats["points"] = solution.n_points;
  stats["bands"] = solution.bands.size();
  stats["band_edges_nm"] = solution.bands.edges_nm;
  stats["reflectance_classes"] = solution.n_reflectance_classes;
  stats["iterations"] = iterations;
  stats["residual"] = residual;
  stats["error_bound"] = bound;
  stats["energy"] = {{"emitted_W", sum.emitted_W},     {"absorbed_W", sum.absorbed_W},
                     {"escaped_W", sum.escaped_W},     {"lost_W", sum.lost_W},
                     {"dropped_W", sum.dropped_W},     {"imbalance", imbalance},
                     {"worst_source_imbalance", worst}};
  stats["input_hash"] = rays.hash;
  stats["output_hash"] = hash;
  const bool reached = solver_ == "track" || residual <= tolerance_;
  if (!reached || std::abs(imbalance) > kGoodBalance) {
    program_.say(!reached ? "the accuracy asked for was not reached"
                          : "the energy balance is open by more than 0.2 %; use a smaller --cell");
    return Exit::check_failed;
  }
  return Exit::done;
}

}  // namespace dim
