#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "common/counted.hpp"
#include "common/database_option.hpp"
#include "common/option_checks.hpp"
#include "dimdis/options.hpp"
#include "network/back_light.hpp"
#include "network/network_storage.hpp"
#include "network/point_places.hpp"

namespace dim {
namespace {

PatchGrid patches_of(const std::string& text, const std::string& option) {
  try {
    return parse_patches(text, option);
  } catch (const InputError& error) {
    throw UsageError(error.what());
  }
}

}  // namespace

DiscretiseCommand::DiscretiseCommand(Program& program) : program_(program) {
  auto& app = program.app();
  add_zone_options(app, input_, false);
  app.add_option("-o,--output", output_, "Ray network to write, - for standard output")->type_name("FILE");
  app.add_option("--accuracy", accuracy_,
                 "Error that dimray is to reach at 95 % of the measuring points, kept in the file: it starts from few "
                 "patches and refines what it has to")
      ->check(share_or_percent())
      ->type_name("P%")
      ->default_str("")
      ->group("Accuracy");
  app.add_option("--patches", patches_, "Hemisphere patches of a cell: AxB (slices x sectors) or a total")
      ->group("Accuracy");
  app.add_option("--point-patches", point_patches_,
                 "Hemisphere patches of a measuring point; auto: more where points are few")
      ->group("Accuracy");
  app.add_option("--sampling", sampling_,
                 "Where rays lie: stratified, or centre (cell centre through patch centroid)")
      ->check(CLI::IsMember({"stratified", "centre"}))
      ->group("Accuracy");
  app.add_flag("--family", family_, "Join cells that no ray hits to the ray of their patch")
      ->group("Accuracy");
  app.add_option("--seed", seed_, "Number of the pattern of rays")->group("Accuracy");
  program.add_common_options(app);
}

// Of work that takes more than a few seconds.
void DiscretiseCommand::predict(std::size_t n_cells, std::size_t n_points, const NetworkOptions& options) const {
  constexpr double kRaysPerSecond = 4e6;  // of one thread, in rooms of 100 to 5,000 surfaces
  constexpr double kWorthSaying_s = 3.0;
  const double n_rays = static_cast<double>(n_cells * options.patches.n_patches() +
                                            n_points * options.point_patches.n_patches());
  const double seconds = n_rays / (kRaysPerSecond * program_.n_threads());
  if (seconds < kWorthSaying_s) return;
  program_.say(fmt::format("{} cells, {:.3g} million rays: about {:.2g} s on {}, {:.2g} GB", n_cells, n_rays / 1e6, seconds,
                           counted(static_cast<std::size_t>(program_.n_threads()), "thread"),
                           network_bytes(n_cells, n_points, options) / 1e9));
}

Exit DiscretiseCommand::run() {
  if (input_.path.empty()) throw UsageError("no zone file given; see 'dimdis --help'");
  if (output_.empty()) throw UsageError("no output given; use -o ROOM.rays, or -o - for a pipe");
  refuse_terminal(output_, "a ray network");
  program_.check_output(output_, {input_.path});
  refuse_database_file(output_, database_search(input_.database, input_.path));
  NetworkOptions options;
  const bool few = !accuracy_.empty() && program_.app().count("--patches") == 0;
  options.patches = few ? PatchGrid{8, 16} : patches_of(patches_, "--patches");
  const bool automatic = point_patches_ == "auto";
  if (!automatic) options.point_patches = patches_of(point_patches_, "--point-patches");
  options.sampling = sampling_ == "centre" ? Sampling::centre : Sampling::stratified;
  options.family = family_;
  options.seed = seed_;

  program_.stage("zone");
  Zone zone = read_zone(program_, input_);
  if (zone.points.empty())
    refuse_without_effect(program_.app(), {"--point-patches"}, "in a zone without measuring points");
  if (automatic) options.point_patches = automatic_point_patches(zone.points.size());
  const Job job = program_.job();
  check_network_fits(zone, options, job);
  program_.stage("cells");
  const Cells cells(zone);
  predict(cells.size(), zone.points.size(), options);
  program_.stage("rays");
  Network network = build_network(zone, cells, options, job);
  if (!accuracy_.empty()) network.accuracy = share_of(accuracy_);
  judge_points(network, zone);
  Warnings warnings = left_out_warnings(zone);
  for (auto& warning : back_warnings(network.back_share, zone)) warnings.push_back(std::move(warning));
  warn(program_, input_, warnings);
  program_.stage(kWritingStage);
  const std::string hash = save_rays(output_, zone, cells, network, job);
  program_.stage("");

  const std::size_t n_rays = network.sinks.n_rays() + network.point_sinks.n_rays();
  program_.say_verbose(fmt::format(
      "{}, {} x {}, {} x {}: {}", counted(zone.surfaces.size(), "surface"), counted(cells.size(), "cell"),
      counted(options.patches.n_patches(), "patch", "patches"), counted(zone.points.size(), "point"),
      counted(options.point_patches.n_patches(), "patch", "patches"), counted(n_rays, "ray")));
  auto& stats = program_.stats();
  stats["zone"] = zone.name;
  stats["surfaces"] = zone.surfaces.size();
  stats["cells"] = cells.size();
  stats["patches"] = options.patches.n_patches();
  stats["points"] = zone.points.size();
  stats["points_left_out"] =
      std::count_if(zone.points.begin(), zone.points.end(), [](const auto& point) { return !point.valid; });
  stats["point_patches"] = options.point_patches.n_patches();
  stats["rays"] = n_rays;
  stats["escaped_rays"] = network.n_escaped_rays;
  stats["back_rays"] = network.n_back_rays;
  stats["network_imbalance"] = network.imbalance;
  stats["network_bytes"] = network.sinks.n_bytes() + network.point_sinks.n_bytes();
  stats["output_hash"] = hash;
  return Exit::done;
}

}  // namespace dim
