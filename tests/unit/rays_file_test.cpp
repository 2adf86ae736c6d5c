// .rays files: whole round trips in both widths of sinks, and forgeries.
#include <algorithm>

#include "catch.hpp"
#include "network/network_storage.hpp"
#include "property/transport_support.hpp"
#include "scene/zone_storage.hpp"
#include "unit/files_support.hpp"

using namespace dim;
using namespace dim::test;
using files_test::Folder;
using files_test::io_error;

namespace {

void check_same(const SinkTable& a, const SinkTable& b) {
  REQUIRE(a.n_rows() == b.n_rows());
  REQUIRE(a.n_patches() == b.n_patches());
  CHECK(a.wide() == b.wide());
  CHECK(std::equal(a.narrow().begin(), a.narrow().end(), b.narrow().begin(), b.narrow().end()));
  CHECK(std::equal(a.wide_entries().begin(), a.wide_entries().end(), b.wide_entries().begin(),
                   b.wide_entries().end()));
}

void check_same(const Network& a, const Network& b) {
  CHECK(a.patches == b.patches);
  CHECK(a.point_patches == b.point_patches);
  CHECK(a.sampling == b.sampling);
  CHECK(a.seed == b.seed);
  check_same(a.sinks, b.sinks);
  check_same(a.point_sinks, b.point_sinks);
  CHECK(a.extra.first == b.extra.first);
  CHECK(a.extra.cell == b.extra.cell);
  CHECK(a.extra.weight == b.extra.weight);
  CHECK(a.visible == b.visible);
  CHECK(a.row_scale == b.row_scale);
  CHECK(a.column_scale == b.column_scale);
  CHECK(a.imbalance == b.imbalance);
  CHECK(a.n_escaped_rays == b.n_escaped_rays);
  CHECK(a.n_back_rays == b.n_back_rays);
  CHECK(a.point_back_fraction == b.point_back_fraction);
}

Zone zone_with_points() {
  Zone zone = furnished_room(0.5, 0.8);
  zone.surfaces.erase(zone.surfaces.begin() + 1);
  for (int i = 0; i < 3; ++i) zone.points.push_back({{-1.0 + i, 0.5, -0.3}, {0, 0, 1}});
  zone.point_sets.push_back({"line", 0, 3});
  return zone;
}

Network coarse_network(const Zone& zone, NetworkOptions options = {}) {
  options.patches = {2, 3};
  options.point_patches = {3, 4};
  return build_network(zone, Cells(zone), options, Job{});
}

}  // namespace

TEST_CASE("A network comes back from its file whole", "[network][unit]") {
  const Folder folder;
  const Zone zone = zone_with_points();
  NetworkOptions options;
  options.seed = 0xFEDCBA9876543210ULL;
  options.sampling = GENERATE(Sampling::stratified, Sampling::centre);
  options.family = GENERATE(false, true);
  const Network network = coarse_network(zone, options);
  CHECK(network.has_family() == options.family);
  const std::string hash = save_rays(folder / "a.rays", zone, Cells(zone), network);
  const RaysFile file = load_rays(folder / "a.rays");
  CHECK(file.hash == hash);
  check_same(file.network, network);
  CHECK(Cells(file.zone).size() == Cells(zone).size());
  // Written again it is the same file.
  CHECK(save_rays(folder / "b.rays", file.zone, Cells(file.zone), file.network) == hash);
}

TEST_CASE("More than 65,535 cells take sinks of four bytes", "[network][unit]") {
  const Folder folder;
  Zone zone = box_zone({2, 2, 2}, 0.5, 2.0);
  for (auto& surface : zone.surfaces) surface.grid = {105, 105};
  const Cells cells(zone);
  REQUIRE(cells.size() == 66150);
  NetworkOptions options;
  options.patches = {1, 2};
  const Network network = build_network(zone, cells, options, Job{});
  REQUIRE(network.sinks.wide());
  // Some ray ends on a cell that two bytes could not count.
  const auto sinks = network.sinks.wide_entries();
  CHECK(*std::max_element(sinks.begin(), sinks.end()) > 0xFFFF);
  save_rays(folder / "a.rays", zone, cells, network);
  check_same(load_rays(folder / "a.rays").network, network);
  const auto direct = Columns<double>::from_rows(std::vector<double>(cells.size(), 1.0), 1);
  const auto gathered =
      gather(network, cells, direct, Columns<double>(0, 1), {1, std::vector<double>(6, 0.5), {0}}, {}, Job{});
  for (std::size_t i = 0; i < cells.size(); ++i)
    REQUIRE(gathered.cell.value(i, 0) == Approx(2.0).epsilon(1e-6));
}

