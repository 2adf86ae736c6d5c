// Pictures against closed forms.
#include "image/render.hpp"

#include "catch.hpp"
#include "geometry/perspective.hpp"
#include "image/light_field.hpp"
#include "property/transport_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

View view_of(const Vec3& eye, const Vec3& focus, int width, int height, double fov_deg = 80.0) {
  View view;
  view.eye = eye;
  view.focus = focus;
  view.fov_rad = radians(fov_deg);
  view.width = width;
  view.height = height;
  return view;
}

// A database of given illuminances of the cells, all of it indirect.
LuminanceDatabase database_of(const Zone& zone, const Lights& lights, const std::vector<double>& cell_lx) {
  const Cells cells(zone);
  Solution solution;
  Source source;
  source.name = source.group = "lamp";
  source.luminaires = {"lamp"};
  source.flux_lm = 1.0;
  source.weights = band_weights(SpectralCurve(1.0), Bands{});
  solution.sources = {source};
  solution.classes = classify(zone, solution.bands);
  solution.n_cells = cells.size();
  solution.cell_direct.assign(cells.size(), 0.0F);
  for (const double lx : cell_lx) solution.cell_total.push_back(static_cast<float>(lx));
  return {zone, cells, lights, std::move(solution)};
}

LuminanceDatabase uniform_database(const Zone& zone, const Lights& lights, double illuminance_lx) {
  return database_of(zone, lights, std::vector<double>(Cells(zone).size(), illuminance_lx));
}

}  // namespace

TEST_CASE("A picture of a uniform closed room shows rho E over pi everywhere", "[image][unit]") {
  const Zone zone = furnished_room(0.6, 0.7);
  const auto database = uniform_database(zone, point_lamp({0, 0, 0}, 0.0), 500.0);
  const Cells cells(database.zone());
  RenderOptions options;
  options.view = view_of({-2.7, -1.6, 0.2}, {1, 0.5, -0.5}, 60, 45);
  options.shading = GENERATE(Shading::cell, Shading::smooth, Shading::gather);
  options.samples = GENERATE(1, 2);
  options.scalar = GENERATE(ScalarQuantity::illuminance, ScalarQuantity::luminance);
  const Raster raster = render_view(database, cells, {1.0}, options, Job{});
  check_raster(raster);
  const double luminance = 0.6 * 500.0 / kPi;
  const double scalar = options.scalar == ScalarQuantity::illuminance ? 500.0 : luminance;
  double worst = 0.0;
  for (std::size_t i = 0; i < raster.n_pixels(); ++i) {
    worst = std::max(worst, std::abs(static_cast<double>(raster.xyz[3 * i + 1]) / luminance - 1.0));
    worst = std::max(worst, std::abs(static_cast<double>(raster.scalar[i]) / scalar - 1.0));
  }
  CHECK(worst < 1e-6);  // single precision
}

TEST_CASE("A mix scales a picture and nothing lit is black", "[image][unit]") {
  const Zone zone = box_zone({4, 3, 2}, 0.5, 0.5);
  const auto database = uniform_database(zone, point_lamp({0, 0, 0}, 0.0), 100.0);
  RenderOptions options;
  options.view = view_of({0, 0, 0}, {1, 0, 0}, 8, 6);
  const Cells cells(database.zone());
  for (const double factor : {0.0, 0.25}) {
    const Raster raster = render_view(database, cells, {factor}, options, Job{});
    for (std::size_t i = 0; i < raster.n_pixels(); ++i)
      CHECK(static_cast<double>(raster.xyz[3 * i + 1]) == Approx(factor * 50.0 / kPi).epsilon(1e-6));
  }
}

TEST_CASE("Out of an open side nothing is seen", "[image][unit]") {
  Zone zone = box_zone({4, 3, 2}, 0.5, 0.5);
  zone.surfaces.pop_back();  // x1
  const auto database = uniform_database(zone, point_lamp({0, 0, 0}, 0.0), 100.0);
  RenderOptions options;
  options.view = view_of({0, 0, 0}, {1, 0, 0}, 8, 6, 20.0);
  const Raster raster = render_view(database, Cells(database.zone()), {1.0}, options, Job{});
  for (std::size_t i = 0; i < raster.n_pixels(); ++i) {
    CHECK(raster.xyz[3 * i + 1] == 0.0F);
    CHECK(std::isnan(raster.scalar[i]));
  }
}

TEST_CASE("An opening shows its intensity over its projected area", "[image][unit]") {
  const Zone zone = box_zone({8, 8, 8}, 0.0, 8.0);
  // Neither Lambertian nor isotropic: I = 100 (1 - gamma / 90 deg), piecewise linear, so exact in between.
  const IntensityTable table({{0.0, 2 * kPi}, {0.0, kPi / 2}, {100.0, 0.0, 100.0, 0.0}});
  Lights lights;
  add_lamp(lights, "lamp", {0, 0, 1}, table, {.opening = rectangle(0.8, 0.4), .factor = 2.0});
  const auto database = uniform_database(zone, lights, 0.0);
  const Cells cells(database.zone());
  for (const double gamma_deg : {0.0, 30.0, 60.0, 75.0}) {
    const double gamma = radians(gamma_deg);
    const Vec3 eye = Vec3(0, 0, 1) + 3.0 * Vec3(std::sin(gamma), 0, -std::cos(gamma));
    RenderOptions options;
    options.view = view_of(eye, {0, 0, 1}, 1, 1, 0.01);
    const Raster raster = render_view(database, cells, {0.5}, options, Job{});
    const double luminance = 0.5 * 2.0 * 100.0 * (1 - gamma_deg / 90.0) / (0.32 * std::cos(gamma));
    CHECK(static_cast<double>(raster.xyz[1]) == Approx(luminance).epsilon(1e-4));
    CHECK(std::isnan(raster.scalar[0]));
  }
}

