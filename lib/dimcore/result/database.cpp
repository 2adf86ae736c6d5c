#include "result/database.hpp"

#include "result/lum_file.hpp"

namespace dim {
namespace {

class InMemory : public TransferStore {
 public:
  explicit InMemory(Solution solution) : solution_(std::move(solution)) {}

  std::vector<float> of_source(TransferPart part, std::size_t source) const override {
    const auto& all = part_of(solution_, part);
    const std::size_t n = all.size() / solution_.sources.size();
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(source * n);
    return {first, first + static_cast<std::ptrdiff_t>(n)};
  }

 private:
  Solution solution_;
};

}  // namespace

LuminanceDatabase::LuminanceDatabase(const std::string& path, const Job& job) {
  LumFile file = load_lum(path, job);
  content_ = std::move(file.content);
  light_ = std::move(file.light);
  hash_ = std::move(file.hash);
  rays_hash_ = std::move(file.rays_hash);
}

LuminanceDatabase::LuminanceDatabase(const Zone& zone, const Cells& cells, const Lights& lights,
                                     Solution solution)
    : content_(content_of(zone, cells, lights, solution)),
      light_(std::make_unique<InMemory>(std::move(solution))) {}

std::vector<float> LuminanceDatabase::transfer(TransferPart part, std::size_t source) const {
  return light_->of_source(part, source);
}

namespace {

// The balance of a class holds in each of its bands; what it is in watts changes with the power there.
std::vector<EnergyBalance> with_power_of(const Source& source, const ReflectanceClasses& classes,
                                         const std::vector<EnergyBalance>& before) {
  std::vector<EnergyBalance> energy;
  for (std::size_t b = 0; b < before.size(); ++b) {
    EnergyBalance sum;
    for (std::size_t other = 0; other < before.size(); ++other)
      if (classes.of_band[other] == classes.of_band[b] && before[other].emitted_W > sum.emitted_W)
        sum = before[other];
    const double emitted_W = source.flux_lm * source.watts_per_lumen(b);
    const double scale = sum.emitted_W > 0.0 ? emitted_W / sum.emitted_W : 0.0;
    energy.push_back({emitted_W, scale * sum.absorbed_W, scale * sum.escaped_W, scale * sum.lost_W,
                      scale * sum.dropped_W, sum.imbalance});
  }
  return energy;
}

}  // namespace

void LuminanceDatabase::set_spectrum(std::size_t s, const SpectralCurve& spectrum) {
  Source& source = content_.sources[s];
  if (content_.classes.luminous)
    throw InputError({{},
                      "source '" + source.name +
                          "' cannot be given another spectrum: the light was solved in one waveband, in which "
                          "finishes reflect as they do under the lamps it was made with",
                      "make the file again with dimray --bands auto"});
  const auto before = std::move(source.energy);
  source.weights = band_weights(spectrum, content_.bands);
  source.energy = with_power_of(source, content_.classes, before);
  content_.spectra[s] = {spectrum, true};
}

std::vector<float> LuminanceDatabase::by_band(TransferPart part, std::size_t source) const {
  const auto by_class = transfer(part, source);
  const bool direct = part == TransferPart::cell_direct || part == TransferPart::point_direct;
  const std::size_t n_classes = direct ? content_.n_direct_classes : content_.classes.size();
  const std::size_t n_bands = content_.bands.size(), n = by_class.size() / n_classes;
  std::vector<float> values(n_bands * n);
  for (std::size_t b = 0; b < n_bands; ++b) {
    const double watts = content_.sources[source].watts_per_lumen(b);
    const float* of_class = by_class.data() + (n_classes > 1 ? content_.classes.of_band[b] * n : 0);
    for (std::size_t i = 0; i < n; ++i)
      values[b * n + i] = static_cast<float>(static_cast<double>(of_class[i]) * watts);
  }
  return values;
}

std::vector<float> LuminanceDatabase::cell_irradiance(std::size_t source) const {
  return by_band(TransferPart::cell_total, source);
}

std::vector<float> LuminanceDatabase::direct_cell_irradiance(std::size_t source) const {
  return by_band(TransferPart::cell_direct, source);
}

std::vector<float> LuminanceDatabase::lobe_radiance(std::size_t source) const {
  return by_band(TransferPart::lobe_total, source);
}

std::vector<float> LuminanceDatabase::direct_lobe_radiance(std::size_t source) const {
  return by_band(TransferPart::lobe_direct, source);
}

std::vector<float> LuminanceDatabase::point_irradiance(std::size_t source) const {
  return by_band(TransferPart::point_total, source);
}

}  // namespace dim
