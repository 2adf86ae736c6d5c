#include "climate/stored_coefficients.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/error.hpp"

namespace dim {
namespace {

/// What the groups have: for messages.
struct Groups {
  std::map<std::string, std::set<std::string>> states;
};

Groups groups_of(const LuminanceDatabase& database) {
  Groups groups;
  for (const auto& source : database.sources())
    if (source.daylight) groups.states[source.group].insert(source.daylight->state);
  return groups;
}

void check_states(const Groups& groups, const WindowStates& asked) {
  for (const auto& [group, state] : asked) {
    const auto known = groups.states.find(group);
    if (known == groups.states.end()) {
      std::vector<std::string> names;
      for (const auto& [name, states] : groups.states) names.push_back(name);
      throw InputError(
          Problem{{}, fmt::format("no group of windows is called '{}'", group), name_cure(group, names)});
    }
    if (!known->second.contains(state))
      throw InputError(Problem{{},
                               fmt::format("the windows '{}' have no state '{}'", group, state),
                               name_cure(state, {known->second.begin(), known->second.end()})});
  }
}

bool is_chosen(const Source& source, const WindowStates& asked) {
  const auto wanted = asked.find(source.group);
  return wanted == asked.end() ? source.daylight->as_it_stands : source.daylight->state == wanted->second;
}

/// Adds transfer [n_classes, n_points] weighted with what each class gives of the source's light.
void add_transfer(const std::vector<float>& transfer, const std::vector<Vec3>& xyz, std::size_t n_points,
                  float* row) {
  const std::size_t n_classes = transfer.size() / n_points;
  for (std::size_t q = 0; q < n_classes; ++q) {
    // Direct light that no class tints is stored once.
    const double weight = n_classes == xyz.size() ? xyz[q].y : 1.0;
    for (std::size_t i = 0; i < n_points; ++i)
      row[i] += static_cast<float>(weight * static_cast<double>(transfer[q * n_points + i]));
  }
}

}  // namespace

WindowStates parse_states(const std::vector<std::string>& texts) {
  WindowStates states;
  for (const auto& text : texts) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      throw InputError(Problem{{}, fmt::format("--state '{}' is not GROUP=STATE", text), ""});
    states[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return states;
}

std::vector<std::string> window_groups(const LuminanceDatabase& database) {
  std::vector<std::string> names;
  for (const auto& [name, states] : groups_of(database).states) names.push_back(name);
  return names;
}

DaylightCoefficients stored_coefficients(const LuminanceDatabase& database, const WindowStates& states,
                                         const std::vector<std::string>& groups) {
  if (!database.sky() || database.sky()->subdivision == 0)
    throw InputError(
        Problem{{},
                "holds no daylight coefficients",
                "run dimray with [sky] model = \"tregenza\" or \"reinhart\" in the lights file"});
  check_states(groups_of(database), states);
  const SkyPatches patches(database.sky()->subdivision);
  DaylightCoefficients c;
  c.subdivision = patches.subdivision();
  c.ground_reflectance = database.sky()->ground_reflectance;
  c.north_rad = database.zone().site ? radians(database.zone().site->north_deg) : 0.0;
  c.n_points = database.zone().points.size();
  c.total_lx.assign(patches.n_columns() * c.n_points, 0.0F);
  c.direct_lx = c.total_lx;
  for (std::size_t s = 0; s < database.sources().size() && c.n_points > 0; ++s) {
    const Source& source = database.sources()[s];
    const bool of_group = groups.empty() || std::find(groups.begin(), groups.end(), source.group) != groups.end();
    if (!source.daylight || !of_group || !is_chosen(source, states)) continue;
    const std::size_t column = column_of(*source.daylight, patches);
    const auto xyz = source.xyz_by_class(database.classes());
    std::vector<float> total(c.n_points, 0.0F), direct(c.n_points, 0.0F);
    add_transfer(database.transfer(TransferPart::point_total, s), xyz, c.n_points, total.data());
    add_transfer(database.transfer(TransferPart::point_direct, s), xyz, c.n_points, direct.data());
    for (std::size_t i = 0; i < c.n_points; ++i) {
      c.direct_lx[column * c.n_points + i] += direct[i];
      c.total_lx[column * c.n_points + i] += total[i];
    }
  }
  return c;
}

}  // namespace dim
