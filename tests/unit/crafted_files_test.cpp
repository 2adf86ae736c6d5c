// Files whose checksum is right and whose contents are not: each is refused by the name of what is wrong and its value.
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "network/network_storage.hpp"
#include "property/transport_support.hpp"
#include "result/database.hpp"
#include "result/lum_file.hpp"
#include "unit/forged_file.hpp"

using namespace dim;
using namespace dim::test;
using files_test::Folder;
using files_test::ForgedFile;
using files_test::io_error;
using Json = nlohmann::json;

namespace {

using Change = std::function<void(const ForgedFile&)>;

// A cube of six cells, with a point and a view.
Zone cube() {
  Zone zone = box_zone({2, 2, 2}, 0.5, 2.0);
  zone.points.push_back({{0, 0, 0}, {0, 0, 1}});
  zone.point_sets.push_back({"point", 0, 1, {}});
  zone.views.push_back({"view", {0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 1.0, 64, 48});
  return zone;
}

std::string rays_refused(const std::string& path, const Change& change) {
  const Zone zone = cube();
  save_rays(path, zone, Cells(zone), network_of(zone, {1, 1}));
  change(ForgedFile(path));
  return io_error([&] { load_rays(path); });
}

std::string lum_refused(const std::string& path, const Change& change) {
  const Zone zone = cube();
  const Cells cells(zone);
  const Lights lights = point_lamp({0, 0, 0}, 1.0);
  save_lum(path, zone, cells, lights, solve(zone, lights, network_of(zone, {1, 1})), std::string(32, '0'));
  change(ForgedFile(path));
  return io_error([&] {
    const LuminanceDatabase database(path);
    database.transfer(TransferPart::cell_total, 0);
  });
}

Change described(const std::function<void(Json&)>& change) {
  return [change](const ForgedFile& file) {
    Json json = Json::parse(file.text("/zone/description"));
    change(json);
    file.replace_text("/zone/description", json.dump());
  };
}

void says(const std::string& refused, const std::string& words) {
  CAPTURE(refused, words);
  CHECK(refused.find(words) != std::string::npos);
  CHECK(refused.find('\n') == std::string::npos);
}

}  // namespace

TEST_CASE("A crafted ray network is refused by what is wrong and its value", "[network][unit]") {
  const Folder folder;
  const std::string path = folder / "a.rays";
  const double nan = std::nan("");
  CHECK(rays_refused(path, [](auto&) {}).empty());
  says(rays_refused(path, [](auto& f) { f.replace("/cells/area", {4.0}, {}); }), "'/cells/area' has shape []");
  says(rays_refused(path, [](auto& f) { f.replace_attribute("/network", "slices", 1, 4096); }),
       "'slices' of '/network' is not a single value");
  says(rays_refused(path,
                    [&](auto& f) {
                      f.remove("/network/visible");
                      H5Lcreate_external((folder / "other").c_str(), "/x", f.id(), "/network/visible", H5P_DEFAULT,
                                         H5P_DEFAULT);
                    }),
       "'/network/visible' is a link to elsewhere");
  says(rays_refused(path, [&](auto& f) { f.replace("/zone/surfaces/frame", std::vector<double>(72, nan), {6, 4, 3}); }),
       "'/zone/surfaces/frame': element 0 is nan");
  says(rays_refused(path, described([](Json& j) { j["finishes"][0]["diffuse"][0][1] = -0.25; })),
       "finishes[0].diffuse[0][1] is -0.25");
  says(rays_refused(path, [&](auto& f) { f.replace("/network/visible", {1, 1, nan, 1, 1, 1}, {6}); }),
       "'/network/visible': element 2 is nan");
  says(rays_refused(path, [](auto& f) { f.replace("/network/column_scale", {1, 1, -1, 1, 1, 1}, {6}); }),
       "'/network/column_scale': element 2 is -1");
}

TEST_CASE("A crafted luminance database is refused by what is wrong and its value", "[result][unit]") {
  const Folder folder;
  const std::string path = folder / "a.lum";
  const auto totals = [](const std::vector<double>& values, hsize_t n) {
    return [=](const ForgedFile& f) { f.replace("/transfer/cell_total", values, {1, 1, n}, H5T_IEEE_F32LE); };
  };
  CHECK(lum_refused(path, [](auto&) {}).empty());
  says(lum_refused(path, [](auto& f) { f.replace_attribute("/zone", "unit_m", 1, 4096); }),
       "'unit_m' of '/zone' is not a single value");
  says(lum_refused(path, totals({1, 1, std::nan(""), 1, 1, 1}, 6)), "'/transfer/cell_total': element 2 is nan");
  says(lum_refused(path, totals({1, 1, 1, 1, 1}, 5)), "'/transfer/cell_total' has shape [1, 1, 5]");
  says(lum_refused(path, totals({1, 1, -1, 1, 1, 1}, 6)), "'/transfer/cell_total': element 2 is -1");
  says(lum_refused(path, described([](Json& j) { j["views"][0]["fov_rad"] = 7.0; })), "views[0].fov_rad is 7");
}

TEST_CASE("Coefficients of parts that the sky of a file has not are refused", "[result][unit]") {
  const Folder folder;
  const auto refused = [&](int subdivision, const char* part, int patch) {
    return lum_refused(folder / "a.lum", [&](const ForgedFile& file) {
      Json json = Json::parse(file.text("/description"));
      if (subdivision >= 0)
        json["sky"] = {{"subdivision", subdivision}, {"horizontal_lx", 0.0}, {"ground_reflectance", 0.2}};
      json["sources"][0]["daylight"] = {{"part", part}, {"patch", patch}, {"state", ""}, {"as_it_stands", true}};
      file.replace_text("/description", json.dump());
    });
  };
  for (const auto& [part, patch] : {std::pair{"sky", 144}, {"ramp", 6}, {"ground", -1}})
    CHECK(refused(1, part, patch).empty());
  CHECK(refused(0, "sun", -1).empty());
  const std::string words = "sources[0].daylight is of a part of the sky that the file has not";
  for (const auto& [part, patch] :
       {std::pair{"sky", 145}, {"sky", -1}, {"ramp", 7}, {"ramp", -1}, {"ground", 0}, {"sun", -1}}) {
    CAPTURE(part, patch);
    says(refused(1, part, patch), words);
  }
  says(refused(0, "sky", 3), words);
  says(refused(0, "ramp", 0), words);
  says(refused(-1, "sky", -1), words);
}
