#include "import/radiance.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <unordered_map>

#include "import/radiance_material.hpp"
#include "import/radiance_tokens.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {
namespace {

constexpr int kRingCorners = 48;

/// Corners of a circle, the polygon's area being the circle's.
Ring3 circle(const Vec3& centre, const Vec3& normal, double radius) {
  const Vec3 u = perpendicular(normal), v = glm::cross(normal, u);
  const double step = 2.0 * kPi / kRingCorners, r = radius * std::sqrt(step / std::sin(step));
  Ring3 ring;
  for (int i = 0; i < kRingCorners; ++i)
    ring.push_back(centre + r * (std::cos(i * step) * u + std::sin(i * step) * v));
  return ring;
}

/// Extents of a ring along its first edge and across it; of a rectangle its sides.
std::array<double, 2> extents(const Ring3& ring, const Vec3& along, const Vec3& across) {
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
  for (const Vec3& p : ring) {
    const double at[2] = {glm::dot(p, along), glm::dot(p, across)};
    for (int i = 0; i < 2; ++i) low[i] = std::min(low[i], at[i]), high[i] = std::max(high[i], at[i]);
  }
  return {high[0] - low[0], high[1] - low[1]};
}

class RadianceReader {
 public:
  explicit RadianceReader(const ImportInput& input) : input_(input), counter_(input) {
    model_.format = "Radiance";
  }

  ImportedModel run() {
    RadianceTokens tokens(input_);
    for (RadiancePrimitive primitive; tokens.next(primitive);) read(primitive);
    problems_.throw_if_any();
    unknowns_.tell(model_.warnings);
    return std::move(model_);
  }

 private:
  void read(const RadiancePrimitive& primitive) {
    const std::string& type = primitive.type;
    if (type == "!")
      problems_.add(primitive.place, fmt::format("the command {} is not run", dim::quoted(primitive.name)),
                    "let Radiance write out what it makes: xform -e SCENE.rad > flat.rad");
    else if (type == "instance" || type == "mesh")
      problems_.add(primitive.place,
                    fmt::format("{} '{}' stands for another file ({}), which is not read", type,
                                primitive.name, primitive.texts.empty() ? "?" : primitive.texts[0]),
                    "put the polygons themselves in its place");
    else if (type == "alias")
      alias(primitive);
    else if (type == "polygon")
      polygon(primitive);
    else if (type == "ring")
      ring(primitive);
    else if (type == "source")
      unknowns_.add("source (sky or sun) is left out", primitive.place, "write a [sky] in the lights file");
    else if (is_solid(type))
      unknowns_.add(fmt::format("{} is left out", type), primitive.place, "make polygons of it");
    else
      material(primitive);
  }

  static bool is_solid(const std::string& type) {
    for (const char* solid : {"sphere", "bubble", "cylinder", "tube", "cone", "cup"})
      if (type == solid) return true;
    return false;
  }

  void material(const RadiancePrimitive& primitive) {
    auto material = radiance_material(primitive);
    if (!material) {
      unknowns_.add(fmt::format("type {} is not understood", dim::quoted(primitive.type)), primitive.place,
                    "surfaces that use it get the material before it, or an assumed reflectance");
      // Patterns and textures leave the material that they change as it is.
      const auto below = index_.find(primitive.modifier);
      if (below != index_.end()) {
        index_[primitive.name] = below->second;
        return;
      }
      material.emplace();
      material->name = primitive.name;
    }
    if (primitive.modifier != "void")
      unknowns_.add(fmt::format("what {} lays on materials is left out", dim::quoted(primitive.modifier)),
                    primitive.place);
    index_[primitive.name] = static_cast<int>(model_.materials.size());
    model_.materials.push_back(std::move(*material));
  }

  void alias(const RadiancePrimitive& primitive) {
    const auto found = index_.find(primitive.texts[0]);
    if (found != index_.end()) index_[primitive.name] = found->second;
  }

