// Spaces that no light reaches: what stands in a cell must not let light through under it.
#include <cmath>
#include <functional>
#include <string>

#include "catch.hpp"
#include "property/transport_support.hpp"
#include "unit/scene_support.hpp"

using namespace dim;

namespace {

// A zone file whose things are turned about the vertical through (0.3, -0.2).
class Scene {
 public:
  Scene(double turn_deg, double cell_m) : turn_(radians(turn_deg)), turn_deg_(turn_deg) {
    text_ = "dim = \"zone/1\"\nname = \"room\"\ncell = " + number(cell_m) + "\n[finishes]\ngrey = 0.8\n";
  }

  Scene& surface(const std::string& name, const Ring3& ring, int sides = 1) {
    text_ += "[[surface]]\nname = \"" + name + "\"\nfinish = \"grey\"\nsides = " + std::to_string(sides) +
             "\nvertices = [";
    for (const auto& p : ring) text_ += place(p) + ",";
    text_ += "]\n";
    return *this;
  }

  // A closed room over an outline, counter-clockwise seen from above.
  Scene& room(const std::vector<Vec2>& outline, double height) {
    Ring3 floor, ceiling;
    for (const auto& p : outline) floor.push_back({p.x, p.y, 0.0});
    for (auto p = outline.rbegin(); p != outline.rend(); ++p) ceiling.push_back({p->x, p->y, height});
    surface("floor", floor).surface("ceiling", ceiling);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2 a = outline[i], b = outline[(i + 1) % outline.size()];
      surface("wall" + std::to_string(i),
              {{a.x, a.y, 0}, {a.x, a.y, height}, {b.x, b.y, height}, {b.x, b.y, 0}});
    }
    return *this;
  }

  Scene& panel(const std::string& name, const Vec2& a, const Vec2& b, double z0, double z1) {
    return surface(name, {{a.x, a.y, z0}, {b.x, b.y, z0}, {b.x, b.y, z1}, {a.x, a.y, z1}}, 2);
  }

  Scene& box(const std::string& name, const Vec3& corner, const Vec3& size) {
    text_ += "[[box]]\nname = \"" + name + "\"\nfinish = \"grey\"\ncorner = " + place(corner) + "\nsize = [" +
             number(size.x) + "," + number(size.y) + "," + number(size.z) + "]\nturn = " + number(turn_deg_) +
             "\n";
    return *this;
  }

  Scene& point(const Vec3& at, const Vec3& normal) {
    points_ += (points_.empty() ? "" : ",") + place(at);
    points_.pop_back();
    const Vec3 n = turned(normal, turn_);
    points_ += "," + number(n.x) + "," + number(n.y) + "," + number(n.z) + "]";
    return *this;
  }

  Zone read() const {
    return test::read(text_ +
                      (points_.empty() ? "" : "[[sensors]]\nname = \"in\"\npoints = [" + points_ + "]\n"));
  }

  // Where a place of the zone is before it was turned, and where one is after.
  Vec3 unturned(const Zone& zone, const Vec3& p) const {
    return turned(p + zone.origin_m - kPivot, -turn_) + kPivot;
  }
  Vec3 in_zone(const Zone& zone, const Vec3& p) const { return moved(p) - zone.origin_m; }

 private:
  static constexpr Vec3 kPivot{0.3, -0.2, 0.0};

  static Vec3 turned(const Vec3& p, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
  }
  Vec3 moved(const Vec3& p) const { return turned(p - kPivot, turn_) + kPivot; }
  static std::string number(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", x);
    return text;
  }
  std::string place(const Vec3& p) const {
    const Vec3 q = moved(p);
    return "[" + number(q.x) + "," + number(q.y) + "," + number(q.z) + "]";
  }

  double turn_, turn_deg_;
  std::string text_, points_;
};

using Inside = std::function<bool(const Vec3&)>;

Inside in_box(const Vec3& low, const Vec3& high) {
  return [=](const Vec3& p) {
    return p.x > low.x && p.y > low.y && p.z > low.z && p.x < high.x && p.y < high.y && p.z < high.z;
  };
}

struct Leaks {
  std::size_t n_dark_cells = 0;
  std::size_t n_rays = 0;         // that join a dark cell or point with a bright one
  std::size_t n_bright_dark = 0;  // dark cells and points with direct light
};

