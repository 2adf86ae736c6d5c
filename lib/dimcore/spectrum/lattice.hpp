#pragma once

#include <array>

#include "spectrum/curve.hpp"
#include "spectrum/tables/five_nanometres.hpp"

/// The wavelengths 380, 385, ... 780 nm at which light and eye are multiplied and summed, as CIE 15 does with
/// its tables. Each stands for the 5 nm around it, the first and last for 2.5 nm.
namespace dim {

inline constexpr double kVisibleLow_nm = 380.0;
inline constexpr double kVisibleHigh_nm = 780.0;

constexpr double lattice_nm(std::size_t i) { return kVisibleLow_nm + kTableStep_nm * static_cast<double>(i); }

using LatticeValues = std::array<double, kTableSize>;

/// A curve at these wavelengths: its values there, or, where it has points closer than 5 nm to each other,
/// its means over the cells around them, so that no narrow line is missed.
LatticeValues on_lattice(const SpectralCurve& curve);

/// Where cell i begins, and the one before it ends: 380, 382.5, 387.5, ... 777.5, 780 for i = 0 ... 81.
constexpr double cell_edge_nm(std::size_t i) {
  return i == 0 ? kVisibleLow_nm : i == kTableSize ? kVisibleHigh_nm : lattice_nm(i) - kTableStep_nm / 2.0;
}

/// How much of the cell around wavelength i lies within [low_nm, high_nm], nm.
double cell_overlap_nm(std::size_t i, double low_nm, double high_nm);

}  // namespace dim
