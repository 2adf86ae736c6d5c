#pragma once

#include <memory>
#include <vector>

#include "image/light_field.hpp"
#include "light/direct_light.hpp"

namespace dim {

/// What shines in a picture: the lit luminaires of a database and their images in mirrors.
class Lamps {
 public:
  /// @param mirrors  surfaces that are mirrors
  Lamps(const LuminanceDatabase& database, const Mix& mix, const LightChannels& channels,
        const std::vector<int>& mirrors);
  Lamps(const Lamps&) = delete;
  Lamps& operator=(const Lamps&) = delete;

  std::size_t size() const { return emitters_.size(); }
  const LightSource& emitter(std::size_t e) const { return emitters_[e]; }
  const Obstructions& obstructions() const { return *obstructions_; }
  /// In the mix, of a luminaire.
  double factor(std::size_t luminaire) const { return factor_[luminaire]; }
  double factor_of(std::size_t e) const { return factor_[emitters_[e].original]; }

  /// Integrators of every emitter that take as many lines for shadows; 0: nothing is in the way.
  std::vector<PairIntegrator> integrators(int shadow_lines) const;

  /// What an emitter's mirrors and its factor leave of its light at a point. [n_bands]
  void tint(std::size_t e, const Vec3& at, std::vector<double>& tint) const;

  /// Adds an emitter's illuminance at a point, mirrors and factor not yet taken off, to its channels.
  void add(std::size_t e, double lx, const Vec3& at, Light& irradiance) const;

 private:
  const LuminanceDatabase& database_;
  const LightChannels& channels_;
  std::vector<double> factor_;  // [n_luminaires]
  Lights lights_;
  std::vector<LightSource> emitters_;
  std::unique_ptr<Obstructions> obstructions_;
};

}  // namespace dim
