#include "report/light_groups.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dim {
namespace {

LightGroup& group_of(std::vector<LightGroup>& groups, const std::string& name, double start, double kept,
                     std::size_t n_sources) {
  const auto same = std::find_if(groups.begin(), groups.end(), [&](const LightGroup& g) {
    return !g.daylight && g.name == name && g.start == start && g.kept == kept;
  });
  if (same != groups.end()) return *same;
  groups.push_back({name, Mix(n_sources, 0.0), start, kept, false});
  return groups.back();
}

// Two sliders of one name could not be told apart.
void tell_apart(std::vector<LightGroup>& groups) {
  const auto names = groups;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto n = std::count_if(names.begin(), names.end(), [&](const auto& o) { return o.name == names[g].name; });
    if (n > 1) groups[g].name += fmt::format(" (from {:g}, maintenance {:g})", groups[g].start, groups[g].kept);
  }
}

}  // namespace

std::vector<LightGroup> light_groups(const LuminanceDatabase& database, const Mix& mix,
                                     const std::vector<double>& kept) {
  const auto& sources = database.sources();
  std::vector<LightGroup> groups, few;
  LightGroup daylight{"daylight", Mix(mix.size(), 0.0), 1.0, 0.0, true};
  bool any_daylight = false;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    if (sources[s].daylight) {
      daylight.full[s] = mix[s];
      any_daylight |= mix[s] != 0.0;
      continue;
    }
    const std::string& name = sources[s].group.empty() ? sources[s].name : sources[s].group;
    group_of(groups, name, mix[s], kept[s], mix.size()).full[s] = 1.0;
    group_of(few, "all luminaires", 1.0, kept[s], mix.size()).full[s] = mix[s];
  }
  if (groups.size() > kMostGroups) groups = few;
  tell_apart(groups);
  if (any_daylight) groups.push_back(std::move(daylight));
  return groups;
}

}  // namespace dim
