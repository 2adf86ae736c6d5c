#include "database/surface_entry.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/input_file.hpp"
#include "database/bsdf_file.hpp"
#include "database/toml_reader.hpp"
#include "reflection/glazing.hpp"

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

// [[degrees from normal, transmittance], ...] from 0 to 90, kept as shares of the first.
void read_angle_table(const TomlTable& table, Finish& finish) {
  const auto rows = table.rows("by_angle", 2, kNotNegative);
  if (!rows) return;
  const auto wrong = [&](const std::string& what) {
    table.problem("by_angle", what, "write [[0, 0.7], [30, 0.69], ..., [90, 0]]");
  };
  if (rows->size() < 2 || rows->front()[0] != 0.0 || rows->back()[0] != 90.0)
    return wrong("by_angle does not go from 0 to 90 degrees");
  const double normal = rows->front()[1];
  if (!(normal > 0.0)) return wrong("by_angle begins with no transmittance at 0 degrees");
  finish.by_angle.clear();
  for (const auto& row : *rows) {
    if (row[1] > 1.0) return wrong(fmt::format("by_angle: transmittance {} is above 1", short_number(row[1])));
    if (!finish.by_angle.empty() && !(row[0] > finish.by_angle.back().first))
      return wrong("by_angle: angles do not ascend");
    finish.by_angle.emplace_back(row[0], row[1] / normal);
  }
  finish.angular_law = "table";
  if (!table.has("transmittance")) finish.transmittance = SpectralCurve(normal);
}

void read_bsdf_key(const TomlTable& table, Finish& finish) {
  constexpr std::size_t kMostBytes = 64u << 20;
  const auto name = table.text("bsdf");
  if (!name) return;
  const std::string path = (std::filesystem::path(table.context().file).parent_path() / *name).string();
  try {
    finish.bsdf = read_bsdf(read_text_file(path, kMostBytes), path);
  } catch (const InputError& error) {
    for (const auto& problem : error.problems())
      table.context().problems.add(problem.place, problem.what, problem.cure);
    return;
  }
  finish.angular_law = "bsdf";
  finish.transmittance = SpectralCurve(std::min(1.0, finish.bsdf->hemispherical_transmittance()));
}

// @param known  whether `finish` holds the values of another glazing
void read_glazing(const TomlTable& table, bool known, Finish& finish) {
  assign(table.curve("transmittance", kFraction), finish.transmittance);
  if (auto ior = table.curve("ior", {1.0, 4.0}))
    finish.ior = std::move(*ior);
  else if (!known)
    finish.ior = SpectralCurve(kGlassIndex);
  assign(table.word("angular_law", {"glass", "constant", "table", "diffusing", "bsdf"}), finish.angular_law);
  read_angle_table(table, finish);
  read_bsdf_key(table, finish);
  assign(table.number("direct", kFraction), finish.direct);
  const std::string& law = finish.angular_law;
  if (law == "table" && finish.by_angle.empty() && !table.has("by_angle"))
    table.problem("angular_law", "a table of angles is missing", "write by_angle = [[0, 0.7], ..., [90, 0]]");
  if (law == "bsdf" && !finish.bsdf && !table.has("bsdf"))
    table.problem("angular_law", "a bsdf is missing", "write bsdf = \"FILE.xml\"");
  if (table.has("direct") && law != "diffusing")
    table.problem("direct", "direct belongs to a diffusing glazing", "write angular_law = \"diffusing\"");
  if (auto reflectance = table.curve("reflectance", kReflectance))
    finish.diffuse = std::move(*reflectance);
  else if (!known && !table.has("reflectance"))
    finish.diffuse = own_reflectance(finish);
  check_glazing_sum(table, finish);
}

}  // namespace

void require_main_key(const TomlTable& table, const Finish& finish) {
  if (finish.kind == FinishKind::opaque)
    table.require("diffuse");
  else if (!table.has("by_angle") && !table.has("bsdf"))
    table.require("transmittance");
}

void read_finish_keys(const TomlTable& table, Finish& finish) {
  const bool known_glazing = finish.kind == FinishKind::glazing;
  if (const auto kind = table.word("kind", {"opaque", "glazing"}))
    finish.kind = *kind == "glazing" ? FinishKind::glazing : FinishKind::opaque;
  else if (!table.has("kind") &&
           (table.has("transmittance") || table.has("by_angle") || table.has("bsdf")))
    finish.kind = FinishKind::glazing;
  if (finish.kind == FinishKind::glazing)
    read_glazing(table, known_glazing, finish);
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
  require_main_key(table, finish);
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
