#include "hemisphere/turn.hpp"

#include "catch.hpp"

using namespace dim;

TEST_CASE("Cosine and sine of turns agree with the library's to 1e-11", "[hemisphere][unit]") {
  for (int i = 0; i <= 100000; ++i) {
    const double turn = i / 100000.0;
    const Vec2 p = cos_sin_of_turn(turn);
    REQUIRE(std::abs(p.x - std::cos(2 * kPi * turn)) < 1e-11);
    REQUIRE(std::abs(p.y - std::sin(2 * kPi * turn)) < 1e-11);
  }
}
