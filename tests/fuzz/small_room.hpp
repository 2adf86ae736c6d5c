#pragma once

#include <string>

#include "property/transport_support.hpp"

namespace dim {

/// A room with a panel in it, a plane and a lamp: small, so that a fuzzer reads thousands of them a second.
inline Zone small_room() {
  Zone zone = test::box_zone({4, 3, 2.5}, 0.5, 1.0);
  test::add_box(zone, "desk.", {-1, -0.5, -0.6}, {0.5, 0.5, -0.5}, 0, 1.0, true);
  zone.closed = true;
  zone.volume_m3 = 30.0;
  for (int i = 0; i < 3; ++i) zone.points.push_back({{0.3 * i, 0.2, -0.4}, {0, 0, 1}});
  zone.point_sets.push_back({"points", 0, 3, {}});
  zone.views.push_back({"view", {-1.5, -1, 0}, {1, 1, 0}, {0, 0, 1}, 1.2, 16, 12});
  return zone;
}

inline Lights small_lights() {
  Lights lights;
  test::add_lamp(lights, "panel", {0, 0, 1.2}, IntensityTable::lambertian(300.0),
                 {.opening = test::rectangle(0.6, 0.6)});
  return lights;
}

inline Network small_network(const Zone& zone, const Cells& cells) {
  NetworkOptions options;
  options.patches = options.point_patches = {4, 8};
  return build_network(zone, cells, options, Job{});
}

/// Where a target's file lies: in memory where there is such a place.
inline std::string scratch_file(const std::string& name) {
  const bool memory = ::access("/dev/shm", W_OK) == 0;
  return std::string(memory ? "/dev/shm/" : "/tmp/") + "dim-fuzz-" + std::to_string(::getpid()) + "-" + name;
}

}  // namespace dim
