#include "scene/maintenance.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "database/toml_reader.hpp"

namespace dim {
namespace {

constexpr NumberRange kMaintenance{0.0, 1.0, true, false, true};

}  // namespace

Maintenance::Maintenance(const TomlTable& root) : of_all_(root.number("maintenance_factor", kMaintenance)) {
  const auto groups = root.table("maintenance", "maintenance");
  if (!groups) return;
  for (const auto& [key, node] : groups->raw()) {
    const std::string name(key.str());
    if (const auto factor = groups->number(name, kMaintenance)) of_group_[name] = {*factor, groups->place(name)};
  }
}

void Maintenance::set(const TomlTable& table, const Fitting& fitting, Luminaire& luminaire) {
  const auto own = table.number("maintenance_factor", kMaintenance);
  const auto group = of_group_.find(luminaire.group);
  const bool is_maintained = fitting.maintenance_factor != 1.0;
  if (own)
    luminaire.maintenance = own;
  else if (group != of_group_.end())
    luminaire.maintenance = group->second.factor;
  else if (!is_maintained)
    luminaire.maintenance = of_all_;
  if (!luminaire.maintenance || !is_maintained) return;
  const std::string what =
      fmt::format("the entry of its fitting '{}' has a maintenance factor of {} already, which would count twice",
                  fitting.name, short_number(fitting.maintenance_factor));
  const std::string cure = "leave it out here, or take it out of the entry";
  if (own)
    table.problem("maintenance_factor", what, cure);
  else
    table.context().problems.add(group->second.place, table.label() + ": " + what, cure);
}

void Maintenance::check_groups(const Lights& lights, Problems& problems) const {
  std::vector<std::string> groups;
  for (const auto& luminaire : lights.luminaires) groups.push_back(luminaire.group);
  for (const auto& entry : of_group_)
    if (std::find(groups.begin(), groups.end(), entry.first) == groups.end())
      problems.add(entry.second.place, fmt::format("maintenance: no luminaire is of a group '{}'", entry.first),
                   name_cure(entry.first, groups));
}

}  // namespace dim
