#include <filesystem>
#include <fstream>

#include "scene_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

// The room with another table behind it; kRoom has 30 lines, so the first of `more` is line 31.
std::vector<std::string> with(const std::string& more) { return problems_of(kRoom + more); }

std::string surface(const std::string& name, const std::string& rest) {
  return "[[surface]]\nname = \"" + name + "\"\nfinish = \"wall\"\n" + rest + "\n";
}

void check_one(const std::vector<std::string>& problems, const std::string& expected) {
  REQUIRE(problems.size() == 1);
  CHECK(problems[0] == expected);
}

}  // namespace

TEST_CASE("Missing header, other kind and newer version are refused with one message", "[scene][unit]") {
  check_one(problems_of("name = \"x\"\n"),
            "1:1 not a DIM file: the key 'dim' is missing | begin the file with dim = \"zone/1\"");
  check_one(problems_of("dim = \"lights/1\"\n"),
            "1:7 'lights/1' is not a zone file | a zone file begins with dim = \"zone/1\"");
  check_one(problems_of("dim = \"zone/2\"\n"),
            "1:7 'zone/2' is newer than this program reads (up to zone/1) | use a newer version of DIM");
  check_one(problems_of("dim = \"zone/0\"\n"),
            "1:7 'zone/0' is not a zone file | a zone file begins with dim = \"zone/1\"");
  check_one(problems_of("dim = 1\n"), "1:7 dim must be text | write dim = \"zone/1\"");
}

TEST_CASE("Syntax and encoding errors have their line and column", "[scene][unit]") {
  const auto syntax = problems_of("dim = \"zone/1\"\ncell = = 3\n");
  REQUIRE(syntax.size() == 1);
  CHECK(syntax[0].starts_with("2:8 "));
  const auto encoding = problems_of("dim = \"zone/1\"\nname = \"\xff\xfe\"\n");
  REQUIRE(encoding.size() == 1);
  CHECK(encoding[0].starts_with("2:"));
  CHECK(problems_of("").size() == 1);
  CHECK(problems_of(std::string("dim = \"zone/1\"\nname = \"a\0b\"\n", 28)).size() == 1);
}

TEST_CASE("Nesting without end is refused, not followed", "[scene][unit]") {
  std::string dotted = "dim = \"zone/1\"\na";
  for (int i = 0; i < 200000; ++i) dotted += ".a";
  check_one(problems_of(dotted + " = 1\n"), "2:131 key nested more than 64 deep");
  CHECK(problems_of("dim = \"zone/1\"\na = " + std::string(100000, '[')).size() == 1);
  CHECK(problems_of("dim = \"zone/1\"\n[a" + dotted.substr(16) + "]\n").size() == 1);
  std::string braces = "dim = \"zone/1\"\na = ";
  for (int i = 0; i < 100000; ++i) braces += "{a=";
  CHECK(problems_of(braces).size() == 1);
}

TEST_CASE("A dotted line in a comment is no deep key", "[scene][unit]") {
  CHECK(problems_of("# " + std::string(500, '.') + "\n# a. b. c. d.\n" + kRoom).empty());
}

TEST_CASE("A long text is refused by its size", "[scene][unit]") {
  const auto problems = problems_of(std::string((64u << 20) + 1, '#'));
  REQUIRE(problems.size() == 1);
  CHECK(problems[0] == "room.toml text of 67108865 bytes is longer than the 64 MiB accepted");
}

TEST_CASE("Unknown keys are reported with the nearest", "[scene][unit]") {
  check_one(
      problems_of(kRoom +
                  "[[box]]\nname = \"b\"\nfinish = \"wall\"\ncorner = [1,1,1]\nsize = [1,1,1]\ntur = 3\n"),
      "36:1 box 'b': unknown key 'tur' | did you mean 'turn'?");
  check_one(problems_of("dim = \"zone/1\"\ncel = 1\n" + kRoom.substr(kRoom.find("[finishes]"))),
            "2:1 unknown key 'cel' | did you mean 'cell'?");
}

