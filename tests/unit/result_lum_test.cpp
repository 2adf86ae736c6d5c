// .lum files: what was solved comes back, mixes are sums, forgeries are refused.
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "base/hdf5_file.hpp"
#include "image/render.hpp"
#include "property/transport_support.hpp"
#include "result/light_colour.hpp"
#include "result/lum_file.hpp"
#include "result/luminous.hpp"
#include "result/spectra_storage.hpp"
#include "unit/files_support.hpp"
#include "unit/forged_file.hpp"

using namespace dim;
using namespace dim::test;
using files_test::Folder;
using files_test::ForgedFile;
using files_test::io_error;

namespace {

Zone lit_zone() {
  Zone zone = furnished_room(0.5, 0.9);
  zone.finishes[0].diffuse = SpectralCurve({{380, 0.2}, {780, 0.8}});
  for (int i = 0; i < 4; ++i) zone.points.push_back({{-1.0 + i, 0.5, -0.3}, {0, 0, 1}});
  zone.point_sets.push_back({"line", 0, 4});
  return zone;
}

Lights two_lamps() {
  Lights lights = point_lamp({-2, 0, 1.2}, 200.0);
  add_lamp(lights, "panel", {1, 1, 1.3}, IntensityTable::lambertian(300.0),
           {.opening = rectangle(0.6, 0.3), .factor = 0.75, .group = "row"});
  lights.fittings[1].spectrum = SpectralCurve({{380, 1.0}, {780, 0.2}});
  lights.fittings[1].has_spectrum = true;
  return lights;
}

SimulationOptions three_bands() {
  SimulationOptions options;
  options.bands = Bands::uniform(3);
  return options;
}

// A database forged by `change`, read whole.
std::string refusal(const std::function<void(const ForgedFile&)>& change, const std::string& path) {
  const Zone zone = box_zone({2, 2, 2}, 0.5, 2.0);
  const Lights lights = point_lamp({0, 0, 0}, 1.0);
  const Cells cells(zone);
  save_lum(path, zone, cells, lights, solve(zone, lights, network_of(zone, {1, 1})), "hash");
  change(ForgedFile(path));
  return io_error([&] {
    const LuminanceDatabase database(path);
    cell_illuminance_lx(database, Mix(database.sources().size(), 1.0));
  });
}

// The same with its description changed.
std::string described(const std::function<void(nlohmann::json&)>& change, const std::string& path) {
  return refusal(
      [&](const ForgedFile& file) {
        auto json = nlohmann::json::parse(file.text("/description"));
        change(json);
        file.replace_text("/description", json.dump());
      },
      path);
}

}  // namespace

