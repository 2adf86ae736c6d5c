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
  for_each(finest, [&](std::size_t c, const Truth& truth, const Lab& lab, double luminance) {
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

void BounceLights::for_each(const CellEdges& edges, const See& see) const {
  std::vector<double> through(edges.size() - 1);
  std::vector<Vec3> weights;  // of every source and band
  for (const auto& source : sources_) {
    for (std::size_t b = 0; b < through.size(); ++b)
      weights.push_back(source.sum[edges[b + 1]] - source.sum[edges[b]]);
  }
  std::size_t c = 0;
  for (std::size_t l = 0; l < lights_.size(); ++l) {
    for (std::size_t b = 0; b < through.size(); ++b) through[b] = throughput(l, edges[b], edges[b + 1]);
    for (std::size_t s = 0; s < sources_.size(); ++s, ++c) {
      Vec3 xyz(0.0);
      for (std::size_t b = 0; b < through.size(); ++b) xyz += through[b] * weights[s * through.size() + b];
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