  int material_of(const RadiancePrimitive& primitive) {
    const auto [found, is_new] =
        index_.emplace(primitive.modifier, static_cast<int>(model_.materials.size()));
    if (is_new) {
      ImportedMaterial material;
      material.name = primitive.modifier;
      model_.materials.push_back(std::move(material));
      unknowns_.add(fmt::format("material {} is not in the file", dim::quoted(primitive.modifier)),
                    primitive.place, "put the file of materials in front: cat materials.rad scene.rad");
    }
    return found->second;
  }

  void polygon(const RadiancePrimitive& primitive) {
    const std::size_t n = primitive.numbers.size();
    if (n < 9 || n % 3 != 0) {
      problems_.add(
          primitive.place,
          fmt::format("polygon '{}' has {} numbers, not 3 for each of 3 corners or more", primitive.name, n));
      return;
    }
    Ring3 outline;
    for (std::size_t i = 0; i < n; i += 3)
      outline.emplace_back(primitive.numbers[i], primitive.numbers[i + 1], primitive.numbers[i + 2]);
    add(primitive, std::move(outline), {});
  }

  void ring(const RadiancePrimitive& primitive) {
    const auto& v = primitive.numbers;
    const Vec3 normal = v.size() == 8 ? Vec3(v[3], v[4], v[5]) : Vec3(0.0);
    if (v.size() != 8 || !(glm::length(normal) > 0.0) || v[6] < 0.0 || v[7] < 0.0 || v[6] == v[7]) {
      problems_.add(primitive.place,
                    fmt::format("ring '{}' needs a centre, a normal and two radii", primitive.name));
      return;
    }
    unknowns_.add(fmt::format("ring becomes a polygon of {} corners of the same area", kRingCorners),
                  primitive.place);
    const Vec3 centre(v[0], v[1], v[2]), n = glm::normalize(normal);
    std::vector<Ring3> holes;
    if (std::min(v[6], v[7]) > 0.0) holes.push_back(circle(centre, n, std::min(v[6], v[7])));
    add(primitive, circle(centre, n, std::max(v[6], v[7])), std::move(holes));
  }

  void add(const RadiancePrimitive& primitive, Ring3 outline, std::vector<Ring3> holes) {
    counter_.add(outline.size());
    ImportedFace face;
    face.outline = std::move(outline);
    face.holes = std::move(holes);
    face.material = material_of(primitive);
    face.name = primitive.name;
    const auto& luminance = model_.materials[static_cast<std::size_t>(face.material)].luminance_cd_m2;
    if (luminance)
      shine(face, *luminance);
    else
      model_.faces.push_back(std::move(face));
  }

  /// A Lambertian luminaire of the surface's flux in its place.
  void shine(const ImportedFace& face, double luminance_cd_m2) {
    Vec3 twice = newell(face.outline);
    const double outline_m2 = glm::length(twice) / 2.0;
    if (!(outline_m2 > 0.0)) {
      unknowns_.add("light without area is left out", input_.place(0));
      return;
    }
    double area_m2 = outline_m2;
    for (const Ring3& hole : face.holes) area_m2 -= glm::length(newell(hole)) / 2.0;
    ImportedLuminaire luminaire;
    luminaire.name = face.name;
    luminaire.lumens = kPi * luminance_cd_m2 * area_m2;
    luminaire.aim = glm::normalize(twice);
    Vec3 sum(0.0);
    for (const Vec3& p : face.outline) sum += p;
    luminaire.at = sum / static_cast<double>(face.outline.size());
    const Vec3 along = glm::normalize(face.outline[1] - face.outline[0]);
    luminaire.c0 = along;
    luminaire.opening = extents(face.outline, along, glm::cross(luminaire.aim, along));
    const double rectangle_m2 = (*luminaire.opening)[0] * (*luminaire.opening)[1];
    if (std::abs(rectangle_m2 / area_m2 - 1.0) > 1e-6)
      unknowns_.add("light that is no rectangle becomes one of its extents and its flux", input_.place(0));
    model_.luminaires.push_back(std::move(luminaire));
  }

  const ImportInput& input_;
  ImportedModel model_;
  FaceCounter counter_;
  Problems problems_;
  Unknowns unknowns_;
  std::unordered_map<std::string, int> index_;
};

}  // namespace

ImportedModel read_radiance(const ImportInput& input) { return RadianceReader(input).run(); }

}  // namespace dim