TEST_CASE("The light in a picture of an opening is the illuminance it gives the eye", "[image][unit]") {
  // Sum over pixels of L cos(theta) d omega, the pixel's solid angle being cos^3 / f^2 in pixels, against
  // Lambert's formula for the same opening: two programs' parts that share nothing.
  const Zone zone = box_zone({8, 8, 8}, 0.0, 8.0);
  const bool round = GENERATE(false, true);
  Lights lights;
  add_lamp(lights, "lamp", {0.2, 0.1, 1}, IntensityTable::lambertian(100.0),
           {.opening = round ? LuminousOpening{OpeningShape::kEllipse, 0.8, 0.8, 0.0} : rectangle(0.8, 0.8)});
  const auto database = uniform_database(zone, lights, 0.0);
  const Vec3 eye(0, 0, -0.5);
  RenderOptions options;
  options.view = view_of(eye, {0, 0, 1}, 200, 200, 60.0);
  options.view.up = {0, 1, 0};
  const Raster raster = render_view(database, Cells(database.zone()), {1.0}, options, Job{});
  const Perspective camera({eye, {0, 0, 1}, {0, 1, 0}, radians(60.0), 200, 200});
  const double focal_px = 100.0 / std::tan(radians(30.0));
  double lux = 0.0;
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      const double cosine = camera.direction(x + 0.5, y + 0.5).z;
      lux += static_cast<double>(raster.xyz[3 * static_cast<std::size_t>(y * 200 + x) + 1]) *
             std::pow(cosine, 4) / (focal_px * focal_px);
    }
  }
  Ring3 outline;
  const int n = round ? 3600 : 4;
  for (int i = 0; i < n; ++i) {
    const double turn = 2 * kPi * (i + 0.5) / n, r = round ? 0.4 : 0.4 * std::sqrt(2.0);
    outline.push_back({0.2 + r * std::cos(turn), 0.1 + r * std::sin(turn), 1.0});
  }
  const double area = round ? kPi * 0.16 : 0.64;
  // Pixels of the edge: some 0.1 % at 3 x 3 rays each.
  CHECK(lux == Approx(lambert_lx(eye, {0, 0, 1}, outline, 100.0 / area)).epsilon(1.5e-3));
}

TEST_CASE("Smooth shading is bilinear between the middles of cells", "[image][unit]") {
  Zone zone;
  zone.diameter_m = 5.0;
  add_grey(zone, 0.5);
  add_floor(zone, {0, 0}, {4, 2}, 0.0, 4, 2);
  const Cells cells(zone);
  std::vector<double> lx;
  // 10 u + 100 v at the middles: bilinear gives the plane back.
  for (std::size_t i = 0; i < cells.size(); ++i)
    lx.push_back(10 * cells[i].centroid.x + 100 * cells[i].centroid.y);
  const auto database = database_of(zone, point_lamp({1, 1, 1}, 0.0), lx);
  const LightChannels channels(database, {1.0});
  const LightField smooth(database, cells, {1.0}, channels, Shading::smooth),
      flat(database, cells, {1.0}, channels, Shading::cell);
  const auto at = [&](const LightField& field, const Vec2& p) {
    Light light(channels.size(), 0.0);
    field.add_irradiance(0, p, light);
    return light[0] * channels.xyz(0).y;
  };
  for (const Vec2& p : {Vec2(0.5, 0.5), Vec2(1.3, 0.9), Vec2(3.49, 1.49), Vec2(2.0, 1.0)})
    CHECK(at(smooth, p) == Approx(10 * p.x + 100 * p.y).epsilon(1e-6));
  CHECK(at(smooth, {0.0, 0.0}) == Approx(55.0).epsilon(1e-6));  // constant beyond the outer middles
  CHECK(at(smooth, {4.0, 2.0}) == Approx(185.0).epsilon(1e-6));
  CHECK(at(flat, {1.3, 0.9}) == Approx(65.0).epsilon(1e-6));
}

TEST_CASE("The scene's white is its sources' colours by their flux", "[image][unit]") {
  const Zone zone = box_zone({4, 3, 2}, 0.5, 1.0);
  const auto database = uniform_database(zone, point_lamp({0, 0, 0}, 0.0), 100.0);
  const Vec3 white = scene_white(database, {2.0});
  CHECK(white.y == 1.0);
  CHECK(white.x == Approx(source_xyz(database.sources()[0]).x));
  CHECK(scene_white(database, {0.0}) == Vec3(1.0));
}
