#include "database/surface_entry.hpp"

#include <fmt/format.h>

#include "base/input_file.hpp"
#include "database/toml_reader.hpp"

namespace dim {
namespace {

constexpr NumberRange kRoughness{0.0, 10.0, false, false};
constexpr NumberRange kRefractiveIndex{0.0, 100.0, true, false};
constexpr double kLeastDielectricIndex = 1.0;
constexpr NumberRange kExtinction{0.0, 100.0, false, false};

template <typename T>
void assign(std::optional<T> value, T& to) {
  if (value) to = std::move(*value);
}

// Metals bend light with less than 1; without absorption nothing does.
void check_dielectric(const TomlTable& table, const Finish& finish) {
  if (finish.extinction || finish.ior.min() >= kLeastDielectricIndex) return;
  table.problem("ior",
                fmt::format("ior must be at least 1 where there is no extinction, not {}",
                            short_number(finish.ior.min())),
                "give the extinction of a metal beside its ior");
}

void read_opaque(const TomlTable& table, Finish& finish) {
  assign(table.curve("diffuse", kReflectance), finish.diffuse);
  assign(table.number("specular", kFraction), finish.specular);
  assign(table.number("roughness", kRoughness), finish.roughness);
  assign(table.curve("ior", kRefractiveIndex), finish.ior);
  if (auto curve = table.curve("extinction", kExtinction)) finish.extinction = std::move(curve);
  if (auto curve = table.curve("specular_reflectance", kFraction))
    finish.specular_reflectance = std::move(curve);
  check_dielectric(table, finish);
  assign(table.word("distribution", {"gaussian", "beckmann"}), finish.distribution);
}

// What passes and what is reflected are at each wavelength parts of the same light.
void check_glazing_sum(const TomlTable& table, const Finish& finish) {
  constexpr double kRounding = 1e-9;
  auto points = finish.transmittance.points();
  const auto& more = finish.diffuse.points();
  points.insert(points.end(), more.begin(), more.end());
  double worst_nm = 0.0, worst = 0.0;
  for (const auto& [nm, value] : points) {
    const double sum = finish.transmittance.at(nm) + finish.diffuse.at(nm);
    if (sum > worst) worst = sum, worst_nm = nm;
  }
  if (worst <= 1.0 + kRounding) return;
  table.problem("transmittance",
                fmt::format("transmittance and reflectance add up to {} at {} nm", short_number(worst),
                            short_number(worst_nm)),
                "their sum is at most 1");
}

void read_glazing(const TomlTable& table, Finish& finish) {
  assign(table.curve("transmittance", kFraction), finish.transmittance);
  assign(table.curve("reflectance", kReflectance), finish.diffuse);
  assign(table.word("angular_law", {"glass", "constant"}), finish.angular_law);
  check_glazing_sum(table, finish);
}

}  // namespace

void read_finish_keys(const TomlTable& table, Finish& finish) {
  if (const auto kind = table.word("kind", {"opaque", "glazing"}))
    finish.kind = *kind == "glazing" ? FinishKind::glazing : FinishKind::opaque;
  else if (!table.has("kind") && table.has("transmittance"))
    finish.kind = FinishKind::glazing;
  if (finish.kind == FinishKind::glazing)
    read_glazing(table, finish);
  else
    read_opaque(table, finish);
}

Finish read_surface_entry(std::string_view text, const std::string& file, const std::string& name) {
  const toml::table root = parse_toml(text, file, {"surface", 1, false, {}});
  Problems problems;
  TomlContext context{file, problems};
  const TomlTable table(root, "", context);
  Finish finish;
  finish.name = name;
  finish.source = name;
  for (const char* key : {"dim", "source", "title", "licence", "note"}) table.text(key);
  read_finish_keys(table, finish);
  table.require(finish.kind == FinishKind::glazing ? "transmittance" : "diffuse");
  table.refuse_unknown();
  problems.throw_if_any();
  return finish;
}

Finish find_surface_entry(const DatabaseSearch& search, const std::string& name) {
  const auto path = search.find_surface(name);
  if (!path)
    throw InputError(Problem{{},
                             fmt::format("no surface '{}' in {}", name, search.places("surfaces")),
                             did_you_mean(name, search.names("surfaces"))});
  return read_surface_entry(read_text_file(*path, kMaxTomlBytes), *path, name);
}

}  // namespace dim
