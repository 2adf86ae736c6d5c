#include "result/lum_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/file_layout.hpp"
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
    case TransferPart::point_cells:
      return "/error/point_cells";
    case TransferPart::point_rays:
      return "/error/point_rays";
    case TransferPart::point_cell_rays:
      return "/error/point_cell_rays";
    case TransferPart::point_direct_deviation:
      return "/error/point_direct_deviation";
    case TransferPart::surface_cells:
      return "/surface_error/cells";
    case TransferPart::surface_rays:
      return "/surface_error/rays";
    case TransferPart::surface_direct_deviation:
      return "/surface_error/direct_deviation";
  }
  throw InternalError("part of a solution of no name");
}

// Shape of a part after its sources.
Shape shape_of(const ResultContent& content, TransferPart part) {
  switch (part) {
    case TransferPart::cell_direct:
      return {content.n_direct_classes, content.cells.size()};
    case TransferPart::cell_total:
      return {content.classes.size(), content.cells.size()};
    case TransferPart::point_direct:
    case TransferPart::point_direct_deviation:
      return {content.n_direct_classes, content.zone.points.size()};
    case TransferPart::point_total:
    case TransferPart::point_cells:
    case TransferPart::point_rays:
    case TransferPart::point_cell_rays:
      return {content.classes.size(), content.zone.points.size()};
    case TransferPart::surface_direct_deviation:
      return {content.n_direct_classes, content.zone.surfaces.size()};
    case TransferPart::surface_cells:
    case TransferPart::surface_rays:
      return {content.classes.size(), content.zone.surfaces.size()};
    case TransferPart::lobe_direct:
    case TransferPart::lobe_total:
      return {content.classes.size(), content.off_specular.size(), content.directional_grid.n_patches()};
  }
  throw InternalError("part of a solution of no name");
}

bool is_lobe(TransferPart part) {
  return part == TransferPart::lobe_direct || part == TransferPart::lobe_total;
}

// Not known of every solution.
bool is_error(TransferPart part) {
  return part == TransferPart::point_cells || part == TransferPart::point_rays ||
         part == TransferPart::point_cell_rays || part == TransferPart::point_direct_deviation ||
         part == TransferPart::surface_cells || part == TransferPart::surface_rays ||
         part == TransferPart::surface_direct_deviation;
}

void store_transfer(Hdf5Writer& file, const ResultContent& content, const Solution& solution) {
  for (const auto part : kTransferParts) {
    if ((is_lobe(part) || is_error(part)) && part_of(solution, part).empty()) continue;
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
  std::vector<double> diffuse, ior, extinction, constant, transmittance;
  for (const auto& finishes : classes.of_finish) {
    for (const auto& reflection : finishes) {
      diffuse.push_back(reflection.diffuse);
      ior.push_back(reflection.n);
      extinction.push_back(reflection.k);
      transmittance.push_back(reflection.transmittance);
      constant.push_back(reflection.constant.value_or(kFresnel));
    }
  }
  const Shape shape{classes.size(), content.zone.finishes.size()};
  file.dataset<double>("/classes/diffuse", diffuse, shape, "1", "k_d times diffuse reflectance");
  file.dataset<double>("/classes/ior", ior, shape, "1");
  file.dataset<double>("/classes/extinction", extinction, shape, "1");
  file.dataset<double>("/classes/specular_reflectance", constant, shape, "1", "-1: by Fresnel's equations");
  file.dataset<double>("/classes/transmittance", transmittance, shape, "1", "of glazings, at normal incidence");
  file.attribute("/classes", "mean", classes.luminous ? "luminous" : "plain");
}

void load_bands(const Hdf5Reader& file, const std::string& path, ResultContent& content) {
  content.bands.edges_nm = file.dataset<double>("/bands/edge", {kAnySize});
  const auto& edges = content.bands.edges_nm;
  const auto not_after = [](double a, double b) { return !(a < b); };
  if (edges.size() < 2 || std::adjacent_find(edges.begin(), edges.end(), not_after) != edges.end())
    throw IoError(path, "dataset '/bands/edge': wavelengths do not ascend");
  const auto of_band = file.dataset<std::uint32_t>("/bands/class", {content.bands.size()});
  auto& classes = content.classes;
  classes.of_band.assign(of_band.begin(), of_band.end());
  classes.luminous = file.text_attribute("/classes", "mean") == "luminous";
  const std::size_t n_finishes = content.zone.finishes.size();
  const Shape shape{file.size("classes"), n_finishes};
  const auto diffuse = file.dataset<double>("/classes/diffuse", shape),
             ior = file.dataset<double>("/classes/ior", shape),
             extinction = file.dataset<double>("/classes/extinction", shape),
             constant = file.dataset<double>("/classes/specular_reflectance", shape),
             transmittance = file.dataset<double>("/classes/transmittance", shape);
  for (std::size_t i = 0; i < diffuse.size(); ++i) {
    if (i % n_finishes == 0) classes.of_finish.emplace_back();
    BandReflection reflection{diffuse[i], content.zone.finishes[i % n_finishes].specular, ior[i],
                              extinction[i], {}, transmittance[i]};
    if (constant[i] != kFresnel) reflection.constant = constant[i];
    if (constant[i] > 1.0 || (constant[i] < 0.0 && constant[i] != kFresnel))
      throw IoError(path, fmt::format("dataset '/classes/specular_reflectance': element {} is {:g}, neither {:g} "
                                      "nor within 0..1",
                                      i, constant[i], kFresnel));
    classes.of_finish.back().push_back(reflection);
  }
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
    content.intensities.push_back(shown_intensity(p.intensity_cd));
  }
}

