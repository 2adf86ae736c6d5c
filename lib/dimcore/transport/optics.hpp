#pragma once

#include <vector>

#include "hemisphere/patches.hpp"
#include "reflection/specular.hpp"
#include "scene/zone.hpp"
#include "spectrum/bands.hpp"

namespace dim {

/// How much of the reflection model a finish needs; found, not asked for. physics.md section 6.
enum class Shininess {
  diffusing,     ///< nothing specular
  off_specular,  ///< a lobe over several patches
  mirror         ///< a lobe narrower than a patch
};

/// Bands in which every finish reflects alike share one solution.
struct ReflectanceClasses {
  std::vector<std::size_t> of_band;                    ///< [n_bands]
  std::vector<std::vector<BandReflection>> of_finish;  ///< [n_classes][n_finishes]
  /// Means over the band are weighted with what the eye makes of the lamps' light, and so hold for these
  /// lamps only; else they are plain.
  bool luminous = false;
  std::size_t size() const { return of_finish.size(); }
  const BandReflection& at(std::size_t klass, int finish) const {
    return of_finish[klass][static_cast<std::size_t>(finish)];
  }
};
/// @param apart     every band a class of its own, alike or not
/// @param luminous  weights of a single band's means (luminous_weights); null for plain means
ReflectanceClasses classify(const Zone& zone, const Bands& bands, bool apart = false,
                            const LatticeValues* luminous = nullptr);

/// Most patches of a lobe grid.
inline constexpr std::size_t kMostLobePatches = 1280;

/// The grid on which off-specular cells keep their light by direction: that of the network, coarsened by
/// halves (odd numbers rounded up) to at most kMostLobePatches.
PatchGrid lobe_grid(const PatchGrid& network);

/// How every surface shines. @param grid  of `lobe_grid`
std::vector<Shininess> shininess_of_surfaces(const Zone& zone, const ReflectanceClasses& classes,
                                             const PatchGrid& grid);

}  // namespace dim
