#include "result/lum_description.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/json_entry.hpp"

namespace dim {
namespace {

using Json = nlohmann::json;

const std::string kDescription = "/description";
constexpr int kMostMirrors = 10'000;

Json to_json(const Vec3& v) { return {v.x, v.y, v.z}; }

Json to_json(const EnergyBalance& e) {
  return {{"emitted_W", e.emitted_W}, {"absorbed_W", e.absorbed_W}, {"escaped_W", e.escaped_W},
          {"lost_W", e.lost_W},       {"dropped_W", e.dropped_W},   {"imbalance", e.imbalance}};
}

// As DaylightPart numbers them.
const std::vector<std::string> kParts = {"sky", "ground", "sun", "ramp"};

Json to_json(const Source& source, bool spectrum_known) {
  Json energy = Json::array();
  for (const auto& e : source.energy) energy.push_back(to_json(e));
  const auto& w = source.weights;
  Json daylight;
  if (source.daylight)
    daylight = {{"part", kParts[static_cast<std::size_t>(source.daylight->part)]},
                {"patch", source.daylight->patch},
                {"state", source.daylight->state},
                {"as_it_stands", source.daylight->as_it_stands}};
  Json json = {{"name", source.name},
               {"daylight", std::move(daylight)},
               {"group", source.group},
               {"luminaires", source.luminaires},
               {"flux_lm", source.flux_lm},
               {"spectrum_known", spectrum_known},
               {"weights",
                {{"efficacy_lm_W", w.efficacy_lm_W}, {"share", w.share}, {"x", w.x}, {"y", w.y}, {"z", w.z}}},
               {"energy", std::move(energy)},
               {"iterations", source.iterations},
               {"residual", source.residual},
               {"error_bound", source.error_bound}};
  if (source.maintenance) json["maintenance_factor"] = *source.maintenance;
  return json;
}

Json to_json(const ShownLuminaire& l) {
  return {{"name", l.name},
          {"source", l.source},
          {"at", to_json(l.at)},
          {"c0", to_json(l.c0)},
          {"c90", to_json(l.c90)},
          {"aim", to_json(l.aim)},
          {"opening_shape", static_cast<int>(l.opening.shape)},
          {"opening_m", {l.opening.length_m, l.opening.width_m, l.opening.height_m}},
          {"photometry", l.photometry},
          {"body", l.body},
          {"factor", l.factor},
          {"mirror_depth", l.mirror_depth}};
}

BandWeights weights_from(const JsonEntry& w, std::size_t n_bands) {
  return {w["efficacy_lm_W"].positive(), w["share"].numbers(n_bands, 0.0), w["x"].numbers(n_bands, 0.0),
          w["y"].numbers(n_bands, 0.0), w["z"].numbers(n_bands, 0.0)};
}

DaylightOrigin daylight_from(const JsonEntry& d) {
  constexpr int kMostPatches = 2305;
  return {static_cast<DaylightPart>(d["part"].word(kParts)), d["patch"].integer(-1, kMostPatches - 1),
          d["state"].text(), d["as_it_stands"].flag()};
}

// Whether a sky has such a part: coefficients are of patches and ramps that it is cut into.
bool has(const SkyRecord& sky, const DaylightOrigin& daylight) {
  const auto below = [&](std::size_t n) { return daylight.patch >= 0 && static_cast<std::size_t>(daylight.patch) < n; };
  if (sky.subdivision == 0) return daylight.part != DaylightPart::ramp && daylight.patch == -1;
  const SkyPatches patches(sky.subdivision);
  switch (daylight.part) {
    case DaylightPart::sky:
      return below(patches.size());
    case DaylightPart::ground:
      return daylight.patch == -1;
    case DaylightPart::sun:
      return false;
    case DaylightPart::ramp:
      break;
  }
  return below(patches.n_ramps());
}

void check_patches(const JsonEntry& sources, const ResultContent& content) {
  for (std::size_t s = 0; s < content.sources.size(); ++s) {
    const auto& daylight = content.sources[s].daylight;
    if (daylight && !(content.sky && has(*content.sky, *daylight)))
      sources.at(s)["daylight"].fail("is of a part of the sky that the file has not");
  }
}

std::optional<SkyRecord> sky_from(const JsonEntry& sky) {
  if (sky.is_null()) return std::nullopt;
  SkyRecord record{sky["subdivision"].integer(0, 4), sky["horizontal_lx"].number(0.0),
                   sky["ground_reflectance"].number(0.0, 1.0)};
  if (record.subdivision == 3) sky["subdivision"].fail("is 3");
  return record;
}

Source source_from(const JsonEntry& entry, std::size_t n_bands) {
  Source source;
  source.name = entry["name"].text();
  source.group = entry["group"].text();
  const JsonEntry luminaires = entry["luminaires"], energy = entry["energy"];
  for (std::size_t i = 0; i < luminaires.size(); ++i) source.luminaires.push_back(luminaires.at(i).text());
  source.flux_lm = entry["flux_lm"].number(0.0);
  if (entry.has("maintenance_factor")) source.maintenance = entry["maintenance_factor"].number(0.0, 1.0);
  source.weights = weights_from(entry["weights"], n_bands);
  for (std::size_t b = 0; b < energy.size(n_bands); ++b) {
    const JsonEntry e = energy.at(b);
    source.energy.push_back({e["emitted_W"].number(), e["absorbed_W"].number(), e["escaped_W"].number(),
                             e["lost_W"].number(), e["dropped_W"].number(), e["imbalance"].number()});
  }
  if (!entry["daylight"].is_null()) source.daylight = daylight_from(entry["daylight"]);
  source.iterations = entry["iterations"].integer(0, std::numeric_limits<int>::max());
  source.residual = entry["residual"].number(0.0);
  source.error_bound = entry["error_bound"].bound();
  return source;
}

// Light is carried by dot products with these: unit axes, C90 = C0 x aim.
void check_axes(const JsonEntry& entry, const ShownLuminaire& shown) {
  constexpr double kRounding = 1e-6;
  const auto off_unit = [](const Vec3& v) { return std::abs(glm::dot(v, v) - 1.0); };
  if (!(off_unit(shown.c0) <= kRounding && off_unit(shown.aim) <= kRounding &&
        glm::length(shown.c90 - glm::cross(shown.c0, shown.aim)) <= kRounding))
    entry.fail("has axes that are not unit vectors with c90 = c0 x aim");
}

ShownLuminaire luminaire_from(const JsonEntry& l, const ResultContent& content) {
  constexpr std::size_t kShapes = static_cast<std::size_t>(OpeningShape::kVerticalEllipse) + 1;
  ShownLuminaire shown;
  shown.name = l["name"].text();
  shown.source = l["source"].index(content.sources.size());
  shown.at = l["at"].vec3();
  shown.c0 = l["c0"].vec3();
  shown.c90 = l["c90"].vec3();
  shown.aim = l["aim"].vec3();
  check_axes(l, shown);
  const auto size = l["opening_m"].numbers(3, 0.0);
  shown.opening = {static_cast<OpeningShape>(l["opening_shape"].index(kShapes)), size[0], size[1], size[2]};
  shown.photometry = l["photometry"].index(content.photometry.size());
  shown.factor = l["factor"].number(0.0);
  shown.body = l["body"].flag();
  shown.mirror_depth = l["mirror_depth"].integer(0, kMostMirrors);
  return shown;
}

}  // namespace

std::string description_of(const ResultContent& content) {
  Json sky;
  if (content.sky)
    sky = {{"subdivision", content.sky->subdivision},
           {"horizontal_lx", content.sky->horizontal_lx},
           {"ground_reflectance", content.sky->ground_reflectance}};
  Json json = {{"sky", std::move(sky)}, {"sources", Json::array()}, {"luminaires", Json::array()}, {"photometry", Json::array()}};
  for (std::size_t s = 0; s < content.sources.size(); ++s)
    json["sources"].push_back(to_json(content.sources[s], content.spectra[s].known));
  for (const auto& luminaire : content.luminaires) json["luminaires"].push_back(to_json(luminaire));
  for (const auto& p : content.photometry)
    json["photometry"].push_back(
        {{"name", p.name}, {"flux_lm", p.flux_lm}, {"watts", p.watts}, {"mean_intensity_cd", p.mean}});
  return dump_json(json);
}

void read_description(const std::string& text, const std::string& path, ResultContent& content) {
  const Json json = parse_json(text, kDescription, path);
  const JsonEntry all(json, kDescription, path);
  const JsonEntry sources = all["sources"], photometry = all["photometry"], luminaires = all["luminaires"];
  for (std::size_t s = 0; s < sources.size(); ++s) {
    content.sources.push_back(source_from(sources.at(s), content.bands.size()));
    content.spectra.push_back({SpectralCurve(1.0), sources.at(s)["spectrum_known"].flag()});
  }
  content.sky = sky_from(all["sky"]);
  check_patches(sources, content);
  for (std::size_t i = 0; i < photometry.size(); ++i) {
    const JsonEntry p = photometry.at(i);
    content.photometry.push_back({p["name"].text(), p["flux_lm"].number(0.0), p["watts"].number(0.0),
                                  p["mean_intensity_cd"].numbers(kShownGammas, 0.0), {}});
  }
  for (std::size_t i = 0; i < luminaires.size(); ++i)
    content.luminaires.push_back(luminaire_from(luminaires.at(i), content));
}

}  // namespace dim
