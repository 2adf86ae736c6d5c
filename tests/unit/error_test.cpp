#include "base/error.hpp"

#include "catch.hpp"

TEST_CASE("A problem prints as file:line:column: what, with the cure below", "[base][unit]") {
  CHECK(dim::to_string({{"room.toml", 14, 11}, "surface 'floor': zero area", "give it three corners"}) ==
        "room.toml:14:11: surface 'floor': zero area\n        give it three corners");
  CHECK(dim::to_string({{"a.ies", 3, 0}, "bad", ""}) == "a.ies:3: bad");
}

TEST_CASE("Problems keep the first twenty and count the rest", "[base][unit]") {
  dim::Problems problems;
  CHECK_NOTHROW(problems.throw_if_any());
  for (int i = 0; i < 25; ++i) problems.add({"f", i + 1, 1}, "wrong");
  try {
    problems.throw_if_any();
    FAIL("nothing thrown");
  } catch (const dim::InputError& error) {
    CHECK(error.problems().size() == 20);
    CHECK(error.n_found() == 25);
  }
}

TEST_CASE("The nearest name is suggested only when it is near", "[base][unit]") {
  const std::vector<std::string> names = {"troffer-3600", "downlight", "high-bay"};
  CHECK(dim::nearest_name("trofer-3600", names) == "troffer-3600");
  CHECK(dim::nearest_name("something else", names).empty());
}
