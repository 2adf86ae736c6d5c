#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "photometry/file_planes.hpp"
#include "photometry/photometry_writer.hpp"

namespace dim {
namespace {

constexpr double kResampled_deg = 2.5;

std::string number(double value) { return fmt::format("{:.10g}", value == 0.0 ? 0.0 : value); }

void append(std::string& text, const std::string& field) { text += field + "\r\n"; }

/// The number that all steps of a list are, or 0.
double step_of(const std::vector<double>& angles) {
  if (angles.size() < 2) return 0.0;
  const double step = angles[1] - angles[0];
  for (std::size_t i = 2; i < angles.size(); ++i)
    if (std::abs(angles[i] - angles[i - 1] - step) > 1e-6) return 0.0;
  return step;
}

IntensityDistribution resampled(const IntensityDistribution& distribution) {
  const IntensityTable table(distribution);
  IntensityDistribution c_gamma;
  const int n_c = static_cast<int>(std::lround(360.0 / kResampled_deg)), n_gamma = n_c / 2;
  // Light that ends at 90 degrees must not be drawn out to the next angle.
  const int last = table.zero_behind() ? n_gamma / 2 : n_gamma;
  for (int c = 0; c <= n_c; ++c) c_gamma.c_rad.push_back(2.0 * kPi * c / n_c);
  for (int g = 0; g <= last; ++g) c_gamma.gamma_rad.push_back(kPi * g / n_gamma);
  for (const double c : c_gamma.c_rad)
    for (const double gamma : c_gamma.gamma_rad) c_gamma.intensity_cd.push_back(table.at_c_gamma(c, gamma));
  return c_gamma;
}

/// The planes of the whole turn, which EULUMDAT names whatever it lists, without the closing one at 360.
std::vector<double> all_planes(const IntensityDistribution& distribution, int isym) {
  if (isym == 1) return {0.0};
  auto planes = file_planes(distribution, Symmetry::kNone).horizontal_deg;
  planes.pop_back();
  return planes;
}

/// Isym, or 0 (every plane) where the planes are not laid out as the symmetry's own count needs them.
int isym_of(Symmetry symmetry, const IntensityDistribution& distribution) {
  const std::size_t n = distribution.c_rad.size() - 1;
  const auto at = [&](std::size_t i, double angle_deg) {
    return std::abs(degrees(distribution.c_rad[i]) - angle_deg) < 1e-6;
  };
  switch (symmetry) {
    case Symmetry::kAxial:
      return 1;
    case Symmetry::kBilateral0_180:
      return n % 2 == 0 && at(n / 2, 180) ? 2 : 0;
    case Symmetry::kBilateral90_270:
      return n % 4 == 0 && at(n / 4, 90) && at(3 * n / 4, 270) ? 3 : 0;
    case Symmetry::kQuadrilateral:
      return n % 4 == 0 && at(n / 4, 90) ? 4 : 0;
    default:
      return 0;
  }
}

/// Which of the distribution's planes are listed, in the file's order.
std::vector<std::size_t> listed_planes(int isym, std::size_t n) {
  std::vector<std::size_t> listed;
  if (isym == 1) return {0};
  if (isym == 3)
    for (std::size_t i = 3 * n / 4; i < n; ++i) listed.push_back(i);
  const std::size_t last = isym == 0 ? n - 1 : isym == 2 ? n / 2 : n / 4;
  for (std::size_t i = 0; i <= last; ++i) listed.push_back(i);
  return listed;
}

struct Area {
  double length_mm, width_mm, height_mm;
};

Area luminous_area(const LuminousOpening& opening, Warnings& warnings) {
  const auto mm = [](double metres) { return metres * 1e3; };
  const bool has_sides =
      opening.shape == OpeningShape::kBox || opening.shape == OpeningShape::kVerticalCylinder;
  Area area = {mm(opening.width_m), mm(opening.length_m), has_sides ? mm(opening.height_m) : 0.0};
  const bool disc =
      opening.shape == OpeningShape::kEllipse || opening.shape == OpeningShape::kVerticalCylinder;
  if (disc && std::abs(opening.width_m - opening.length_m) <= 1e-6)
    area.width_mm = 0.0;
  else if (disc || opening.shape == OpeningShape::kEllipsoid ||
           opening.shape == OpeningShape::kVerticalEllipse ||
           opening.shape == OpeningShape::kHorizontalCylinder)
    warnings.push_back(
        {{}, "EULUMDAT cannot state this luminous opening: written as the rectangle round it", ""});
  // A length without a width would be a disc.
  if (opening.shape == OpeningShape::kLine && area.width_mm == 0.0) area.width_mm = 1.0;
  return area;
}

double downward_share(const IntensityDistribution& distribution) {
  IntensityDistribution lower = distribution;
  const auto& gamma = lower.gamma_rad;
  if (gamma.back() <= kPi / 2 + 1e-9) return 1.0;
  if (gamma.front() >= kPi / 2 - 1e-9) return 0.0;
  // The table is cut at 90 degrees, with what it gives there.
  const IntensityTable whole(distribution);
  std::vector<double> kept;
  for (const double g : gamma)
    if (g < kPi / 2 - 1e-9) kept.push_back(g);
  kept.push_back(kPi / 2);
  lower.intensity_cd.clear();
  for (const double c : lower.c_rad)
    for (const double g : kept) lower.intensity_cd.push_back(whole.at_c_gamma(c, g));
  lower.gamma_rad = kept;
  return whole.flux_lm() > 0.0 ? IntensityTable(lower).flux_lm() / whole.flux_lm() : 0.0;
}

void append_lamps(std::string& text, const Photometry& photometry, double set_flux_lm, bool relative) {
  LampSet set;
  if (!photometry.lamp_sets.empty()) set = photometry.lamp_sets.front();
  if (set.type.empty()) set.type = photometry.keyword("LAMP");
  append(text, "1");
  append(text, fmt::format("{}", relative ? photometry.n_lamps : -photometry.n_lamps));
  append(text, set.type);
  append(text, number(set_flux_lm));
  append(text, set.colour);
  append(text, set.rendering);
  append(text, number(photometry.watts.value_or(set.watts)));
}

}  // namespace

std::string eulumdat_text(const Photometry& photometry, Warnings& warnings) {
  if (!(photometry.flux_lm > 0.0))
    throw InputError({{},
                      "a luminaire that emits no light cannot be written as EULUMDAT",
                      "its intensities are relative to its flux; write IES in place of it"});
  const bool type_c = photometry.distribution.type == PhotometricType::kC;
  const IntensityDistribution distribution =
      type_c ? photometry.distribution : resampled(photometry.distribution);
  const Symmetry symmetry = type_c ? photometry.symmetry : Symmetry::kNone;
  if (!type_c)
    warnings.push_back(
        {{}, fmt::format("resampled from type A or B to C-gamma every {} degrees", kResampled_deg), ""});
  if (photometry.tilt) warnings.push_back({{}, "EULUMDAT has no lamp tilt factors: left out", ""});

  const bool relative = photometry.lumens_per_lamp.has_value() && photometry.n_lamps > 0;
  const double set_flux_lm = relative ? photometry.n_lamps * *photometry.lumens_per_lamp : photometry.flux_lm;
  const int isym = isym_of(symmetry, distribution);
  const auto planes_deg = all_planes(distribution, isym);
  std::vector<double> gamma_deg = file_planes(distribution, Symmetry::kAxial).vertical_deg;

  std::string text;
  append(text, photometry.keyword("MANUFAC"));
  append(text, isym == 1 ? "1" : "3");
  append(text, fmt::format("{}", isym));
  append(text, fmt::format("{}", planes_deg.size()));
  append(text, number(step_of(planes_deg)));
  append(text, fmt::format("{}", gamma_deg.size()));
  append(text, number(step_of(gamma_deg)));
  for (const char* keyword : {"TEST", "LUMINAIRE", "LUMCAT", "_FILENAME", "ISSUEDATE"})
    append(text, photometry.keyword(keyword));
  const Area area = luminous_area(photometry.opening, warnings);
  // The size of the luminaire itself is not known: that of its opening.
  for (int i = 0; i < 2; ++i) {
    append(text, number(area.length_mm));
    append(text, number(area.width_mm));
    append(text, number(area.height_mm));
  }
  for (int i = 0; i < 3; ++i) append(text, number(area.height_mm));
  append(text, number(100.0 * downward_share(distribution)));
  append(text, number(100.0 * photometry.flux_lm / set_flux_lm));
  append(text, "1");
  append(text, "0");
  append_lamps(text, photometry, set_flux_lm, relative);
  for (int i = 0; i < 10; ++i) append(text, "0");
  for (const double c : planes_deg) append(text, number(c));
  for (const double gamma : gamma_deg) append(text, number(gamma));
  const std::size_t n_gamma = gamma_deg.size();
  for (const std::size_t plane : listed_planes(isym, distribution.c_rad.size() - 1))
    for (std::size_t g = 0; g < n_gamma; ++g)
      append(text, number(distribution.intensity_cd[plane * n_gamma + g] * 1000.0 / set_flux_lm));
  return text;
}

}  // namespace dim
