#include "import/zone_writer.hpp"

#include <fmt/format.h>

#include <cmath>

#include "database/entry_text.hpp"
#include "import/plain_names.hpp"
#include "import/zone_numbers.hpp"

namespace dim {
namespace {

constexpr double kWhitest = 0.95;
constexpr double kAssumedTransmittance = 0.7;  // of double glazing

std::string comment_line(const std::string& text) {
  std::string line;
  for (const char c : text) line += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  return line;
}

/// Reflectances and transmittances of a file, made such as a zone file may have them.
class FinishWriter {
 public:
  explicit FinishWriter(Warnings& warnings) : warnings_(warnings) {}

  std::string operator()(const ImportedMaterial& material, const std::string& name) {
    const std::string key = toml_quoted(name);
    if (material.is_glass && !material.transmittance) return unstated_glazing(key, name);
    if (material.transmittance) return fmt::format("{} = {}\n", key, glazing(material));
    if (!material.diffuse && material.specular < 1.0) assumed_.push_back(name);
    const double diffuse = share(material.diffuse.value_or(material.assumed), name);
    std::string keys = fmt::format("diffuse = {}", number(material.specular < 1.0 ? diffuse : 0.0));
    if (material.specular > 0.0) {
      keys += fmt::format(", specular = {}, roughness = {}", number(std::min(material.specular, 1.0)),
                          number(material.roughness));
      if (material.specular_reflectance)
        keys +=
            fmt::format(", specular_reflectance = {}", number(std::min(*material.specular_reflectance, 1.0)));
    }
    const bool is_assumed = !material.diffuse && material.specular < 1.0;
    return fmt::format("{} = {{ {} }}{}\n", key, keys, is_assumed ? "  # not stated: assumed" : "");
  }

  void tell() const {
    if (!assumed_.empty())
      warnings_.push_back(
          {{},
           fmt::format("no reflectance is stated for {}: assumed ones are written", list_of(assumed_)),
           "write the right ones under [finishes]"});
    if (!unknown_glass_.empty())
      warnings_.push_back({{},
                           fmt::format("no transmittance is stated for {}: {:g} is assumed",
                                       list_of(unknown_glass_), kAssumedTransmittance),
                           "write the right ones under [finishes]"});
    if (!too_white_.empty())
      warnings_.push_back(
          {{},
           fmt::format("a reflectance of 1 or more in {}: {:g} is written", list_of(too_white_), kWhitest),
           "write the right ones under [finishes]"});
  }

 private:
  std::string unstated_glazing(const std::string& key, const std::string& name) {
    unknown_glass_.push_back(name);
    return fmt::format("{} = {{ transmittance = {} }}  # not stated: assumed\n", key,
                       number(kAssumedTransmittance));
  }

  static std::string number(double value) { return fmt::format("{:.6g}", value); }

  static std::string glazing(const ImportedMaterial& material) {
    std::string keys =
        fmt::format("transmittance = {}", number(std::clamp(*material.transmittance, 0.0, 1.0)));
    if (material.scattering) {
      keys += ", angular_law = \"diffusing\"";
      if (material.direct > 0.0) keys += fmt::format(", direct = {}", number(material.direct));
      if (material.diffuse) keys += fmt::format(", reflectance = {}", number(*material.diffuse));
      return "{ " + keys + " }";
    }
    if (material.ior != 1.52) keys += fmt::format(", ior = {}", number(material.ior));
    return "{ " + keys + " }";
  }

  double share(double reflectance, const std::string& name) {
    if (reflectance < 1.0) return std::max(reflectance, 0.0);
    too_white_.push_back(name);
    return kWhitest;
  }

  Warnings& warnings_;
  std::vector<std::string> assumed_, unknown_glass_, too_white_;
};

/// The surface entries of one mesh.
class SurfaceWriter {
 public:
  SurfaceWriter(const FaceMesh& mesh, const std::vector<std::string>& finishes, const ZoneNumbers& numbers)
      : mesh_(mesh), finishes_(finishes), numbers_(numbers), names_("face") {
    n_of_object_.resize(mesh.objects.size());
    for (const MeshFace& face : mesh.faces) ++n_of_object_[static_cast<std::size_t>(face.object)];
  }

  std::string operator()(const MeshFace& face, FaceUse facing, ImportReport& report) {
    if (facing == FaceUse::two_spaces) {
      MeshFace other = face;
      if (other.back_material < 0) other.back_material = face.material;
      turn_round(other);
      // One after the other: names are given in the order of writing.
      std::string text = (*this)(face, FaceUse::front, report);
      return text += (*this)(other, FaceUse::front, report);
    }
    const MeshObject& object = mesh_.objects[static_cast<std::size_t>(face.object)];
    const bool differ =
        facing == FaceUse::both && face.back_material >= 0 && face.back_material != face.material;
    if (differ) return (*this)(face, FaceUse::two_spaces, report);
    const std::string name = names_.add(object.name);
    written_.emplace(object.name, name);
    ++report.n_written;
    report.area_written_m2 += area_m2(mesh_, face);
    std::string text = fmt::format("[[surface]]\nname = {}\nfinish = {}\n", toml_quoted(name),
                                   toml_quoted(finishes_[static_cast<std::size_t>(face.material)]));
    if (facing == FaceUse::both || facing == FaceUse::outside_sheet) text += "sides = 2\n";
    if (is_outside(facing)) text += "outside = true\n", ++report.n_outside;
    if (const std::string* parent = parent_of(object)) text += fmt::format("on = {}\n", toml_quoted(*parent));
    text += "vertices = " + ring(face.rings[0]) + "\n";
    if (face.rings.size() > 1) {
      text += "holes = [";
      for (std::size_t i = 1; i < face.rings.size(); ++i)
        text += (i > 1 ? ",\n         " : "") + ring(face.rings[i]);
      text += "]\n";
    }
    return text + "\n";
  }

