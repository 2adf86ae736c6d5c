#pragma once

#include <memory>
#include <vector>

#include "light/window.hpp"
#include "reflection/klems.hpp"
#include "reflection/specular.hpp"

namespace dim {

/// What the glazing of a window lets pass in one state and class of bands: straight on by angle, and scattered.
struct Pane {
  const Transmission* straight = nullptr;  ///< null: all of it (what is open)
  const Finish* scattering = nullptr;      ///< its `bsdf`, or evenly in all directions; null: nothing
  double diffuse = 0.0;                    ///< transmittance of what goes evenly in all directions

  double straight_at(double cos_incidence) const { return straight ? straight->at(cos_incidence) : 1.0; }
  bool operator==(const Pane&) const = default;
};

/// A set of columns that is computed as one: a group of windows in one state, as it is in reflectance classes in
/// which neither its panes nor the surfaces outside differ.
struct PaneSlot {
  std::size_t group = 0, state = 0;
  std::size_t outside_class = 0;  ///< of `Outside`
  std::vector<Pane> panes;        ///< of the group's windows, in their order
};

/// The glazing of all windows in all their states and classes of bands.
class Panes {
 public:
  /// @param of_finish  [n_classes][n_finishes] reflection (and transmission) in each class
  Panes(const Zone& zone, const Windows& windows, const std::vector<std::vector<BandReflection>>& of_finish);

  const std::vector<PaneSlot>& slots() const { return slots_; }
  /// Slots of a group are neighbours: [first, last).
  std::size_t first_of_group(std::size_t group) const { return first_of_group_[group]; }
  std::size_t last_of_group(std::size_t group) const { return first_of_group_[group + 1]; }
  std::size_t slot(std::size_t group, std::size_t state, std::size_t klass) const {
    return slot_of_[group][state][klass];
  }
  /// Whether some group's light differs from class to class.
  bool tinted() const { return tinted_; }
  /// [n_outside_classes][n_surfaces] reflectance of outside surfaces.
  const std::vector<std::vector<double>>& outside_reflectance() const { return outside_reflectance_; }

 private:
  struct Law {
    int finish;
    double normal;
    std::unique_ptr<const Transmission> straight;
  };
  Pane pane(const Zone& zone, int finish, const BandReflection& reflection);

  std::vector<Law> laws_;
  std::vector<PaneSlot> slots_;
  std::vector<std::size_t> first_of_group_;
  std::vector<std::vector<std::vector<std::size_t>>> slot_of_;
  std::vector<std::vector<double>> outside_reflectance_;
  bool tinted_ = false;
};

}  // namespace dim