TEST_CASE("A luminance database gives back what was solved", "[result][unit]") {
  const Folder folder;
  const Zone zone = lit_zone();
  const Cells cells(zone);
  const Lights lights = two_lamps();
  const Solution solution = solve(zone, lights, network_of(zone, {4, 6}), three_bands());
  const std::string hash = save_lum(folder / "a.lum", zone, cells, lights, solution, "abc");
  const LuminanceDatabase database(folder / "a.lum");
  CHECK(database.hash() == hash);
  CHECK(database.rays_hash() == "abc");
  CHECK(database.n_cells() == cells.size());
  CHECK(database.bands().edges_nm == solution.bands.edges_nm);
  CHECK(database.zone().surfaces.size() == zone.surfaces.size());
  REQUIRE(database.sources().size() == 2);
  const std::size_t n = cells.size();
  for (std::size_t s = 0; s < 2; ++s) {
    const auto &a = database.sources()[s], &b = solution.sources[s];
    CHECK(a.name == b.name);
    CHECK(a.group == b.group);
    CHECK(a.luminaires == b.luminaires);
    CHECK(a.flux_lm == b.flux_lm);
    CHECK(a.weights == b.weights);
    CHECK(a.iterations == b.iterations);
    CHECK(a.residual == b.residual);
    CHECK(a.error_bound == b.error_bound);
    REQUIRE(a.energy.size() == 3);
    for (std::size_t band = 0; band < 3; ++band) {
      CHECK(a.energy[band].emitted_W == b.energy[band].emitted_W);
      CHECK(a.energy[band].absorbed_W == b.energy[band].absorbed_W);
      CHECK(a.energy[band].escaped_W == b.energy[band].escaped_W);
      CHECK(a.energy[band].lost_W == b.energy[band].lost_W);
      CHECK(a.energy[band].dropped_W == b.energy[band].dropped_W);
      CHECK(a.energy[band].imbalance == b.energy[band].imbalance);
    }
    const auto on_cells = database.transfer(TransferPart::cell_total, s);
    CHECK(on_cells.size() == 3 * n);
    CHECK(std::equal(on_cells.begin(), on_cells.end(), &solution.cell_total[solution.cell_row(s, 0)]));
    const auto at_points = database.transfer(TransferPart::point_total, s);
    CHECK(std::equal(at_points.begin(), at_points.end(), &solution.point_total[solution.point_row(s, 0)]));
    // No mirror: one class of direct light for all bands.
    CHECK(database.transfer(TransferPart::cell_direct, s).size() == n);
    const auto irradiance = database.cell_irradiance(s), direct = database.direct_cell_irradiance(s);
    for (std::size_t band = 0; band < 3; ++band) {
      const double watts = b.weights.share[band] / b.weights.efficacy_lm_W;
      for (std::size_t i = 0; i < n; i += 5) {
        CHECK(irradiance[band * n + i] == Approx(watts * static_cast<double>(on_cells[band * n + i])).epsilon(1e-6));
        CHECK(direct[band * n + i] == Approx(watts * static_cast<double>(solution.cell_direct[s * n + i])).epsilon(1e-6));
      }
    }
  }
  REQUIRE(database.spectra().size() == 2);
  CHECK(database.spectra()[0].curve.points() == lights.fittings[0].spectrum.points());
  CHECK_FALSE(database.spectra()[0].known);
  CHECK(database.spectra()[1].curve.points() == lights.fittings[1].spectrum.points());
  CHECK(database.spectra()[1].known);
  REQUIRE(database.luminaires().size() == 2);
  const auto& shown = database.luminaires()[1];
  CHECK(shown.name == "panel");
  CHECK(shown.source == 1);
  CHECK(shown.at == lights.luminaires[1].at);
  CHECK(shown.aim == lights.luminaires[1].aim);
  CHECK(shown.c0 == lights.luminaires[1].c0);
  CHECK(shown.c90 == lights.luminaires[1].c90);
  CHECK(shown.factor == 0.75);
  CHECK(shown.opening.shape == OpeningShape::kRectangle);
  CHECK(shown.opening.length_m == 0.6);
  CHECK(shown.opening.width_m == 0.3);
  REQUIRE(database.photometry().size() == 2);
  CHECK(database.photometry()[shown.photometry].mean[60] == Approx(300.0 * 0.5).epsilon(1e-9));

  // Any mix is the weighted sum; illuminance of both kinds agrees with the solution's own numbers.
  const Mix mix = {0.5, 2.0};
  const auto cell = cell_illuminance_lx(database, mix), point = point_illuminance_lx(database, mix);
  const auto a = cell_lx(solution, 0), b = cell_lx(solution, 1);
  for (std::size_t i = 0; i < n; ++i) CHECK(cell[i] == Approx(0.5 * a[i] + 2.0 * b[i]).epsilon(1e-12));
  const auto c = test::point_lx(solution, 0), d = test::point_lx(solution, 1);
  for (std::size_t i = 0; i < 4; ++i) CHECK(point[i] == Approx(0.5 * c[i] + 2.0 * d[i]).epsilon(1e-12));

  // What an eye sees of a cell is what its reflectance makes of each band: rho E / pi.
  const auto appearance = cell_appearance(database, cells, mix);
  for (std::size_t i = 0; i < n; i += 7) {
    CHECK(appearance.illuminance_lx[i] == Approx(cell[i]).epsilon(1e-12));
    double luminance = 0.0;
    for (std::size_t s = 0; s < 2; ++s) {
      for (std::size_t band = 0; band < 3; ++band) {
        const double rho = 0.2 + 0.6 * (static_cast<double>(band) + 0.5) / 3.0;  // middle of a straight line
        const auto& weights = solution.sources[s].weights;
        const double lumens = 683.0 * weights.y[band] * weights.share[band] / weights.efficacy_lm_W;
        luminance += mix[s] * lumens * rho / kPi *
                     static_cast<double>(solution.cell_total[solution.cell_row(s, band) + i]);
      }
    }
    CHECK(appearance.xyz_cd_m2[i].y == Approx(luminance).epsilon(1e-9));
  }
}

