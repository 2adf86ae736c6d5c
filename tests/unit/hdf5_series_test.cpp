#include "base/hdf5_series.hpp"

#include <hdf5.h>
#include <hdf5_hl.h>

#include <numeric>

#include "catch.hpp"
#include "files_support.hpp"

using namespace dim;
using files_test::Folder;
using files_test::io_error;

namespace {

constexpr std::size_t kRows = 1000, kColumns = 130;

/// A table whose values tell their place, written in three parts.
void write_sample(const std::string& path) {
  Hdf5Series file(path, "hourly", 1);
  std::vector<double> steps(kRows);
  std::iota(steps.begin(), steps.end(), 1.0);
  file.numbers("step", steps, "h", "end of the step");
  file.texts("point", std::vector<std::string>(kColumns, "plane[0]"), "measuring point");
  file.table("illuminance", "step", "point", "lx", "by daylight");
  for (const auto& [first, n] : {std::pair<std::size_t, std::size_t>{0, 50}, {50, 70}, {120, 10}}) {
    std::vector<float> values;
    for (std::size_t row = 0; row < kRows; ++row)
      for (std::size_t k = 0; k < n; ++k) values.push_back(static_cast<float>(1000 * row + first + k));
    file.columns(first, n, values);
  }
  file.commit();
}

}  // namespace

TEST_CASE("A series is a chunked table on dimension scales with units", "[base][hdf5][unit]") {
  const Folder folder;
  const std::string path = folder / "year.h5";
  write_sample(path);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  REQUIRE(file >= 0);
  const hid_t table = H5Dopen2(file, "illuminance", H5P_DEFAULT);
  REQUIRE(table >= 0);
  std::vector<float> values(kRows * kColumns);
  REQUIRE(H5Dread(table, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
  CHECK(values[0] == 0.0F);
  CHECK(values[7 * kColumns + 129] == 7129.0F);
  CHECK(values[999 * kColumns + 60] == 999060.0F);
  CHECK(H5DSget_num_scales(table, 0) == 1);
  CHECK(H5DSget_num_scales(table, 1) == 1);
  const hid_t step = H5Dopen2(file, "step", H5P_DEFAULT);
  CHECK(H5DSis_scale(step) > 0);
  CHECK(H5DSis_attached(table, step, 0) > 0);
  const hid_t properties = H5Dget_create_plist(table);
  CHECK(H5Pget_layout(properties) == H5D_CHUNKED);
  CHECK(H5Aexists(table, "unit") > 0);
  H5Pclose(properties);
  H5Dclose(step);
  H5Dclose(table);
  H5Fclose(file);
}

TEST_CASE("A series without a commit leaves no file, and devices are refused", "[base][hdf5][unit]") {
  const Folder folder;
  const std::string path = folder / "year.h5";
  { Hdf5Series file(path, "hourly", 1); }
  CHECK(std::filesystem::is_empty(std::filesystem::path(path).parent_path()));
  CHECK_THROWS_AS(Hdf5Series("/dev/null", "hourly", 1), IoError);
  CHECK_THROWS_AS(Hdf5Series(folder / "no/year.h5", "hourly", 1), IoError);
}
