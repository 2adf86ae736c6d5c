#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "image/light_field.hpp"
#include "reflection/specular.hpp"
#include "light/direct_light.hpp"

namespace dim {

enum class Shading {
  cell,    ///< flat cells
  smooth,  ///< interpolated within a surface, never across its edge
  gather   ///< direct light point by point, inter-reflected light interpolated
};

/// What an eye sees along a ray: diffuse reflection from the cells (or direct light point by point), lobes
/// from the light by direction and the exact direct light, mirrors by going on to what they show, luminous
/// openings.
class Shader {
 public:
  /// @param n_samples  times that `seen` is asked for in each pixel: shadows and highlights are sampled
  /// accordingly
  Shader(const LuminanceDatabase& database, const Cells& cells, const Mix& mix, Shading shading,
         int n_samples);

  const LightChannels& channels() const { return channels_; }

  struct Seen {
    bool anything = false;
    bool surface = false;         ///< the ray met a surface first, lit or not; else an opening or nothing
    double illuminance_lx = 0.0;  ///< of the point met first
  };
  /// Adds the radiance along a ray to `light`. @param chance  differs from ray to ray
  Seen seen(const Vec3& eye, const Vec3& direction, std::uint64_t chance, Light& light) const;

 private:
  struct Opening {
    const ShownLuminaire* luminaire;
    Polygon polygon;
  };
  void make_lamps(const Mix& mix);
  void add_opening(std::size_t index, const Vec3& direction, const Light& tint, Light& light) const;
  void add_surface(std::size_t surface, const Vec2& local, const Vec3& direction, std::uint64_t chance,
                   const Light& tint, Light& light, double& illuminance_lx) const;
  void add_direct(std::size_t surface, const Vec2& local, std::uint64_t chance, const Vec3* towards,
                  Light& irradiance, Light& lobe) const;

  const LuminanceDatabase& database_;
  const Zone& zone_;
  Shading shading_;
  int n_samples_;
  LightChannels channels_;
  LightField field_;
  std::vector<Opening> openings_;
  std::vector<std::vector<BandReflection>> reflection_;  // [finish][band]
  std::vector<std::unique_ptr<Facets>> facets_;          // [finish], of off-specular ones
  std::vector<bool> mirror_;                             // [finish]
  Lights lights_;
  std::vector<LightSource> sources_;
  std::vector<PairIntegrator> integrators_;
  std::vector<double> factor_;         // [n_lights] in the mix
  std::unique_ptr<RayCaster> caster_;  // surfaces, openings, bodies
  std::unique_ptr<Obstructions> obstructions_;
};

}  // namespace dim
