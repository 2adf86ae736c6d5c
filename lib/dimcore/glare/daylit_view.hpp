#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "geometry/ray_caster.hpp"
#include "glare/daylight_glare.hpp"
#include "light/outside_light.hpp"
#include "reflection/glazing.hpp"
#include "result/luminous.hpp"

namespace dim {

/// The light of day as an eye in a room sees it: surfaces with the luminance of their cells, the sky and the ground
/// through glazings, each patch of the sky even but for its ramp (with the sun's light, which the mix spreads over the
/// patches around it). External obstructions are black. Luminaires have no part in it.
class DaylitView {
 public:
  /// @param mix  of daylight coefficients, as sky_mix has it
  /// @throws InputError  no daylight coefficients; a window in a state that scatters light, whose own luminance is not
  ///                     known
  DaylitView(const LuminanceDatabase& database, const Mix& mix);

  /// Sets the luminances of what an eye sees. @param eye  zone-centred
  void look(const Vec3& eye, std::span<SeenPixel> pixels) const;

 private:
  // A group of windows as the mix has it.
  struct Outside {
    std::vector<double> column_cd_m2;  // of the patches' columns, ramps too
    std::string state;
    bool as_it_stands = true;
    std::vector<double> class_share;  // [n_classes] of the light's Y
  };
  // Of a window, by reflectance class.
  struct Pane {
    const Outside* outside = nullptr;
    std::vector<Transmission> transmission;
  };

  void find_outside(const Mix& mix);
  void find_panes();
  double luminance_cd_m2(const Vec3& eye, const Vec3& direction) const;
  double through(std::size_t surface, const Vec3& at, const Vec3& direction) const;

  const LuminanceDatabase& database_;
  OutsideLight outside_light_;  // by patches
  std::map<std::string, Outside> outside_;  // by group
  std::vector<Pane> panes_;                 // [n_surfaces]
  std::vector<float> cell_cd_m2_;
  RayCaster caster_;
};

}  // namespace dim
