#include "geometry/hidden_lines.hpp"

#include <algorithm>
#include <random>

#include "catch.hpp"

using namespace dim;

namespace {

struct Model {
  std::vector<Polygon> polygons;
  std::vector<bool> bounding;

  void add(const Ring3& ring, const std::vector<Ring3>& holes = {}, bool is_bounding = false) {
    polygons.emplace_back(ring, holes);
    bounding.push_back(is_bounding);
  }

  void add_box(const Vec3& lo, const Vec3& hi, bool room = false) {
    const auto at = [&](int x, int y, int z) {
      return Vec3(x ? hi.x : lo.x, y ? hi.y : lo.y, z ? hi.z : lo.z);
    };
    const std::vector<Ring3> faces = {{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)},
                                      {at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1)},
                                      {at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0)},
                                      {at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)},
                                      {at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)},
                                      {at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0)}};
    for (auto ring : faces) {
      if (!room) std::reverse(ring.begin(), ring.end());
      add(ring, {}, room);
    }
  }

  std::vector<Plate> plates() const {
    std::vector<Plate> result;
    for (std::size_t i = 0; i < polygons.size(); ++i) result.push_back({&polygons[i], bounding[i]});
    return result;
  }
};

double length_px(const std::vector<Segment2>& segments) {
  double sum = 0.0;
  for (const auto& s : segments) sum += glm::length(s.b - s.a);
  return sum;
}

double distance_px(const Vec2& p, const std::vector<Segment2>& segments) {
  double least = 1e9;
  for (const auto& s : segments) {
    const Vec2 way = s.b - s.a;
    const double t = std::clamp(glm::dot(p - s.a, way) / glm::dot(way, way), 0.0, 1.0);
    least = std::min(least, glm::length(p - (s.a + t * way)));
  }
  return least;
}

// Whether the drawing has just this line, among others.
bool has_line(const std::vector<Segment2>& segments, const Vec2& a, const Vec2& b) {
  return std::any_of(segments.begin(), segments.end(), [&](const Segment2& s) {
    return std::min(glm::length(s.a - a) + glm::length(s.b - b),
                    glm::length(s.a - b) + glm::length(s.b - a)) < 1e-6;
  });
}

Model furnished_room() {
  Model model;
  model.add_box({0, 0, 0}, {5, 4, 2.7}, true);
  for (const double x : {0.8, 2.9}) {
    model.add_box({x, 2.2, 0.7}, {x + 1.4, 2.9, 0.74});
    for (const double leg_x : {x + 0.02, x + 1.33}) {
      for (const double leg_y : {2.22, 2.83})
        model.add_box({leg_x, leg_y, 0}, {leg_x + 0.05, leg_y + 0.05, 0.7});
    }
    model.add_box({x + 0.4, 1.7, 0.42}, {x + 0.85, 2.1, 0.46});
    model.add_box({x + 0.4, 1.7, 0.46}, {x + 0.85, 1.73, 0.9});
  }
  model.add_box({4.4, 0.3, 0}, {5, 1.5, 1.8});
  model.add({{1.5, 3.999, 1.2}, {2.6, 3.999, 1.2}, {2.6, 3.999, 2.1}, {1.5, 3.999, 2.1}},
            {{{1.6, 3.999, 1.3}, {2.5, 3.999, 1.3}, {2.5, 3.999, 2.0}, {1.6, 3.999, 2.0}}});
  return model;
}

const Camera kIntoRoom{{0.4, 0.3, 1.7}, {3.2, 3.1, 0.8}, {0, 0, 1}, radians(75), 1280, 960};

}  // namespace

