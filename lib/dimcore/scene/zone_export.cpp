#include "scene/zone_export.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include "geometry/bridge.hpp"
#include "spectrum/bands.hpp"

namespace dim {
namespace {

double luminous(const SpectralCurve& curve) {
  static const LatticeValues weights = luminous_weights({}, {});
  const LatticeValues values = on_lattice(curve);
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += weights[i] * values[i];
  return sum;
}

/// What is reflected as by a mirror at normal incidence, of all that the specular part gets.
double normal_specular(const Finish& finish) {
  if (finish.specular_reflectance) return luminous(*finish.specular_reflectance);
  const double n = luminous(finish.ior), k = finish.extinction ? luminous(*finish.extinction) : 0.0;
  return ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
}

/// Radiance's transmissivity of a pane of index 1.52 from its transmittance at normal incidence.
double transmissivity(double transmittance) {
  if (transmittance <= 0.0) return 0.0;
  constexpr double a = 0.8402528435, b = 0.0072522239, c = 0.9166530661, d = 0.0036261119;
  return (std::sqrt(a + b * transmittance * transmittance) - c) / (d * transmittance);
}

/// Whether a sign of a name means nothing to either format: Radiance runs what follows `!`.
bool is_plain(char c) {
  return std::isgraph(static_cast<unsigned char>(c)) && std::string_view("!#\"'\\").find(c) == std::string_view::npos;
}

/// Names that both formats can spell, each only once, with `_` for other signs.
class PlainNames {
 public:
  explicit PlainNames(std::set<std::string> taken = {}) : taken_(std::move(taken)) {}

  std::string add(const std::string& text) {
    std::string stem;
    for (const char c : text) stem += is_plain(c) ? c : '_';
    std::string name = stem;
    for (int n = 2; !taken_.insert(name).second; ++n) name = fmt::format("{}_{}", stem, n);
    return name;
  }

 private:
  std::set<std::string> taken_;
};

std::vector<std::string> plain_names(const std::vector<Finish>& finishes) {
  PlainNames plain({"void"});  // Radiance's word for no material
  std::vector<std::string> names;
  for (const Finish& finish : finishes) names.push_back(plain.add(finish.name));
  return names;
}

std::vector<std::string> plain_names(const std::vector<Surface>& surfaces) {
  PlainNames plain;
  std::vector<std::string> names;
  for (const Surface& surface : surfaces) names.push_back(plain.add(surface.name));
  return names;
}

std::string material(const Finish& finish, const std::string& name, std::vector<Problem>& warnings) {
  const auto lost = [&](const std::string& what) {
    warnings.push_back({{}, fmt::format("finish '{}': {}", finish.name, what), ""});
  };
  if (finish.kind == FinishKind::glazing) {
    if (finish.angular_law != "glass")
      lost(fmt::format("angular law '{}' is written as clear glass", finish.angular_law));
    const double t = transmissivity(luminous(finish.transmittance));
    return fmt::format("void glass {}\n0\n0\n3 {:.9g} {:.9g} {:.9g}\n\n", name, t, t, t);
  }
  const double specular = finish.specular > 0.0 ? finish.specular * normal_specular(finish) : 0.0;
  if (finish.specular == 1.0 && finish.roughness == 0.0)
    return fmt::format("void mirror {}\n0\n0\n3 {:.9g} {:.9g} {:.9g}\n\n", name, specular, specular, specular);
  const double diffuse = (1.0 - finish.specular) * luminous(finish.diffuse);
  const double colour = specular < 1.0 ? diffuse / (1.0 - specular) : 0.0;
  return fmt::format("void plastic {}\n0\n0\n5 {:.9g} {:.9g} {:.9g} {:.9g} {:.9g}\n\n", name, colour, colour,
                     colour, specular, finish.roughness);
}

Ring3 in_users_place(const Zone& zone, const Polygon& polygon, const Ring2& ring) {
  Ring3 corners;
  for (const Vec2& corner : ring) corners.push_back(polygon.frame().to_world(corner) + zone.origin_m);
  return corners;
}

}  // namespace

std::string to_radiance(const Zone& zone, std::vector<Problem>& warnings) {
  const auto names = plain_names(zone.finishes), surface_names = plain_names(zone.surfaces);
  std::string text = "# metres, z up\n";
  for (std::size_t f = 0; f < names.size(); ++f) text += material(zone.finishes[f], names[f], warnings);
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
    const Surface& surface = zone.surfaces[s];
    if (surface.twin >= 0 && static_cast<std::size_t>(surface.twin) < s) {
      const Surface& twin = zone.surfaces[static_cast<std::size_t>(surface.twin)];
      if (twin.finish == surface.finish) continue;
      warnings.push_back({surface.place,
                          fmt::format("surface '{}' and its other side '{}' differ in finish and are written "
                                      "as two polygons in one place",
                                      surface.name, twin.name),
                          ""});
    }
    for (const Ring2& ring : bridged_rings(surface.polygon)) {
      text += fmt::format("{} polygon {}\n0\n0\n{}\n", names[static_cast<std::size_t>(surface.finish)],
                          surface_names[s], 3 * ring.size());
      for (const Vec3& p : in_users_place(zone, surface.polygon, ring))
        text += fmt::format("  {:.17g} {:.17g} {:.17g}\n", p.x, p.y, p.z);
      text += '\n';
    }
  }
  return text;
}

std::string to_obj(const Zone& zone) {
  const auto names = plain_names(zone.finishes), surface_names = plain_names(zone.surfaces);
  std::string text = "# metres, z up\n";
  std::size_t n_corners = 0;
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
    const Surface& surface = zone.surfaces[s];
    text += fmt::format("g {}\nusemtl {}\n", surface_names[s],
                        names[static_cast<std::size_t>(surface.finish)]);
    for (const Ring2& ring : bridged_rings(surface.polygon)) {
      std::string face = "f";
      for (const Vec3& p : in_users_place(zone, surface.polygon, ring)) {
        text += fmt::format("v {:.17g} {:.17g} {:.17g}\n", p.x, p.y, p.z);
        face += fmt::format(" {}", ++n_corners);
      }
      text += face + '\n';
    }
  }
  return text;
}

std::string to_sensor_points(const Zone& zone) {
  std::string text;
  for (const MeasuringPoint& point : zone.points) {
    const Vec3 p = point.position + zone.origin_m;
    text += fmt::format("{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", p.x, p.y, p.z, point.normal.x,
                        point.normal.y, point.normal.z);
  }
  return text;
}

}  // namespace dim