// Rays of the network between the dark space and the rest, and direct light of a lamp outside it.
Leaks leaks(const Scene& scene, const Inside& dark, const Vec3& lamp) {
  const Zone zone = scene.read();
  const Cells cells(zone);
  const auto is_dark = [&](std::size_t cell) {
    const Frame& frame = zone.surfaces[cells.surface_of(cell)].polygon.frame();
    return dark(scene.unturned(zone, frame.to_world(cells[cell].centroid) + 1e-9 * frame.n));
  };
  const Network network = test::network_of(zone, {8, 16});
  Leaks result;
  std::vector<bool> of_cell(cells.size() + 1, false);
  for (std::size_t i = 0; i < cells.size(); ++i) result.n_dark_cells += of_cell[i] = is_dark(i);
  const auto count = [&](const SinkTable& sinks, std::size_t row, bool row_dark) {
    for (std::size_t k = 0; k < sinks.n_patches(); ++k) {
      const auto sink = sinks.at(row, k);
      result.n_rays += sink < cells.size() && of_cell[sink] != row_dark;
    }
  };
  for (std::size_t i = 0; i < cells.size(); ++i) count(network.sinks, i, of_cell[i]);
  for (std::size_t p = 0; p < zone.points.size(); ++p) count(network.point_sinks, p, true);
  const auto light = test::direct(zone, test::point_lamp(scene.in_zone(zone, lamp), 1000.0));
  for (std::size_t i = 0; i < cells.size(); ++i)
    result.n_bright_dark += of_cell[i] && light.cell_lx[i] != 0.0;
  for (const double lx : light.point_lx) result.n_bright_dark += lx != 0.0;
  return result;
}

const std::vector<Vec2> kRoom = {{0, 0}, {4, 0}, {4, 3}, {0, 3}};

}  // namespace

TEST_CASE("A box of thin panels in a bright room is dark inside at any turn and cell size",
          "[network][property]") {
  const double turn = GENERATE(0.0, 17.3, 30.0, 45.0), cell_m = GENERATE(0.5, 0.25, 0.1);
  Scene scene(turn, cell_m);
  scene.room(kRoom, 2.5).panel("s", {1, 1}, {2.2, 1}, 0, 1.3).panel("n", {1, 2}, {2.2, 2}, 0, 1.3);
  scene.panel("w", {1, 1}, {1, 2}, 0, 1.3).panel("e", {2.2, 1}, {2.2, 2}, 0, 1.3);
  // The lid in three pieces that meet in a T.
  scene.surface("lid1", {{1, 1, 1.3}, {2.2, 1, 1.3}, {2.2, 1.55, 1.3}, {1, 1.55, 1.3}}, 2);
  scene.surface("lid2", {{1, 1.55, 1.3}, {1.45, 1.55, 1.3}, {1.45, 2, 1.3}, {1, 2, 1.3}}, 2);
  scene.surface("lid3", {{1.45, 1.55, 1.3}, {2.2, 1.55, 1.3}, {2.2, 2, 1.3}, {1.45, 2, 1.3}}, 2);
  for (const double off : {1e-6, 1e-4, 1e-3, 0.3}) {
    scene.point({1 + off, 1 + off, off}, {0, 0, 1});
    scene.point({2.2 - off, 2 - off, 1.3 - off}, {0, 0, -1});
    scene.point({1.45, 1.55, 1.3 - off}, {0, 0, 1});
    scene.point({1 + off, 1.5, 0.3}, {1, 0, 0});
  }
  const Leaks found = leaks(scene, in_box({1, 1, 0}, {2.2, 2, 1.3}), {3.1, 0.9, 2.3});
  CHECK(found.n_dark_cells > 20);
  CHECK(found.n_rays == 0);
  CHECK(found.n_bright_dark == 0);
}

TEST_CASE("Behind a partition from wall to wall it is dark, wherever it stands in its cells",
          "[network][property]") {
  const double turn = GENERATE(0.0, 17.3), at = GENERATE(2.8, 2.75, 2.5 + 1e-9, 2.5 - 3e-8);
  const double cell_m = GENERATE(0.5, 0.25);
  Scene scene(turn, cell_m);
  scene.room(kRoom, 2.7).panel("partition", {at, 0}, {at, 3}, 0, 2.7);
  scene.point({at + 0.01, 1.5, 0.01}, {0, 0, 1}).point({3.9, 1.5, 1}, {-1, 0, 0});
  scene.point({at + 1e-6, 1e-6, 1e-6}, {0, 0, 1});
  const Leaks found = leaks(scene, in_box({at, -1, -1}, {9, 9, 9}), {1.5, 1.4, 2.3});
  CHECK(found.n_dark_cells > 20);
  CHECK(found.n_rays == 0);
  CHECK(found.n_bright_dark == 0);
}

TEST_CASE("A skew partition seals a room as well", "[network][property]") {
  const double cell_m = GENERATE(0.5, 0.25, 0.1);
  Scene scene(0.0, cell_m);
  scene.room(kRoom, 2.5).panel("partition", {2.1, 0}, {3.3, 3}, 0, 2.5);
  scene.point({3.5, 1.0, 1e-3}, {0, 0, 1});
  const Leaks found =
      leaks(scene, [](const Vec3& p) { return (p.x - 2.1) * 3 - p.y * 1.2 > 0; }, {1.0, 1.4, 2.3});
  CHECK(found.n_dark_cells > 20);
  CHECK(found.n_rays == 0);
  CHECK(found.n_bright_dark == 0);
}

