#include "scene/lights_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include "database/fitting_entry.hpp"
#include "database/toml_reader.hpp"
#include "scene/luminaire_body.hpp"
#include "scene/luminaire_field.hpp"
#include "scene/maintenance.hpp"
#include "scene/sky_reader.hpp"
#include "scene/zone_frame.hpp"

namespace dim {
namespace {

struct Bounds {
  Vec3 low{std::numeric_limits<double>::max()};
  Vec3 high{std::numeric_limits<double>::lowest()};
};

Bounds bounds_of(const Zone& zone) {
  Bounds bounds;
  for (const auto& surface : zone.surfaces) {
    if (surface.outside) continue;
    for (const auto& ring : surface.polygon.corners())
      for (const auto& p : ring) bounds.low = glm::min(bounds.low, p), bounds.high = glm::max(bounds.high, p);
  }
  return bounds;
}

class LightsReader {
 public:
  LightsReader(const TomlTable& root, const std::string& folder, const Zone& zone,
               const DatabaseSearch& search, const FileLoader& load, Warnings& warnings)
      : root_(root),
        zone_(zone),
        frame_{zone.origin_m / zone.unit_m, zone.unit_m},
        bounds_(bounds_of(zone)),
        slack_m_(1e-6 * zone.diameter_m),
        problems_(root.context().problems),
        warnings_(warnings),
        folder_(folder),
        load_(load),
        maintenance_(root),
        shelf_(folder, search, load, problems_, warnings) {}

  Lights read() {
    for (const char* key : {"dim", "name"}) root_.text(key);
    lights_.sky = read_sky(root_, zone_.site, folder_, load_, shelf_.spectra());
    check_windows();
    const auto tables = root_.tables("luminaire");
    for (const auto& table : tables) read_entry(table);
    if (tables.empty() && !root_.has("sky") && problems_.empty())
      problems_.add({root_.context().file, 1, 1}, "the file has no light source",
                    "write at least one [[luminaire]], or a [sky]");
    root_.refuse_unknown();
    check_groups();
    if (problems_.empty()) maintenance_.check_groups(lights_, problems_);
    problems_.throw_if_any();
    lights_.fittings = shelf_.take();
    return std::move(lights_);
  }

 private:
  void check_windows() {
    const bool any = !zone_.closed || std::any_of(zone_.surfaces.begin(), zone_.surfaces.end(),
                                                  [&](const Surface& surface) { return is_window(zone_, surface); });
    if (root_.has("sky") && !any)
      root_.problem("sky", "no light of the sky comes in: the zone is closed and has no window",
                    "give a surface of the zone file a finish of kind = \"glazing\"");
  }

  void read_entry(const TomlTable& table) {
    const auto name = table.require("name") ? table.name() : std::nullopt;
    Luminaire luminaire;
    luminaire.place = table.place();
    luminaire.group = table.name("group").value_or(name.value_or(""));
    read_body(table, luminaire);
    const bool aimed = read_aim(table, luminaire);
    const bool lit = read_source(table, luminaire);
    if (lit) maintenance_.set(table, shelf_[luminaire.fitting], luminaire);
    read_opening(table, luminaire);
    const auto places = read_field(table, luminaire, kMaxLuminaires - lights_.luminaires.size());
    table.refuse_unknown();
    if (!name || !aimed || !lit) return;
    if (luminaire.body && !has_body(luminaire))
      warnings_.push_back({table.place("body"),
                           fmt::format("{}: its opening has no area, so that it has no body", table.label()),
                           "give its size: opening = [length, width]"});
    for (const auto& one : places) {
      Luminaire copy = luminaire;
      copy.name = *name + one.suffix;
      for (Vec3* axis : {&copy.c0, &copy.c90, &copy.aim})
        if (one.turn_rad != 0.0) *axis = turned_about_vertical(*axis, one.turn_rad);
      place(table, std::move(copy), one.at);
    }
  }

  // aim, c0 and turn to the luminaire's axes.
  bool read_aim(const TomlTable& table, Luminaire& luminaire) {
    constexpr double kParallel = 1e-6;
    const auto aim = table.vec3("aim");
    const auto c0 = table.vec3("c0");
    const double turn = radians(table.number_or("turn", kAnyNumber, 0.0));
    if ((table.has("aim") && !aim) || (table.has("c0") && !c0)) return false;
    const Vec3 direction = aim.value_or(Vec3(0, 0, -1));
    if (!(glm::length(direction) > 0.0)) return table.problem("aim", "aim has zero length"), false;
    luminaire.aim = glm::normalize(direction);
    Vec3 start = c0.value_or(Vec3(1, 0, 0));
    if (c0 && !(glm::length(start) > 0.0)) return table.problem("c0", "c0 has zero length"), false;
    start = glm::normalize(start);
    if (glm::length(glm::cross(start, luminaire.aim)) < kParallel) {
      if (c0)
        return table.problem("c0", "c0 is parallel to aim", "C = 0 is a direction across the aim"), false;
      start = {0, 1, 0};
    }
    const Vec3 x = glm::normalize(start - glm::dot(start, luminaire.aim) * luminaire.aim);
    const Vec3 y = glm::cross(x, luminaire.aim);
    luminaire.c0 = std::cos(turn) * x + std::sin(turn) * y;
    luminaire.c90 = glm::cross(luminaire.c0, luminaire.aim);
    return true;
  }