TEST_CASE("A forged luminance database is refused by the name of what is wrong", "[result][unit]") {
  const Folder folder;
  const std::string path = folder / "a.lum";
  using Json = nlohmann::json;
  const auto names = [&](const std::string& what, const std::function<void(const ForgedFile&)>& change) {
    const std::string refused = refusal(change, path);
    CAPTURE(what, refused);
    CHECK(refused.find(what) != std::string::npos);
    CHECK(refused.find('\n') == std::string::npos);
  };
  CHECK(refusal([](const ForgedFile&) {}, path).empty());
  const std::vector<double> six(6, 4.0), five(5, 4.0);
  names("'/cells/area'", [&](auto& f) { f.replace("/cells/area", five, {5}); });
  names("'/cells/area'", [&](auto& f) { f.replace("/cells/area", {1.0}, {}); });
  names("element 3 is nan", [&](auto& f) {
    f.replace("/cells/area", {4, 4, 4, std::nan(""), 4, 4}, {6});
  });
  names("not those of its zone", [&](auto& f) { f.replace("/cells/area", {4, 4, 4, 3, 4, 4}, {6}); });
  names("'/cells/surface'", [&](auto& f) {
    f.replace("/cells/surface", {0, 1, 2, 3, 4, 6}, {6}, H5T_STD_U32LE);
  });
  names("'/cells/surface' has 0 cells on surface", [&](auto& f) {
    f.replace("/cells/surface", {0, 1, 2, 3, 4, 4}, {6}, H5T_STD_U32LE);
  });
  names("'/transfer/cell_total': element 2 is -1", [&](auto& f) {
    f.replace("/transfer/cell_total", {1, 1, -1, 1, 1, 1}, {1, 1, 6}, H5T_IEEE_F32LE);
  });
  names("'/transfer/cell_total' holds float64", [&](auto& f) {
    f.replace("/transfer/cell_total", {1, 1, 1, 1, 1, 1}, {1, 1, 6});
  });
  names("'/transfer/cell_total' has shape [1, 6]", [&](auto& f) {
    f.replace("/transfer/cell_total", {1, 1, 1, 1, 1, 1}, {1, 6}, H5T_IEEE_F32LE);
  });
  names("'/bands/class'", [&](auto& f) { f.replace("/bands/class", {1}, {1}, H5T_STD_U32LE); });
  names("'/bands/edge'", [&](auto& f) { f.replace("/bands/edge", {780, 380}, {2}); });
  names("'/classes/diffuse'", [&](auto& f) { f.replace("/classes/diffuse", {1.5}, {1, 1}); });
  names("'/classes/specular_reflectance'", [&](auto& f) {
    f.replace("/classes/specular_reflectance", {-0.5}, {1, 1});
  });
  names("no dataset '/spectra/first'", [&](auto& f) { f.remove("/spectra/first"); });
  names("'unit_m' of '/zone' is not a single value", [](auto& f) {
    f.replace_attribute("/zone", "unit_m", 1.0, 4096);
  });
  names("'unit_m' of '/zone' is -1", [](auto& f) { f.replace_attribute("/zone", "unit_m", -1.0); });

  const auto tells = [&](const std::string& what, const std::function<void(Json&)>& change) {
    const std::string refused = described(change, path);
    CAPTURE(what, refused);
    CHECK(refused.find(what) != std::string::npos);
  };
  CHECK(described([](Json&) {}, path).empty());
  tells("luminaires[0].source", [](Json& j) { j["luminaires"][0]["source"] = 1; });
  tells("luminaires[0].source", [](Json& j) { j["luminaires"][0]["source"] = -1; });
  tells("luminaires[0].photometry", [](Json& j) { j["luminaires"][0]["photometry"] = 9; });
  tells("luminaires[0].at", [](Json& j) { j["luminaires"][0]["at"] = {1.0}; });
  tells("luminaires[0] has axes", [](Json& j) { j["luminaires"][0]["aim"] = {0.0, 0.0, 2.0}; });
  tells("mean_intensity_cd", [](Json& j) { j["photometry"][0]["mean_intensity_cd"] = {1.0, 2.0}; });
  tells("sources[0].weights.y", [](Json& j) { j["sources"][0]["weights"]["y"] = Json::array(); });
  tells("efficacy_lm_W", [](Json& j) { j["sources"][0]["weights"]["efficacy_lm_W"] = 0.0; });
  tells("sources[0].flux_lm is -1", [](Json& j) { j["sources"][0]["flux_lm"] = -1.0; });
  tells("sources[0].name", [](Json& j) { j["sources"][0]["name"] = 3; });
  tells("source", [](Json& j) { j["sources"] = Json::array(); });
  tells("2 sources", [](Json& j) { j["sources"].push_back(j["sources"][0]); });
}