TEST_CASE("A cube seen from outside shows nine edges and hides three", "[geometry][hidden_lines][unit]") {
  Model cube;
  cube.add_box({0, 0, 0}, {1, 1, 1});
  const Camera camera{{3, 2.2, 1.9}, {0.5, 0.5, 0.5}, {0, 0, 1}, radians(50), 1000, 800};
  const auto lines = hidden_lines(cube.plates(), 2.0, camera);
  CHECK(lines.size() == 9);
  const Perspective view(camera);
  const auto at = [&](double x, double y, double z) { return *view.project({x, y, z}); };
  for (const Vec3 to : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
    CHECK_FALSE(has_line(lines, at(0, 0, 0), at(to.x, to.y, to.z)));
  for (const Vec3 to : {Vec3(0, 1, 1), Vec3(1, 0, 1), Vec3(1, 1, 0)})
    CHECK(has_line(lines, at(1, 1, 1), at(to.x, to.y, to.z)));
  CHECK(hidden_lines(cube.plates(), 2.0, {{0.5, -4, 0.5}, {0.5, 0, 0.5}, {0, 0, 1}, 1.0, 800, 600}).size() ==
        4);
}

TEST_CASE("A half-hidden edge ends exactly where the nearer edge's image crosses it",
          "[geometry][hidden_lines][unit]") {
  Model model;
  // From the origin along +y: a screen at y = 1 covers x < 0.2; a triangle at y = 2 has an edge from (-1, 2,
  // 0) to (1, 2, 0), which comes out from behind it at x = 0.4.
  model.add({{-3, 1, -1}, {0.2, 1, -1}, {0.2, 1, 1}, {-3, 1, 1}});
  model.add({{-1, 2, 0}, {1, 2, 0}, {0, 2, 0.5}});
  const Camera camera{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, radians(90), 1000, 1000};
  const auto lines = hidden_lines(model.plates(), 5.0, camera);
  const Perspective view(camera);
  CHECK(has_line(lines, *view.project({0.4, 2, 0}), *view.project({1, 2, 0})));
  CHECK(has_line(lines, *view.project({0.4, 2, 0.3}), *view.project({1, 2, 0})));
  CHECK_FALSE(has_line(lines, *view.project({-1, 2, 0}), *view.project({1, 2, 0})));
}

TEST_CASE("An edge that goes through a polygon ends where it enters", "[geometry][hidden_lines][unit]") {
  Model model;
  model.add({{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}});
  model.add({{0.1, 1, 0.1}, {0.3, 3, 0.2}, {0.1, 1, 0.4}});
  const Camera camera{{-0.5, 0, 0}, {0, 2, 0}, {0, 0, 1}, radians(80), 1000, 1000};
  const auto lines = hidden_lines(model.plates(), 5.0, camera);
  const Perspective view(camera);
  CHECK(has_line(lines, *view.project({0.1, 1, 0.1}), *view.project({0.2, 2, 0.15})));
  CHECK(has_line(lines, *view.project({0.1, 1, 0.4}), *view.project({0.2, 2, 0.3})));
}

TEST_CASE("Through a hole one sees what is behind, and the hole's edges are drawn",
          "[geometry][hidden_lines][unit]") {
  Model model;
  model.add({{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}},
            {{{-0.5, 1, -0.5}, {0.5, 1, -0.5}, {0.5, 1, 0.5}, {-0.5, 1, 0.5}}});
  model.add({{-2, 2, 0}, {2, 2, 0}, {2, 2, -3}, {-2, 2, -3}});
  const Camera camera{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, radians(100), 1000, 1000};
  const auto lines = hidden_lines(model.plates(), 6.0, camera);
  const Perspective view(camera);
  CHECK(has_line(lines, *view.project({-1, 2, 0}), *view.project({1, 2, 0})));
  CHECK(has_line(lines, *view.project({-0.5, 1, 0.5}), *view.project({0.5, 1, 0.5})));
  CHECK(lines.size() == 9);
}

TEST_CASE("A surface with an open back is seen from its front only", "[geometry][hidden_lines][unit]") {
  Model room;
  room.add_box({0, 0, 0}, {4, 3, 2.5}, true);
  room.add_box({1.5, 1.5, 0}, {2.5, 2.5, 0.5});
  // From high outside, the near walls and the ceiling are away: floor and two walls, 9 edges; box, 9 edges.
  const auto lines =
      hidden_lines(room.plates(), 6.0, {{9, 7, 8}, {2, 1.5, 1}, {0, 0, 1}, radians(40), 1000, 1000});
  CHECK(lines.size() == 18);
  // From inside, away from the box: the far corner's three edges and the rest of those in view.
  const auto inside =
      hidden_lines(room.plates(), 6.0, {{2, 1.5, 1.3}, {4, 3, 1.3}, {0, 0, 1}, radians(30), 100, 60});
  CHECK(inside.size() == 1);
}

TEST_CASE("Edges that polygons share in part are drawn once and in one piece",
          "[geometry][hidden_lines][unit]") {
  Model model;
  model.add({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}});
  model.add({{0, 1, 0}, {0.7, 1, 0}, {0.7, 2, 0}, {0, 2, 0}});
  model.add({{0.7, 1, 0}, {2, 1, 0}, {2, 2, 0}, {0.7, 2, 0}});
  const auto lines = hidden_lines(model.plates(), 3.0, {{1, 1, 5}, {1, 1.1, 0}, {0, 1, 0}, 0.8, 1000, 1000});
  // The square's outline, the line across and the short one upwards.
  CHECK(lines.size() == 6);
}

TEST_CASE("The picture does not depend on the order of the polygons", "[geometry][hidden_lines][property]") {
  const auto model = furnished_room();
  const auto lines = hidden_lines(model.plates(), 7.0, kIntoRoom);
  std::mt19937 random(3);
  for (int i = 0; i < 5; ++i) {
    auto plates = model.plates();
    std::shuffle(plates.begin(), plates.end(), random);
    const auto other = hidden_lines(plates, 7.0, kIntoRoom);
    CHECK(other.size() == lines.size());
    CHECK(length_px(other) == Approx(length_px(lines)).epsilon(1e-9));
    for (const auto& s : other) CHECK(has_line(lines, s.a, s.b));
  }
}