void load_directional(const Hdf5Reader& file, const std::string& path, ResultContent& content) {
  if (!file.has("/directional")) return;
  content.directional_grid = {static_cast<int>(file.integer_attribute("/directional", "slices")),
                              static_cast<int>(file.integer_attribute("/directional", "sectors"))};
  content.off_specular = file.dataset<std::uint32_t>("/directional/cells", {kAnySize});
  const auto not_after = [](std::uint32_t a, std::uint32_t b) { return a >= b; };
  if (std::adjacent_find(content.off_specular.begin(), content.off_specular.end(), not_after) !=
      content.off_specular.end())
    throw IoError(path, "dataset '/directional/cells' does not ascend");
}

// Reads row by row from the file, whose layout was checked.
class OnDisk : public TransferStore {
 public:
  OnDisk(Hdf5Reader file, const ResultContent& content) : file_(std::move(file)) {
    for (const auto part : kTransferParts) {
      std::size_t n = 1;
      for (const std::size_t size : shape_of(content, part)) n *= size;
      if (!file_.has(dataset_of(part))) n = 0;
      n_of_source_[static_cast<std::size_t>(part)] = n;
    }
  }

  std::vector<float> of_source(TransferPart part, std::size_t source) const override {
    std::vector<float> values(n_of_source_[static_cast<std::size_t>(part)]);
    if (!values.empty()) file_.read_rows(dataset_of(part), source, 1, std::span(values));
    return values;
  }

 private:
  Hdf5Reader file_;
  std::size_t n_of_source_[std::size(kTransferParts)] = {};
};

// What other datasets say must be what the description says.
void check_counts(const Hdf5Reader& file, const std::string& path, const ResultContent& content) {
  const auto same = [&](const char* what, std::size_t described, const char* size) {
    if (described != file.size(size))
      throw IoError(path, fmt::format("'/description' holds {} {}, the datasets {}", described, what, file.size(size)));
  };
  same("sources", content.sources.size(), "sources");
  same("photometries", content.photometry.size(), "photometries");
  same("finishes", content.zone.finishes.size(), "finishes");
  const std::size_t n = file.size("direct_classes");
  if (n != 1 && n != content.classes.size())
    throw IoError(path, fmt::format("dataset '/transfer/cell_direct' has {} classes, expected 1 or {}", n,
                                    content.classes.size()));
}

}  // namespace

