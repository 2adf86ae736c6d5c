#include "result/lum_file.hpp"

#include <algorithm>
#include <cmath>

#include "base/hdf5_file.hpp"
#include "network/network_storage.hpp"
#include "result/lum_description.hpp"
#include "result/spectra_storage.hpp"
#include "scene/zone_storage.hpp"

namespace dim {
namespace {

const char* dataset_of(TransferPart part) {
  switch (part) {
    case TransferPart::cell_direct:
      return "/transfer/cell_direct";
    case TransferPart::cell_total:
      return "/transfer/cell_total";
    case TransferPart::point_direct:
      return "/transfer/point_direct";
    case TransferPart::point_total:
      return "/transfer/point_total";
    case TransferPart::lobe_direct:
      return "/directional/direct";
    case TransferPart::lobe_total:
      return "/directional/total";
  }
  throw InternalError("part of a solution of no name");
}

// Shape of a part after its sources.
Shape shape_of(const ResultContent& content, TransferPart part) {
  switch (part) {
    case TransferPart::cell_direct:
      return {content.n_direct_classes, content.n_cells};
    case TransferPart::cell_total:
      return {content.classes.size(), content.n_cells};
    case TransferPart::point_direct:
      return {content.n_direct_classes, content.zone.points.size()};
    case TransferPart::point_total:
      return {content.classes.size(), content.zone.points.size()};
    case TransferPart::lobe_direct:
    case TransferPart::lobe_total:
      return {content.classes.size(), content.off_specular.size(), content.directional_grid.n_patches()};
  }
  throw InternalError("part of a solution of no name");
}

bool is_lobe(TransferPart part) {
  return part == TransferPart::lobe_direct || part == TransferPart::lobe_total;
}

void store_transfer(Hdf5Writer& file, const ResultContent& content, const Solution& solution) {
  for (const auto part : kTransferParts) {
    if (is_lobe(part) && content.off_specular.empty()) continue;
    Shape shape = shape_of(content, part);
    shape.insert(shape.begin(), content.sources.size());
    file.dataset<float>(dataset_of(part), part_of(solution, part), shape, is_lobe(part) ? "cd/m2" : "lx",
                        is_lobe(part) ? "by source, class of bands, off-specular cell and patch"
                                      : "by source, class of bands and cell or point");
  }
  if (content.off_specular.empty()) return;
  file.dataset<std::uint32_t>("/directional/cells", content.off_specular, {content.off_specular.size()}, "1",
                              "off-specular cells");
  file.attribute("/directional", "slices", content.directional_grid.n_slices);
  file.attribute("/directional", "sectors", content.directional_grid.n_sectors);
}

// Specular reflectance of finishes that follow Fresnel's equations.
constexpr double kFresnel = -1.0;

void store_bands(Hdf5Writer& file, const ResultContent& content) {
  const auto& classes = content.classes;
  std::vector<std::uint32_t> of_band(classes.of_band.begin(), classes.of_band.end());
  file.dataset<double>("/bands/edge", content.bands.edges_nm, {content.bands.edges_nm.size()}, "nm",
                       "edges of the wavebands");
  file.dataset<std::uint32_t>("/bands/class", of_band, {of_band.size()}, "1",
                              "class of each band: bands in which every finish reflects alike");
  std::vector<double> diffuse, ior, extinction, constant;
  for (const auto& finishes : classes.of_finish) {
    for (const auto& reflection : finishes) {
      diffuse.push_back(reflection.diffuse);
      ior.push_back(reflection.n);
      extinction.push_back(reflection.k);
      constant.push_back(reflection.constant.value_or(kFresnel));
    }
  }
  const Shape shape{classes.size(), content.zone.finishes.size()};
  file.dataset<double>("/classes/diffuse", diffuse, shape, "1", "k_d times diffuse reflectance");
  file.dataset<double>("/classes/ior", ior, shape, "1");
  file.dataset<double>("/classes/extinction", extinction, shape, "1");
  file.dataset<double>("/classes/specular_reflectance", constant, shape, "1", "-1: by Fresnel's equations");
  file.attribute("/classes", "mean", classes.luminous ? "luminous" : "plain");
}

void load_bands(const Hdf5Reader& file, ResultContent& content) {
  content.bands.edges_nm = file.dataset<double>("/bands/edge", {kAnySize});
  if (content.bands.edges_nm.size() < 2) throw std::out_of_range("bands");
  const auto of_band = file.dataset<std::uint32_t>("/bands/class", {content.bands.size()});
  auto& classes = content.classes;
  classes.of_band.assign(of_band.begin(), of_band.end());
  classes.luminous = file.text_attribute("/classes", "mean") == "luminous";
  const std::size_t n_finishes = content.zone.finishes.size();
  const Shape shape{kAnySize, n_finishes};
  const auto diffuse = file.dataset<double>("/classes/diffuse", shape),
             ior = file.dataset<double>("/classes/ior", shape),
             extinction = file.dataset<double>("/classes/extinction", shape),
             constant = file.dataset<double>("/classes/specular_reflectance", shape);
  for (std::size_t i = 0; i < diffuse.size(); ++i) {
    if (i % n_finishes == 0) classes.of_finish.emplace_back();
    BandReflection reflection{diffuse.at(i), content.zone.finishes[i % n_finishes].specular, ior.at(i),
                              extinction.at(i), {}};
    if (constant.at(i) != kFresnel) reflection.constant = constant[i];
    classes.of_finish.back().push_back(reflection);
  }
  for (const auto q : classes.of_band)
    if (q >= classes.size()) throw std::out_of_range("class");
}

void store_photometry(Hdf5Writer& file, const ResultContent& content) {
  std::vector<float> cd;
  for (const auto& p : content.photometry) cd.insert(cd.end(), p.intensity_cd.begin(), p.intensity_cd.end());
  file.dataset<float>("/photometry/intensity", cd, {content.photometry.size(), kShownPlanes, kShownGammas}, "cd",
                      "by photometry, C in steps of 5 degrees, gamma in steps of 1 degree, before factors");
}

void load_photometry(const Hdf5Reader& file, ResultContent& content) {
  const auto values =
      file.dataset<float>("/photometry/intensity", {content.photometry.size(), kShownPlanes, kShownGammas});
  auto from = values.begin();
  for (auto& p : content.photometry) {
    p.intensity_cd.assign(from, from + kShownPlanes * kShownGammas);
    from += kShownPlanes * kShownGammas;
    if (!std::all_of(p.intensity_cd.begin(), p.intensity_cd.end(), [](float cd) { return cd >= 0.0F; }))
      throw std::out_of_range("intensity");
    content.intensities.push_back(shown_intensity(p.intensity_cd));
  }
}

void load_directional(const Hdf5Reader& file, ResultContent& content) {
  if (!file.has("/directional/cells")) return;
  content.directional_grid = {static_cast<int>(file.integer_attribute("/directional", "slices")),
                              static_cast<int>(file.integer_attribute("/directional", "sectors"))};
  if (content.directional_grid.n_slices < 1 || content.directional_grid.n_sectors < 1)
    throw std::out_of_range("directional");
  content.off_specular = file.dataset<std::uint32_t>("/directional/cells", {kAnySize});
  for (std::size_t i = 0; i < content.off_specular.size(); ++i) {
    if (content.off_specular[i] >= content.n_cells ||
        (i > 0 && content.off_specular[i] <= content.off_specular[i - 1]))
      throw std::out_of_range("directional");
  }
}

class OnDisk : public TransferStore {
 public:
  OnDisk(Hdf5Reader file, std::string path, const ResultContent& content)
      : file_(std::move(file)), path_(std::move(path)) {
    for (const auto part : kTransferParts) {
      Shape shape = shape_of(content, part);
      std::size_t& n = n_of_source_[static_cast<std::size_t>(part)];
      n = 1;
      for (const std::size_t size : shape) n *= size;
      if (is_lobe(part) && content.off_specular.empty()) continue;
      shape.insert(shape.begin(), content.sources.size());
      if (file_.shape(dataset_of(part)) != shape)
        throw IoError(path_, std::string("dataset '") + dataset_of(part) + "' has another shape than it should");
    }
  }

