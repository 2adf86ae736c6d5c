#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "image/place_light.hpp"

namespace dim {

/// What an eye sees along a ray: diffuse reflection from the cells (or direct light point by point), lobes
/// from the light by direction and the exact direct light, mirrors by going on to what they show, luminous
/// openings.
class Shader {
 public:
  Shader(const LuminanceDatabase& database, const Cells& cells, const Mix& mix, Shading shading);

  const LightChannels& channels() const { return channels_; }

  /// What a ray meets first.
  Hit first(const Vec3& eye, const Vec3& direction) const { return caster_->nearest(eye, direction); }

  /// What a ray that met something is: the lit face of a surface that looks alike from everywhere is shaded as
  /// a place (`shade`), with others of its surface; everything else by `seen`.
  enum class Kind { place, glossy, mirror, other };
  Kind kind(const Hit& hit) const;

  /// Whether a convex part of a surface is shaded alike wherever it is looked at.
  bool in_one_cell(std::size_t surface, const std::array<Vec2, 4>& corners) const;

  /// Whether direct light is wanted at a place.
  bool wants_direct(std::size_t surface, const Vec2& local) const {
    return field_.open_share(surface, local) > 0.0;
  }
  const PlaceLight& place_light() const { return *place_light_; }

  /// Adds the radiance of a place to `light`; returns its illuminance, lx.
  /// @param lamp_lx  [n_lamps] of `PlaceLight`, or null where no direct light is wanted
  double shade(std::size_t surface, const Vec2& local, const double* lamp_lx, Light& light) const;

  struct Seen {
    bool anything = false;
    bool surface = false;         ///< the ray met a surface first, lit or not; else an opening or nothing
    double illuminance_lx = 0.0;  ///< of the point met first
  };
  /// Adds the radiance along a ray to `light`.
  /// @param hit     of `first`
  /// @param weight  of the ray in its pixel: shadows and highlights are sampled accordingly
  /// @param chance  differs from ray to ray
  Seen seen(const Vec3& eye, const Vec3& direction, const Hit& hit, double weight, std::uint64_t chance,
            Light& light) const;

  /// Polygons whose edges can be seen: surfaces, openings, bodies.
  const std::vector<const Polygon*>& outlines() const { return outlines_; }

 private:
  struct Opening {
    const ShownLuminaire* luminaire;
    Polygon polygon;
  };
  void find_finishes(const Cells& cells);
  void add_opening(std::size_t index, const Vec3& direction, const Light& tint, Light& light) const;
  double add_surface(std::size_t surface, const Vec2& local, const Vec3& direction, double weight,
                     std::uint64_t chance, const Light& tint, Light& light) const;
  void add_highlights(std::size_t surface, const Vec2& local, const Vec3& towards, double weight,
                      std::uint64_t chance, Light& lobe) const;
  void add_place(std::size_t surface, const Vec2& local, const double* lamp_lx, Light& irradiance) const;
  double reflect(std::size_t surface, const Light& irradiance, const Light* tint, Light& light) const;

  const LuminanceDatabase& database_;
  const Zone& zone_;
  const Cells& cells_;
  Shading shading_;
  LightChannels channels_;
  LightField field_;
  std::vector<Opening> openings_;
  std::vector<std::vector<BandReflection>> reflection_;  // [finish][band]
  std::vector<std::unique_ptr<Facets>> facets_;          // [finish], of off-specular ones
  std::vector<bool> mirror_;                             // [finish]
  std::unique_ptr<Lamps> lamps_;
  std::unique_ptr<PlaceLight> place_light_;
  std::vector<PairIntegrator> paths_;  // [n_lamps], for highlights
  std::vector<const Polygon*> outlines_;
  std::unique_ptr<RayCaster> caster_;  // surfaces, openings, bodies
};

}  // namespace dim