  bool read_source(const TomlTable& table, Luminaire& luminaire) {
    const double dimmed = read_dim(table);
    const auto name = table.name("fitting");
    const auto ideal = table.word("ideal", {"isotropic", "lambertian"});
    const auto intensity = table.number("intensity", kNotNegative);
    const auto lumens = table.number("lumens", kNotNegative);
    if (table.has("fitting") == table.has("ideal")) {
      table.problem(table.has("ideal") ? "ideal" : "name",
                    table.has("ideal") ? "both fitting and ideal are given" : "'fitting' is missing",
                    "give a fitting, or ideal = \"isotropic\" or \"lambertian\"");
      return false;
    }
    luminaire.fitting = name ? shelf_.find(*name, table.label(), table.place("fitting"))
                             : (ideal ? shelf_.ideal(*ideal) : -1);
    if (luminaire.fitting < 0) return false;
    const Fitting& fitting = shelf_[luminaire.fitting];
    luminaire.opening = fitting.opening;
    luminaire.factor = dimmed;
    if (!set_flux(table, fitting, ideal.has_value(), intensity, lumens, luminaire)) return false;
    if (!std::isfinite(luminaire.factor * std::max(fitting.flux_lm, 1.0)))
      return table.problem("dim", "its flux is too large for a number"), false;
    read_spectrum(table, luminaire);
    return true;
  }

  double read_dim(const TomlTable& table) {
    NumberRange factor = kNotNegative;
    factor.share = true;
    const double dim = table.number_or("dim", factor, 1.0);
    // Nobody dims to thirty times the flux: a per cent figure.
    constexpr double kMostLikely = 2.0;
    if (dim > kMostLikely)
      warnings_.push_back({table.place("dim"),
                           fmt::format("{}: dim = {} is {} times the full flux", table.label(),
                                       short_number(dim), short_number(dim)),
                           fmt::format("in percent? write dim = {}, or \"{} %\"", short_number(dim / 100.0),
                                       short_number(dim))});
    return dim;
  }

  bool set_flux(const TomlTable& table, const Fitting& fitting, bool ideal, std::optional<double> intensity,
                std::optional<double> lumens, Luminaire& luminaire) {
    if (intensity && !ideal)
      return table.problem("intensity", "intensity belongs to an ideal source", "use lumens or dim"), false;
    if (intensity && lumens)
      return table.problem("lumens", "both intensity and lumens are given", "leave one out"), false;
    if (ideal && !table.has("intensity") && !table.has("lumens"))
      return table.problem("ideal", "an ideal source needs its intensity (cd) or lumens"), false;
    if (intensity) luminaire.factor *= *intensity;
    if (!lumens) return true;
    if (!(fitting.flux_lm > 0.0)) {
      if (*lumens == 0.0) return true;
      return table.problem("lumens", "the fitting's own flux is zero: nothing to scale"), false;
    }
    // The lumens are those of the fitting as new: the entry's lamp and maintenance factors stay.
    luminaire.factor *= *lumens * fitting.in_use_factor / fitting.flux_lm;
    return true;
  }

  void read_spectrum(const TomlTable& table, Luminaire& luminaire) {
    std::optional<SpectralCurve> spectrum;
    std::string spectrum_name;
    read_spectrum_key(table, spectrum, spectrum_name, shelf_.spectra());
    if (!spectrum) return;
    const std::string key =
        spectrum_name.empty() ? fmt::format("line {}", table.place().line) : "named " + spectrum_name;
    luminaire.fitting = shelf_.with_spectrum(luminaire.fitting, key, *spectrum, spectrum_name);
  }

  void read_opening(const TomlTable& table, Luminaire& luminaire) {
    const auto* node = table.node("opening");
    if (!node) return;
    if (node->is_string()) {
      if (table.word("opening", {"file", "point"}) == "point") luminaire.opening = {};
      return;
    }
    const auto size = table.numbers("opening", 2, {0.0, kMaxCoordinate});
    if (!size) return;
    LuminousOpening opening;
    opening.length_m = (*size)[0] * zone_.unit_m;
    opening.width_m = (*size)[1] * zone_.unit_m;
    const bool length = opening.length_m > 0.0, width = opening.width_m > 0.0;
    opening.shape = length && width   ? OpeningShape::kRectangle
                    : length || width ? OpeningShape::kLine
                                      : OpeningShape::kPoint;
    luminaire.opening = opening;
  }

