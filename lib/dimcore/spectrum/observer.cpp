#include "spectrum/observer.hpp"

#include "spectrum/lattice.hpp"
#include "spectrum/tables/cie_observers.hpp"

namespace dim {
namespace {

Observer observer_of(const ObserverTables& tables) {
  return {curve_of(tables.x), curve_of(tables.y), curve_of(tables.z)};
}

}  // namespace

SpectralCurve curve_of(FiveNanometreTable values) {
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < kTableSize; ++i) points.emplace_back(lattice_nm(i), values[i]);
  return SpectralCurve(std::move(points));
}

const Observer& cie_1931_observer() {
  static const Observer observer = observer_of(cie_1931_tables());
  return observer;
}

const Observer& cie_1964_observer() {
  static const Observer observer = observer_of(cie_1964_tables());
  return observer;
}

const SpectralCurve& photopic_efficiency() { return cie_1931_observer().y; }

const SpectralCurve& scotopic_efficiency() {
  static const SpectralCurve curve = curve_of(scotopic_table());
  return curve;
}

const SpectralCurve& melanopic_action() {
  static const SpectralCurve curve = curve_of(melanopic_table());
  return curve;
}

}  // namespace dim
