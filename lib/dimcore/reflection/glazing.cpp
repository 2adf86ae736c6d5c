#include "reflection/glazing.hpp"

#include <algorithm>
#include <cmath>

#include "reflection/fresnel.hpp"

namespace dim {
namespace {

double of_face(double ior) {
  const double root = (ior - 1.0) / (ior + 1.0);
  return root * root;
}

// Share that survives one way, of a pane that passes `tau` with faces that reflect r: the positive root of
// tau r^2 a^2 + (1-r)^2 a - tau = 0.
double survival(double tau, double r) {
  const double b = (1.0 - r) * (1.0 - r);
  return 2.0 * tau / (b + std::sqrt(b * b + 4.0 * tau * tau * r * r));
}

struct PaneLight {
  double transmitted, reflected;
};
PaneLight of_polarisation(double r, double a) {
  const double tau = (1.0 - r) * (1.0 - r) * a / std::max(1.0 - r * r * a * a, 1e-300);
  return {r < 1.0 ? tau : 0.0, r < 1.0 ? r * (1.0 + tau * a) : 1.0};
}

PaneLight mean_light(double cos_incidence, double ior, double a) {
  const auto face = fresnel_polarised(cos_incidence, ior);
  const PaneLight s = of_polarisation(face.s, a), p = of_polarisation(face.p, a);
  return {(s.transmitted + p.transmitted) / 2.0, (s.reflected + p.reflected) / 2.0};
}

double interpolated(const std::vector<std::pair<double, double>>& table, double x) {
  const auto after = std::find_if(table.begin(), table.end(), [&](const auto& point) { return point.first >= x; });
  if (after == table.begin()) return table.front().second;
  if (after == table.end()) return table.back().second;
  const auto& [x0, y0] = *std::prev(after);
  return y0 + (after->second - y0) * (x - x0) / (after->first - x0);
}

}  // namespace

Slab::Slab(double ior, double normal_transmittance) : ior_(ior) {
  const double r = of_face(ior), most = (1.0 - r) / (1.0 + r);
  if (normal_transmittance > most) {
    const double root = std::sqrt((1.0 - normal_transmittance) / (1.0 + normal_transmittance));
    ior_ = (1.0 + root) / (1.0 - root);
    inside_ = 1.0;
    return;
  }
  inside_ = survival(normal_transmittance, r);
}

double Slab::survives(double cos_incidence) const {
  if (inside_ == 0.0 || inside_ == 1.0) return inside_;
  const double sine2 = (1.0 - cos_incidence * cos_incidence) / (ior_ * ior_);
  return std::pow(inside_, 1.0 / std::sqrt(std::max(1.0 - sine2, 1e-300)));
}

double Slab::transmittance(double cos_incidence) const {
  return mean_light(cos_incidence, ior_, survives(cos_incidence)).transmitted;
}

double Slab::reflectance(double cos_incidence) const {
  return mean_light(cos_incidence, ior_, survives(cos_incidence)).reflected;
}

double Slab::hemispherical_reflectance() const {
  constexpr int kSteps = 2048;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) sum += reflectance(std::sqrt((i + 0.5) / kSteps));
  return sum / kSteps;
}

Transmission::Transmission(const Finish& finish, double normal_transmittance) {
  if (finish.angular_law == "bsdf") return;
  const double straight = finish.angular_law == "diffusing" ? finish.direct * normal_transmittance : normal_transmittance;
  const Slab slab(finish.ior.mean(380.0, 780.0), straight);
  for (int i = 0; i <= kSteps; ++i) {
    const double c = static_cast<double>(i) / kSteps;
    double& value = values_[static_cast<std::size_t>(i)];
    if (finish.angular_law == "constant")
      value = straight;
    else if (finish.angular_law == "table")
      value = straight * interpolated(finish.by_angle, degrees(std::acos(std::min(1.0, c))));
    else
      value = slab.transmittance(c);
  }
}

SpectralCurve own_reflectance(const Finish& finish) {
  if (finish.angular_law != "glass" && finish.angular_law != "table") return SpectralCurve(0.0);
  std::vector<std::pair<double, double>> points;
  for (const auto& [nm, tau] : finish.transmittance.points())
    points.emplace_back(nm, std::min(Slab(finish.ior.at(nm), tau).hemispherical_reflectance(), 1.0 - tau));
  return SpectralCurve(std::move(points));
}

}  // namespace dim
