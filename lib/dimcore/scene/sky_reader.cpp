#include "scene/sky_reader.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "sky/calendar.hpp"
#include "sky/direction.hpp"
#include "sky/sky_patches.hpp"
#include "sky/sun_position.hpp"
#include "spectrum/named_spectra.hpp"

namespace dim {
namespace {

constexpr NumberRange kIlluminance{0.0, 1e6, false, false};
constexpr NumberRange kIrradiance{0.0, 2000.0, false, false};
constexpr std::size_t kTregenzaPatches = 145;
constexpr char kSkySpectrum[] = "d65";
constexpr char kSunSpectrum[] = "daylight-5500";

class SkyReader {
 public:
  SkyReader(const TomlTable& table, const std::optional<Site>& site, const std::string& folder, const FileLoader& load,
            const SpectrumFinder& spectra)
      : table_(table), site_(site), folder_(folder), load_(load), spectra_(spectra) {}

  std::optional<SkyLight> read() {
    table_.require("model");
    const auto model = table_.word("model", models());
    light_.place = table_.place();
    light_.ground_reflectance = table_.number_or("ground", kReflectance, 0.2);
    light_.sky_spectrum = spectrum_of(table_, kSkySpectrum, light_.sky_spectrum_name);
    light_.sun_spectrum = find_spectrum(light_.sun_spectrum_name = kSunSpectrum);
    if (!model) return std::nullopt;
    light_.model = *model;
    read_model(*model);
    table_.refuse_unknown();
    return light_;
  }

 private:
  static std::vector<std::string> models() {
    std::vector<std::string> names{"cie-overcast", "uniform", "perez", "tregenza", "reinhart", "file"};
    for (int type = 1; type <= 15; ++type) names.push_back(fmt::format("cie-{}", type));
    return names;
  }

  void read_model(const std::string& model) {
    if (model == "tregenza" || model == "reinhart") return read_coefficients(model == "reinhart");
    const auto sun = read_sun();
    if (model == "perez") return read_perez(sun);
    if (model == "file") return read_file(sun);
    SkyModel form = SkyModel::overcast();
    if (model == "uniform") form = SkyModel::uniform();
    if (model.starts_with("cie-") && model != "cie-overcast") form = SkyModel::cie(std::stoi(model.substr(4)));
    if (form.follows_sun() && !sun) {
      if (!table_.has("sun"))
        table_.problem("model", fmt::format("the sky {} follows the sun, whose place is missing", model),
                       "write sun = { altitude = 40, azimuth = 150 }");
      return;
    }
    set_sky(form, sun);
  }

  void read_coefficients(bool reinhart) {
    for (const char* key : {"horizontal", "diffuse_horizontal", "direct_normal", "sun"})
      if (table_.has(key))
        table_.problem(key, fmt::format("{} belongs to one sky; coefficients are for any", key),
                       "leave it out, and say the sky afterwards: dimout grid --sky cie-overcast:10000");
    if (!reinhart) return;
    const auto subdivision = table_.integer("subdivision", 2, 4);
    light_.subdivision = subdivision.value_or(2);
    if (light_.subdivision == 3) table_.problem("subdivision", "subdivision is 2 or 4, not 3");
  }

  struct Sun {
    double altitude_rad;
    Vec3 towards;
    double distance_au = 1.0;
  };
  std::optional<Sun> read_sun() {
    if (!table_.has("sun")) return std::nullopt;
    const auto table = table_.table("sun", "sky, sun");
    if (!table) return std::nullopt;
    const bool by_time = table->has("time");
    const auto sun = by_time ? sun_at_time(*table) : sun_at_angles(*table);
    light_.sun_spectrum = spectrum_of(*table, kSunSpectrum, light_.sun_spectrum_name);
    table->refuse_unknown();
    if (!sun || sun->altitude_rad > 0.0) return sun;
    table->problem(by_time ? "time" : "altitude",
                   fmt::format("the sun stands {} degrees above the horizon: it sends no light",
                               short_number(degrees(sun->altitude_rad))),
                   by_time ? "a time of the day, or a sky without sun" : "an altitude above 0, or a sky without sun");
    return std::nullopt;
  }

  static std::optional<Sun> sun_at_angles(const TomlTable& table) {
    table.require("altitude");
    table.require("azimuth");
    const auto altitude = table.number("altitude", {-90.0, 90.0});
    const auto azimuth = table.number("azimuth", {-360.0, 360.0});
    if (!altitude || !azimuth) return std::nullopt;
    return Sun{radians(*altitude), sky_direction(radians(*altitude), radians(*azimuth))};
  }

  // Local standard time of the site. Light comes from the apparent sun.
  std::optional<Sun> sun_at_time(const TomlTable& table) const {
    const auto text = table.text("time");
    if (!text) return std::nullopt;
    const auto time = parse_local_time(*text);
    if (!time) {
      table.problem("time", fmt::format("'{}' is no time of the years 1950 to 2050", *text),
                    "write \"2001-06-21T09:30\", local standard time");
      return std::nullopt;
    }
    if (!site_) {
      table.problem("time", "the sun's place at a time depends on the site, and the zone file has no [site]",
                    "give the zone file [site] latitude and longitude, or write altitude and azimuth here");
      return std::nullopt;
    }
    const auto position = sun_position(julian_day(*time, site_->time_zone_h), radians(site_->latitude_deg),
                                       radians(site_->longitude_deg));
    return Sun{position.apparent_altitude_rad, position.direction(), position.distance_au};
  }

