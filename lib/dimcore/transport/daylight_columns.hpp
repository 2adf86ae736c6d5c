#pragma once

#include <memory>
#include <vector>

#include "light/sun_light.hpp"
#include "light/window_light.hpp"
#include "scene/lights.hpp"
#include "transport/direct_columns.hpp"
#include "transport/simulate.hpp"

namespace dim {

/// The windows of a zone under a sky, as sources of direct light: one source for each group of windows, state and
/// part of the outside, in this order, after those of the luminaires.
class DaylightSources {
 public:
  /// @param first  number of the first source: how many the luminaires have
  /// @throws Interrupted
  DaylightSources(const Zone& zone, const SkyLight& sky, const ReflectanceClasses& classes,
                  const Obstructions& obstructions, Combine combine, const Bands& bands, std::size_t first,
                  const Job& job);

  /// Puts the sources, energy figures left out, behind those of luminaires, and the flux that comes in by each, lm,
  /// as the windows send it: [n_classes].
  void append_to(std::vector<Source>& sources, std::vector<std::vector<double>>& class_flux_lm) const;

  /// Whether their light differs from class to class.
  bool tinted() const { return panes_->tinted(); }
  std::size_t n_outside_cells() const { return outside_->n_cells(); }

  /// Adds their light to columns class * n_sources + source; first makes these of one class into those of all
  /// where it has to.
  void add_to(DirectColumns& direct, std::size_t n_sources, std::size_t n_classes, const Zone& zone,
              const Cells& cells, const Job& job) const;

  /// What becomes of their light before it meets a cell.
  void add_flights(std::vector<FirstFlight>& flights) const;

  /// The flux of what is open in ways only rays know: what cells received.
  void complete(std::vector<Source>& sources, std::vector<std::vector<double>>& class_flux_lm,
                const std::vector<ColumnReport>& columns) const;

  SkyRecord record() const { return record_; }

  /// What is modelled of the outside, for ModelPlan::daylight.
  std::vector<std::string> in_words() const;

 private:
  std::size_t n_outside_columns() const { return light_->n_columns(); }
  void make_sources(const SkyLight& sky, const Bands& bands);

  std::size_t slot(std::size_t source, std::size_t klass) const {
    return panes_->slot(origin_[source].group, origin_[source].state, klass);
  }
  double luminous_flux_lm(const Source& source, const std::vector<double>& class_flux_lm) const;

  std::size_t first_, n_classes_;
  ReflectanceClasses classes_;
  SkyRecord record_;
  Windows windows_;
  std::unique_ptr<const OutsideLight> light_;
  std::unique_ptr<const Panes> panes_;
  std::unique_ptr<const Outside> outside_;
  std::unique_ptr<const WindowFlux> flux_;
  std::unique_ptr<const WindowLight> window_light_;
  std::unique_ptr<const SunLight> sun_light_;
  std::vector<Source> sources_;
  struct Origin {
    std::size_t group, state, column;
  };
  std::vector<Origin> origin_;  // [n_sources]
};

}  // namespace dim
