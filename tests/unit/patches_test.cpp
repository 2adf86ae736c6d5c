#include "hemisphere/patches.hpp"

#include "base/error.hpp"
#include "catch.hpp"

using namespace dim;

TEST_CASE("Patch weights add up to pi for any number of slices and sectors", "[hemisphere][unit]") {
  for (const PatchGrid grid : {PatchGrid{1, 1}, PatchGrid{5, 10}, PatchGrid{16, 32}, PatchGrid{1000, 1000}}) {
    double sum = 0.0;
    for (int slice = 0; slice < grid.n_slices; ++slice) sum += grid.n_sectors * grid.weight_sr(slice);
    CHECK(sum == Approx(kPi).epsilon(1e-12));
  }
}

TEST_CASE("Every direction drawn in a patch lies in that patch", "[hemisphere][property]") {
  const PatchGrid grid{7, 11};
  for (int slice = 0; slice < 7; ++slice) {
    for (int sector = 0; sector < 11; ++sector) {
      const auto patch = static_cast<std::size_t>(slice * 11 + sector);
      for (const double s : {0.0001, 0.5, 0.9999}) {
        const Vec3 d = grid.direction(slice, sector, s, 1.0 - s);
        CHECK(glm::length(d) == Approx(1.0).epsilon(1e-11));
        CHECK(grid.patch_of(d) == patch);
      }
      CHECK(grid.patch_of(grid.centre(slice, sector)) == patch);
    }
  }
}

TEST_CASE("Inside a patch the mean of 1/cos over draws is what cosine density makes it",
          "[hemisphere][unit]") {
  // With density proportional to cos over cos in [c0, c1], E[1/cos] = 2/(c0 + c1): the weight w_k = cos_k
  // omega is then unbiased, because w_k * E[1/cos] equals the patch's plain solid angle.
  const PatchGrid grid{4, 8};
  double sum = 0.0;
  constexpr int kDraws = 20000;
  for (int i = 0; i < kDraws; ++i) sum += 1.0 / grid.direction(1, 3, (i + 0.5) / kDraws, 0.5).z;
  CHECK(sum / kDraws * grid.weight_sr(1) == Approx(grid.solid_angle_sr()).epsilon(1e-6));
}

TEST_CASE("Patches are given as AxB or as a total", "[hemisphere][unit]") {
  CHECK(parse_patches("16x32", "--patches") == PatchGrid{16, 32});
  CHECK(parse_patches("50", "--patches") == PatchGrid{5, 10});
  CHECK(parse_patches("1", "--patches") == PatchGrid{1, 1});
  for (const char* wrong : {"", "x", "0", "-3", "4x", "x4", "4x0", "3.5", "1e9", "99999x99999", "16x32x2"})
    CHECK_THROWS_AS(parse_patches(wrong, "--patches"), InputError);
}
