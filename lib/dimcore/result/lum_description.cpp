#include "result/lum_description.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.hpp"

namespace dim {
namespace {

using Json = nlohmann::json;

Json to_json(const Vec3& v) { return {v.x, v.y, v.z}; }

Json to_json(const EnergyBalance& e) {
  return {{"emitted_W", e.emitted_W}, {"absorbed_W", e.absorbed_W}, {"escaped_W", e.escaped_W},
          {"lost_W", e.lost_W},       {"dropped_W", e.dropped_W},   {"imbalance", e.imbalance}};
}

Json to_json(const Source& source, bool spectrum_known) {
  Json energy = Json::array();
  for (const auto& e : source.energy) energy.push_back(to_json(e));
  const auto& w = source.weights;
  return {{"name", source.name},
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

// A value of the description and its name, `sources[2].flux_lm`, for messages.
class Entry {
 public:
  Entry(const Json& json, std::string name, const std::string& path)
      : json_(json), name_(std::move(name)), path_(path) {}

  Entry operator[](const char* key) const {
    const std::string name = name_.empty() ? key : name_ + "." + key;
    if (!json_.is_object() || !json_.contains(key)) fail(name + " is missing");
    return {json_[key], name, path_};
  }
  Entry operator[](std::size_t i) const { return {json_[i], fmt::format("{}[{}]", name_, i), path_}; }

  /// Elements of a list; of exactly `n` where that is asked for.
  std::size_t size(std::size_t n = kAny) const {
    if (!json_.is_array()) fail(name_ + " is no list");
    if (n != kAny && json_.size() != n)
      fail(fmt::format("{} has {} elements, expected {}", name_, json_.size(), n));
    return json_.size();
  }
  std::string text() const {
    if (!json_.is_string()) fail(name_ + " is no text");
    return json_.get<std::string>();
  }
  bool flag() const {
    if (!json_.is_boolean()) fail(name_ + " is neither true nor false");
    return json_.get<bool>();
  }
  double number(double low, double high = HUGE_VAL) const {
    if (!json_.is_number()) fail(name_ + " is no number");
    const double value = json_.get<double>();
    if (!(value >= low && value <= high) || !std::isfinite(value))
      fail(fmt::format("{} is {:g}, outside {:g}..{:g}", name_, value, low, high));
    return value;
  }
  std::size_t index(std::size_t n) const {
    if (!json_.is_number_unsigned() || json_.get<std::size_t>() >= n)
      fail(fmt::format("{} is {}, not an index below {}", name_, json_.dump(), n));
    return json_.get<std::size_t>();
  }
  std::vector<double> numbers(std::size_t n, double low) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < size(n); ++i) values.push_back((*this)[i].number(low));
    return values;
  }
  Vec3 vec3() const {
    const auto v = numbers(3, -HUGE_VAL);
    return {v[0], v[1], v[2]};
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw IoError(path_, "this luminance database does not hold together: in its description " + what);
  }

 private:
  static constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();
  const Json& json_;
  std::string name_;
  const std::string& path_;
};

BandWeights weights_from(const Entry& w, std::size_t n_bands) {
  BandWeights weights{w["efficacy_lm_W"].number(0.0), w["share"].numbers(n_bands, 0.0), w["x"].numbers(n_bands, 0.0),
                      w["y"].numbers(n_bands, 0.0), w["z"].numbers(n_bands, 0.0)};
  if (!(weights.efficacy_lm_W > 0.0)) w["efficacy_lm_W"].fail("a source's efficacy is not positive");
  return weights;
}

Source source_from(const Entry& entry, std::size_t n_bands) {
  Source source;
  source.name = entry["name"].text();
  source.group = entry["group"].text();
  const Entry luminaires = entry["luminaires"], energy = entry["energy"];
  for (std::size_t i = 0; i < luminaires.size(); ++i) source.luminaires.push_back(luminaires[i].text());
  source.flux_lm = entry["flux_lm"].number(0.0);
  source.weights = weights_from(entry["weights"], n_bands);
  for (std::size_t b = 0; b < energy.size(n_bands); ++b) {
    const Entry e = energy[b];
    const auto figure = [&](const char* key) { return e[key].number(-HUGE_VAL); };
    source.energy.push_back({figure("emitted_W"), figure("absorbed_W"), figure("escaped_W"), figure("lost_W"),
                             figure("dropped_W"), figure("imbalance")});
  }
  constexpr double kMostIterations = 2e9;
  source.iterations = static_cast<int>(entry["iterations"].number(0.0, kMostIterations));
  source.residual = entry["residual"].number(0.0);
  source.error_bound = entry["error_bound"].number(0.0);
  return source;
}

// Frames carry light by dot products: unit axes, C90 = C0 x aim.
void check_frame(const Entry& entry, const ShownLuminaire& shown) {
  constexpr double kRounding = 1e-6;
  const auto off_unit = [](const Vec3& v) { return std::abs(glm::dot(v, v) - 1.0); };
  if (off_unit(shown.c0) > kRounding || off_unit(shown.aim) > kRounding ||
      glm::length(shown.c90 - glm::cross(shown.c0, shown.aim)) > kRounding)
    entry.fail(fmt::format("the axes of luminaire '{}' are not unit vectors with c90 = c0 x aim", shown.name));
}

ShownLuminaire luminaire_from(const Entry& l, const ResultContent& content) {
  constexpr std::size_t kShapes = static_cast<std::size_t>(OpeningShape::kVerticalEllipse) + 1;
  ShownLuminaire shown;
  shown.name = l["name"].text();
  shown.source = l["source"].index(content.sources.size());
  shown.at = l["at"].vec3();
  shown.c0 = l["c0"].vec3();
  shown.c90 = l["c90"].vec3();
  shown.aim = l["aim"].vec3();
  check_frame(l, shown);
  const auto size = l["opening_m"].numbers(3, 0.0);
  shown.opening = {static_cast<OpeningShape>(l["opening_shape"].index(kShapes)), size[0], size[1], size[2]};
  shown.photometry = l["photometry"].index(content.photometry.size());
  shown.factor = l["factor"].number(0.0);
  shown.body = l["body"].flag();
  shown.mirror_depth = static_cast<int>(l["mirror_depth"].index(1'001));
  return shown;
}

}  // namespace

std::string description_of(const ResultContent& content) {
  Json json = {{"sources", Json::array()}, {"luminaires", Json::array()}, {"photometry", Json::array()}};
  for (std::size_t s = 0; s < content.sources.size(); ++s)
    json["sources"].push_back(to_json(content.sources[s], content.spectra[s].known));
  for (const auto& luminaire : content.luminaires) json["luminaires"].push_back(to_json(luminaire));
  for (const auto& p : content.photometry)
    json["photometry"].push_back(
        {{"name", p.name}, {"flux_lm", p.flux_lm}, {"watts", p.watts}, {"mean_intensity_cd", p.mean}});
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void read_description(const std::string& text, const std::string& path, ResultContent& content) {
  const Json json = Json::parse(text, nullptr, false);
  const Entry all(json, "", path);
  if (json.is_discarded()) all.fail("the text is not JSON");
  const Entry sources = all["sources"], photometry = all["photometry"], luminaires = all["luminaires"];
  for (std::size_t s = 0; s < sources.size(); ++s) {
    content.sources.push_back(source_from(sources[s], content.bands.size()));
    content.spectra.push_back({SpectralCurve(1.0), sources[s]["spectrum_known"].flag()});
  }
  for (std::size_t i = 0; i < photometry.size(); ++i) {
    const Entry p = photometry[i];
    content.photometry.push_back({p["name"].text(), p["flux_lm"].number(0.0), p["watts"].number(0.0),
                                  p["mean_intensity_cd"].numbers(kShownGammas, 0.0), {}});
  }
  for (std::size_t i = 0; i < luminaires.size(); ++i)
    content.luminaires.push_back(luminaire_from(luminaires[i], content));
}

}  // namespace dim
