#include "judge/requirements.hpp"

#include "database/toml_reader.hpp"

namespace dim {
namespace {

constexpr NumberRange kMaintenance{0.0, 1.0, true, false, true};
constexpr NumberRange kUgr{-100.0, 100.0};
constexpr NumberRange kRa{-100.0, 100.0};
constexpr int kMostDirections = 360;

void refuse_on_surfaces(const TomlTable& table) {
  for (const char* key : {"ugr", "eye_height", "directions", "daylight_factor", "power_per_100_lx"})
    if (table.has(key))
      table.problem(key, "is asked of surfaces, and belongs to a plane", "write it under plane = \"…\"");
}

Requirement read_requirement(const TomlTable& table) {
  Requirement r;
  r.place = table.place();
  r.plane = table.name("plane").value_or("");
  r.surfaces = table.texts("surfaces").value_or(std::vector<std::string>{});
  if (r.plane.empty() == r.surfaces.empty())
    table.problem("plane", "needs a plane or surfaces, one of the two",
                  "plane = \"workplane\" or surfaces = [\"wall-n\"]");
  r.illuminance_lx = table.number("illuminance", kPositive);
  r.uniformity = table.number("uniformity", kFraction);
  r.colour_rendering = table.number("colour_rendering", kRa);
  r.daylight_factor_percent = table.number("daylight_factor", kPositive);
  r.ugr = table.number("ugr", kUgr);
  r.eye_height_m = table.number_or("eye_height", kPositive, r.eye_height_m);
  r.directions = table.integer("directions", 1, kMostDirections).value_or(r.directions);
  r.power_W_m2 = table.number("power_density", kPositive);
  r.power_W_m2_100lx = table.number("power_per_100_lx", kPositive);
  if (!r.surfaces.empty()) refuse_on_surfaces(table);
  table.refuse_unknown();
  return r;
}

}  // namespace

Requirements read_requirements(std::string_view text, const std::string& file,
                               const std::vector<std::string>& overrides) {
  const toml::table parsed = parse_toml(text, file, {"requirements", 1, true, {}}, overrides);
  Problems problems;
  TomlContext context{file, problems};
  const TomlTable root(parsed, "", context);
  root.text("dim");
  Requirements result;
  result.title = root.text("title").value_or("");
  if (root.require("source", "say where the figures are from: source = \"EN 12464-1:2021, …\""))
    result.source = root.text("source").value_or("");
  result.maintenance_factor = root.number_or("maintenance_factor", kMaintenance, 1.0);
  if (const auto factors = root.table("maintenance", "maintenance")) {
    for (const auto& [key, node] : factors->raw()) {
      const std::string name(key.str());
      if (const auto factor = factors->number(name, kMaintenance)) {
        result.maintenance[name] = *factor;
        result.maintenance_place[name] = factors->place(name);
      }
    }
  }
  for (const auto& table : root.tables("require")) result.requirements.push_back(read_requirement(table));
  root.refuse_unknown();
  if (result.requirements.empty() && problems.empty())
    problems.add({file, 1, 1}, "the file requires nothing", "write at least one [[require]]");
  problems.throw_if_any();
  return result;
}

}  // namespace dim
