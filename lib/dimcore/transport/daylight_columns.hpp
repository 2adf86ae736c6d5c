#pragma once

#include <memory>
#include <vector>

#include "light/first_flight.hpp"
#include "light/sun_light.hpp"
#include "light/window_light.hpp"
#include "scene/lights.hpp"
#include "transport/direct_columns.hpp"
#include "transport/plan.hpp"

namespace dim {

/// The windows of a zone under a sky, as sources of direct light: one source for each group of windows, state and
/// part of the outside, in this order, after those of the luminaires.
class DaylightSources {
 public:
  /// @param room  with a sky among its lights; must outlive this
  /// @param plan  has the sources of luminaires and no others
  /// @throws Interrupted
  DaylightSources(const Room& room, const ModelPlan& plan, const SimulationOptions& options, const Job& job);

  /// Puts the sources, energy figures left out, behind those of luminaires in the plan, and what is modelled of the
  /// outside in words; warns of what is not.
  void append_to(ModelPlan& plan, Warnings& warnings) const;

  /// Whether their light differs from class to class.
  bool tinted() const { return panes_->tinted(); }
  std::size_t n_outside_cells() const { return outside_->n_cells(); }

  /// Adds their light to direct columns; first makes these of one class into those of all where it has to.
  /// @param plan  with these sources appended
  void add_to(DirectColumns& direct, const ModelPlan& plan, const Job& job) const;

  /// What becomes of their light before it meets a cell.
  void add_flights(std::vector<FirstFlight>& flights) const;

  /// The flux that comes in by each of the sources in each class, lm; of what is open in ways only rays know it is
  /// what cells received.
  /// @param sources        of the solution; those without windows get their flux here
  /// @param class_flux_lm  [n_sources][n_classes], filled for these sources
  void take_flux(std::vector<Source>& sources, std::vector<std::vector<double>>& class_flux_lm,
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
  std::vector<double> class_flux_lm(std::size_t source) const;
  void balance(DirectColumns& direct, std::size_t n_sources) const;
  double luminous_flux_lm(const Source& source, const std::vector<double>& class_flux_lm) const;

  const Room& room_;
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
