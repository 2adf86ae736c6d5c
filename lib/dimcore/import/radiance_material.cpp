#include "import/radiance_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dim {
namespace {

constexpr double kLumensPerWatt = 179.0;

class MaterialReader {
 public:
  explicit MaterialReader(const RadiancePrimitive& primitive) : primitive_(primitive) {
    material_.name = primitive.name;
  }

  std::optional<ImportedMaterial> run() {
    const std::string& type = primitive_.type;
    if (type == "plastic" || type == "metal")
      plastic(type == "metal");
    else if (type == "trans")
      trans();
    else if (type == "glass")
      glass();
    else if (type == "mirror")
      mirror();
    else if (type == "light" || type == "glow")
      light();
    else
      return std::nullopt;
    return material_;
  }

 private:
  double number(std::size_t i) const {
    if (i >= primitive_.numbers.size())
      throw InputError({primitive_.place,
                        fmt::format("{} '{}' has {} numbers, too few", primitive_.type, primitive_.name,
                                    primitive_.numbers.size()),
                        ""});
    if (primitive_.numbers[i] < 0.0)
      throw InputError(
          {primitive_.place,
           fmt::format("{} '{}': {:g} is below 0", primitive_.type, primitive_.name, primitive_.numbers[i]),
           ""});
    return primitive_.numbers[i];
  }
  double grey() const { return 0.265 * number(0) + 0.670 * number(1) + 0.065 * number(2); }

  /// Radiance: (1 - s) C diffuse, s (plastic) or s C (metal) specular. So with k_s = s.
  void plastic(bool is_metal) {
    material_.diffuse = grey();
    material_.specular = std::min(number(3), 1.0);
    material_.roughness = number(4);
    if (material_.specular > 0.0) material_.specular_reflectance = is_metal ? std::min(grey(), 1.0) : 1.0;
  }

  void trans() {
    const double passed = number(5), body = grey() * (1.0 - std::min(number(3), 1.0));
    if (!(passed > 0.0)) {
      plastic(false);
      return;
    }
    material_.transmittance = body * std::min(passed, 1.0);
    material_.diffuse = body * (1.0 - std::min(passed, 1.0));
    material_.scattering = true;
    material_.direct = std::min(number(6), 1.0);
  }

  /// Reflected r at each face, t let through on the way: T = t (1 - r)^2 / (1 - r^2 t^2).
  void glass() {
    const double n = primitive_.numbers.size() > 3 ? number(3) : 1.52, t = std::min(grey(), 1.0);
    const double r = (n - 1) * (n - 1) / ((n + 1) * (n + 1));
    material_.transmittance = t * (1 - r) * (1 - r) / (1 - r * r * t * t);
    material_.ior = n;
  }

  void mirror() {
    material_.diffuse = 0.0;
    material_.specular = 1.0;
    material_.specular_reflectance = std::min(grey(), 1.0);
  }

  void light() { material_.luminance_cd_m2 = kLumensPerWatt * grey(); }

  const RadiancePrimitive& primitive_;
  ImportedMaterial material_;
};

}  // namespace

std::optional<ImportedMaterial> radiance_material(const RadiancePrimitive& primitive) {
  return MaterialReader(primitive).run();
}

}  // namespace dim
