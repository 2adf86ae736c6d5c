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
  Zone zone = read(zone_text);
  const PatchGrid patches = NetworkOptions{}.patches;
  return daylit(std::move(zone), sky, patches);
}

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
