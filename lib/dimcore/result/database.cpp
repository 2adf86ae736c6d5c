#include "result/database.hpp"

#include <nlohmann/json.hpp>

#include "network/network_storage.hpp"
#include "result/spectra_storage.hpp"
#include "scene/zone_storage.hpp"

namespace dim {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kGammaSteps = 180;

Json to_json(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 vec3(const Json& json) { return {json.at(0), json.at(1), json.at(2)}; }

Json source_to_json(const Source& source) {
  Json energy = Json::array();
  for (const auto& e : source.energy)
    energy.push_back({{"emitted_W", e.emitted_W},
                      {"absorbed_W", e.absorbed_W},
                      {"escaped_W", e.escaped_W},
                      {"lost_W", e.lost_W},
                      {"dropped_W", e.dropped_W},
                      {"imbalance", e.imbalance}});
  const auto& w = source.weights;
  return {{"name", source.name},
          {"group", source.group},
          {"luminaires", source.luminaires},
          {"flux_lm", source.flux_lm},
          {"weights",
           {{"efficacy_lm_W", w.efficacy_lm_W}, {"share", w.share}, {"x", w.x}, {"y", w.y}, {"z", w.z}}},
          {"energy", std::move(energy)},
          {"iterations", source.iterations},
          {"residual", source.residual},
          {"error_bound", source.error_bound}};
}

Source source_from_json(const Json& json, std::size_t n_bands) {
  Source source;
  source.name = json.at("name");
  source.group = json.at("group");
  source.luminaires = json.at("luminaires").get<std::vector<std::string>>();
  source.flux_lm = json.at("flux_lm");
  const auto& w = json.at("weights");
  const auto column = [&](const char* name) {
    auto values = w.at(name).get<std::vector<double>>();
    if (values.size() != n_bands) throw std::out_of_range(name);
    return values;
  };
  source.weights = {w.at("efficacy_lm_W"), column("share"), column("x"), column("y"), column("z")};
  for (const auto& e : json.at("energy"))
    source.energy.push_back({e.at("emitted_W"), e.at("absorbed_W"), e.at("escaped_W"), e.at("lost_W"),
                             e.at("dropped_W"), e.at("imbalance")});
  source.iterations = json.at("iterations");
  source.residual = json.at("residual");
  source.error_bound = json.at("error_bound");
  return source;
}

MeanIntensity mean_intensity(const IntensityTable& table) {
  constexpr int kPlanes = 24;
  MeanIntensity mean;
  for (std::size_t i = 0; i <= kGammaSteps; ++i) {
    const double gamma = kPi * static_cast<double>(i) / kGammaSteps;
    double sum = 0.0;
    for (int c = 0; c < kPlanes; ++c) sum += table.at_c_gamma(2.0 * kPi * c / kPlanes, gamma);
    mean.push_back(sum / kPlanes);
  }
  return mean;
}

std::size_t source_of(const Solution& solution, const std::string& luminaire) {
  for (std::size_t s = 0; s < solution.sources.size(); ++s) {
    for (const auto& name : solution.sources[s].luminaires) {
      if (name == luminaire) return s;
    }
  }
  throw InternalError("luminaire '" + luminaire + "' belongs to no source");
}

Json description(const Lights& lights, const Solution& solution) {
  Json json = {{"sources", Json::array()}, {"luminaires", Json::array()}, {"photometry", Json::array()}};
  for (const auto& source : solution.sources) json["sources"].push_back(source_to_json(source));
  for (const auto& fitting : lights.fittings)
    json["photometry"].push_back({{"name", fitting.name},
                                  {"flux_lm", fitting.intensity.flux_lm()},
                                  {"watts", fitting.watts},
                                  {"mean_intensity_cd", mean_intensity(fitting.intensity)}});
  for (std::size_t i = 0; i < lights.luminaires.size(); ++i) {
    const auto& l = lights.luminaires[i];
    json["luminaires"].push_back(
        {{"name", l.name},
         {"source", source_of(solution, l.name)},
         {"at", to_json(l.at)},
         {"c0", to_json(l.c0)},
         {"c90", to_json(l.c90)},
         {"aim", to_json(l.aim)},
         {"opening_shape", static_cast<int>(l.opening.shape)},
         {"opening_m", {l.opening.length_m, l.opening.width_m, l.opening.height_m}},
         {"photometry", l.fitting},
         {"body", l.body},
         {"factor", l.factor},
         {"mirror_depth", i < solution.mirror_depth.size() ? solution.mirror_depth[i] : 0}});
  }
  return json;
}

ShownLuminaire luminaire_from_json(const Json& l, std::size_t n_sources, std::size_t n_photometry) {
  ShownLuminaire shown;
  shown.name = l.at("name");
  shown.source = l.at("source");
  shown.at = vec3(l.at("at"));
  shown.c0 = vec3(l.at("c0"));
  shown.c90 = vec3(l.at("c90"));
  shown.aim = vec3(l.at("aim"));
  const int shape = l.at("opening_shape");
  const auto& size = l.at("opening_m");
  shown.opening = {static_cast<OpeningShape>(shape), size.at(0), size.at(1), size.at(2)};
  shown.photometry = l.at("photometry");
  shown.factor = l.at("factor");
  shown.body = l.at("body");
  shown.mirror_depth = l.at("mirror_depth");
  if (shown.source >= n_sources || shown.photometry >= n_photometry || shown.mirror_depth < 0)
    throw std::out_of_range("luminaire");
  return shown;
}

// Intensities on a grid fine enough for any photometric file: C every 5, gamma every degree.
constexpr std::size_t kCPlanes = 73;

IntensityDistribution on_grid() {
  IntensityDistribution grid;
  for (std::size_t c = 0; c < kCPlanes; ++c)
    grid.c_rad.push_back(2.0 * kPi * static_cast<double>(c) / (kCPlanes - 1));
  for (std::size_t g = 0; g <= kGammaSteps; ++g)
    grid.gamma_rad.push_back(kPi * static_cast<double>(g) / kGammaSteps);
  return grid;
}

void store_intensities(Hdf5Writer& file, const Lights& lights) {
  std::vector<float> cd;
  const auto grid = on_grid();
  for (const auto& fitting : lights.fittings) {
    for (const double c : grid.c_rad) {
      for (const double gamma : grid.gamma_rad)
        cd.push_back(static_cast<float>(fitting.intensity.at_c_gamma(c, gamma)));
    }
  }
  file.dataset<float>("/photometry/intensity", cd, {lights.fittings.size(), kCPlanes, kGammaSteps + 1}, "cd",
                      "by photometry, C in steps of 5 degrees, gamma in steps of 1 degree, before factors");
}

std::vector<IntensityTable> load_intensities(const Hdf5Reader& file, std::size_t n) {
  const auto values = file.dataset<float>("/photometry/intensity", {n, kCPlanes, kGammaSteps + 1});
  std::vector<IntensityTable> tables;
  constexpr std::size_t kEach = kCPlanes * (kGammaSteps + 1);
  for (std::size_t i = 0; i < n; ++i) {
    auto distribution = on_grid();
    for (std::size_t k = 0; k < kEach; ++k) {
      const double cd = static_cast<double>(values[i * kEach + k]);
      if (!(cd >= 0.0)) throw std::out_of_range("intensity");
      distribution.intensity_cd.push_back(cd);
    }
    tables.emplace_back(distribution);
  }
  return tables;
}

void store_directional(Hdf5Writer& file, const Solution& solution) {
  const auto& directional = solution.directional;
  if (directional.cells.empty()) return;
  const Shape shape{solution.sources.size(), solution.bands.size(), directional.cells.size(),
                    directional.grid.n_patches()};
  file.dataset<std::uint32_t>("/directional/cells", directional.cells, {directional.cells.size()}, "1",
                              "off-specular cells");
  file.dataset<float>("/directional/direct", directional.direct, shape, "W/(m2 sr)",
                      "radiance by the lobe, of direct light alone, by source, band, cell and patch");
  file.dataset<float>("/directional/total", directional.total, shape, "W/(m2 sr)",
                      "radiance by the lobe, by source, band, cell and patch");
  file.attribute("/directional", "slices", directional.grid.n_slices);
  file.attribute("/directional", "sectors", directional.grid.n_sectors);
}

}  // namespace

std::string save_lum(const std::string& path, const Zone& zone, const Cells& cells, const Lights& lights,
                     const Solution& solution, const std::string& rays_hash, const Job& job) {
  Hdf5Writer file("lum", kLumVersion);
  store_zone(file, zone);
  file.text("/description", description(lights, solution).dump());
  file.attribute("/", "rays_hash", rays_hash);
  file.dataset<double>("/bands", solution.bands.edges_nm, {solution.bands.edges_nm.size()}, "nm",
                       "band edges");
  store_spectra(file, lights, solution);
  store_cells(file, zone, cells);
  const auto store = [&](const std::string& name, const std::vector<float>& values, std::size_t n) {
    file.dataset<float>(name, values, {solution.sources.size(), solution.bands.size(), n}, "W/m2",
                        "irradiance by source, band and cell or point");
  };
  store("/cells/direct", solution.cell_direct, solution.n_cells);
  store("/cells/total", solution.cell_total, solution.n_cells);
  store("/points/direct", solution.point_direct, solution.n_points);
  store("/points/total", solution.point_total, solution.n_points);
  store_intensities(file, lights);
  store_directional(file, solution);
  return std::move(file).write(path, job);
}

LuminanceDatabase::LuminanceDatabase(const std::string& path, const Job& job)
    : path_(path), file_(path, "lum", kLumVersion, job), zone_(load_zone(file_, path)) {
  try {
    bands_.edges_nm = file_.dataset<double>("/bands", {kAnySize});
    if (bands_.edges_nm.size() < 2) throw std::out_of_range("bands");
    n_cells_ = file_.shape("/cells/area").at(0);
    rays_hash_ = file_.text_attribute("/", "rays_hash");
    const Json json = Json::parse(file_.text("/description"));
    for (const auto& source : json.at("sources")) sources_.push_back(source_from_json(source, bands_.size()));
    spectra_ = load_spectra(file_, path, sources_.size());
    for (const auto& p : json.at("photometry")) {
      photometry_.push_back(p.at("mean_intensity_cd").get<std::vector<double>>());
      if (photometry_.back().size() != kGammaSteps + 1) throw std::out_of_range("photometry");
    }
    intensities_ = load_intensities(file_, photometry_.size());
    load_directional();
    for (const auto& l : json.at("luminaires"))
      luminaires_.push_back(luminaire_from_json(l, sources_.size(), photometry_.size()));
  } catch (const nlohmann::json::exception&) {
    throw IoError(path, "the description in this luminance database cannot be read");
  } catch (const std::out_of_range&) {
    throw IoError(path, "this luminance database does not hold together");
  }
}

std::vector<float> LuminanceDatabase::of_source(const std::string& dataset, std::size_t source,
                                                std::size_t n) const {
  if (file_.shape(dataset) != Shape{sources_.size(), bands_.size(), n})
    throw IoError(path_, dataset + " is not [sources, bands, " + std::to_string(n) + "]");
  std::vector<float> values(bands_.size() * n);
  file_.read_rows(dataset, source, 1, std::span(values));
  return values;
}

void LuminanceDatabase::load_directional() {
  if (!file_.has("/directional/cells")) return;
  directional_grid_ = {static_cast<int>(file_.integer_attribute("/directional", "slices")),
                       static_cast<int>(file_.integer_attribute("/directional", "sectors"))};
  off_specular_ = file_.dataset<std::uint32_t>("/directional/cells", {kAnySize});
  for (std::size_t i = 0; i < off_specular_.size(); ++i) {
    if (off_specular_[i] >= n_cells_ || (i > 0 && off_specular_[i] <= off_specular_[i - 1]))
      throw std::out_of_range("directional");
  }
  const bool fits = directional_grid_.n_slices > 0 && directional_grid_.n_sectors > 0;
  const Shape shape{sources_.size(), bands_.size(), off_specular_.size(), directional_grid_.n_patches()};
  if (!fits || file_.shape("/directional/total") != shape || file_.shape("/directional/direct") != shape)
    throw std::out_of_range("directional");
}

std::vector<float> LuminanceDatabase::directional(const std::string& dataset, std::size_t source) const {
  std::vector<float> values(bands_.size() * off_specular_.size() * directional_grid_.n_patches());
  file_.read_rows(dataset, source, 1, std::span(values));
  return values;
}

std::vector<float> LuminanceDatabase::lobe_radiance(std::size_t source) const {
  return directional("/directional/total", source);
}

std::vector<float> LuminanceDatabase::direct_lobe_radiance(std::size_t source) const {
  return directional("/directional/direct", source);
}

std::vector<float> LuminanceDatabase::direct_cell_irradiance(std::size_t source) const {
  return of_source("/cells/direct", source, n_cells_);
}

std::vector<float> LuminanceDatabase::cell_irradiance(std::size_t source) const {
  return of_source("/cells/total", source, n_cells_);
}

std::vector<float> LuminanceDatabase::point_irradiance(std::size_t source) const {
  return of_source("/points/total", source, zone_.points.size());
}

}  // namespace dim