  void read_perez(const std::optional<Sun>& sun) {
    for (const char* key : {"direct_normal", "diffuse_horizontal"}) table_.require(key, "W/m2");
    if (!table_.has("sun")) table_.require("sun", "write sun = { altitude = 40, azimuth = 150 }");
    const auto direct = table_.number("direct_normal", kIrradiance);
    const auto diffuse = table_.number("diffuse_horizontal", kIrradiance);
    if (sun && direct && diffuse) light_.now = perez_daylight(sun->towards, {*direct, *diffuse}, sun->distance_au);
  }

  // A form scaled to illuminance or irradiance, with the beam in the same unit.
  void set_sky(const SkyModel& form, const std::optional<Sun>& sun) {
    const bool watts = table_.has("diffuse_horizontal");
    if (watts && table_.has("horizontal"))
      return table_.problem("horizontal", "both horizontal (lx) and diffuse_horizontal (W/m2) are given",
                            "leave one out");
    if (!watts && !table_.require("horizontal", "lx, unobstructed, of the sky alone")) return;
    const auto given = watts ? table_.number("diffuse_horizontal", kIrradiance) : table_.number("horizontal", kIlluminance);
    const auto beam = table_.number("direct_normal", watts ? kIrradiance : kIlluminance);
    if (beam && !sun && !table_.has("sun"))
      table_.problem("direct_normal", "a beam without the sun's place", "write sun = { altitude = 40, azimuth = 150 }");
    if (!given || (beam && !sun)) return;
    const Vec3 towards = sun ? sun->towards : Vec3(0, 0, 1);
    double sky_lx = *given, beam_lx = beam.value_or(0.0);
    if (watts) {
      const double altitude_rad = sun ? sun->altitude_rad : 0.5 * kPi;
      const auto state = sky_clearness(beam_lx, std::max(*given, 1e-3), altitude_rad);
      sky_lx *= diffuse_efficacy_lm_W(state, altitude_rad);
      beam_lx *= direct_efficacy_lm_W(state, altitude_rad);
    }
    light_.now = Daylight{Sky(form, towards, sky_lx), towards, beam_lx};
  }

  // 145 luminances, one a line or separated by commas, in the order of the patches; as they stand unless a
  // horizontal illuminance is given.
  void read_file(const std::optional<Sun>& sun) {
    if (!table_.require("file", "a CSV of 145 luminances")) return;
    const auto name = table_.text("file");
    if (!name) return;
    const std::string path = (std::filesystem::path(folder_) / *name).string();
    std::vector<double> luminances;
    if (!read_numbers(load_(path), path, luminances)) return;
    const SkyModel form = SkyModel::table(luminances);
    if (table_.has("horizontal") || table_.has("diffuse_horizontal")) return set_sky(form, sun);
    const SkyPatches patches;
    double lx = 0.0;
    for (std::size_t p = 0; p < patches.size(); ++p) lx += patches.horizontal_sr(p) * luminances[p];
    const auto beam = table_.number("direct_normal", kIlluminance);
    const Vec3 towards = sun ? sun->towards : Vec3(0, 0, 1);
    light_.now = Daylight{Sky(form, towards, lx), towards, sun ? beam.value_or(0.0) : 0.0};
  }

  bool read_numbers(const std::string& text, const std::string& path, std::vector<double>& values) {
    const auto refuse = [&](int line, const std::string& what) {
      table_.context().problems.add({path, line, 0}, what, "145 luminances in cd/m2, from the horizon up");
      return false;
    };
    int line = 1;
    for (std::size_t at = 0; at < text.size();) {
      const char c = text[at];
      line += c == '\n';
      if (std::isspace(static_cast<unsigned char>(c)) || c == ',' || c == ';') {
        ++at;
        continue;
      }
      if (c == '#') {
        while (at < text.size() && text[at] != '\n') ++at;
        continue;
      }
      double value = 0.0;
      const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), value);
      if (error != std::errc() || !(value >= 0.0) || !std::isfinite(value))
        return refuse(line, fmt::format("luminance {} is no number of at least 0", values.size() + 1));
      values.push_back(value);
      at = static_cast<std::size_t>(end - text.data());
    }
    if (values.size() != kTregenzaPatches)
      return refuse(line, fmt::format("{} luminances, expected {}", values.size(), kTregenzaPatches));
    return true;
  }

  SpectralCurve spectrum_of(const TomlTable& table, const char* usual, std::string& name) const {
    std::optional<SpectralCurve> given;
    read_spectrum_key(table, given, name, spectra_);
    if (given) return *given;
    name = usual;
    return find_spectrum(usual);
  }

  const TomlTable& table_;
  const std::optional<Site>& site_;
  const std::string& folder_;
  const FileLoader& load_;
  const SpectrumFinder& spectra_;
  SkyLight light_;
};

}  // namespace

std::optional<SkyLight> read_sky(const TomlTable& root, const std::optional<Site>& site, const std::string& folder,
                                 const FileLoader& load, const SpectrumFinder& spectra) {
  if (!root.has("sky")) return std::nullopt;
  const auto table = root.table("sky", "sky");
  if (!table) return std::nullopt;
  return SkyReader(*table, site, folder, load, spectra).read();
}

}  // namespace dim