TEST_CASE("Spectra that do not hold together are refused", "[result][unit]") {
  const Folder folder;
  const std::string path = folder / "a.lum";
  const auto read = [&](std::vector<std::uint32_t> of_source, std::vector<std::uint64_t> first,
                        std::vector<double> points) {
    Hdf5Writer file("lum", kLumVersion);
    file.dataset<std::uint32_t>("/spectra/of_source", of_source, {of_source.size()}, "1");
    file.dataset<std::uint64_t>("/spectra/first", first, {first.size()}, "1");
    file.dataset<double>("/spectra/point", points, {points.size() / 2, 2}, "nm, 1");
    std::move(file).write(path);
    std::vector<ShownSpectrum> spectra(1);
    return io_error([&] { load_spectra(Hdf5Reader(path, "lum", kLumVersion), path, spectra); }).empty();
  };
  CHECK(read({0}, {0, 2}, {400, 1, 700, 2}));
  CHECK_FALSE(read({1}, {0, 2}, {400, 1, 700, 2}));     // no such spectrum
  CHECK_FALSE(read({0, 0}, {0, 2}, {400, 1, 700, 2}));  // more sources than there are
  CHECK_FALSE(read({0}, {0, 3}, {400, 1, 700, 2}));     // more points than there are
  CHECK_FALSE(read({0}, {2, 0}, {400, 1, 700, 2}));     // backwards
  CHECK_FALSE(read({0}, {0, 0}, {400, 1, 700, 2}));     // no points
  CHECK_FALSE(read({0}, {0, 2}, {700, 1, 400, 2}));     // descending
  CHECK_FALSE(read({0}, {0, 2}, {400, -1, 700, 2}));    // negative
  CHECK_FALSE(read({0}, {0, 2}, {400, std::nan(""), 700, 2}));
}

TEST_CASE("Tables and pictures from memory are those from the file, to the bit", "[result][unit]") {
  const Folder folder;
  Zone zone = lit_zone();
  // A lobe and a mirror, so that every part of the light is there.
  for (const double roughness : {0.3, 0.0}) {
    zone.surfaces[roughness > 0.0 ? 0U : 2U].finish = add_grey(zone, 0.3);
    zone.finishes.back().specular = 0.4;
    zone.finishes.back().roughness = roughness;
    zone.finishes.back().ior = SpectralCurve({{380, 1.7}, {780, 1.4}});
  }
  const Cells cells(zone);
  const Lights lights = two_lamps();
  const Solution solution = solve(zone, lights, network_of(zone, {4, 6}), three_bands());
  REQUIRE(solution.n_direct_classes == 3);
  REQUIRE_FALSE(solution.directional.cells.empty());
  save_lum(folder / "a.lum", zone, cells, lights, solution, "abc");
  const LuminanceDatabase from_file(folder / "a.lum"), from_memory(zone, cells, lights, solution);
  for (const auto part : kTransferParts) {
    for (std::size_t s = 0; s < 2; ++s) CHECK(from_file.transfer(part, s) == from_memory.transfer(part, s));
  }
  const Mix mix = {0.5, 2.0};
  CHECK(point_illuminance_lx(from_file, mix) == point_illuminance_lx(from_memory, mix));
  const auto one = cell_appearance(from_file, cells, mix), other = cell_appearance(from_memory, cells, mix);
  CHECK(one.illuminance_lx == other.illuminance_lx);
  CHECK(one.xyz_cd_m2 == other.xyz_cd_m2);
  const auto colour = LightColours(from_file).at_points(mix)[2];
  const double ra = LightColours(from_memory).at_points(mix)[2].ra;
  CHECK((colour.ra == ra || (std::isnan(colour.ra) && std::isnan(ra))));
  RenderOptions options;
  options.view.eye = {-2.7, -1.6, 0.2};
  options.view.focus = {1, 0.5, -0.5};
  options.view.width = 24;
  options.view.height = 18;
  options.spectral = true;
  options.samples = 1;
  options.shading = Shading::gather;
  const auto a = render_view(from_file, cells, mix, options, Job{}),
             b = render_view(from_memory, cells, mix, options, Job{});
  CHECK(a.xyz == b.xyz);
  CHECK(a.radiance == b.radiance);
  CHECK(*std::max_element(a.xyz.begin(), a.xyz.end()) > 0.0F);
}
