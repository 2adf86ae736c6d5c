#include "import/honeybee_luminaires.hpp"

#include <fmt/format.h>

#include <cmath>

#include "database/entry_name.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {
namespace {

Vec3 turned_about_z(const Vec3& v, double degrees_) {
  const double c = std::cos(radians(degrees_)), s = std::sin(radians(degrees_));
  return {v.x * c - v.y * s, v.x * s + v.y * c, v.z};
}

Vec3 turned_about_y(const Vec3& v, double degrees_) {
  const double c = std::cos(radians(degrees_)), s = std::sin(radians(degrees_));
  return {v.x * c + v.z * s, v.y, -v.x * s + v.z * c};
}

/// Spin about the vertical, then tilt about y, then rotation about the vertical.
Vec3 turned(const Vec3& v, const JsonNode& instance) {
  const Vec3 spun = turned_about_z(v, instance.number_or("spin", 0.0));
  return turned_about_z(turned_about_y(spun, instance.number_or("tilt", 0.0)),
                        instance.number_or("rotation", 0.0));
}

Vec3 point_of(const JsonNode& point) {
  if (point.is_list()) return point.vec3();
  return {point["x"].number(), point["y"].number(), point["z"].number()};
}

/// Name of the photometric file, written beside the lights file; empty where there is none.
std::string photometry_of(const JsonNode& luminaire, const std::string& name, ImportedModel& model) {
  const std::string content = luminaire.text("ies_content", "");
  if (content.empty()) return luminaire.text("ies_path", "");
  std::string stem = entry_name_from(name);
  if (stem.empty()) stem = "luminaire";
  std::string file = stem + ".ies";
  const auto is_taken = [&] {
    for (const ImportedFile& other : model.files)
      if (other.name == file) return true;
    return false;
  };
  for (int n = 2; is_taken(); ++n) file = fmt::format("{}-{}.ies", stem, n);
  model.files.push_back({file, content});
  return file;
}

}  // namespace

void add_honeybee_luminaire(const JsonNode& luminaire, ImportedModel& model, Unknowns& unknowns,
                            const ImportInput& input) {
  const std::string name = luminaire.text("identifier", "luminaire");
  const std::string photometry = photometry_of(luminaire, name, model);
  const bool is_placed =
      luminaire.has("luminaire_zone") && luminaire["luminaire_zone"].count("instances") > 0;
  if (photometry.empty() || !is_placed) {
    unknowns.add(fmt::format("luminaire {} has no {} and is left out", dim::quoted(name),
                             is_placed ? "photometry" : "place"),
                 input.place(0));
    return;
  }
  double factor = luminaire.number_or("light_loss_factor", 1.0, 0.0) *
                  luminaire.number_or("candela_multiplier", 1.0, 0.0);
  if (luminaire.has("custom_lamp")) {
    factor *= luminaire["custom_lamp"].number_or("depreciation_factor", 1.0, 0.0);
    unknowns.add("colours of lamps are not read", input.place(0), "write `spectrum` in the lights file");
  }
  const JsonNode instances = luminaire["luminaire_zone"]["instances"];
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const JsonNode instance = instances.at(i);
    ImportedLuminaire placed;
    placed.name = name;
    placed.photometry = photometry;
    placed.at = point_of(instance["point"]);
    placed.aim = turned({0, 0, -1}, instance);
    placed.c0 = turned({1, 0, 0}, instance);
    placed.factor = factor;
    model.luminaires.push_back(std::move(placed));
  }
}

}  // namespace dim
