#include "dimray/explain.hpp"

#include <fmt/format.h>

#include "common/counted.hpp"

namespace dim {
namespace {

std::string list(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ", ")); }

}  // namespace

void explain(Program& program, const ModelPlan& plan) {
  const auto say = [&](const std::string& line) { program.say("explain: " + line); };
  if (!plan.diffusing.empty()) say("diffusing finishes: " + list(plan.diffusing));
  if (plan.off_specular.empty())
    say("no off-specular finish: no light by direction is stored or moved");
  else
    say(fmt::format("off-specular finishes: {}; light by direction on {} cells x {} patches",
                    list(plan.off_specular), plan.n_off_specular_cells, plan.n_lobe_patches));
  if (plan.mirrors.empty())
    say("no mirror: rays end where they first meet a surface, no images of luminaires");
  else
    say(fmt::format(
        "mirrors: {}; rays go on there ({:.2g} % of their light met too many), {} images of luminaires",
        list(plan.mirrors), 100.0 * plan.mirror_rays_cut_off, plan.n_images));
  say(plan.n_classes < plan.n_bands
          ? fmt::format("{} bands, of which {} reflect differently: {} solved (--full bands)", plan.n_bands,
                        plan.n_classes, plan.n_classes)
          : (plan.n_bands == 1 ? std::string("1 band")
                               : fmt::format("{} bands, solved apart", plan.n_bands)));
  say(fmt::format("{} in {} (--combine), {}", counted(plan.n_luminaires, "luminaire"),
                  counted(plan.n_sources, "source"), counted(plan.n_spectra, "spectrum", "spectra")));
  if (!plan.without_spectrum.empty())
    say("fittings without a spectrum, taken as equal-energy white: " + list(plan.without_spectrum));
  say("no glazing: no sky");
  say(plan.tests_visibility
          ? "surfaces may hide each other: visibility of luminaires is tested"
          : "convex and empty zone: visibility of luminaires is not tested (--full visibility)");
  say(fmt::format("{} bytes a ray for its sink", plan.bytes_per_sink));
  if (plan.n_black_cells > 0)
    say(counted(plan.n_black_cells, "cell reflects nothing", "cells reflect nothing"));
}

}  // namespace dim
