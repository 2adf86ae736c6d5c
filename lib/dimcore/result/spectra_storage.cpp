#include "result/spectra_storage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace dim {
namespace {

using Points = std::vector<std::pair<double, double>>;

// A spectrum of the file, checked as what a program of this name would have written.
SpectralCurve curve_from(const std::vector<double>& values, std::size_t first, std::size_t last,
                         const std::string& path) {
  Points points;
  for (std::size_t i = first; i < last; ++i) points.emplace_back(values[2 * i], values[2 * i + 1]);
  const auto not_after = [](const auto& a, const auto& b) { return !(a.first < b.first); };
  const auto not_power = [](const auto& point) { return !(point.second >= 0.0); };
  if (points.empty() || std::adjacent_find(points.begin(), points.end(), not_after) != points.end() ||
      std::any_of(points.begin(), points.end(), not_power))
    throw IoError(path, fmt::format("dataset '/spectra/point': points {} to {} are no spectrum", first, last));
  return SpectralCurve(std::move(points));
}

}  // namespace

void store_spectra(Hdf5Writer& file, const std::vector<ShownSpectrum>& spectra) {
  std::map<Points, std::uint32_t> known;
  std::vector<std::uint32_t> of_source;
  std::vector<std::uint64_t> first{0};
  std::vector<double> values;
  for (const auto& spectrum : spectra) {
    const Points& points = spectrum.curve.points();
    const auto [it, added] = known.emplace(points, static_cast<std::uint32_t>(known.size()));
    of_source.push_back(it->second);
    if (!added) continue;
    for (const auto& [nm, power] : points) values.insert(values.end(), {nm, power});
    first.push_back(values.size() / 2);
  }
  file.dataset<std::uint32_t>("/spectra/of_source", of_source, {of_source.size()}, "1",
                              "spectrum of each source");
  file.dataset<std::uint64_t>("/spectra/first", first, {first.size()}, "1",
                              "points of spectrum i are first[i] to first[i + 1]");
  file.dataset<double>("/spectra/point", values, {values.size() / 2, 2}, "nm, 1",
                       "wavelength and relative spectral power");
}

void load_spectra(const Hdf5Reader& file, const std::string& path, std::vector<ShownSpectrum>& spectra) {
  const auto of_source = file.dataset<std::uint32_t>("/spectra/of_source", {spectra.size()});
  const auto first = file.dataset<std::uint64_t>("/spectra/first", {kAnySize});
  const auto values = file.dataset<double>("/spectra/point", {kAnySize, 2});
  if (!std::is_sorted(first.begin(), first.end()) || (!first.empty() && first.back() > values.size() / 2))
    throw IoError(path, fmt::format("dataset '/spectra/first' does not ascend to at most {}", values.size() / 2));
  for (std::size_t s = 0; s < spectra.size(); ++s) {
    const std::uint32_t i = of_source[s];
    if (i + std::size_t{1} >= first.size())
      throw IoError(path, fmt::format("dataset '/spectra/of_source': element {} is {}, no spectrum", s, i));
    spectra[s].curve = curve_from(values, first[i], first[i + 1], path);
  }
}

}  // namespace dim
