#pragma once

#include "spectrum/tables/five_nanometres.hpp"

namespace dim {

/// Colour-matching functions of an observer.
struct ObserverTables {
  FiveNanometreTable x, y, z;
};

/// CIE 1931, 2 degrees: every fifth value of the 1 nm table of ISO/CIE 11664-1 (CIE 018).
const ObserverTables& cie_1931_tables();
/// CIE 1964, 10 degrees: the same.
const ObserverTables& cie_1964_tables();
/// The 1931 observer at 360..375 and 785..830 nm every 5 nm, for the Planckian locus.
struct OuterValues {
  double nm, x, y, z;
};
std::span<const OuterValues> cie_1931_outer();
/// V'(lambda), CIE 1951: every fifth value of the 1 nm table.
FiveNanometreTable scotopic_table();
/// Melanopic action spectrum, CIE S 026:2018 table 2: every fifth value.
FiveNanometreTable melanopic_table();

}  // namespace dim
