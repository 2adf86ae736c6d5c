#pragma once

#include <array>
#include <functional>
#include <vector>

#include "base/vec.hpp"
#include "spectrum/bands.hpp"
#include "spectrum/colour.hpp"
#include "spectrum/lattice.hpp"

namespace dim {

/// Edges of bands as numbers of 5 nm cells: 0 (380 nm), 1 (382.5), 2 (387.5), ... 80 (777.5), 81 (780).
using CellEdges = std::vector<std::size_t>;

/// Every light that sources and finishes can make in one reflection, in two, or thrown to and fro between two
/// finishes for ever, and its colour when solved at every fifth nanometre. A case is one light of one source.
class BounceLights {
 public:
  /// Equal spectra and equal reflectances count once; of greys only the brightest does.
  BounceLights(const std::vector<SpectralCurve>& spectra, const std::vector<SpectralCurve>& reflectances);

  /// The 5 nm answer for a case; white surfaces lit by the source alone have luminance 1.
  struct Truth {
    Vec3 xyz;
    Lab lab;
    double beside;        ///< luminance that an error of luminance is a share of
    Vec3 slope;           ///< of CIELAB's cube roots
    double chroma_scale;  ///< what CIEDE2000 takes off differences between strong colours
    /// Errors of 81 bands, which only very steep reflectances have.
    double finest_delta_e = 0.0, finest_luminance = 0.0;
  };

  std::size_t n_cases() const { return truth_.size(); }

  /// What bands make of sources and finishes.
  struct Banded {
    std::size_t n_bands = 0;
    std::vector<Vec3> xyz;            ///< [n_sources, n_bands] of a white surface
    std::vector<double> reflectance;  ///< [n_finishes, n_bands]
  };
  Banded banded(const CellEdges& edges) const;
  /// Bands of any edges.
  Banded banded(const Bands& bands) const;
  /// One band whose reflectances are means with these weights, which add up to 1.
  Banded banded(const LatticeValues& weights) const;

  /// Calls `see(case, truth, colour, error of luminance)` with what bands make of every case.
  using See = std::function<void(std::size_t, const Truth&, const Lab&, double)>;
  void for_each(const Banded& banded, const See& see) const;

  /// Makes the running sums of a case that band_cost needs.
  void prepare(std::size_t c);
  /// Square of the error of a prepared case over one band, its parts in units of what is allowed.
  double band_cost(std::size_t c, std::size_t from, std::size_t to, double delta_e, double luminance) const;

 private:
  struct Reflectance {
    LatticeValues at{};                           // each wavelength
    std::array<double, kTableSize + 1> sum_nm{};  // integral up to each edge: band means are differences
    double mean(std::size_t from, std::size_t to) const {
      return (sum_nm[to] - sum_nm[from]) / (cell_edge_nm(to) - cell_edge_nm(from));
    }
    bool operator==(const Reflectance&) const = default;
  };
  struct SourceWeights {
    std::array<Vec3, kTableSize> cell{};     // XYZ of a white surface from each cell
    std::array<Vec3, kTableSize + 1> sum{};  // up to each edge
    Vec3 white{0.0};
    bool operator==(const SourceWeights&) const = default;
  };
  enum class Path { once, twice, for_ever };
  struct Light {
    Path path;
    std::size_t a, b;
  };

  void add_source(const SpectralCurve& spectrum);
  void add_finish(const SpectralCurve& curve, Reflectance& brightest_grey);
  void find_truth();
  Truth truth_of(const Vec3& xyz, const Vec3& white) const;
  static double along(Path path, double a, double b);
  double throughput(std::size_t light, std::size_t from, std::size_t to) const;
  double throughput(std::size_t light, std::size_t cell) const;

  std::vector<SourceWeights> sources_;
  std::vector<Reflectance> finishes_;
  std::vector<Light> lights_;
  std::vector<std::size_t> once_;  // light of each finish alone
  std::vector<Truth> truth_;       // of every light (slowest) and source
  std::vector<std::vector<Vec3>> running_;
};

}  // namespace dim