TEST_CASE("Every point of every edge is drawn if and only if nothing is before it",
          "[geometry][hidden_lines][property]") {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 10; ++round) {
    Model model;  // boxes and triangles through one another
    for (int i = 0; i < 12; ++i) {
      const Vec3 low(3 * unit(random), 3 * unit(random), 3 * unit(random));
      model.add_box(low, low + 0.2 + 1.2 * Vec3(unit(random), unit(random), unit(random)));
      Ring3 triangle;
      for (int k = 0; k < 3; ++k) triangle.emplace_back(4 * unit(random), 4 * unit(random), 4 * unit(random));
      model.add(triangle);
    }
    const Camera camera{{-2 - unit(random), -3, 5 * unit(random)}, {2, 2, 2}, {0, 0, 1}, 1.0, 1000, 800};
    const auto lines = hidden_lines(model.plates(), 8.0, camera);
    const Perspective view(camera);
    const auto first_crossing = [&](const Vec3& point) {  // in units of the way from the eye
      double first = 1e9;
      const Vec3 way = point - camera.eye;
      for (const auto& polygon : model.polygons) {
        const double t = -polygon.frame().height(camera.eye) / glm::dot(polygon.normal(), way);
        if (t > 0.0 && polygon.contains(polygon.frame().to_local(camera.eye + t * way)))
          first = std::min(first, t);
      }
      return first;
    };
    int n_wrong = 0;
    for (const auto& polygon : model.polygons) {
      const auto ring = polygon.corners()[0];
      for (std::size_t i = 0; i < ring.size(); ++i) {
        for (int k = 0; k < 10; ++k) {
          const Vec3 point = ring[i] + unit(random) * (ring[(i + 1) % ring.size()] - ring[i]);
          const auto image = view.project(point);
          if (!image || image->x < 0 || image->y < 0 || image->x > 1000 || image->y > 800) continue;
          const bool drawn = distance_px(*image, lines) < 1e-6;
          if (drawn != (first_crossing(point) > 1 - 1e-9)) ++n_wrong;
        }
      }
    }
    CHECK(n_wrong == 0);
  }
}

TEST_CASE("Moved, turned and scaled with its camera a scene gives the same picture",
          "[geometry][hidden_lines][property]") {
  const auto model = furnished_room();
  const auto lines = hidden_lines(model.plates(), 7.0, kIntoRoom);
  const double scale = 1e3, a = 0.6;
  const auto moved = [&](const Vec3& p) {
    return scale *
           Vec3(std::cos(a) * p.x - std::sin(a) * p.z, p.y - 1.0, std::sin(a) * p.x + std::cos(a) * p.z);
  };
  std::vector<Polygon> polygons;
  std::vector<Plate> plates;
  for (const auto& polygon : model.polygons) {
    auto rings = polygon.corners();
    for (auto& ring : rings) std::transform(ring.begin(), ring.end(), ring.begin(), moved);
    polygons.emplace_back(rings[0], std::vector<Ring3>(rings.begin() + 1, rings.end()));
  }
  for (std::size_t i = 0; i < polygons.size(); ++i) plates.push_back({&polygons[i], bool(model.bounding[i])});
  Camera camera = kIntoRoom;
  camera.eye = moved(kIntoRoom.eye);
  camera.focus = moved(kIntoRoom.focus);
  camera.up = moved(Vec3(0, 1, 1)) - moved(Vec3(0, 1, 0));
  const auto other = hidden_lines(plates, 7.0 * scale, camera);
  CHECK(other.size() == lines.size());
  CHECK(length_px(other) == Approx(length_px(lines)).epsilon(1e-8));
}

TEST_CASE("An SVG names its size and title and has one line per segment", "[geometry][hidden_lines][unit]") {
  const auto svg = to_svg({{{0, 1}, {2, 3.456}}, {{5, 5}, {6, 7}}}, 640, 480, "Büro <A & B>");
  CHECK(svg.find("viewBox=\"0 0 640 480\"") != std::string::npos);
  CHECK(svg.find("<title>Büro &lt;A &amp; B&gt;</title>") != std::string::npos);
  CHECK(svg.find("M0.00 1.00L2.00 3.46") != std::string::npos);
  CHECK(std::count(svg.begin(), svg.end(), 'M') == 2);
  CHECK(to_svg({}, 10, 10, "").find("</svg>") != std::string::npos);
}

TEST_CASE("A plan shows the room and what stands in it, to scale, lower things hidden by higher ones",
          "[geometry][hidden_lines][unit]") {
  Model model;
  model.add_box({0, 0, 0}, {4, 3, 2.7}, true);
  model.add_box({1, 1, 0}, {3, 2, 0.7});
  model.add_box({2, 0.5, 1.0}, {2.5, 1.5, 1.2});  // over the desk's edge
  Camera camera{{2, 1.5, 3.0}, {2, 1.5, 0}, {0, 1, 0}};
  camera.width = 400, camera.height = 300;
  camera.parallel_m = 4.0;
  const auto lines = hidden_lines(model.plates(), 5.7, camera);
  CHECK(has_line(lines, {100, 100}, {300, 100}));
  CHECK(has_line(lines, {200, 150}, {250, 150}));
  CHECK(has_line(lines, {100, 200}, {200, 200}));  // the desk's near edge on both sides of the shelf
  CHECK(has_line(lines, {250, 200}, {300, 200}));
  CHECK(length_px(lines) ==
        Approx(2.0 * (400 + 300) + 2.0 * (200 + 100) - 50.0 + 2.0 * (50 + 100)).margin(4.0));
}
