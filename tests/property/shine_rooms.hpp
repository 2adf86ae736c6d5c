#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "property/transport_support.hpp"
#include "transport/gather.hpp"
#include "transport/gather_kernel.hpp"

/// Rooms with lobes and mirrors, and the parts of their solution one by one.
namespace dim::test {

enum RoomFace { kFloor, kCeiling, kY0, kY1, kX0, kX1 };

/// A box centred on the origin whose faces have a grey finish each.
inline Zone shiny_room(double reflectance, double cell_m, const Vec3& size_m = {4, 3, 2.5}) {
  Zone zone = box_zone(size_m, reflectance, cell_m);
  for (int face = 0; face < 6; ++face) zone.surfaces[std::size_t(face)].finish = add_grey(zone, reflectance);
  return zone;
}

inline Finish& finish_of(Zone& zone, int face) {
  return zone.finishes[static_cast<std::size_t>(zone.surfaces[static_cast<std::size_t>(face)].finish)];
}

/// k_s 1, or less over a diffuse part.
inline Finish& make_mirror(Zone& zone, int face, double specular = 1.0, double diffuse = 0.0) {
  Finish& finish = finish_of(zone, face);
  finish.specular = specular;
  finish.diffuse = SpectralCurve(diffuse);
  finish.roughness = 0.0;
  return finish;
}

inline Finish& make_mirror_of(Zone& zone, int face, double reflectance) {
  Finish& finish = make_mirror(zone, face);
  finish.specular_reflectance = SpectralCurve(reflectance);
  return finish;
}

inline Finish& make_glossy(Zone& zone, int face, double specular, double roughness, double ior,
                           double diffuse = 0.3) {
  Finish& finish = finish_of(zone, face);
  finish.specular = specular;
  finish.diffuse = SpectralCurve(diffuse);
  finish.roughness = roughness;
  finish.ior = SpectralCurve(ior);
  return finish;
}

/// Everything that a zone's shine is made of, and light of one's own choice on it.
struct ShineProblem {
  Zone zone;
  Cells cells;
  Network network;
  ReflectanceClasses classes;
  RayCaster caster;
  Shine shine;
  Reflectances reflectances;
  DirectShine direct;

  /// @param n_sources  columns in each class
  ShineProblem(const Zone& zone_in, const NetworkOptions& options, std::size_t n_sources = 1, int n_bands = 1)
      : zone(zone_in),
        cells(zone),
        network(build_network(zone, cells, options, Job{})),
        classes(classify(zone, Bands::uniform(n_bands))),
        caster(plates_of(zone), zone.diameter_m),
        shine(zone, cells, network, classes, caster, MirrorRayOptions{}, Job{}) {
    reflectances.n_classes = classes.size();
    reflectances.of_surface.resize(zone.surfaces.size() * classes.size());
    for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
      for (std::size_t q = 0; q < classes.size(); ++q)
        reflectances.of_surface[s * classes.size() + q] = classes.at(q, zone.surfaces[s].finish).diffuse;
    }
    for (std::size_t c = 0; c < n_sources * classes.size(); ++c)
      reflectances.class_of_column.push_back(c / n_sources);
    direct.psi.assign(shine.n_states() * n_columns(), 0.0F);
    direct.point_lobe.assign(zone.points.size() * n_columns(), 0.0);
  }

  std::size_t n_columns() const { return reflectances.n_columns(); }
  GatherShine gather_shine() const { return {shine, zone, direct}; }

  ShineState state(std::size_t width) const {
    return {shine,       zone, network,     cells, direct, reflectances.class_of_column,
            n_columns(), 0,    n_columns(), width};
  }

  /// What arrives on every cell, the network's own rows and light by direction, of given exitances.
  /// @param exitance  [n_cells + 1, width], column scales included
  std::vector<double> arriving(const ShineState& state, const std::vector<double>& exitance,
                               std::size_t width) const {
    std::vector<double> sums(cells.size() * width);
    gather_rows(network.sinks, network.patches, network.has_family() ? &network.extra : nullptr,
                exitance.data(), width, 0, cells.size(), sums.data());
    state.add_to_cells(exitance, sums);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      for (std::size_t c = 0; c < width; ++c) sums[i * width + c] *= network.row_scale[i];
    }
    return sums;
  }
};

inline NetworkOptions network_options(const PatchGrid& patches, bool family = false) {
  NetworkOptions options;
  options.patches = options.point_patches = patches;
  options.family = family;
  return options;
}

/// Random numbers 0..1, by seed.
inline std::vector<double> random_values(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<double> values(n);
  for (double& value : values) value = static_cast<double>(random()) / 4294967296.0;
  return values;
}

}  // namespace dim::test