TEST_CASE("Wrong types and ranges name the key, the value and what is allowed", "[scene][unit]") {
  check_one(problems_of(kRoom, {"cell=-1"}),
            "--set cell=-1 cell must be greater than 0 and at most 1e+12, not -1");
  check_one(problems_of(kRoom, {"cell=wide"}), "--set cell=wide cell must be a number, not text");
  check_one(problems_of(kRoom, {"cell=nan"}), "--set cell=nan cell must be finite, not nan");
  check_one(problems_of(kRoom, {"unit=yard"}),
            "--set unit=yard unit must be one of m, mm, cm, in, ft, not 'yard'");
  check_one(problems_of(kRoom, {"surface.floor.grid=[0, 3]"}),
            "--set surface.floor.grid=[0, 3] surface 'floor': grid must be 1 to 10000, not 0");
  check_one(problems_of(kRoom, {"surface.floor.grid=[1.5, 3]"}),
            "--set surface.floor.grid=[1.5, 3] surface 'floor': grid must be two whole numbers");
}

TEST_CASE("Overrides of what is not there name what is near", "[scene][unit]") {
  check_one(problems_of(kRoom, {"finishes.wal.diffuse=0.7"}),
            "--set finishes.wal.diffuse=0.7 no 'wal' in [finishes] | did you mean 'wall'?");
  check_one(problems_of(kRoom, {"finishes.wal=0.7"}),
            "--set finishes.wal=0.7 no 'wal' in [finishes] | did you mean 'wall'?");
  check_one(problems_of(kRoom, {"surface.flor.finish=wall"}),
            "--set surface.flor.finish=wall no surface named 'flor' | did you mean 'floor'?");
  check_one(problems_of(kRoom, {"cel=1"}), "--set cel=1 unknown key 'cel' | did you mean 'cell'?");
  check_one(problems_of(kRoom, {"finishes.wall.difuse=0.7"}),
            "--set finishes.wall.difuse=0.7 finish 'wall': unknown key 'difuse' | did you mean 'diffuse'?");
  check_one(problems_of(kRoom, {"cell"}),
            "--set cell no '=' in the override | write KEY=VALUE, for example cell=0.2");
  check_one(problems_of(kRoom, {"a..b=1"}),
            "--set a..b=1 not a key | write KEY=VALUE, for example finishes.wall.diffuse=0.7");
  check_one(problems_of(kRoom, {"name.x=1"}),
            "--set name.x=1 'name' is a value, nothing can be set inside it");
  check_one(problems_of(kRoom, {"surface=1"}),
            "--set surface=1 surface must be a list of tables | write [[surface]] before each");
}

TEST_CASE("Surfaces that are no polygon are refused", "[scene][unit]") {
  check_one(with(surface("s", "vertices = [[1,1,1],[2,1,1]]")),
            "34:12 surface 's': outline has 2 different corners, at least 3 are needed");
  check_one(with(surface("s", "vertices = [[1,1,1],[2,1,1],[2,1,1],[1,1,1]]")),
            "34:12 surface 's': outline has 2 different corners, at least 3 are needed");
  check_one(with(surface("s", "vertices = []")),
            "34:12 surface 's': outline has 0 different corners, at least 3 are needed");
  check_one(with(surface("s", "vertices = [[1,1,1],[2,1,1],[3,1,1]]")),
            "34:12 surface 's': outline has zero area: its corners lie on one line");
  check_one(with(surface("s", "vertices = [[1,1,1],[2,1,1],[2,nan,1]]")),
            "34:32 surface 's': vertices must be finite, not nan");
  check_one(with(surface("s", "vertices = [[1,1,1],[2,1,1],[2,inf,1]]")),
            "34:32 surface 's': vertices must be finite, not inf");
  check_one(with(surface("s", "vertices = [[1,1,1],[2,1],[2,2,1]]")),
            "34:21 surface 's': vertices must be 3 numbers, not 2");
  check_one(with(surface("s", "vertices = [[1,1,1],[2,1,1],\"x\"]")),
            "34:29 surface 's': vertices must be 3 numbers, not text");
  check_one(with(surface("s", "")), "31:1 surface 's': 'vertices' is missing");
}