const FileSchema& lum_schema() {
  static const FileSchema schema = [] {
    FileSchema lum = zone_schema();
    lum.add(cells_schema());
    FileSchema result;
    result.attributes = {{"/", "rays_hash", AttributeType::text},
                         {"/classes", "mean", AttributeType::text},
                         {"/directional", "slices", AttributeType::integer, 1, 1e7, true},
                         {"/directional", "sectors", AttributeType::integer, 1, 1e7, true}};
    result.datasets = {
        {"/description", "text", ""},
        {"/classes/diffuse", "float64", "classes, finishes", "1", Allowed::share},
        {"/classes/ior", "float64", "classes, finishes", "1", Allowed::not_negative},
        {"/classes/extinction", "float64", "classes, finishes", "1", Allowed::not_negative},
        {"/classes/specular_reflectance", "float64", "classes, finishes", "1", Allowed::finite},
        {"/classes/transmittance", "float64", "classes, finishes", "1", Allowed::share},
        {"/bands/class", "uint32", "bands", "1", Allowed::index, "classes"},
        {"/bands/edge", "float64", "bands+1", "nm", Allowed::positive},
        {"/transfer/cell_total", "float32", "sources, classes, cells", "lx", Allowed::not_negative, {}, false, true},
        {"/transfer/cell_direct", "float32", "sources, direct_classes, cells", "lx", Allowed::not_negative, {},
         false, true},
        {"/transfer/point_total", "float32", "sources, classes, points", "lx", Allowed::not_negative, {}, false,
         true},
        {"/transfer/point_direct", "float32", "sources, direct_classes, points", "lx", Allowed::not_negative, {},
         false, true},
        {"/directional/cells", "uint32", "lobe_cells", "1", Allowed::index, "cells", true},
        {"/directional/total", "float32", "sources, classes, lobe_cells, slices*sectors", "cd/m2",
         Allowed::not_negative, {}, true, true},
        {"/directional/direct", "float32", "sources, classes, lobe_cells, slices*sectors", "cd/m2",
         Allowed::not_negative, {}, true, true},
        {"/error/point_cells", "float32", "sources, classes, points", "lx", Allowed::finite, {}, true, true},
        {"/error/point_rays", "float32", "sources, classes, points", "lx", Allowed::finite, {}, true, true},
        {"/error/point_cell_rays", "float32", "sources, classes, points", "lx", Allowed::finite, {}, true, true},
        {"/error/point_direct_deviation", "float32", "sources, direct_classes, points", "lx", Allowed::not_negative, {},
         true, true},
        {"/surface_error/cells", "float32", "sources, classes, surfaces", "lx", Allowed::finite, {}, true, true},
        {"/surface_error/rays", "float32", "sources, classes, surfaces", "lx", Allowed::finite, {}, true, true},
        {"/surface_error/direct_deviation", "float32", "sources, direct_classes, surfaces", "lx", Allowed::not_negative,
         {}, true, true},
        {"/photometry/intensity", "float32", "photometries, 73, 181", "cd", Allowed::not_negative},
        {"/spectra/of_source", "uint32", "sources", "1", Allowed::index, "spectra"},
        {"/spectra/first", "uint64", "spectra+1"},
        {"/spectra/point", "float64", "spectrum_points, 2", "nm, 1", Allowed::not_negative}};
    return lum.add(result);
  }();
  return schema;
}

std::string save_lum(const std::string& path, const Zone& zone, const Cells& cells, const Lights& lights,
                     const Solution& solution, const std::string& rays_hash, const Job& job) {
  const ResultContent content = content_of(zone, cells, lights, solution);
  Hdf5Writer file("lum", any_bodies_measure(zone) ? kLumVersion : kPlanarLumVersion);
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
  Hdf5Reader file(path, "lum", kLumVersion, job, kPlanarLumVersion);
  file.lay_against(lum_schema(), job.memory_limit_bytes);
  LumFile lum;
  ResultContent& content = lum.content;
  content.zone = load_zone(file, path);
  content.cells = load_cells(file, content.zone, path, job);
  lum.hash = file.hash();
  lum.rays_hash = file.text_attribute("/", "rays_hash");
  load_bands(file, path, content);
  read_description(file.text("/description"), path, content);
  check_counts(file, path, content);
  load_spectra(file, path, content.spectra);
  load_photometry(file, content);
  load_directional(file, path, content);
  content.n_direct_classes = file.size("direct_classes");
  lum.light = std::make_unique<OnDisk>(std::move(file), content);
  return lum;
}

}  // namespace dim
