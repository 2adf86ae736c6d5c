#include <hdf5.h>

#include <chrono>
#include <cstring>
#include <limits>
#include <numeric>
#include <thread>

#include "base/hdf5_file.hpp"
#include "base/version.hpp"
#include "catch.hpp"
#include "files_support.hpp"

using dim::Hdf5Reader;
using dim::Hdf5Writer;
using dim::kAnySize;
using dim::Shape;
using files_test::contents;
using files_test::Folder;
using files_test::io_error;

namespace {

Hdf5Writer sample() {
  Hdf5Writer writer("rays", 1);
  const std::vector<double> areas = {0.25, 0.5, 1.0};
  const std::vector<std::uint16_t> sinks = {0, 1, 2, 3, 4, 65535};
  writer.dataset<double>("/cells/area_m2", areas, {3}, "m2", "area of each cell");
  writer.dataset<std::uint16_t>("/network/sinks", sinks, {3, 2}, "1");
  writer.strings("/surfaces/name", {"floor", "wänd", "", "a b"});
  writer.text("/zone/toml", "dim = \"zone/1\"\n");
  writer.attribute("/network", "patches", 2);
  writer.attribute("/network", "tolerance", 1e-3);
  return writer;
}

template <class T>
void check_round_trip(const Folder& folder) {
  using Limits = std::numeric_limits<T>;
  const std::vector<T> values = {Limits::lowest(), Limits::max(), T{0}, T{1}, Limits::min(), T{42}};
  Hdf5Writer writer("lum", 1);
  writer.dataset<T>("/a/b/c", values, {3, 2}, "cd/m2");
  std::move(writer).write(folder / "t.lum");
  const Hdf5Reader reader(folder / "t.lum", "lum", 1);
  CHECK(reader.dataset<T>("/a/b/c", {3, 2}) == values);
  CHECK(reader.type("/a/b/c") == dim::element_type<T>());
  CHECK(reader.shape("/a/b/c") == Shape{3, 2});
  CHECK(reader.text_attribute("/a/b/c", "unit") == "cd/m2");
}

std::string refusal(const Folder& folder, auto&& use) {
  const Hdf5Reader reader(folder / "a.rays", "rays", 1);
  const std::string message = io_error([&] { use(reader); });
  const std::string place = (folder / "a.rays") + ": ";
  return message.starts_with(place) ? message.substr(place.size()) : "";
}

}  // namespace

TEST_CASE("Arrays of every type come back as they went in", "[base][unit]") {
  const Folder folder;
  check_round_trip<std::uint8_t>(folder);
  check_round_trip<std::uint16_t>(folder);
  check_round_trip<std::uint32_t>(folder);
  check_round_trip<std::uint64_t>(folder);
  check_round_trip<std::int32_t>(folder);
  check_round_trip<std::int64_t>(folder);
  check_round_trip<float>(folder);
  check_round_trip<double>(folder);
}

TEST_CASE("Not-a-numbers and infinities keep their bits", "[base][unit]") {
  const Folder folder;
  const std::vector<double> values = {std::numeric_limits<double>::quiet_NaN(),
                                      -std::numeric_limits<double>::infinity(), -0.0, 5e-324};
  Hdf5Writer writer("lum", 1);
  writer.dataset<double>("/x", values, {4}, "1");
  std::move(writer).write(folder / "x");
  const auto read = Hdf5Reader(folder / "x", "lum", 1).dataset<double>("/x", {4});
  CHECK(std::memcmp(read.data(), values.data(), sizeof(double) * values.size()) == 0);
}

