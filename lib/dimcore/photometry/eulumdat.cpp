#include "photometry/eulumdat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "photometry/carried_on.hpp"
#include "photometry/field_lines.hpp"
#include "photometry/symmetry.hpp"

namespace dim {
namespace {

constexpr double kMetresPerMillimetre = 1e-3;
constexpr Limits kDimension_mm = {0, 1e6};
constexpr Limits kMoreThanAny = {-1e18, 1e18};
constexpr double kMaxIntensity_cd = 1e18;
constexpr double kMaxIntensities = 8e6;
constexpr double kSame_deg = 1e-3;
constexpr int kUtilisationFactors = 10;

/// Fields that say how the rest is to be read.
struct Layout {
  int isym = 0;
  int n_planes = 0;
  int n_gamma = 0;
  Place isym_place;
};

void keep(Photometry& photometry, const char* keyword, const std::string& value) {
  if (!value.empty()) photometry.keywords.emplace_back(keyword, value);
}

Layout take_layout(Photometry& photometry, FieldLines& in) {
  keep(photometry, "MANUFAC", in.text("identification (line 1)"));
  in.count("type indicator Ityp", {0, 3});
  Layout layout;
  layout.isym = in.count("symmetry indicator Isym", {0, 4});
  layout.isym_place = in.place();
  layout.n_planes = in.count("number of C planes Mc", {1, 36001});
  in.number("distance of C planes Dc", {0, 360});
  layout.n_gamma = in.count("number of intensities in a plane Ng", {2, 36001});
  in.number("distance of intensities Dg", {0, 180});
  const double n = static_cast<double>(layout.n_planes) * layout.n_gamma;
  if (n > kMaxIntensities)
    throw InputError({in.place(),
                      fmt::format("{} x {} intensities are more than the {} allowed", layout.n_planes,
                                  layout.n_gamma, kMaxIntensities),
                      "resample the file to coarser angles"});
  return layout;
}

LuminousOpening opening_of(double length_m, double width_m, double height_m) {
  LuminousOpening opening;
  opening.width_m = length_m;
  opening.length_m = width_m;
  opening.height_m = height_m;
  if (length_m > 0.0 && width_m == 0.0) {
    opening.length_m = length_m;
    opening.shape = height_m > 0.0 ? OpeningShape::kVerticalCylinder : OpeningShape::kEllipse;
  } else if (length_m > 0.0) {
    opening.shape = height_m > 0.0 ? OpeningShape::kBox : OpeningShape::kRectangle;
  } else if (width_m > 0.0) {
    opening.shape = OpeningShape::kLine;
  }
  return opening;
}

void take_dimensions(Photometry& photometry, FieldLines& in) {
  for (const char* what : {"length of the luminaire", "width of the luminaire", "height of the luminaire"})
    in.number(what, kDimension_mm);
  const double length = in.number("length of the luminous area", kDimension_mm);
  const double width = in.number("width of the luminous area", kDimension_mm);
  double height = 0.0;
  for (const char* plane : {"C0", "C90", "C180", "C270"})
    height =
        std::max(height, in.number(fmt::format("height of the luminous area in {}", plane), kDimension_mm));
  photometry.opening =
      opening_of(length * kMetresPerMillimetre, width * kMetresPerMillimetre, height * kMetresPerMillimetre);
}

LampSet take_lamp_set(FieldLines& in, bool& absolute) {
  LampSet set;
  set.n_lamps = in.count("number of lamps", {-1e6, 1e6});
  absolute = set.n_lamps < 0;
  set.n_lamps = std::max(1, std::abs(set.n_lamps));
  set.type = in.text("type of lamps");
  set.flux_lm = in.number("total luminous flux of lamps", {0, 1e12});
  if (set.flux_lm <= 0.0)
    throw InputError(
        {in.place(), fmt::format("total luminous flux of lamps {} is not above 0", set.flux_lm),
         "EULUMDAT intensities are in cd/klm; absolute photometry gives the luminaire's flux here"});
  set.colour = in.text("colour appearance of lamps");
  set.rendering = in.text("colour rendering of lamps");
  set.watts = in.number("wattage including ballast", {0, 1e9});
  return set;
}

void take_lamps(Photometry& photometry, FieldLines& in, Warnings& warnings) {
  const int n_sets = in.count("number of sets of lamps", {1, 20});
  const Place place = in.place();
  bool absolute = false;
  for (int i = 0; i < n_sets; ++i) {
    bool set_absolute = false;
    photometry.lamp_sets.push_back(take_lamp_set(in, set_absolute));
    if (i == 0) absolute = set_absolute;
  }
  const LampSet& first = photometry.lamp_sets.front();
  photometry.n_lamps = first.n_lamps;
  if (!absolute) {
    photometry.lumens_per_lamp = first.flux_lm / first.n_lamps;
    photometry.declared_lamp_flux_lm = first.flux_lm;
  }
  if (first.watts > 0.0) photometry.watts = first.watts;
  keep(photometry, "LAMP", first.type);
  if (n_sets > 1)
    warnings.push_back({place,
                        fmt::format("{} sets of lamps: the first is used ({} of {:g} lm)", n_sets,
                                    quoted(first.type), first.flux_lm),
                        ""});
}

Symmetry symmetry_of_isym(int isym) {
  switch (isym) {
    case 1:
      return Symmetry::kAxial;
    case 2:
      return Symmetry::kBilateral0_180;
    case 3:
      return Symmetry::kBilateral90_270;
    case 4:
      return Symmetry::kQuadrilateral;
    default:
      return Symmetry::kNone;
  }
}

[[noreturn]] void refuse_planes(const Layout& layout, const char* needs) {
  throw InputError(
      {layout.isym_place,
       fmt::format("Isym {} does not go with the file's C planes: it needs {}", layout.isym, needs), ""});
}

/// The angles of the planes whose intensities the file lists, of all the planes it names.
std::vector<double> listed_planes(const Layout& layout, const std::vector<double>& c_deg) {
  const auto n = c_deg.size();
  const auto is = [&](std::size_t i, double angle) { return std::abs(c_deg[i] - angle) <= kSame_deg; };
  if (layout.isym == 1) return {0.0};
  if (layout.isym == 0) {
    if (n > 1 && !symmetry_of(c_deg)) refuse_planes(layout, "planes round the whole turn");
    return c_deg;
  }
  // Some programs write the plane at 360, which is the one at 0 again.
  const std::size_t round = n > 1 && is(n - 1, 360.0) ? n - 1 : n;
  if (layout.isym == 3) {
    const std::size_t first = 3 * round / 4, last = round / 4;
    if (round % 4 != 0 || !is(0, 0.0) || !is(first, 270.0) || !is(last, 90.0))
      refuse_planes(layout, "planes at C0, C90 and C270, a multiple of 4 of them");
    std::vector<double> listed;
    for (std::size_t i = first; i < round; ++i) listed.push_back(c_deg[i] - 360.0);
    for (std::size_t i = 0; i <= last; ++i) listed.push_back(c_deg[i]);
    listed.front() = -90.0;
    listed.back() = 90.0;
    return listed;
  }
  const double end = layout.isym == 2 ? 180.0 : 90.0;
  const std::size_t last = layout.isym == 2 ? round / 2 : round / 4;
  if (last >= n || last == 0 || !is(0, 0.0) || !is(last, end))
    refuse_planes(layout, layout.isym == 2 ? "planes at C0 and C180, as many after as before"
                                           : "planes at C0 and C90, a multiple of 4 of them");
  std::vector<double> listed(c_deg.begin(), c_deg.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  listed.front() = 0.0;
  listed.back() = end;
  return listed;
}

void refuse_unsorted(const std::vector<double>& angles, const char* what, const Place& last) {
  for (std::size_t i = 1; i < angles.size(); ++i)
    if (angles[i] <= angles[i - 1]) {
      const Place place = {last.file, last.line - static_cast<int>(angles.size() - 1 - i), 1};
      throw InputError({place,
                        fmt::format("{} {} of {}: {} follows {}, but they must ascend", what, i + 1,
                                    angles.size(), angles[i], angles[i - 1]),
                        ""});
    }
}

/// Says what follows the intensities that Isym asks for: of further planes, most likely.
void warn_of_rest(const Layout& layout, std::size_t n_listed, FieldLines& in, Warnings& warnings) {
  const Place last = in.place();
  const std::size_t n = in.count_numbers_left();
  if (n == 0) return;
  const auto n_gamma = static_cast<std::size_t>(layout.n_gamma);
  const std::string planes =
      n % n_gamma == 0 ? fmt::format(" ({} more {})", n / n_gamma, n == n_gamma ? "plane" : "planes") : "";
  warnings.push_back(
      {{last.file, last.line + 1, 0},
       fmt::format("{} more {} after the intensities of the {} {} that Isym {} lists: ignored", n,
                   n == 1 ? "number" : "numbers", n_listed, n_listed == 1 ? "plane" : "planes", layout.isym) +
           planes,
       "where the planes differ, Isym (line 3) is wrong: 0 lists them all"});
}

void take_intensities(Photometry& photometry, const Layout& layout, FieldLines& in, Warnings& warnings) {
  const auto n_gamma = static_cast<std::size_t>(layout.n_gamma);
  const auto c_deg = in.list("C plane", static_cast<std::size_t>(layout.n_planes), {-360, 360});
  // With rotational symmetry the planes are often left at 0.
  if (layout.isym != 1) refuse_unsorted(c_deg, "C plane", in.place());
  auto gamma_deg = in.list("angle gamma", n_gamma, {0, 180});
  refuse_unsorted(gamma_deg, "angle gamma", in.place());
  const Place gamma_place = in.place();
  std::vector<double> planes_deg = listed_planes(layout, c_deg);
  auto candelas = in.list("intensity", planes_deg.size() * n_gamma, {0, kMaxIntensity_cd});
  const Place last_place = in.place();
  warn_of_rest(layout, planes_deg.size(), in, warnings);
  const double factor = photometry.lamp_sets.front().flux_lm / 1000.0 * photometry.multiplier;
  const double highest = *std::max_element(candelas.begin(), candelas.end());
  if (highest * factor > kMaxIntensity_cd)
    throw InputError(
        {last_place,
         fmt::format("intensity {} cd/klm x {} is {}", highest, factor, outside({0, kMaxIntensity_cd})), ""});
  for (double& cd : candelas) cd *= factor;
  carry_on_to_hemispheres(gamma_deg, candelas, gamma_place, warnings);
  photometry.symmetry = planes_deg.size() == 1 ? Symmetry::kAxial : symmetry_of_isym(layout.isym);
  photometry.distribution = expand(photometry.symmetry, planes_deg, gamma_deg, candelas);
}

void warn_of_flux(const Photometry& photometry, const std::string& file_name, Warnings& warnings) {
  const double flux = photometry.flux_lm;
  if (flux <= 0.0) warnings.push_back({{file_name, 0, 0}, "the luminaire emits no light", ""});
  if (const auto declared = photometry.declared_flux_lm; declared && std::abs(flux / *declared - 1.0) > 0.02)
    warnings.push_back(
        {{file_name, 0, 0},
         fmt::format(
             "intensity integrates to {:.6g} lm but the file declares {:.6g} lm (light output ratio x "
             "lamps, {:+.1f} %)",
             flux, *declared, 100.0 * (flux / *declared - 1.0)),
         fmt::format("using {:.6g} lm", flux)});
}

}  // namespace

Photometry read_eulumdat(std::string_view bytes, const std::string& file_name, Warnings& warnings) {
  TextScanner scanner(photometric_text(bytes, file_name), file_name);
  FieldLines in(scanner);
  Photometry photometry;
  photometry.format_year = 0;
  photometry.format = "EULUMDAT";
  const Layout layout = take_layout(photometry, in);
  keep(photometry, "TEST", in.text("measurement report number"));
  keep(photometry, "LUMINAIRE", in.text("luminaire name"));
  keep(photometry, "LUMCAT", in.text("luminaire number"));
  keep(photometry, "_FILENAME", in.text("file name"));
  keep(photometry, "ISSUEDATE", in.text("date and user"));
  take_dimensions(photometry, in);
  in.number("downward flux fraction", {0, 1000});
  const double output_ratio = in.number("light output ratio", {0, 1e6}) / 100.0;
  const double conversion = in.number("conversion factor for intensities", {0, 1e12});
  photometry.multiplier = conversion > 0.0 ? conversion : 1.0;
  const double tilt_deg = in.number("tilt during measurement", kMoreThanAny);
  if (tilt_deg != 0.0)
    warnings.push_back(
        {in.place(),
         fmt::format("measured tilted by {:g} degrees: gamma 0 is the luminaire's own axis", tilt_deg), ""});
  take_lamps(photometry, in, warnings);
  for (int i = 0; i < kUtilisationFactors; ++i) in.number("direct ratio", kMoreThanAny);
  take_intensities(photometry, layout, in, warnings);

  const IntensityTable table(photometry.distribution);
  photometry.flux_lm = table.flux_lm();
  photometry.max_cd = table.max_cd();
  if (output_ratio > 0.0) photometry.declared_flux_lm = output_ratio * photometry.lamp_sets.front().flux_lm;
  warn_of_flux(photometry, file_name, warnings);
  return photometry;
}

}  // namespace dim
