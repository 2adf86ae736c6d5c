#pragma once

#include <array>
#include <string>

#include "property/transport_support.hpp"
#include "validation/daylight_support.hpp"

/// Rooms of CIE 171:2006 and how they are solved when nothing is asked for.
namespace dim::test {

/// Empty room centred on the origin, with the programs' own cell size for it.
inline Zone cie171_room(const Vec3& size_m, double reflectance) {
  Zone zone = box_zone(size_m, reflectance, std::min(0.25, glm::length(size_m) / 20.0));
  zone.closed = true;
  return zone;
}

inline Solution solve_at_defaults(const Zone& zone, const Lights& lights) {
  NetworkOptions options;
  options.point_patches = automatic_point_patches(zone.points.size());
  return solve(zone, lights, build_network(zone, Cells(zone), options, Job{}));
}

inline DaylitRoom under_sky(const std::string& zone_text, const std::string& sky) {
  return daylit(zone_text, sky, NetworkOptions{}.patches);
}

/// What a pane of one index, 1.52, lets through at an angle when it passes a given share at normal incidence: light
/// to and fro in the slab summed up, half of it polarised either way.
class ClearPane {
 public:
  explicit ClearPane(double at_normal) {
    double low = 0.0, high = 1.0;
    for (int k = 0; k < 60; ++k) {
      inside_ = (low + high) / 2.0;
      ((*this)(1.0) < at_normal ? low : high) = inside_;
    }
  }

  /// @param cosine  of the angle of incidence, above 0
  double operator()(double cosine) const {
    const double refracted = std::sqrt(1.0 - (1.0 - cosine * cosine) / (1.52 * 1.52));
    const double across = std::pow((cosine - 1.52 * refracted) / (cosine + 1.52 * refracted), 2);
    const double along = std::pow((1.52 * cosine - refracted) / (1.52 * cosine + refracted), 2);
    const double kept = std::pow(inside_, 1.0 / refracted);
    return (passed(across, kept) + passed(along, kept)) / 2.0;
  }

 private:
  static double passed(double reflected, double kept) {
    return std::pow(1.0 - reflected, 2) * kept / (1.0 - std::pow(reflected * kept, 2));
  }
  double inside_ = 0.5;
};

/// The room of 5.4, 5.9 and 5.10: black, 4 x 4 x 3 m from the origin, a square opening in the middle of its roof.
/// An opening of 4 m takes the whole roof.
/// @param more  further text of the zone file
inline std::string roof_room(double edge_m, const std::string& finish, const std::string& more) {
  const auto point = [](double x, double y, double z) {
    return "[" + std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(z) + "]";
  };
  const double lo = 2.0 - edge_m / 2.0, hi = 2.0 + edge_m / 2.0;
  const std::string ring =
      point(lo, lo, 3) + "," + point(lo, hi, 3) + "," + point(hi, hi, 3) + "," + point(hi, lo, 3);
  const std::string whole = point(0, 0, 3) + "," + point(0, 4, 3) + "," + point(4, 4, 3) + "," + point(4, 0, 3);
  std::string text =
      "dim = \"zone/1\"\n[finishes]\nblack = 0.0\nhole = { kind = \"glazing\", transmittance = 1.0, angular_law = "
      "\"constant\" }\npane = { kind = \"glazing\", transmittance = 0.88, ior = 1.52, reflectance = 0 }\n"
      "[[surface]]\nname = \"s\"\nfinish = \"black\"\nvertices = [[0,0,0],[0,0,3],[4,0,3],[4,0,0]]\n"
      "[[surface]]\nname = \"n\"\nfinish = \"black\"\nvertices = [[0,4,0],[4,4,0],[4,4,3],[0,4,3]]\n"
      "[[surface]]\nname = \"w\"\nfinish = \"black\"\nvertices = [[0,0,0],[0,4,0],[0,4,3],[0,0,3]]\n"
      "[[surface]]\nname = \"e\"\nfinish = \"black\"\nvertices = [[4,4,0],[4,0,0],[4,0,3],[4,4,3]]\n"
      "[[surface]]\nname = \"f\"\nfinish = \"black\"\nvertices = [[0,0,0],[4,0,0],[4,4,0],[0,4,0]]\n";
  if (edge_m < 4.0)
    text += "[[surface]]\nname = \"roof\"\nfinish = \"black\"\nvertices = [" + whole + "]\n[[surface]]\nname = \"o\"\non = \"roof\"\nfinish = \"" +
            finish + "\"\nvertices = [" + ring + "]\n";
  else
    text += "[[surface]]\nname = \"o\"\nfinish = \"" + finish + "\"\nvertices = [" + whole + "]\n";
  return text + more;
}

}  // namespace dim::test
