#include "scene/zone_reader.hpp"

#include "database/toml_reader.hpp"
#include "scene/finish_reader.hpp"
#include "scene/length_unit.hpp"
#include "scene/receiver_reader.hpp"
#include "scene/zone_assembly.hpp"

namespace dim {
namespace {

double unit_of(const TomlTable& root) {
  const auto unit = root.word("unit", {"m", "mm", "cm", "in", "ft"});
  return unit ? *unit_named(*unit) : 1.0;
}

ZoneParts read_parts(const TomlTable& root, double cell_override_m, const DatabaseSearch& search) {
  ZoneParts parts;
  const Place top{root.context().file, 1, 1};
  parts.name = root.text("name").value_or("");
  root.has("dim");
  parts.unit_m = unit_of(root);
  parts.unit_place = root.has("unit") ? root.place("unit") : top;
  const auto cell = root.number("cell", kLength);
  parts.cell_m = cell_override_m > 0.0 ? cell_override_m : cell ? *cell * parts.unit_m : 0.0;
  parts.finishes = read_finishes(root, search);
  parts.faces = read_faces(root);
  if (parts.faces.empty() && root.context().problems.empty())
    root.context().problems.add(top, "the zone has no surface", "write at least one [[surface]]");
  for (const auto& view : root.tables("view")) parts.eyes.push_back(view.place("eye"));
  return parts;
}

}  // namespace

Zone read_zone(std::string_view text, const std::string& file_name, const std::vector<std::string>& overrides,
               double cell_override_m, const DatabaseSearch& search, Warnings& warnings) {
  const toml::table table = parse_toml(text, file_name, {"zone", 1, true, {"finishes"}}, overrides);
  Problems problems;
  TomlContext context{file_name, problems};
  const TomlTable root(table, "", context);
  const ZoneParts parts = read_parts(root, cell_override_m, search);
  const auto add_receivers = [&](const ZoneFrame& frame, double cell_m, Zone& zone) {
    read_receivers(root, frame, cell_m, zone);
    root.refuse_unknown();
  };
  return assemble_zone(parts, add_receivers, problems, warnings);
}

}  // namespace dim