  const std::vector<std::string>& replaced_names() const { return names_.replaced(); }

 private:
  /// What the object is cut out of, where that is one surface and written already.
  const std::string* parent_of(const MeshObject& object) const {
    if (object.on.empty()) return nullptr;
    const auto found = written_.find(object.on);
    if (found == written_.end()) return nullptr;
    for (std::size_t i = 0; i < mesh_.objects.size(); ++i)
      if (mesh_.objects[i].name == object.on && n_of_object_[i] != 1) return nullptr;
    return &found->second;
  }

  std::string ring(const CornerRing& corners) const {
    std::string text;
    for (const std::uint32_t i : corners)
      text += (text.empty() ? "" : ", ") + numbers_.point(mesh_.points[i]);
    return "[" + text + "]";
  }

  const FaceMesh& mesh_;
  const std::vector<std::string>& finishes_;
  const ZoneNumbers& numbers_;
  PlainNames names_;
  std::vector<std::size_t> n_of_object_;
  std::unordered_map<std::string, std::string> written_;
};

std::string sensors_text(const ImportedModel& model, const ZoneNumbers& numbers) {
  std::string text;
  PlainNames names("sensors");
  for (const ImportedSensors& sensors : model.sensors) {
    text += fmt::format("[[sensors]]\nname = {}\npoints = [\n", toml_quoted(names.add(sensors.name)));
    for (std::size_t i = 0; i < sensors.positions.size(); ++i)
      text += fmt::format("  [{}, {}],\n", numbers.values(sensors.positions[i]),
                          numbers.values(sensors.normals[i]));
    text += "]\n\n";
  }
  return text;
}

std::vector<bool> materials_in_use(const ImportedModel& model, const FaceMesh& mesh,
                                   const std::vector<FaceUse>& facings) {
  std::vector<bool> used(model.materials.size(), false);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (!is_written(facings[f])) continue;
    used[static_cast<std::size_t>(mesh.faces[f].material)] = true;
    if (mesh.faces[f].back_material >= 0) used[static_cast<std::size_t>(mesh.faces[f].back_material)] = true;
  }
  return used;
}

std::string heading_text(const ZoneHeading& heading, const std::string& what) {
  return fmt::format("# {} imported from {} by `dimdis import`. Metres; z up.\n", what,
                     comment_line(heading.source));
}

}  // namespace

std::string zone_text(const ImportedModel& model, const FaceMesh& mesh, const std::vector<FaceUse>& facings,
                      const ZoneHeading& heading, ImportReport& report, Warnings& warnings) {
  const ZoneNumbers numbers(model.single_precision ? mesh.size_m : 0.0);
  std::string text =
      heading_text(heading, "A zone") +
      fmt::format("dim = \"zone/1\"\nname = {}\nunit = \"m\"\n\n[finishes]\n", toml_quoted(heading.name));
  PlainNames finish_names("unnamed");
  FinishWriter finish(warnings);
  const auto used = materials_in_use(model, mesh, facings);
  std::vector<std::string> finishes;
  for (std::size_t m = 0; m < model.materials.size(); ++m) {
    finishes.push_back(finish_names.add(model.materials[m].name));
    if (used[m]) text += finish(model.materials[m], finishes[m]);
  }
  finish.tell();
  text += '\n';
  SurfaceWriter surface(mesh, finishes, numbers);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (facings[f] == FaceUse::hidden)
      report.hidden.push_back(mesh.objects[static_cast<std::size_t>(mesh.faces[f].object)].name);
    else if (is_written(facings[f]))
      text += surface(mesh.faces[f], facings[f], report);
  }
  for (const auto* replaced : {&finish_names.replaced(), &surface.replaced_names()})
    if (!replaced->empty()) report.changes.push_back("names written anew: " + list_of(*replaced));
  return text + sensors_text(model, numbers);
}

std::string lights_text(const ImportedModel& model, const ZoneHeading& heading) {
  const ZoneNumbers numbers(0.0);
  std::string text = heading_text(heading, "Lights") + "dim = \"lights/1\"\n\n";
  PlainNames names("luminaire");
  for (const ImportedLuminaire& luminaire : model.luminaires) {
    text += fmt::format("[[luminaire]]\nname = {}\n", toml_quoted(names.add(luminaire.name)));
    if (luminaire.photometry.empty())
      text += fmt::format("ideal = \"lambertian\"\nlumens = {:.6g}\n", luminaire.lumens);
    else
      text += fmt::format("fitting = {}\n", toml_quoted(luminaire.photometry));
    text += fmt::format("at = {}\naim = {}\n", numbers.point(luminaire.at), numbers.point(luminaire.aim));
    if (luminaire.c0) text += fmt::format("c0 = {}\n", numbers.point(*luminaire.c0));
    if (luminaire.opening)
      text += fmt::format("opening = [{:.6g}, {:.6g}]\n", (*luminaire.opening)[0], (*luminaire.opening)[1]);
    if (luminaire.factor != 1.0) text += fmt::format("dim = {:.6g}\n", luminaire.factor);
    text += '\n';
  }
  return text;
}

}  // namespace dim
