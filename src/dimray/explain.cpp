#include "dimray/explain.hpp"

#include <fmt/format.h>

#include "common/counted.hpp"

namespace dim {
namespace {

std::string list(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ", ")); }

}  // namespace

void explain(Program& program, const Solution& solution, const BandChoice& bands) {
  const ModelPlan& plan = solution.plan;
  const MirrorOutcome& mirrors = solution.mirrors;
  const auto say = [&](const std::string& line) { program.say("explain: " + line); };
  if (!plan.diffusing.empty()) say("diffusing finishes: " + list(plan.diffusing));
  if (plan.off_specular.empty())
    say("no off-specular finish: no light by direction is stored or moved");
  else
    say(fmt::format("off-specular finishes: {}; light by direction on {} cells x {} patches",
                    list(plan.off_specular), plan.n_off_specular_cells, plan.lobe_grid.n_patches()));
  if (plan.mirrors.empty())
    say("no mirror: rays end where they first meet a surface, no images of luminaires");
  else {
    say(fmt::format("mirrors: {}; rays go on there ({:.2g} % of their light met too many)",
                    list(plan.mirrors), 100.0 * mirrors.rays_cut_off));
    say(fmt::format(
        "{} images of luminaires, on cells {} deep, {:.2g} % of a source's light followed from the last on by "
        "{} rays; at points good to {:.2g} % (--mirror-depth)",
        mirrors.n_images, mirrors.deepest(), 100.0 * mirrors.rays_share, mirrors.n_rays,
        100.0 * mirrors.uncertain));
  }
  say(in_words(bands));
  if (plan.classes.of_band.size() > 1)
    say(plan.n_classes() < plan.classes.of_band.size()
            ? fmt::format("{} of the wavebands reflect differently and are solved (--full bands)",
                          plan.n_classes())
            : "all wavebands reflect differently and are solved");
  say(fmt::format("{} in {} (--combine), {}", counted(plan.n_luminaires, "luminaire"),
                  counted(plan.n_sources(), "source"), counted(plan.n_spectra, "spectrum", "spectra")));
  say(plan.n_bodies == 0 ? std::string("no luminaire has a body: the network's rays are as they are stored")
                         : fmt::format("{} luminaire bodies with {} cells stand among the network's rays",
                                       plan.n_bodies, plan.n_body_cells));
  if (!plan.without_spectrum.empty())
    say("fittings without a spectrum, taken as equal-energy white: " + list(plan.without_spectrum));
  if (plan.daylight.empty())
    say("no light from outside: no sky");
  else
    for (const auto& line : plan.daylight) say(line);
  say(plan.tests_visibility
          ? "surfaces may hide each other: visibility of luminaires is tested"
          : "convex and empty zone: visibility of luminaires is not tested (--full visibility)");
  say(fmt::format("{} bytes a ray for its sink", plan.bytes_per_sink));
  if (plan.n_black_cells > 0)
    say(counted(plan.n_black_cells, "cell reflects nothing", "cells reflect nothing"));
}

}  // namespace dim
