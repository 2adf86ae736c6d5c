// Requirements: their file, verdicts, and rooms of known light.
#include "catch.hpp"
#include "judge/check.hpp"
#include "property/transport_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

Requirements read(const std::string& text) { return read_requirements(text, "r.toml", {}); }

std::string with_head(const std::string& text) {
  return "dim = \"requirements/1\"\nsource = \"a standard\"\n" + text;
}

/// A room with one point lit by two lamps to 300 and 200 lx, its cells to 100 lx and 0 lx.
struct LitRoom {
  Zone zone = box_zone({4, 3, 2}, 0.5, 0.5);
  double error_bound = 0.0;

  LuminanceDatabase database() {
    zone.points = {{{-1, 0, 0}, {0, 0, 1}}, {{1, 0, 0}, {0, 0, 1}}};
    zone.point_sets = {{"desk", 0, 2}};
    const Cells cells(zone);
    Lights lights = point_lamp({0.5, 0, 0.9}, 100.0);
    add_lamp(lights, "second", {-0.5, 0, 0.9}, IntensityTable::isotropic(1.0), {.factor = 100.0});
    for (auto& fitting : lights.fittings) fitting.watts = 30.0;
    Solution solution;
    for (const char* name : {"lamp", "second"}) {
      Source source;
      source.name = source.group = name;
      source.luminaires = {name};
      source.flux_lm = 1000.0;
      source.weights = band_weights(SpectralCurve(1.0), Bands{});
      source.error_bound = error_bound;
      solution.sources.push_back(source);
    }
    solution.classes = classify(zone, solution.bands);
    solution.n_cells = cells.size();
    solution.n_points = 2;
    solution.cell_direct.assign(2 * cells.size(), 0.0F);
    solution.cell_total.assign(2 * cells.size(), 0.0F);
    std::fill_n(solution.cell_total.begin(), cells.size(), 100.0F);
    solution.point_direct.assign(4, 0.0F);
    solution.point_total = {300.0F, 330.0F, 200.0F, 170.0F};
    return {zone, cells, lights, std::move(solution)};
  }
};

std::vector<Finding> checked(LitRoom room, const std::string& text) {
  return check(room.database(), read(with_head(text)), {{1.0, 1.0}, {}, 0.0}, Job{});
}

}  // namespace

TEST_CASE("A limit within the error leaves the matter undecided", "[judge][unit]") {
  CHECK(judge_at_least(510.0, 5.0, 500.0) == Verdict::met);
  CHECK(judge_at_least(505.0, 5.0, 500.0) == Verdict::met);
  CHECK(judge_at_least(502.0, 5.0, 500.0) == Verdict::undecided);
  CHECK(judge_at_least(496.0, 5.0, 500.0) == Verdict::undecided);
  CHECK(judge_at_least(490.0, 5.0, 500.0) == Verdict::not_met);
  CHECK(judge_at_least(500.0, 0.0, 500.0) == Verdict::met);
  CHECK(judge_at_most(18.9, 0.05, 19.0) == Verdict::met);
  CHECK(judge_at_most(19.0, 0.0, 19.0) == Verdict::met);
  CHECK(judge_at_most(19.2, 0.05, 19.0) == Verdict::not_met);
  CHECK(judge_at_most(std::nan(""), 0.0, 19.0) == Verdict::undecided);
  CHECK(overall({}) == Verdict::met);
  CHECK(overall({Verdict::met, Verdict::undecided}) == Verdict::undecided);
  CHECK(overall({Verdict::undecided, Verdict::not_met, Verdict::met}) == Verdict::not_met);
}