TEST_CASE("Corners out of plane are refused with the deviation and the cure", "[scene][unit]") {
  // Alternate corners 4 mm up: each is 2 mm off the best plane through the mean, of a size of sqrt(2) m.
  check_one(
      with(surface("s", "vertices = [[1,1,1],[2,1,1.004],[2,2,1],[1,2,1.004]]")),
      "34:12 surface 's': corners lie up to 0.002 m out of one plane, 0.0014 of its size; at most 0.0001 is "
      "accepted | split it into triangles");
  CHECK(with(surface("s", "vertices = [[1,1,1],[2,1,1.0002],[2,2,1],[1,2,1.0002]]")).empty());
}

TEST_CASE("The red wall of the Cornell box data is out of plane", "[scene][unit]") {
  // Twist of 3.2 mm: its corners lie alternately 0.8 mm before and behind the best plane.
  const auto problems = problems_of(R"(dim = "zone/1"
unit = "mm"
finishes = { red = 0.1 }
[[surface]]
name = "left_wall"
finish = "red"
vertices = [[552.8,0,0],[549.6,0,559.2],[556,548.8,559.2],[556,548.8,0]]
)");
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].starts_with("7:12 surface 'left_wall': corners lie up to 0.00079"));
  CHECK(problems[0].ends_with("| split it into triangles"));
}

TEST_CASE("Outlines that cross or touch themselves are refused", "[scene][unit]") {
  check_one(
      with(surface("s", "vertices = [[1,1,1],[3,1,1],[1.5,3,1],[2.5,3,1]]")),
      "34:12 surface 's': the outline crosses or touches itself: side 2 meets side 4 | list the corners once "
      "round; write openings as holes");
  check_one(with(surface("s", "vertices = [[1,1,1],[2,2,1],[2,1,1],[1,2,1]]")),
            "34:12 surface 's': outline crosses itself: the areas of its parts cancel | list the corners "
            "once round");
  check_one(
      with(surface("s", "vertices = [[1,1,1],[3,1,1],[3,3,1],[2,1,1],[1,3,1]]")),
      "34:12 surface 's': the outline crosses or touches itself: side 1 meets side 3 | list the corners once "
      "round; write openings as holes");
  check_one(
      with(surface("s", "vertices = [[1,1,1],[3,1,1],[3,3,1],[3,2,1],[1,2,1]]")),
      "34:12 surface 's': the outline crosses or touches itself: side 2 meets side 3 | list the corners once "
      "round; write openings as holes");
}

TEST_CASE("Repeated corners, also the first at the end, are dropped silently", "[scene][unit]") {
  const Zone zone =
      read(kRoom + surface("s", "sides = 2\nvertices = [[1,1,1],[2,1,1],[2,1,1],[2,2,1],[1,1,1]]"));
  CHECK(find(zone, "s")->polygon.rings()[0].size() == 3);
}

TEST_CASE("Holes lie inside the outline and apart", "[scene][unit]") {
  const std::string square = "vertices = [[1,1,1],[3,1,1],[3,3,1],[1,3,1]]\n";
  check_one(with(surface("s", square + "holes = [[[4,1,1],[5,1,1],[5,2,1]]]")),
            "34:12 surface 's': hole 1 lies outside the outline");
  check_one(with(surface("s", square + "holes = [[[2,2,1],[5,2,1],[5,2.5,1]]]")),
            "34:12 surface 's': hole 1 crosses or touches the outline | holes lie wholly inside the outline "
            "and apart "
            "from each other");
  check_one(
      with(surface(
          "s",
          square + "holes = [[[1.5,1.5,1],[2.5,1.5,1],[2.5,2.5,1]], [[2,1.6,1],[2.4,1.6,1],[2.4,1.8,1]]]")),
      "34:12 surface 's': hole 2 lies inside hole 1");
  check_one(with(surface("s", square + "holes = [[[1.5,1.5,1.1],[2.5,1.5,1.1],[2.5,2.5,1.1]]]")),
            "34:12 surface 's': hole 1 lies 0.1 m off the plane of the outline");
  check_one(with(surface("s", square + "holes = [[[1.5,1.5,1],[2.5,1.5,1]]]")),
            "34:12 surface 's': hole 1 has 2 different corners, at least 3 are needed");
}