TEST_CASE("The widest network of two-byte sinks keeps 'nowhere' apart from its last cell",
          "[network][unit]") {
  const SinkTable narrow(1, 1, 0xFFFF), wide(1, 1, 0x10000);
  CHECK_FALSE(narrow.wide());
  CHECK(wide.wide());
  SinkTable table(1, 2, 0xFFFF);
  table.set(0, 0, 0xFFFE);
  table.set(0, 1, 0xFFFF);
  CHECK(table.at(0, 0) == 0xFFFE);
  CHECK(table.at(0, 1) == 0xFFFF);
}

TEST_CASE("A network that names cells out of range is refused", "[network][unit]") {
  const Folder folder;
  const std::string path = folder / "a.rays";
  const Zone zone = zone_with_points();
  const Cells cells(zone);
  const auto n_cells = static_cast<std::uint32_t>(cells.size());
  const auto refused = [&](auto&& forge, bool family = false) {
    NetworkOptions options;
    options.family = family;
    Network network = coarse_network(zone, options);
    forge(network);
    save_rays(path, zone, cells, network);
    return io_error([&] { load_rays(path); });
  };
  CHECK(refused([](Network&) {}).empty());
  CHECK(refused([](Network&) {}, true).empty());
  CHECK(refused([&](Network& n) { n.sinks.set(1, 2, n_cells + 1); }).find("sinks") != std::string::npos);
  CHECK(refused([&](Network& n) { n.point_sinks.set(2, 11, 0xFFFF); }).find("point_sinks") !=
        std::string::npos);
  CHECK_FALSE(refused([](Network& n) { n.visible.pop_back(); }).empty());
  CHECK_FALSE(refused([](Network& n) { n.row_scale.push_back(1.0); }).empty());
  CHECK_FALSE(refused([](Network& n) { n.point_back_fraction.clear(); }).empty());
  CHECK_FALSE(refused([](Network& n) { n.patches = {3, 3}; }).empty());
  CHECK_FALSE(refused([](Network& n) { n.patches = {0, 6}; }).empty());
  CHECK_FALSE(refused([](Network& n) { n.column_scale[3] = std::nan(""); }).empty());
  CHECK_FALSE(refused([](Network& n) { n.column_scale[3] = 0.0; }).empty());
  const auto names = [&](const std::string& dataset, auto&& forge, bool family = false) {
    const std::string message = refused(forge, family);
    CAPTURE(message);
    CHECK(message.find("'/network/" + dataset + "'") != std::string::npos);
  };
  names("visible", [](Network& n) { n.visible[0] = std::nan(""); });
  names("visible", [](Network& n) { n.visible[0] = 1.1; });
  names("point_back_fraction", [](Network& n) { n.point_back_fraction[1] = -0.1; });
  names("row_scale", [](Network& n) { n.row_scale[2] = -1.0; });
  names("family/weight", [](Network& n) { std::fill(n.extra.weight.begin(), n.extra.weight.end(), -100.0); }, true);
  names("family/weight", [](Network& n) { n.extra.weight[0] += 0.5; }, true);
  names("family/first", [](Network& n) { n.extra.first[0] = 1; }, true);
  CHECK_FALSE(refused([&](Network& n) { n.extra.cell[0] = n_cells; }, true).empty());
  CHECK_FALSE(refused([](Network& n) { n.extra.first[1] = 1u << 30; }, true).empty());
  CHECK_FALSE(refused([](Network& n) { n.extra.weight.pop_back(); }, true).empty());
}

TEST_CASE("A network whose cells are not those of its zone is refused in one line", "[network][unit]") {
  const Folder folder;
  const std::string path = folder / "a.rays";
  Zone zone = zone_with_points();
  const Cells cells(zone);
  const Network network = coarse_network(zone, {});
  const auto message = [&] {
    save_rays(path, zone, cells, network);
    return io_error([&] { load_rays(path); });
  };
  REQUIRE(message().empty());
  // A panel has come in since, whose foot divides cells of the floor.
  test::add_surface(zone, "panel", {{0.1, 0.1, -1}, {0.1, 0.4, -1}, {0.1, 0.4, 0}, {0.1, 0.1, 0}}, 0, 0.5);
  const std::string said = message();
  CAPTURE(said);
  CHECK(said.find("the zone asks for") != std::string::npos);
}

TEST_CASE("A network file with a seed that is no number is refused", "[network][unit]") {
  const Folder folder;
  const std::string path = folder / "a.rays";
  Hdf5Writer file("rays", kRaysVersion);
  const Zone zone = box_zone({2, 2, 2}, 0.5, 2.0);
  store_zone(file, zone);
  store_cells(file, zone, Cells(zone));
  for (const char* name : {"slices", "sectors", "point_slices", "point_sectors", "escaped_rays", "back_rays"})
    file.attribute("/network", name, 1);
  file.attribute("/network", "imbalance", 0.0);
  file.attribute("/network", "sampling", "centre");
  file.attribute("/network", "seed", "many");
  std::move(file).write(path);
  CHECK_FALSE(io_error([&] { load_rays(path); }).empty());
}