TEST_CASE("Requirements are read, and their problems told with their places", "[judge][unit]") {
  const auto r =
      read(with_head("maintenance_factor = 0.8\n[maintenance]\n\"row A\" = 0.7\n"
                     "[[require]]\nplane = \"desk\"\nilluminance = 500\nugr = 19\neye_height = 1.65\n"
                     "[[require]]\nsurfaces = [\"wall\"]\nuniformity = \"10 %\"\n"));
  CHECK(r.maintenance_factor == 0.8);
  CHECK(r.maintenance.at("row A") == 0.7);
  REQUIRE(r.requirements.size() == 2);
  CHECK(*r.requirements[0].illuminance_lx == 500.0);
  CHECK(r.requirements[0].eye_height_m == 1.65);
  CHECK(r.requirements[1].uniformity == Approx(0.1));
  CHECK_FALSE(r.requirements[1].ugr);
  const auto refused = [](const std::string& text, const std::string& words) {
    try {
      read(text);
      FAIL_CHECK("accepted: " << text);
    } catch (const InputError& error) {
      CHECK(error.problems().front().what.find(words) != std::string::npos);
      CHECK(error.problems().front().place.file == "r.toml");
    }
  };
  refused("dim = \"requirements/1\"\n[[require]]\nplane = \"desk\"\n", "source");
  refused(with_head(""), "requires nothing");
  refused(with_head("[[require]]\nilluminance = 500\n"), "needs a plane or surfaces");
  refused(with_head("[[require]]\nplane = \"a\"\nsurfaces = [\"b\"]\n"), "needs a plane or surfaces");
  refused(with_head("[[require]]\nsurfaces = [\"b\"]\nugr = 19\n"), "belongs to a plane");
  refused(with_head("[[require]]\nplane = \"a\"\nilluminence = 5\n"), "illuminence");
  refused(with_head("maintenance_factor = 1.2\n[[require]]\nplane = \"a\"\n"), "maintenance_factor");
}

TEST_CASE("Maintained light is each source times its factor, once", "[judge][unit]") {
  const auto findings = checked({},
                                "maintenance_factor = 0.8\n[maintenance]\nsecond = 0.5\n"
                                "[[require]]\nplane = \"desk\"\nilluminance = 351.9\nuniformity = 0.9\n");
  REQUIRE(findings.size() == 2);
  const double a = 0.8 * 300.0 + 0.5 * 200.0, b = 0.8 * 330.0 + 0.5 * 170.0;
  CHECK(findings[0].value == Approx(0.5 * (a + b)));
  CHECK(findings[0].initial == Approx(500.0));
  CHECK(findings[0].verdict == Verdict::not_met);
  CHECK(findings[1].value == Approx(2.0 * std::min(a, b) / (a + b)));
  CHECK(findings[1].verdict == Verdict::met);
}

TEST_CASE("The stated error of the solution decides what is undecided", "[judge][unit]") {
  LitRoom room;
  room.error_bound = 0.02;
  CHECK(stated_error(room.database(), {1.0, 1.0}) == Approx(0.02));
  CHECK(stated_error(room.database(), {0.0, 0.0}) == 0.0);
  for (const auto& [limit, verdict] : {std::pair{489.0, Verdict::met},
                                       {495.0, Verdict::undecided},
                                       {509.0, Verdict::undecided},
                                       {511.0, Verdict::not_met}}) {
    const auto found =
        checked(room, "[[require]]\nplane = \"desk\"\nilluminance = " + std::to_string(limit) + "\n");
    CHECK(found.front().verdict == verdict);
    CHECK(found.front().error == Approx(10.0));
  }
}

TEST_CASE("Surfaces, power and glare are held against their limits", "[judge][unit]") {
  const auto found =
      checked({},
              "[[require]]\nsurfaces = [\"floor\", \"x0\"]\nilluminance = 99\nuniformity = 0.99\n"
              "[[require]]\nplane = \"desk\"\npower_density = 5\npower_per_100_lx = 0.9\nugr = 10\n");
  REQUIRE(found.size() == 7);
  for (std::size_t k = 0; k < 4; ++k) CHECK(found[k].verdict == Verdict::met);
  CHECK(found[0].value == Approx(100.0));
  CHECK(found[4].what == "ugr");
  CHECK(found[4].verdict == Verdict::not_met);
  CHECK(found[5].value == Approx(60.0 / 12.0));  // W over the floor
  CHECK(found[5].verdict == Verdict::met);
  CHECK(found[6].value == Approx(100.0 * 5.0 / 500.0));
  CHECK(found[6].verdict == Verdict::not_met);
}

TEST_CASE("A requirement for what is not there is refused at its place", "[judge][unit]") {
  for (const char* text : {"[[require]]\nplane = \"dask\"\nilluminance = 1\n",
                           "[[require]]\nsurfaces = [\"flor\"]\nilluminance = 1\n",
                           "[[require]]\nplane = \"desk\"\ndaylight_factor = 2\n",
                           "[[require]]\nplane = \"desk\"\nilluminance = 1\n[maintenance]\nsecnd = 0.7\n"}) {
    try {
      checked({}, text);
      FAIL_CHECK("accepted: " << text);
    } catch (const InputError& error) {
      CHECK(error.problems().front().place.line >= 3);
    }
  }
}