TEST_CASE("A thin solid box is a wall", "[network][property]") {
  const double turn = GENERATE(0.0, 30.0), width_m = GENERATE(0.1, 0.004), cell_m = GENERATE(0.5, 0.25);
  Scene scene(turn, cell_m);
  scene.room(kRoom, 2.7).box("wall", {2.8, 0, 0}, {width_m, 3, 2.7});
  scene.point({2.8 + width_m + 1e-5, 1.5, 1e-5}, {0, 0, 1});
  const Leaks found = leaks(scene, in_box({2.8 + width_m / 2, -1, -1}, {9, 9, 9}), {1.5, 1.4, 2.3});
  CHECK(found.n_dark_cells > 20);
  CHECK(found.n_rays == 0);
  CHECK(found.n_bright_dark == 0);
}

TEST_CASE("A box that goes through floor and ceiling and meets two walls seals what is behind it",
          "[network][property]") {
  const double cell_m = GENERATE(0.5, 0.25, 0.1);
  Scene scene(0.0, cell_m);
  scene.room(kRoom, 2.7).box("core", {2.3, -0.2, -0.1}, {0.33, 3.4, 3.1});
  scene.point({2.64, 1.5, 0.01}, {0, 0, 1});
  const Leaks found = leaks(scene, in_box({2.63, -1, -1}, {9, 9, 9}), {1.5, 1.4, 2.3});
  CHECK(found.n_dark_cells > 20);
  CHECK(found.n_rays == 0);
  CHECK(found.n_bright_dark == 0);
}

TEST_CASE("An L-shaped space behind two partitions is dark round its corner", "[network][property]") {
  const double turn = GENERATE(0.0, 17.3), cell_m = GENERATE(0.5, 0.25, 0.1);
  Scene scene(turn, cell_m);
  scene.room({{0, 0}, {4, 0}, {4, 3}, {1.9, 3}, {1.9, 2.4}, {0, 2.4}}, 2.5);
  scene.panel("a", {0, 1.3}, {2.7, 1.3}, 0, 2.5).panel("b", {2.7, 1.3}, {2.7, 3}, 0, 2.5);
  scene.point({2.69, 1.31, 0.005}, {0, 0, 1}).point({0.1, 2.3, 2.49}, {0, 0, -1});
  const Leaks found = leaks(scene, in_box({-1, 1.3, -1}, {2.7, 9, 9}), {3.5, 0.5, 2.2});
  CHECK(found.n_dark_cells > 20);
  CHECK(found.n_rays == 0);
  CHECK(found.n_bright_dark == 0);
}

TEST_CASE("A ray that ends on the foot of a partition ends on the side it comes from", "[network][unit]") {
  const Scene scene = [] {
    Scene made(17.3, 0.5);
    made.room(kRoom, 2.7).panel("partition", {2.8, 0}, {2.8, 3}, 0, 2.7);
    return made;
  }();
  const Zone zone = scene.read();
  const Cells cells(zone);
  const Frame& floor = zone.surfaces[0].polygon.frame();
  const auto x_of_hit = [&](double y, double off, double step) {
    const auto place = [&](double x, double z) { return scene.in_zone(zone, {x, y, z}); };
    const Vec3 direction = glm::normalize(place(2.8, 0) - place(2.8 - step, 1));
    const auto cell = cells.cell_hit(0, floor.to_local(place(2.8 + off, 0)), direction);
    return scene.unturned(zone, floor.to_world(cells[cell].centroid)).x;
  };
  for (double y = 0.05; y < 3.0; y += 0.1) {
    for (const double off : {-1e-10, 0.0, 1e-10}) {
      CHECK(x_of_hit(y, off, 0.3) < 2.8);
      CHECK(x_of_hit(y, off, -0.3) > 2.8);
    }
  }
}

TEST_CASE("Light goes round a panel that ends in the middle of the floor", "[network][property]") {
  Scene scene(0.0, 0.5);
  scene.room(kRoom, 2.5).panel("panel", {2.8, 0}, {2.8, 1.7}, 0, 2.5);
  scene.point({3.4, 1.0, 0.8}, {0, 0, 1});
  const Leaks found = leaks(scene, in_box({2.8, -1, -1}, {9, 1.7, 9}), {1.5, 1.4, 2.3});
  CHECK(found.n_rays > 0);
  // The floor before and behind the panel is not one cell.
  const Zone zone = scene.read();
  const Cells cells(zone);
  const Polygon& floor = test::find(zone, "floor")->polygon;
  const auto cell = [&](double x, double y) {
    return cells.grid(0).cell_at(floor.frame().to_local(scene.in_zone(zone, {x, y, 0})));
  };
  CHECK(cell(2.79, 1.2) != cell(2.81, 1.2));
  CHECK(cell(2.79, 2.6) == cell(2.81, 2.6));
}