TEST_CASE("Unknown finishes and parents are reported with the nearest", "[scene][unit]") {
  check_one(with("[[surface]]\nname = \"s\"\nfinish = \"wal\"\nvertices = [[1,1,1],[2,1,1],[2,2,1]]\n"),
            "33:10 surface 's': no finish 'wal' | did you mean 'wall'?");
  check_one(with("[[surface]]\nname = \"s\"\nfinish = \"oak\"\nvertices = [[1,1,1],[2,1,1],[2,2,1]]\n"),
            "33:10 surface 's': no finish 'oak' | write it in [finishes]: oak = 0.5");
  check_one(with(surface("s", "on = \"suth\"\nvertices = [[1,0,1],[1,0,2],[2,0,2]]")),
            "34:6 surface 's': no surface 'suth' to lie on | did you mean 'south'?");
}

TEST_CASE("Finishes out of range or from an unknown entry are refused", "[scene][unit]") {
  check_one(problems_of(kRoom, {"finishes.wall=1"}),
            "--set finishes.wall=1 finishes: wall must be at least 0 and less than 1, not 1");
  check_one(
      problems_of(kRoom, {"finishes.wall={diffuse=0.5,roughness=-1}"}),
      "--set finishes.wall={diffuse=0.5,roughness=-1} finish 'wall': roughness must be 0 to 10, not -1");
  check_one(problems_of(kRoom, {"finishes.wall={specular=0.5}"}),
            "--set finishes.wall={specular=0.5} finish 'wall': 'diffuse' is missing");
  check_one(
      problems_of(kRoom, {"finishes.wall={diffuse=[[500,0.2],[400,0.3]]}"}),
      "--set finishes.wall={diffuse=[[500,0.2],[400,0.3]]} finish 'wall': diffuse: wavelengths must ascend, "
      "400 nm follows 500 nm | sort the points, each wavelength once");
  check_one(problems_of(kRoom, {"finishes.wall=paint-white-matt"}),
            "--set finishes.wall=paint-white-matt finish 'wall': no surface 'paint-white-matt' in no "
            "database folder");
}

TEST_CASE("A name used twice is reported with the first place", "[scene][unit]") {
  check_one(
      with(surface("south", "vertices = [[1,1,1],[2,1,1],[2,2,1]]")),
      "32:8 the name 'south' is used twice, first at line 16 | give each surface, box and copy its own name");
  check_one(
      with(surface("b.top", "vertices = [[1,1,1],[2,1,1],[2,2,1]]") +
           "[[box]]\nname = \"b\"\nfinish = \"wall\"\ncorner = [3,1,1]\nsize = [1,1,1]\n"),
      "36:8 the name 'b.top' is used twice, first at line 32 | give each surface, box and copy its own name");
}

TEST_CASE("Boxes have a positive size, copies an original", "[scene][unit]") {
  check_one(with("[[box]]\nname = \"b\"\nfinish = \"wall\"\ncorner = [1,1,1]\nsize = [1,-1,1]\n"),
            "35:11 box 'b': size must be greater than 0 and at most 1e+12, not -1");
  check_one(with("[[copy]]\nof = \"flor\"\nnames = [\"x\"]\nby = [[0,0,1]]\n"),
            "32:6 copy of 'flor': no surface or box of that name above | did you mean 'floor'?");
  check_one(with("[[copy]]\nof = \"floor\"\nnames = [\"x\", \"y\"]\nby = [[0,0,1]]\n"),
            "34:6 copy of 'floor': 2 names but 1 displacements | give one [x, y, z] for each name");
}

