#include "spectrum/bounce_lights.hpp"

#include <algorithm>
#include <cmath>
#include <glm/exponential.hpp>

#include "spectrum/tables/cie_observers.hpp"

namespace dim {
namespace {

// Luminance errors of lights dimmer than this share of a white beside them are stated as a share of that.
constexpr double kDim = 0.01;
constexpr double kMostReflective = 0.99;  // light thrown to and fro for ever stays finite

template <typename T>
void add_once(std::vector<T>& list, const T& value) {
  if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

}  // namespace

BounceLights::BounceLights(const std::vector<SpectralCurve>& spectra,
                           const std::vector<SpectralCurve>& reflectances) {
  Reflectance brightest_grey;
  for (const auto& spectrum : spectra) add_source(spectrum);
  for (const auto& curve : reflectances) add_finish(curve, brightest_grey);
  if (brightest_grey.sum_nm.back() > 0.0) add_once(finishes_, brightest_grey);
  for (std::size_t a = 0; a < finishes_.size(); ++a) {
    once_.push_back(lights_.size());
    lights_.push_back({Path::once, a, a});
    for (std::size_t b = a; b < finishes_.size(); ++b) {
      lights_.push_back({Path::twice, a, b});
      lights_.push_back({Path::for_ever, a, b});
    }
  }
  find_truth();
}

void BounceLights::add_source(const SpectralCurve& spectrum) {
  const LatticeValues power = on_lattice(spectrum);
  const ObserverTables& eye = cie_1931_tables();
  SourceWeights source;
  for (std::size_t i = 0; i < kTableSize; ++i) {
    const double width_nm = cell_edge_nm(i + 1) - cell_edge_nm(i);
    source.cell[i] = width_nm * power[i] * Vec3(eye.x[i], eye.y[i], eye.z[i]);
    source.sum[i + 1] = source.sum[i] + source.cell[i];
  }
  const double white = source.sum.back().y;
  for (auto& xyz : source.cell) xyz /= white;
  for (auto& xyz : source.sum) xyz /= white;
  // Red light alone has no Z to compare with.
  constexpr double kNone = 1e-9;
  source.white = glm::max(source.sum.back(), Vec3(kNone));
  add_once(sources_, source);
}

void BounceLights::add_finish(const SpectralCurve& curve, Reflectance& brightest_grey) {
  Reflectance finish;
  for (std::size_t i = 0; i < kTableSize; ++i) {
    const double low = cell_edge_nm(i), high = cell_edge_nm(i + 1);
    finish.at[i] = std::min(curve.at(lattice_nm(i)), kMostReflective);
    finish.sum_nm[i + 1] = finish.sum_nm[i] + std::min(curve.mean(low, high), kMostReflective) * (high - low);
  }
  if (!curve.is_flat())
    add_once(finishes_, finish);
  else if (finish.sum_nm.back() > brightest_grey.sum_nm.back())
    brightest_grey = finish;
}

double BounceLights::along(Path path, double a, double b) {
  if (path == Path::once) return a;
  return path == Path::twice ? a * b : a * b / (1.0 - a * b);
}

double BounceLights::throughput(std::size_t light, std::size_t from, std::size_t to) const {
  const auto& [path, first, second] = lights_[light];
  return along(path, finishes_[first].mean(from, to), finishes_[second].mean(from, to));
}

double BounceLights::throughput(std::size_t light, std::size_t cell) const {
  const auto& [path, first, second] = lights_[light];
  return along(path, finishes_[first].at[cell], finishes_[second].at[cell]);
}

void BounceLights::find_truth() {
  LatticeValues through;
  for (std::size_t l = 0; l < lights_.size(); ++l) {
    for (std::size_t i = 0; i < kTableSize; ++i) through[i] = throughput(l, i);
    for (const auto& source : sources_) {
      Vec3 xyz(0.0);
      for (std::size_t i = 0; i < kTableSize; ++i) xyz += through[i] * source.cell[i];
      truth_.push_back(truth_of(xyz, source.white));
    }
  }
  // More than one reflection is seen beside the light that met either finish once.
  const std::size_t n = sources_.size();
  for (std::size_t c = 0; c < truth_.size(); ++c) {
    const Light& light = lights_[c / n];
    for (const std::size_t finish : {light.a, light.b})
      truth_[c].beside = std::max(truth_[c].beside, truth_[once_[finish] * n + c % n].xyz.y);
  }
  running_.resize(truth_.size());
  CellEdges finest;
  for (std::size_t i = 0; i <= kTableSize; ++i) finest.push_back(i);
  for_each(banded(finest), [&](std::size_t c, const Truth& truth, const Lab& lab, double luminance) {
    truth_[c].finest_delta_e = delta_e_2000(truth.lab, lab);
    truth_[c].finest_luminance = luminance;
  });
}

BounceLights::Truth BounceLights::truth_of(const Vec3& xyz, const Vec3& white) const {
  constexpr double kCubeFrom = 0.008856;  // below, CIELAB is straight
  Truth truth{xyz, lab_of(xyz, white), std::max(xyz.y, kDim * white.y), Vec3(0.0), 1.0};
  const Vec3 share = glm::max(xyz / white, Vec3(kCubeFrom));
  truth.slope = 1.0 / (3.0 * white * glm::pow(share, Vec3(2.0 / 3.0)));
  truth.chroma_scale = 1.0 / (1.0 + 0.045 * std::hypot(truth.lab.a, truth.lab.b));
  return truth;
}

namespace {

// A running sum over cells up to a wavelength, within a cell in proportion.
template <typename Sums>
auto up_to(const Sums& sum, double nm) {
  std::size_t i = 0;
  while (i + 1 < kTableSize && cell_edge_nm(i + 1) <= nm) ++i;
  const double part = (nm - cell_edge_nm(i)) / (cell_edge_nm(i + 1) - cell_edge_nm(i));
  return sum[i] + std::clamp(part, 0.0, 1.0) * (sum[i + 1] - sum[i]);
}

}  // namespace

BounceLights::Banded BounceLights::banded(const CellEdges& edges) const {
  Banded result{edges.size() - 1, {}, {}};
  for (const auto& source : sources_) {
    for (std::size_t b = 0; b < result.n_bands; ++b)
      result.xyz.push_back(source.sum[edges[b + 1]] - source.sum[edges[b]]);
  }
  for (const auto& finish : finishes_) {
    for (std::size_t b = 0; b < result.n_bands; ++b)
      result.reflectance.push_back(finish.mean(edges[b], edges[b + 1]));
  }
  return result;
}

BounceLights::Banded BounceLights::banded(const Bands& bands) const {
  Banded result{bands.size(), {}, {}};
  for (const auto& source : sources_) {
    for (std::size_t b = 0; b < bands.size(); ++b)
      result.xyz.push_back(up_to(source.sum, bands.high_nm(b)) - up_to(source.sum, bands.low_nm(b)));
  }
  for (const auto& finish : finishes_) {
    for (std::size_t b = 0; b < bands.size(); ++b)
      result.reflectance.push_back((up_to(finish.sum_nm, bands.high_nm(b)) - up_to(finish.sum_nm, bands.low_nm(b))) /
                                   (bands.high_nm(b) - bands.low_nm(b)));
  }
  return result;
}

BounceLights::Banded BounceLights::banded(const LatticeValues& weights) const {
  Banded result{1, {}, {}};
  for (const auto& source : sources_) result.xyz.push_back(source.sum.back());
  for (const auto& finish : finishes_) {
    double mean = 0.0;
    for (std::size_t i = 0; i < kTableSize; ++i) mean += weights[i] * finish.at[i];
    result.reflectance.push_back(mean);
  }
  return result;
}

void BounceLights::for_each(const Banded& banded, const See& see) const {
  const std::size_t n = banded.n_bands;
  std::vector<double> through(n);
  std::size_t c = 0;
  for (const auto& [path, first, second] : lights_) {
    for (std::size_t b = 0; b < n; ++b)
      through[b] = along(path, banded.reflectance[first * n + b], banded.reflectance[second * n + b]);
    for (std::size_t s = 0; s < sources_.size(); ++s, ++c) {
      Vec3 xyz(0.0);
      for (std::size_t b = 0; b < n; ++b) xyz += through[b] * banded.xyz[s * n + b];
      const Truth& truth = truth_[c];
      see(c, truth, lab_of(xyz, sources_[s].white), std::abs(xyz.y - truth.xyz.y) / truth.beside);
    }
  }
}

void BounceLights::prepare(std::size_t c) {
  if (!running_[c].empty()) return;
  const std::size_t l = c / sources_.size();
  const SourceWeights& source = sources_[c % sources_.size()];
  running_[c].assign(kTableSize + 1, Vec3(0.0));
  for (std::size_t i = 0; i < kTableSize; ++i)
    running_[c][i + 1] = running_[c][i] + throughput(l, i) * source.cell[i];
}

double BounceLights::band_cost(std::size_t c, std::size_t from, std::size_t to, double delta_e,
                               double luminance) const {
  const SourceWeights& source = sources_[c % sources_.size()];
  const Truth& truth = truth_[c];
  const Vec3 off = throughput(c / sources_.size(), from, to) * (source.sum[to] - source.sum[from]) -
                   (running_[c][to] - running_[c][from]);
  const Vec3 f = off * truth.slope;
  const double a = 500.0 * (f.x - f.y) * truth.chroma_scale, b = 200.0 * (f.y - f.z) * truth.chroma_scale;
  const double l = 116.0 * f.y, y = off.y / truth.beside;
  return (l * l + a * a + b * b) / (delta_e * delta_e) + y * y / (luminance * luminance);
}

}  // namespace dim
