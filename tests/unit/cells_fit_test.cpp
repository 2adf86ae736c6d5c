#include <string>

#include "catch.hpp"
#include "geometry/cell_grid.hpp"
#include "rooms.hpp"

using namespace dim;

TEST_CASE("The number of squares is known without making the grid", "[geometry][unit]") {
  const Polygon wall({{0, 0, 0}, {7.2, 0, 0}, {7.2, 0, 2.8}, {0, 0, 2.8}});
  CHECK(n_squares(wall, 0.25) == 29 * 12);
  CHECK(n_squares(wall, 0.25, std::pair{3, 4}) == 12);
  CHECK(n_squares(wall, 1e-9) == Approx(7.2e9 * 2.8e9));
}

TEST_CASE("A zone whose cells cannot fit is refused with their number, their memory and the option",
          "[scene][unit]") {
  constexpr std::size_t kGiB = std::size_t{1} << 30;
  CHECK_NOTHROW(check_cells_fit(test::box_zone({4, 3, 2.5}, 0.5, 0.1), kGiB));
  try {
    check_cells_fit(test::box_zone({4, 3, 2.5}, 0.5, 1e-3), kGiB);
    FAIL("nothing thrown");
  } catch (const LimitError& error) {
    const std::string words = error.what();
    CHECK(words.find("5.9e+07 cells") != std::string::npos);  // 2 (12 + 10 + 7.5) m2 of 1e-6 m2 each
    CHECK(words.find("1 GiB are free") != std::string::npos);
    CHECK(words.find("--cell") != std::string::npos);
  }
}