TEST_CASE("Features lie in their parent's plane, face as it does and stay inside", "[scene][unit]") {
  check_one(
      with(surface("p", "on = \"south\"\nvertices = [[1,0.01,1],[1,0.01,2],[3,0.01,2],[3,0.01,1]]")),
      "35:12 surface 'p' lies 0.01 m off the plane of its parent 'south' | a feature's corners lie in its "
      "parent's plane");
  check_one(
      with(surface("p", "on = \"south\"\nvertices = [[1,0,1],[3,0,1],[3,0,2],[1,0,2]]")),
      "35:12 surface 'p' faces the other way from its parent 'south' | list its corners the other way round");
  check_one(with(surface("p", "on = \"south\"\nvertices = [[1,0,2],[1,0,3.5],[3,0,3.5],[3,0,2]]")),
            "35:12 surface 'p' reaches 1 m2 beyond its parent 'south' | keep it inside the parent's outline "
            "and clear "
            "of its holes");
  check_one(with(surface("p", "on = \"q\"\nvertices = [[1,0,1],[1,0,2],[3,0,2],[3,0,1]]") +
                 surface("q", "on = \"p\"\nvertices = [[1,0,1],[1,0,2],[3,0,2],[3,0,1]]")),
            "34:6 surface 'p' lies on itself | name the surface that it is cut out of");
  check_one(with(surface("p", "on = \"south\"\nsides = 2\nvertices = [[1,0,1],[1,0,2],[3,0,2],[3,0,1]]")),
            "35:9 surface 'p': a feature on a parent has one side | leave out sides, or on");
}

TEST_CASE("Views and planes that show or measure nothing are refused", "[scene][unit]") {
  check_one(with("[[view]]\nname = \"v\"\neye = [1,1,1]\nfocus = [1,1,1]\n"),
            "34:9 view 'v': focus and eye are the same point");
  check_one(with("[[view]]\nname = \"v\"\neye = [1,1,1]\nfocus = [1,2,1]\nfov = 180\n"),
            "35:7 view 'v': fov must be greater than 0 and less than 180, not 180");
  check_one(with("[[view]]\nname = \"v\"\neye = [1,1,1]\nfocus = [1,2,1]\nup = [0,3,0]\n"),
            "35:6 view 'v': up is parallel to the direction of view");
  check_one(with("[[plane]]\nname = \"w\"\nvertices = [[1,1,1],[2,1,1],[3,1,1]]\nspacing = 1\n"),
            "33:12 plane 'w': outline has zero area: its corners lie on one line");
  check_one(with("[[plane]]\nname = \"w\"\nvertices = [[1,1,1],[2,1,1],[2,2,1]]\nspacing = 0\n"),
            "34:11 plane 'w': spacing must be greater than 0 and at most 1e+12, not 0");
  check_one(with("[[plane]]\nname = \"w\"\nvertices = [[1,1,1],[2,1,1],[2,2,1]]\nspacing = 1e-9\n"),
            "34:11 plane 'w': more than 10000 points along one side | give a larger spacing");
  check_one(with("[[sensors]]\nname = \"s\"\npoints = [[1,1,1, 0,0,1],[1,1,1, 0,0,0]]\n"),
            "33:26 sensors 's': point 2 has a normal of zero length | write x y z nx ny nz");
  check_one(with("[[sensors]]\nname = \"s\"\npoints = [[1,1,1]]\n"),
            "33:11 sensors 's': points must be 6 numbers, not 3");
  check_one(with("[site]\nlatitude = 91\n"), "32:12 site: latitude must be -90 to 90, not 91");
}

TEST_CASE("A view straight down has +y at the top of the picture", "[scene][unit]") {
  const Zone zone = read(kRoom + "[[view]]\nname = \"plan\"\neye = [3,2,2.9]\nfocus = [3,2,0]\n");
  CHECK(zone.views[0].up == Vec3(0, 1, 0));
}

TEST_CASE("A plan and an elevation without a width show the whole room", "[scene][unit]") {
  const Zone zone = read(kRoom + "[[view]]\nname = \"plan\"\nkind = \"plan\"\neye = [3,2,2.9]\nfocus = [3,2,0]\nsize = [100,100]\n"
                                 "[[view]]\nname = \"south\"\nkind = \"elevation\"\neye = [3,2,1.5]\nfocus = [3,4,1.5]\nwidth = 9\n"
                                 "[[view]]\nname = \"eye\"\nkind = \"fisheye\"\neye = [3,2,1.5]\nfocus = [3,4,1.5]\n");
  REQUIRE(zone.views.size() == 3);
  CHECK(zone.views[0].kind == ViewKind::plan);
  CHECK(zone.views[0].up == Vec3(0, 1, 0));
  CHECK(zone.views[0].width_m == Approx(1.04 * 6.0));  // the room is 6 m long
  CHECK(zone.views[1].width_m == 9.0);
  CHECK(zone.views[2].width == 1024);
  CHECK(zone.views[2].height == 1024);
}

