#pragma once

#include <vector>

#include "transport/propagation.hpp"

namespace dim {

/// By how much a reflection lessens light, for bounds of what an iteration has left out: error at most
/// residual / (1 - share). By reflectance class.
///
/// Without lobes, in the maximum norm: if no cell's irradiance is off by more than d, then after one more
/// reflection none is by more than share * d. `share` is the largest irradiance of a cell when all irradiances
/// are 1: the largest row sum of rho, with what is seen in mirrors.
///
/// With lobes, in flux: if what cells and lobes send is off by d in sum of absolute values, then after one more
/// reflection by no more than share * d, and what arrives on cells by no more than `landing` * d. `share` is
/// the largest part of a unit of flux, sent by any cell or lobe, that is sent on by where it lands; a mirror
/// counts as sending on rho / (1 - F), which is what it comes to by way of itself, at the most reflecting of
/// its slices.
struct Contraction {
  bool in_flux = false;
  std::vector<double> share;    ///< [n_classes]; no bound where it is not below 1
  std::vector<double> landing;  ///< [n_classes], in flux only
};

/// Of flux that lands on a surface: `share`, the most that is sent on, and `landing`, what it counts for in all
/// the places it comes down on its way. See `Contraction`.
struct SentOn {
  double share = 0.0;
  double landing = 1.0;
};
SentOn most_sent_on(std::size_t surface, double reflectance, const Shine* shine, const Zone& zone,
                    std::size_t klass);

/// @param shine  null where every surface is diffusing
Contraction contraction(const Network& network, const Cells& cells, const Reflectances& reflectances,
                        const GatherShine* shine);

}  // namespace dim