TEST_CASE("Strings, texts and attributes come back as they went in", "[base][unit]") {
  const Folder folder;
  Hdf5Writer writer = sample();
  const std::string long_text(200'000, 'z');
  const std::string odd_text("\0a\0\n\xff\0", 6);
  writer.text("/text/long", long_text);
  writer.text("/text/odd", odd_text);
  writer.text("/text/empty", "");
  writer.strings("/text/none", {});
  std::vector<std::string> many;
  for (int i = 0; i < 5000; ++i) many.push_back("surface " + std::to_string(i));
  writer.strings("/text/many", many);
  writer.attribute("/cells/area_m2", "negative", -3);
  std::move(writer).write(folder / "a.rays");

  const Hdf5Reader reader(folder / "a.rays", "rays", 1);
  CHECK(reader.version() == 1);
  CHECK(reader.strings("/surfaces/name") == std::vector<std::string>{"floor", "wänd", "", "a b"});
  CHECK(reader.text("/zone/toml") == "dim = \"zone/1\"\n");
  CHECK(reader.text("/text/long") == long_text);
  CHECK(reader.text("/text/odd") == odd_text);
  CHECK(reader.text("/text/empty").empty());
  CHECK(reader.strings("/text/none").empty());
  CHECK(reader.strings("/text/many") == many);
  CHECK(reader.integer_attribute("/network", "patches") == 2);
  CHECK(reader.integer_attribute("/cells/area_m2", "negative") == -3);
  CHECK(reader.number_attribute("/network", "tolerance") == 1e-3);
  CHECK(reader.number_attribute("/network", "patches") == 2.0);
  CHECK(reader.text_attribute("/cells/area_m2", "description") == "area of each cell");
  CHECK(reader.text_attribute("/surfaces/name", "unit") == "1");
  CHECK(reader.text_attribute("/", "dim_format") == "rays");
  CHECK(reader.text_attribute("/", "dim_program") == dim::version());
  CHECK(reader.has("/"));
  CHECK(reader.has("/cells"));
  CHECK(reader.has("/cells/area_m2"));
  CHECK_FALSE(reader.has("/cells/none"));
  CHECK_FALSE(reader.has("/none/area_m2"));
  CHECK(reader.has_attribute("/network", "patches"));
  CHECK_FALSE(reader.has_attribute("/network", "none"));
  CHECK_FALSE(reader.has_attribute("/none", "patches"));
}

TEST_CASE("Single values and empty arrays have shapes", "[base][unit]") {
  const Folder folder;
  Hdf5Writer writer("lum", 1);
  writer.dataset<double>("/single", std::vector<double>{7.5}, {}, "1");
  writer.dataset<float>("/none", {}, {0, 5}, "1");
  std::move(writer).write(folder / "x");
  const Hdf5Reader reader(folder / "x", "lum", 1);
  CHECK(reader.dataset<double>("/single", {}) == std::vector<double>{7.5});
  CHECK(reader.dataset<float>("/none", {kAnySize, 5}).empty());
  CHECK(reader.shape("/none") == Shape{0, 5});
}

TEST_CASE("The same content gives the same bytes, whenever it is written", "[base][unit]") {
  const Folder folder;
  const std::string first_hash = sample().write(folder / "a.rays");
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // times in HDF5 count seconds
  Hdf5Writer second = sample();
  Hdf5Writer third = sample();
  CHECK(std::move(third).write(folder / "c.rays") == first_hash);
  CHECK(std::move(second).write(folder / "b.rays") == first_hash);
  CHECK(contents(folder / "a.rays") == contents(folder / "b.rays"));
  CHECK(contents(folder / "a.rays") == contents(folder / "c.rays"));
  CHECK(Hdf5Reader(folder / "a.rays", "rays", 1).hash() == first_hash);
}

TEST_CASE("Another content gives another hash", "[base][unit]") {
  const Folder folder;
  Hdf5Writer other = sample();
  other.attribute("/network", "seed", 1);
  CHECK(std::move(other).write("/dev/null") != sample().write("/dev/null"));
}

TEST_CASE("Rows are read from anywhere in an array", "[base][unit]") {
  const Folder folder;
  std::vector<std::uint32_t> values(1000 * 7);
  std::iota(values.begin(), values.end(), 0U);
  Hdf5Writer writer("rays", 1);
  writer.dataset<std::uint32_t>("/x", values, {1000, 7}, "1");
  std::move(writer).write(folder / "a.rays");
  const Hdf5Reader reader(folder / "a.rays", "rays", 1);
  std::vector<std::uint32_t> rows(3 * 7);
  reader.read_rows<std::uint32_t>("/x", 500, 3, rows);
  CHECK(std::equal(rows.begin(), rows.end(), values.begin() + 500 * 7));
  reader.read_rows<std::uint32_t>("/x", 1000, 0, {});
  std::vector<double> wide(7);
  reader.read_rows<double>("/x", 999, 1, wide);
  CHECK(wide.back() == 6999.0);

  CHECK(refusal(folder, [&](auto& r) { r.template read_rows<std::uint32_t>("/x", 998, 3, rows); }) ==
        "dataset '/x' has 1000 rows; 3 from row 998 on were expected");
  CHECK_FALSE(refusal(folder, [&](auto& r) {
                r.template read_rows<std::uint32_t>("/x", kAnySize, 3, rows);
              }).empty());
  CHECK_THROWS_AS(reader.read_rows<std::uint32_t>("/x", 0, 2, rows), dim::InternalError);
}

TEST_CASE("Numbers are widened but never narrowed", "[base][unit]") {
  const Folder folder;
  sample().write(folder / "a.rays");
  const Hdf5Reader reader(folder / "a.rays", "rays", 1);
  CHECK(reader.dataset<std::uint32_t>("/network/sinks", {3, 2}).back() == 65535U);
  CHECK(reader.dataset<std::int32_t>("/network/sinks", {3, 2}).back() == 65535);
  CHECK(reader.dataset<float>("/network/sinks", {3, 2}).back() == 65535.0F);

  CHECK(refusal(folder, [](auto& r) {
          r.template dataset<std::uint8_t>("/network/sinks", {3, 2});
        }) == "dataset '/network/sinks' holds uint16, expected uint8");
  CHECK(refusal(folder, [](auto& r) { r.template dataset<float>("/cells/area_m2", {3}); }) ==
        "dataset '/cells/area_m2' holds float64, expected float32");
  CHECK(refusal(folder, [](auto& r) { r.template dataset<std::int64_t>("/cells/area_m2", {3}); }) ==
        "dataset '/cells/area_m2' holds float64, expected int64");
}

TEST_CASE("What is not in the file as expected is refused by name", "[base][unit]") {
  const Folder folder;
  sample().write(folder / "a.rays");
  CHECK(refusal(folder, [](auto& r) { r.template dataset<double>("/cells/x", {3}); }) ==
        "holds no dataset '/cells/x'");
  CHECK(refusal(folder, [](auto& r) { r.shape("/cells"); }) == "holds no dataset '/cells'");
  CHECK(refusal(folder, [](auto& r) { r.template dataset<double>("/cells/area_m2", {4}); }) ==
        "dataset '/cells/area_m2' has shape [3], expected [4]");
  CHECK(refusal(folder, [](auto& r) { r.template dataset<std::uint16_t>("/network/sinks", {kAnySize}); }) ==
        "dataset '/network/sinks' has shape [3, 2], expected [*]");
  CHECK(refusal(folder, [](auto& r) { r.type("/zone/toml"); }) ==
        "dataset '/zone/toml' holds no numbers that DIM writes");
  CHECK(refusal(folder, [](auto& r) { r.text("/surfaces/name"); }) == "dataset '/surfaces/name' is no text");
  CHECK(refusal(folder, [](auto& r) { r.text("/cells/area_m2"); }) == "dataset '/cells/area_m2' is no text");
  CHECK(refusal(folder, [](auto& r) { r.strings("/cells/area_m2"); }) ==
        "dataset '/cells/area_m2' is no list of strings");
  CHECK(refusal(folder, [](auto& r) { r.text_attribute("/network", "patches"); }) ==
        "attribute 'patches' of '/network' is no text");
  CHECK(refusal(folder, [](auto& r) { r.integer_attribute("/network", "tolerance"); }) ==
        "attribute 'tolerance' of '/network' is no integer");
  CHECK(refusal(folder, [](auto& r) { r.number_attribute("/cells/area_m2", "unit"); }) ==
        "attribute 'unit' of '/cells/area_m2' is no number");
  CHECK(refusal(folder, [](auto& r) { r.number_attribute("/network", "none"); }) ==
        "holds no attribute 'none' of '/network'");
}

TEST_CASE("A writer used wrongly says so", "[base][unit]") {
  Hdf5Writer writer = sample();
  const std::vector<double> three = {1, 2, 3};
  CHECK_THROWS_AS(writer.dataset<double>("/x", three, {2, 2}, "1"), dim::InternalError);
  CHECK_THROWS_AS(writer.dataset<double>("/x", three, {kAnySize, kAnySize}, "1"), dim::InternalError);
  CHECK_THROWS_AS(writer.dataset<double>("/cells/area_m2", three, {3}, "m2"), dim::InternalError);
  CHECK_THROWS_AS(writer.dataset<double>("x", three, {3}, "m2"), dim::InternalError);
  CHECK_THROWS_AS(writer.dataset<double>("/x/", three, {3}, "m2"), dim::InternalError);
  CHECK_THROWS_AS(writer.attribute("/network", "patches", 3), dim::InternalError);
  CHECK_THROWS_AS(writer.attribute("/", "big", ~std::uint64_t{0}), dim::InternalError);
  CHECK_THROWS_AS(writer.strings("/s", {std::string("a\0b", 3)}), dim::InternalError);
  CHECK_THROWS_AS(Hdf5Writer("two words", 1).write("/dev/null"), dim::InternalError);
}

TEST_CASE("HDF5 itself opens the file by its name and finds the content", "[base][unit]") {
  const Folder folder;
  sample().write(folder / "a.rays");
  const hid_t file = H5Fopen((folder / "a.rays").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  REQUIRE(file >= 0);
  const hid_t set = H5Dopen2(file, "/cells/area_m2", H5P_DEFAULT);
  std::vector<double> areas(3);
  CHECK(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, areas.data()) >= 0);
  CHECK(areas == std::vector<double>{0.25, 0.5, 1.0});
  hsize_t size = 0;
  CHECK(H5Fget_filesize(file, &size) >= 0);
  CHECK(size == contents(folder / "a.rays").size());
  H5Dclose(set);
  H5Fclose(file);
}

TEST_CASE("An existing file survives a failed write of a database", "[base][unit]") {
  const Folder folder;
  sample().write(folder / "a.rays");
  const std::string before = contents(folder / "a.rays");
  CHECK(io_error([&] { sample().write("/dev/full"); }) == "/dev/full: cannot write: No space left on device");
  CHECK_FALSE(io_error([&] { sample().write(folder / "no/a.rays"); }).empty());
  CHECK(contents(folder / "a.rays") == before);
  CHECK(folder.n_files() == 1);
}