TEST_CASE("What a kind of view cannot be is refused", "[scene][unit]") {
  const auto view = [](const std::string& more) {
    return with("[[view]]\nname = \"v\"\neye = [1,1,1]\nfocus = [1,2,1.5]\n" + more);
  };
  check_one(view("kind = \"fish-eye\"\nwidth = 3\n"),
            "35:8 view 'v': kind must be one of perspective, plan, elevation, fisheye, hemispherical, not 'fish-eye' | did "
            "you mean 'fisheye'?");
  check_one(view("width = 3\n"), "35:9 view 'v': only plans and elevations have a width | give fov, or leave it out");
  check_one(view("kind = \"fisheye\"\nfov = 90\n"),
            "36:7 view 'v': a view of kind fisheye has no fov | leave it out: it shows 180 degrees");
  check_one(view("kind = \"fisheye\"\nsize = [64,48]\n"), "36:8 view 'v': a round picture is square | write size = [48, 48]");
  check_one(view("kind = \"plan\"\n"), "34:9 view 'v': a plan looks straight down or up | give focus the x and y of eye");
  check_one(view("kind = \"elevation\"\n"), "34:9 view 'v': an elevation looks level | give focus the height of eye");
}

TEST_CASE("All problems of a file come together", "[scene][unit]") {
  const auto problems = with(surface("a", "vertices = [[1,1,1],[2,1,1]]") + surface("b", "vertices = 3") +
                             "[[box]]\nname = \"c\"\nfinish = \"none\"\ncorner = [1,1,1]\nsize = [1,1,1]\n");
  REQUIRE(problems.size() == 3);
  CHECK(problems[0].starts_with("34:12 surface 'a'"));
  CHECK(problems[1].starts_with("38:12 surface 'b'"));
  CHECK(problems[2].starts_with("41:10 surface 'c.top': no finish 'none'"));
}

TEST_CASE("Hundreds of copies at one place are refused together, not pair by pair", "[scene][unit]") {
  std::string names, by;
  for (int i = 0; i < 300; ++i) {
    names += "\"d" + std::to_string(i) + "\",";
    by += "[1,0,0],";
  }
  const auto problems = with(
      "[[box]]\nname = \"d\"\nfinish = \"wall\"\ncorner = [1,1,1]\nsize = [0.2,0.2,0.2]\n"
      "[[copy]]\nof = \"d\"\nnames = [" +
      names + "]\nby = [" + by + "]\n");
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].find("lie on top of each other") != std::string::npos);
}

TEST_CASE("An empty zone and a zone of boxes alone", "[scene][unit]") {
  check_one(problems_of("dim = \"zone/1\"\n"),
            "1:1 the zone has no surface | write at least one [[surface]]");
  Warnings warnings;
  const Zone zone = read(
      "dim = \"zone/1\"\nfinishes = { w = 0.5 }\n[[box]]\nname = \"b\"\nfinish = \"w\"\ncorner = "
      "[0,0,0]\nsize = "
      "[1,1,1]\n",
      {}, &warnings);
  CHECK_FALSE(zone.closed);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].what == "the zone is not closed: it has no bounding surface");
}

TEST_CASE("Every file of the corpus of bad zones is refused where it says", "[scene][unit]") {
  namespace fs = std::filesystem;
  int n = 0;
  for (const auto& file : fs::directory_iterator(fs::path(DIM_SOURCE_DIR) / "tests/data/scene/bad")) {
    if (file.path().extension() != ".toml") continue;
    INFO(file.path().filename().string());
    std::ifstream stream(file.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const std::string mark = "# expect ";
    REQUIRE(text.starts_with(mark));
    const std::string place = text.substr(mark.size(), text.find('\n') - mark.size());
    const auto problems = problems_of(text);
    REQUIRE_FALSE(problems.empty());
    CHECK(problems[0].starts_with(place + (place.ends_with(":") ? "" : " ")));
    ++n;
  }
  CHECK(n >= 14);
}