  void read_body(const TomlTable& table, Luminaire& luminaire) {
    const auto* node = table.node("body");
    if (!node) return;
    if (node->is_boolean()) {
      luminaire.body = table.flag("body", false);
      return;
    }
    if (!node->is_table())
      return table.problem("body", "body must be true, false or a table",
                           "write true for a black body, or { reflectance = 0.5 }");
    const auto body = table.table("body", table.label() + ", body");
    body->require("reflectance", "write body = true for a black one");
    luminaire.body = true;
    luminaire.body_reflectance = body->number_or("reflectance", kReflectance, 0.0);
    body->refuse_unknown();
  }

  void place(const TomlTable& table, Luminaire luminaire, const Vec3& at) {
    const auto [it, added] = names_.emplace(luminaire.name, table.place("name").line);
    if (!added)
      return table.problem(
          "name", fmt::format("the name '{}' is used twice, first at line {}", luminaire.name, it->second));
    luminaire.at = frame_.to_zone(at);
    if (const auto& tilt = shelf_[luminaire.fitting].tilt)
      luminaire.factor *= tilt_factor(*tilt, std::acos(std::clamp(-luminaire.aim.z, -1.0, 1.0)));
    for (int axis = 0; axis < 3; ++axis) {
      if (luminaire.at[axis] >= bounds_.low[axis] - slack_m_ &&
          luminaire.at[axis] <= bounds_.high[axis] + slack_m_)
        continue;
      return problems_.add(
          table.place(table.has("at") ? "at" : "line"),
          fmt::format("luminaire '{}' at {} is outside the zone, which reaches from {} to {}", luminaire.name,
                      short_point(at), short_point(frame_.to_file(bounds_.low)),
                      short_point(frame_.to_file(bounds_.high))),
          "positions are in the zone file's unit");
    }
    warn_if_on_surface(table, luminaire);
    luminaire.at = clear_of_surfaces(luminaire, zone_);
    lights_.luminaires.push_back(std::move(luminaire));
  }

  // Recessed luminaires lie on the ceiling and shine away from it: nothing to say about those.
  void warn_if_on_surface(const TomlTable& table, const Luminaire& luminaire) {
    for (const auto& surface : zone_.surfaces) {
      const Frame& plane = surface.polygon.frame();
      if (surface.outside || std::abs(plane.height(luminaire.at)) > slack_m_ ||
          !surface.polygon.contains(plane.to_local(luminaire.at), slack_m_))
        continue;
      constexpr double kSquare = 1.0 - 1e-6;
      const bool away =
          shelf_[luminaire.fitting].intensity.zero_behind() && glm::dot(luminaire.aim, plane.n) > kSquare;
      if (away) continue;
      warnings_.push_back(
          {table.place(table.has("at") ? "at" : "line"),
           fmt::format("luminaire '{}' lies on surface '{}': light it sends behind that is lost",
                       luminaire.name, surface.name),
           "move it a little into the zone"});
      return;
    }
  }

  // Mixes name sources and groups alike.
  void check_groups() {
    std::set<std::string> reported;
    for (const auto& luminaire : lights_.luminaires) {
      if (luminaire.group == luminaire.name || !names_.contains(luminaire.group) ||
          !reported.insert(luminaire.group).second)
        continue;
      problems_.add(luminaire.place,
                    fmt::format("luminaire '{}': its group '{}' is the name of another luminaire",
                                luminaire.name, luminaire.group),
                    "mixes choose by name or group: keep them apart");
    }
  }

  const TomlTable& root_;
  const Zone& zone_;
  ZoneFrame frame_;
  Bounds bounds_;
  double slack_m_;
  Problems& problems_;
  Warnings& warnings_;
  const std::string& folder_;
  const FileLoader& load_;
  Maintenance maintenance_;
  FittingShelf shelf_;
  std::map<std::string, int> names_;
  Lights lights_;
};

}  // namespace

Lights read_lights(std::string_view text, const std::string& file_name,
                   const std::vector<std::string>& overrides, const Zone& zone, const DatabaseSearch& search,
                   Warnings& warnings, const FileLoader& load) {
  const toml::table table = parse_toml(text, file_name, {"lights", 1, true, {}}, overrides);
  Problems problems;
  TomlContext context{file_name, problems};
  const TomlTable root(table, "", context);
  const std::string folder = std::filesystem::path(file_name).parent_path().string();
  return LightsReader(root, folder, zone, search, load, warnings).read();
}

}  // namespace dim
