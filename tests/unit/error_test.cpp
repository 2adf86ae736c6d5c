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

TEST_CASE("Problems are reported in the order of the file, files in the order they came", "[base][unit]") {
  dim::Problems problems;
  problems.add({"z", 3, 8}, "third");
  problems.add({"a", 1, 1}, "fourth");
  problems.add({"z", 2, 8}, "first");
  problems.add({"z", 3, 2}, "second");
  try {
    problems.throw_if_any();
    FAIL("nothing thrown");
  } catch (const dim::InputError& error) {
    REQUIRE(error.problems().size() == 4);
    CHECK(error.problems()[0].what == "first");
    CHECK(error.problems()[1].what == "second");
    CHECK(error.problems()[2].what == "third");
    CHECK(error.problems()[3].what == "fourth");
  }
}

TEST_CASE("The nearest name is suggested only when it is near", "[base][unit]") {
  const std::vector<std::string> names = {"troffer-3600", "downlight", "high-bay"};
  CHECK(dim::nearest_name("trofer-3600", names) == "troffer-3600");
  CHECK(dim::nearest_name("something else", names).empty());
  CHECK(dim::nearest_name("ligth", {"dark", "light"}) == "light");
  CHECK(dim::nearest_name("drak", {"light", "dark"}) == "dark");
}

TEST_CASE("The cure for an unknown name is the nearest one, else the names there are", "[base][unit]") {
  CHECK(dim::name_cure("trofer", {"troffer", "spot"}) == "did you mean 'troffer'?");
  CHECK(dim::name_cure("nothing like it", {"a", "b", "a"}) == "there is 'a', 'b'");
  CHECK(dim::name_cure("nothing like it", {}) == "there is none");
  const std::vector<std::string> many = {"1", "2", "3", "4", "5", "6", "7", "8", "9", "10"};
  CHECK(dim::name_cure("nothing like it", many).ends_with("'8' and 2 more"));
}