  std::vector<float> of_source(TransferPart part, std::size_t source) const override {
    std::vector<float> values(n_of_source_[static_cast<std::size_t>(part)]);
    if (!values.empty()) file_.read_rows(dataset_of(part), source, 1, std::span(values));
    return values;
  }

 private:
  Hdf5Reader file_;
  std::string path_;
  std::size_t n_of_source_[std::size(kTransferParts)] = {};
};

}  // namespace

std::string save_lum(const std::string& path, const Zone& zone, const Cells& cells, const Lights& lights,
                     const Solution& solution, const std::string& rays_hash, const Job& job) {
  const ResultContent content = content_of(zone, lights, solution);
  Hdf5Writer file("lum", kLumVersion);
  store_zone(file, zone);
  file.text("/description", description_of(content));
  file.attribute("/", "rays_hash", rays_hash);
  store_bands(file, content);
  store_spectra(file, content.spectra);
  store_cells(file, zone, cells);
  store_photometry(file, content);
  store_transfer(file, content, solution);
  return std::move(file).write(path, job);
}

LumFile load_lum(const std::string& path, const Job& job) {
  Hdf5Reader file(path, "lum", kLumVersion, job, kLumVersion);
  LumFile lum;
  ResultContent& content = lum.content;
  content.zone = load_zone(file, path);
  lum.hash = file.hash();
  lum.rays_hash = file.text_attribute("/", "rays_hash");
  try {
    content.n_cells = file.shape("/cells/area").at(0);
    load_bands(file, content);
    read_description(file.text("/description"), path, content);
    load_spectra(file, path, content.spectra);
    load_photometry(file, content);
    load_directional(file, content);
    content.n_direct_classes = file.shape("/transfer/cell_direct").at(1);
    if (content.n_direct_classes != 1 && content.n_direct_classes != content.classes.size())
      throw std::out_of_range("direct classes");
  } catch (const std::out_of_range&) {
    throw IoError(path, "this luminance database does not hold together");
  }
  lum.light = std::make_unique<OnDisk>(std::move(file), path, content);
  return lum;
}

}  // namespace dim
