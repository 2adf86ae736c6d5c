#include "photometry/ies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "photometry/carried_on.hpp"
#include "photometry/ies_labels.hpp"
#include "photometry/number_reader.hpp"
#include "photometry/symmetry.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {
namespace {

constexpr double kMetresPerFoot = 0.3048;
constexpr Limits kFactor = {1e-12, 1e12};
constexpr double kMaxAngles = 36001;
constexpr double kMaxCandelas = 8e6;
constexpr double kMaxIntensity_cd = 1e18;
constexpr double kMaxOpening_m = 1000.0;
const char* const kCountCure = "check this line; decimals take a point, for a comma separates two numbers";

/// The numbers between the TILT lines and the angles.
struct IesCounts {
  std::size_t n_gamma;
  std::size_t n_c;
  PhotometricType type;
};

LampTilt read_tilt(TextScanner& scanner) {
  NumberReader in(scanner);
  LampTilt tilt;
  tilt.geometry = in.count("TILT lamp-to-luminaire geometry", {1, 3});
  const auto n = static_cast<std::size_t>(in.count("number of TILT angles", {1, 1000}));
  for (const double angle : in.ascending("TILT angle", n, {0, 180})) tilt.angle_rad.push_back(radians(angle));
  tilt.factor = in.list("TILT factor", n, {0, 100});
  return tilt;
}

/// The data of another file: errors name it and the line, but quote nothing of what may not be lamp data.
LampTilt read_tilt_file(const std::string& bytes, const std::string& name, const Place& asked) {
  try {
    TextScanner scanner(bytes, name);
    return read_tilt(scanner);
  } catch (const InputError& error) {
    const int line = error.problems().front().place.line;
    throw InputError(
        {asked, fmt::format("TILT={}: line {} of that file is not lamp tilt data", name, line),
         "it holds the lamp-to-luminaire geometry (1 to 3), the number of angles, the angles, and a "
         "factor for each"});
  }
}

void take_tilt(Photometry& photometry, const IesLabels& labels, TextScanner& scanner,
               const TiltResolver& resolver) {
  const std::string tilt = in_capitals(labels.tilt);
  constexpr const char* kCure = "write TILT=NONE, or put the data into the file after TILT=INCLUDE";
  if (tilt == "NONE") return;
  if (tilt == "INCLUDE") {
    photometry.tilt = read_tilt(scanner);
    return;
  }
  for (const char* word : {"NONE", "INCLUDE"})
    if (tilt.starts_with(std::string(word) + " "))
      throw InputError({labels.tilt_place,
                        fmt::format("TILT={} is followed by {} on the same line", word,
                                    quoted(trimmed(std::string_view(labels.tilt).substr(std::strlen(word))))),
                        "put the numbers on the lines below it"});
  if (labels.tilt.find_first_of("/\\") != std::string::npos || labels.tilt.starts_with(".."))
    throw InputError({labels.tilt_place, "TILT=" + quoted(labels.tilt) + " names another folder",
                      "a TILT file is looked for beside the photometric file only: write its bare name"});
  if (labels.tilt.empty() || !resolver)
    throw InputError(
        {labels.tilt_place, "TILT=" + quoted(labels.tilt) + ": the lamp's tilt data are missing", kCure});
  std::string bytes;
  try {
    bytes = resolver(labels.tilt);
  } catch (const IoError&) {
    throw InputError(
        {labels.tilt_place,
         fmt::format("TILT={}: there is no such file beside this one that can be read", to_utf8(labels.tilt)),
         kCure});
  }
  photometry.tilt = read_tilt_file(bytes, to_utf8(labels.tilt), labels.tilt_place);
}

void take_lamps(Photometry& photometry, NumberReader& in, const TextScanner& scanner, Warnings& warnings) {
  photometry.n_lamps = in.count("number of lamps", {0, 1e6});
  const double lumens = in.number("lumens per lamp", {-1, 1e9});
  if (lumens < 0.0 && lumens != -1.0)
    throw InputError(
        {scanner.place(),
         fmt::format("lumens per lamp {} is neither -1 (absolute photometry) nor in 0..1e9", lumens), ""});
  if (lumens > 0.0) photometry.lumens_per_lamp = lumens;
  if (lumens == 0.0)
    warnings.push_back({scanner.place(), "lumens per lamp 0: read as absolute photometry (-1)", ""});
  photometry.multiplier = in.number("candela multiplier", kFactor);
}

void take_opening(Photometry& photometry, NumberReader& in, bool feet, PhotometricType type) {
  const double unit_m = feet ? kMetresPerFoot : 1.0;
  const Limits limits = {-kMaxOpening_m / unit_m, kMaxOpening_m / unit_m};
  const double width_m = unit_m * in.number("width of the luminous opening", limits);
  const double length_m = unit_m * in.number("length of the luminous opening", limits);
  const double height_m = unit_m * in.number("height of the luminous opening", limits);
  photometry.opening = opening_from_lm63(width_m, length_m, height_m, photometry.format_year);
  // The width is across the plane of horizontal angle 0, which is C0-C180 in type C, C90-C270 in A and B.
  if (type != PhotometricType::kC && photometry.opening.shape != OpeningShape::kVerticalEllipse)
    std::swap(photometry.opening.length_m, photometry.opening.width_m);
}

/// The third number of the ballast line, which three editions define differently.
void take_third_number(Photometry& photometry, NumberReader& in, const TextScanner& scanner,
                       Warnings& warnings) {
  if (photometry.format_year <= 1991) {
    photometry.ballast_lamp_factor = in.number("ballast-lamp photometric factor", kFactor);
    return;
  }
  const double third = in.number("number after the ballast factor", {-1e12, 1e12});
  if (photometry.format_year >= 2019) {
    photometry.file_generation = third;
    return;
  }
  if (third != 1.0)
    warnings.push_back(
        {scanner.place(),
         fmt::format("number {} after the ballast factor is ignored: it is reserved, and not a "
                     "factor, in LM-63-{}",
                     third, photometry.format_year),
         ""});
}

void take_watts(Photometry& photometry, NumberReader& in, const TextScanner& scanner, Warnings& warnings) {
  const double watts = in.number("input watts", {-1e9, 1e9});
  if (watts >= 0.0)
    photometry.watts = watts;
  else
    warnings.push_back({scanner.place(), fmt::format("input watts {} is below 0: ignored", watts), ""});
}

IesCounts take_header(Photometry& photometry, TextScanner& scanner, Warnings& warnings) {
  NumberReader in(scanner);
  take_lamps(photometry, in, scanner, warnings);
  IesCounts counts{};
  counts.n_gamma =
      static_cast<std::size_t>(in.count("number of vertical angles", {2, kMaxAngles}, kCountCure));
  counts.n_c = static_cast<std::size_t>(in.count("number of horizontal angles", {1, kMaxAngles}, kCountCure));
  if (static_cast<double>(counts.n_gamma) * static_cast<double>(counts.n_c) > kMaxCandelas)
    throw InputError({scanner.place(),
                      fmt::format("{} x {} candela values are more than the {} allowed", counts.n_gamma,
                                  counts.n_c, kMaxCandelas),
                      "resample the file to coarser angles"});
  counts.type = static_cast<PhotometricType>(in.count("photometric type", {1, 3}));
  if (counts.type != PhotometricType::kC && counts.n_c < 2)
    throw InputError({scanner.place(),
                      fmt::format("1 horizontal angle is too few for photometric type {}",
                                  counts.type == PhotometricType::kB ? 'B' : 'A'),
                      "types A and B have no axial form; list H from 0 or -90 to 90"});
  const bool feet = in.count("units type", {1, 2}) == 1;
  take_opening(photometry, in, feet, counts.type);
  photometry.ballast_factor = in.number("ballast factor", kFactor);
  take_third_number(photometry, in, scanner, warnings);
  take_watts(photometry, in, scanner, warnings);
  return counts;
}

Symmetry checked_symmetry(const std::vector<double>& c_deg, const Place& place, Warnings& warnings) {
  const std::optional<Symmetry> symmetry = symmetry_of(c_deg);
  if (!symmetry)
    throw InputError(
        {place,
         fmt::format("horizontal angles run from {} to {}; allowed are one plane, 0..90, 0..180, "
                     "90..270 and 0..360",
                     c_deg.front(), c_deg.back()),
         ""});
  if (*symmetry == Symmetry::kAxial && c_deg.front() != 0.0)
    warnings.push_back(
        {place, fmt::format("the only plane is C {}: used for all directions", c_deg.front()), ""});
  if (*symmetry == Symmetry::kNone) {
    double widest = 0.0;
    for (std::size_t i = 1; i < c_deg.size(); ++i) widest = std::max(widest, c_deg[i] - c_deg[i - 1]);
    const double gap = 360.0 - (c_deg.back() - c_deg.front());
    if (gap > 1.01 * widest)
      warnings.push_back(
          {place,
           fmt::format("no planes between C {} and C {}: interpolated", c_deg.back(), c_deg.front() + 360.0),
           ""});
  }
  return *symmetry;
}

/// Types A and B: whether H is listed on one side only.
Symmetry symmetry_about_aim(const std::vector<double>& h_deg, const std::vector<double>& v_deg,
                            const Place& place, Warnings& warnings) {
  if (v_deg.front() >= 0.0 || v_deg.back() <= 0.0)
    warnings.push_back(
        {place,
         fmt::format("vertical angles run from {} to {}: read as the {} half alone, no light leaves on the "
                     "other side of the aim",
                     v_deg.front(), v_deg.back(), v_deg.front() >= 0.0 ? "upper" : "lower"),
         "where the luminaire is the same above and below, list both halves, from -90 to 90"});
  if (h_deg.front() == 0.0) return Symmetry::kLateral;
  if (h_deg.front() > 0.0 || h_deg.back() <= 0.0)
    throw InputError({place,
                      fmt::format("horizontal angles run from {} to {}; in types A and B they start at 0 or "
                                  "below and end above 0",
                                  h_deg.front(), h_deg.back()),
                      ""});
  return Symmetry::kNone;
}

/// Allowed angles of each type: along the plane's turn, and between the poles.
Limits vertical_limits(PhotometricType type) {
  if (type == PhotometricType::kC) return {0, 180};
  return type == PhotometricType::kB ? Limits{-180, 180} : Limits{-90, 90};
}

Limits horizontal_limits(PhotometricType type) {
  if (type == PhotometricType::kC) return {-180, 360};
  return type == PhotometricType::kB ? Limits{-90, 90} : Limits{-180, 180};
}

void take_intensities(Photometry& photometry, const IesCounts& counts, TextScanner& scanner,
                      Warnings& warnings) {
  NumberReader in(scanner);
  const bool type_c = counts.type == PhotometricType::kC;
  auto vertical_deg = in.ascending("vertical angle", counts.n_gamma, vertical_limits(counts.type));
  const Place vertical_place = scanner.place();
  const auto horizontal_deg = in.ascending("horizontal angle", counts.n_c, horizontal_limits(counts.type));
  photometry.symmetry = type_c ? checked_symmetry(horizontal_deg, scanner.place(), warnings)
                               : symmetry_about_aim(horizontal_deg, vertical_deg, scanner.place(), warnings);
  const double factor = photometry.multiplier * photometry.ballast_factor * photometry.ballast_lamp_factor;
  std::vector<double> candelas = in.list("candela value", counts.n_c * counts.n_gamma, {0, kMaxIntensity_cd});
  const double highest = *std::max_element(candelas.begin(), candelas.end());
  if (highest * factor > kMaxIntensity_cd)
    throw InputError(
        {scanner.place(),
         fmt::format("candela value {} x factor {} is {}", highest, factor, outside({0, kMaxIntensity_cd})),
         ""});
  for (double& candela : candelas) candela *= factor;
  if (type_c) carry_on_to_hemispheres(vertical_deg, candelas, vertical_place, warnings);
  photometry.distribution = type_c ? expand(photometry.symmetry, horizontal_deg, vertical_deg, candelas)
                                   : expand_about_aim(counts.type, horizontal_deg, vertical_deg, candelas);
}

void warn_of_rest(TextScanner& scanner, Warnings& warnings) {
  std::size_t n = 0;
  double value = 0.0;
  Place first;
  for (std::string_view word = scanner.take_word(); parse_number(word, value); word = scanner.take_word())
    if (n++ == 0) first = scanner.place();
  if (n > 0)
    warnings.push_back({first, fmt::format("{} more numbers after the last candela value: ignored", n),
                        "check the numbers of angles"});
}

/// A keyword's first number, "9,217 lm" being 9217; nothing where there is none above 0.
std::optional<double> leading_number(std::string_view value) {
  std::string word;
  for (std::size_t i = 0; i < value.size() && value[i] != ' '; ++i)
    if (value[i] != ',') word += value[i];
  while (!word.empty() && (word.back() < '0' || word.back() > '9')) word.pop_back();
  double number = 0.0;
  if (!parse_number(word, number) || number <= 0.0) return std::nullopt;
  return number;
}

std::optional<double> declared_luminaire_flux(const Photometry& photometry) {
  static const std::array<std::string, 3> kNames = {"ABSOLUTELUMENS", "LUMINAIRELUMENS", "TOTALLUMENS"};
  for (const auto& [key, value] : photometry.keywords) {
    std::string name;
    for (const char c : key)
      if (c != '_' && c != ' ') name += c;
    if (std::find(kNames.begin(), kNames.end(), name) == kNames.end()) continue;
    if (const auto number = leading_number(value)) return number;
  }
  return std::nullopt;
}

void warn_of_flux(const Photometry& photometry, const std::string& file_name, Warnings& warnings) {
  const double flux = photometry.flux_lm;
  const auto warn = [&](const char* says, double declared) {
    warnings.push_back({{file_name, 0, 0},
                        fmt::format("intensity integrates to {:.6g} lm but the file {} {:.6g} lm ({:+.1f} %)",
                                    flux, says, declared, 100.0 * (flux / declared - 1.0)),
                        fmt::format("using {:.6g} lm", flux)});
  };
  if (flux <= 0.0) warnings.push_back({{file_name, 0, 0}, "the luminaire emits no light", ""});
  if (const auto declared = photometry.declared_flux_lm; declared && std::abs(flux / *declared - 1.0) > 0.02)
    warn("declares", *declared);
  const auto lamps = photometry.declared_lamp_flux_lm;
  const double factor = photometry.ballast_factor * photometry.ballast_lamp_factor;
  if (lamps && flux > 1.02 * *lamps * factor) warn("gives its lamps", *lamps * factor);
}

}  // namespace

Photometry read_ies(std::string_view bytes, const std::string& file_name, Warnings& warnings,
                    const TiltResolver& resolver) {
  TextScanner scanner(photometric_text(bytes, file_name), file_name);
  Photometry photometry;
  IesLabels labels = read_ies_labels(scanner, warnings);
  photometry.identifier = std::move(labels.identifier);
  photometry.format_year = labels.format_year;
  photometry.format = fmt::format("LM-63-{}", labels.format_year);
  photometry.keywords = std::move(labels.keywords);
  take_tilt(photometry, labels, scanner, resolver);
  const IesCounts counts = take_header(photometry, scanner, warnings);
  take_intensities(photometry, counts, scanner, warnings);
  warn_of_rest(scanner, warnings);

  const IntensityTable table(photometry.distribution);
  photometry.flux_lm = table.flux_lm();
  photometry.max_cd = table.max_cd();
  photometry.declared_flux_lm = declared_luminaire_flux(photometry);
  if (photometry.lumens_per_lamp)
    photometry.declared_lamp_flux_lm = photometry.n_lamps * *photometry.lumens_per_lamp;
  warn_of_flux(photometry, file_name, warnings);
  return photometry;
}

}  // namespace dim
