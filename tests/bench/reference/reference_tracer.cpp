// Independent reference: illuminance at the measuring points of a zone by path tracing with next-event
// estimation.
//
// Shares no code with lib/dimcore: its own reading of zone.toml, lights.toml and IES files, its own polygons,
// bounding volume hierarchy and random numbers, so that an agreement between the two says something. Unbiased
// but for rounding; double precision throughout; the same result for any number of threads.
//
//   E(point) = sum over luminaires of (1/A) integral over the opening of I(C, gamma) cos(theta) / r^2
//   [direct]
//            + mean over cosine-distributed directions of rho E(first hit) [reflected]
//
// Direct light uses jittered strata of every opening; at later vertices one luminaire is picked with a
// probability that follows a bound of what it can give. Reflected light uses jittered strata of the first
// direction. Every point is computed in kBatches independent batches; the standard error is that of the mean
// of the batches.
//
// Understands what the scenes of this project use: diffuse finishes, holes, features (`on`), two-sided
// panels, boxes, copies, planes, sensors, arrays of luminaires, IES type C, ideal sources. Anything else is
// refused, never ignored.

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

namespace fs = std::filesystem;
using std::numbers::pi;

constexpr int kBatches = 64;
constexpr double kMinWeight = 0.1;  // below this a path plays Russian roulette

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

// ----------------------------------------------------------------------------------------------------
// vectors

struct Vec {
  double x = 0, y = 0, z = 0;
  double operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
};
Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec operator*(double s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec cross(Vec a, Vec b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
double length(Vec a) { return std::sqrt(dot(a, a)); }
Vec unit(Vec a) {
  const double l = length(a);
  if (!(l > 0)) fail("a direction has no length");
  return (1 / l) * a;
}
double& at(Vec& a, int i) { return i == 0 ? a.x : i == 1 ? a.y : a.z; }

struct Box3 {
  Vec lo{1e300, 1e300, 1e300}, hi{-1e300, -1e300, -1e300};
  void grow(Vec p) {
    for (int i = 0; i < 3; ++i) {
      at(lo, i) = std::min(lo[i], p[i]);
      at(hi, i) = std::max(hi[i], p[i]);
    }
  }
  void grow(const Box3& b) { grow(b.lo), grow(b.hi); }
  double half_area() const {
    const Vec d = hi - lo;
    return d.x * d.y + d.y * d.z + d.z * d.x;
  }
};

/// xoshiro256++ (Blackman and Vigna 2019), seeded by splitmix64.
class Random {
 public:
  explicit Random(std::uint64_t seed) {
    for (auto& word : state_) {
      seed += 0x9e3779b97f4a7c15u;
      std::uint64_t z = seed;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
      word = z ^ (z >> 31);
    }
  }
  /// Uniform in [0, 1).
  double operator()() {
    const std::uint64_t result = rotl(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t t = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= t;
    state_[3] = rotl(state_[3], 45);
    return static_cast<double>(result >> 11) * 0x1p-53;
  }

 private:
  static std::uint64_t rotl(std::uint64_t x, int k) { return (x << k) | (x >> (64 - k)); }
  std::array<std::uint64_t, 4> state_{};
};

/// Two unit vectors that complete n to a right-handed frame.
std::pair<Vec, Vec> frame(Vec n) {
  const Vec a = std::abs(n.x) < 0.6 ? Vec{1, 0, 0} : Vec{0, 1, 0};
  const Vec s = unit(cross(a, n));
  return {s, cross(n, s)};
}

/// Cosine-distributed direction about n from two uniform numbers.
Vec cosine_direction(Vec n, double u1, double u2) {
  const auto [s, t] = frame(n);
  const double r = std::sqrt(u1), phi = 2 * pi * u2;
  return (r * std::cos(phi)) * s + (r * std::sin(phi)) * t + std::sqrt(1 - u1) * n;
}

// ----------------------------------------------------------------------------------------------------
// polygons

using Ring = std::vector<Vec>;

struct Polygon {
  std::string name;
  std::vector<Ring> rings;  // outline, then holes and cut-out features: inside is even-odd over all of them
  double reflectance = 0;
  bool two_sided = false;
  std::string on;

  Vec normal;
  double offset = 0;  // normal . p = offset
  int drop = 2;       // coordinate left out for the point-in-polygon test
  double area_m2 = 0;
  Box3 bounds;

  void finish() {
    const Ring& r = rings.front();
    if (r.size() < 3) fail("surface '" + name + "': fewer than three vertices");
    const Vec twice = newell(r);
    normal = unit(twice);
    Vec centre;
    for (Vec p : r) centre = centre + p;
    centre = (1.0 / static_cast<double>(r.size())) * centre;
    offset = dot(normal, centre);
    area_m2 = 0.5 * length(twice);
    for (std::size_t h = 1; h < rings.size(); ++h) area_m2 -= 0.5 * length(newell(rings[h]));
    const double ax = std::abs(normal.x), ay = std::abs(normal.y), az = std::abs(normal.z);
    drop = az >= ax && az >= ay ? 2 : ay >= ax ? 1 : 0;
    for (const Ring& ring : rings)
      for (Vec p : ring) {
        if (std::abs(dot(normal, p) - offset) > 1e-6)
          fail("surface '" + name + "': vertices or holes not in one plane");
        bounds.grow(p);
      }
  }
  bool contains(Vec p) const {
    const int i = drop == 0 ? 1 : 0, j = drop == 2 ? 1 : 2;
    bool inside = false;
    for (const Ring& ring : rings)
      for (std::size_t a = 0, b = ring.size() - 1; a < ring.size(); b = a++) {
        const Vec& q = ring[a];
        const Vec& s = ring[b];
        if ((q[j] > p[j]) != (s[j] > p[j]) && p[i] < (s[i] - q[i]) * (p[j] - q[j]) / (s[j] - q[j]) + q[i])
          inside = !inside;
      }
    return inside;
  }
  /// Distance along the ray, or infinity.
  double hit(Vec o, Vec d, double t_min, double t_max) const {
    const double facing = dot(normal, d);
    if (facing == 0) return std::numeric_limits<double>::infinity();
    const double t = (offset - dot(normal, o)) / facing;
    return t > t_min && t < t_max && contains(o + t * d) ? t : std::numeric_limits<double>::infinity();
  }

 private:
  static Vec newell(const Ring& r) {
    Vec sum;
    for (std::size_t i = 1; i + 1 < r.size(); ++i) sum = sum + cross(r[i] - r[0], r[i + 1] - r[0]);
    return sum;
  }
};

/// Rectangle of a polygon's own: u along its longest edge.
struct OwnRectangle {
  Vec corner, u, v;
  double length_u = 0, length_v = 0;
  OwnRectangle(const Ring& r, Vec normal) {
    double longest = 0;
    for (std::size_t i = 0; i < r.size(); ++i) {
      const Vec e = r[(i + 1) % r.size()] - r[i];
      if (length(e) > longest * (1 + 1e-12)) longest = length(e), u = unit(e);
    }
    v = cross(normal, u);
    double lo_u = 1e300, lo_v = 1e300, hi_u = -1e300, hi_v = -1e300;
    for (Vec p : r) {
      lo_u = std::min(lo_u, dot(p, u)), hi_u = std::max(hi_u, dot(p, u));
      lo_v = std::min(lo_v, dot(p, v)), hi_v = std::max(hi_v, dot(p, v));
    }
    corner = lo_u * u + lo_v * v + dot(r[0], normal) * normal;
    length_u = hi_u - lo_u, length_v = hi_v - lo_v;
  }
  Vec at(double fu, double fv) const { return corner + (fu * length_u) * u + (fv * length_v) * v; }
};

// ---------------------------------------------------------------------------------- bounding volume
// hierarchy

struct Hit {
  double t = std::numeric_limits<double>::infinity();
  int polygon = -1;
};

class Hierarchy {
 public:
  explicit Hierarchy(const std::vector<Polygon>& polygons) : polygons_(polygons), order_(polygons.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    Box3 all;
    for (const Polygon& p : polygons) all.grow(p.bounds);
    pad_ = 1e-9 * std::max(1.0, length(all.hi - all.lo));
    nodes_.reserve(2 * polygons.size());
    build(0, static_cast<int>(polygons.size()));
  }
  /// Nearest polygon further than t_min, other than `skip`.
  Hit nearest(Vec o, Vec d, double t_min, int skip) const {
    Hit best;
    walk(o, d, best.t, [&](int i) {
      if (i == skip) return false;
      const double t = polygon(i).hit(o, d, t_min, best.t);
      if (t < best.t) best = {t, i};
      return false;
    });
    return best;
  }
  /// Is anything between o and o + d, other than `skip`?
  bool blocked(Vec o, Vec d, double t_min, int skip) const {
    double reach = 1 - 1e-9;
    bool found = false;
    walk(o, d, reach, [&](int i) {
      found = i != skip && polygon(i).hit(o, d, t_min, 1 - 1e-9) < 1;
      return found;
    });
    return found;
  }

 private:
  struct Node {
    Box3 box;
    int first = 0, count = 0;  // leaf: polygons order_[first, first + count)
    int right = 0;             // else: left child follows, right child is here
    int axis = 0;
  };
  const Polygon& polygon(int i) const { return polygons_[static_cast<std::size_t>(i)]; }
  int index(int i) const { return order_[static_cast<std::size_t>(i)]; }
  double centre(int i, int axis) const {
    return 0.5 * (polygon(i).bounds.lo[axis] + polygon(i).bounds.hi[axis]);
  }

  int build(int begin, int end) {
    const int id = static_cast<int>(nodes_.size());
    nodes_.emplace_back();
    Box3 box;
    for (int k = begin; k < end; ++k) box.grow(polygon(index(k)).bounds);
    const Vec pad{pad_, pad_, pad_};
    box.lo = box.lo - pad, box.hi = box.hi + pad;
    int best_axis = -1, best_split = 0;
    double best_cost = static_cast<double>(end - begin) * box.half_area();
    const auto first = order_.begin();
    const auto sort_by = [&](int axis) {
      std::sort(first + begin, first + end, [&](int a, int b) {
        return centre(a, axis) != centre(b, axis) ? centre(a, axis) < centre(b, axis) : a < b;
      });
    };
    for (int axis = 0; axis < 3 && end - begin > 2; ++axis) {
      sort_by(axis);
      std::vector<double> right_area(static_cast<std::size_t>(end - begin));
      Box3 r;
      for (int k = end - 1; k > begin; --k) {
        r.grow(polygon(index(k)).bounds);
        right_area[static_cast<std::size_t>(k - begin)] = r.half_area();
      }
      Box3 l;
      for (int k = begin + 1; k < end; ++k) {
        l.grow(polygon(index(k - 1)).bounds);
        const double cost = 0.5 * box.half_area() + (k - begin) * l.half_area() +
                            (end - k) * right_area[static_cast<std::size_t>(k - begin)];
        if (cost < best_cost) best_cost = cost, best_axis = axis, best_split = k;
      }
    }
    Node node{box, begin, end - begin, 0, 0};
    if (best_axis >= 0) {
      sort_by(best_axis);
      build(begin, best_split);
      node.right = build(best_split, end);
      node.count = 0, node.axis = best_axis;
    }
    nodes_[static_cast<std::size_t>(id)] = node;
    return id;
  }

  template <class Visit>
  void walk(Vec o, Vec d, double& reach, Visit visit) const {
    const Vec inverse{1 / d.x, 1 / d.y, 1 / d.z};
    std::array<int, 96> stack{};
    int depth = 0;
    stack[static_cast<std::size_t>(depth++)] = 0;
    while (depth > 0) {
      const int id = stack[static_cast<std::size_t>(--depth)];
      const Node& node = nodes_[static_cast<std::size_t>(id)];
      if (!crosses(node.box, o, inverse, reach)) continue;
      if (node.count > 0) {
        for (int k = node.first; k < node.first + node.count; ++k)
          if (visit(index(k))) return;
        continue;
      }
      const bool forward = d[node.axis] >= 0;
      if (depth + 2 > static_cast<int>(stack.size())) fail("hierarchy too deep");
      stack[static_cast<std::size_t>(depth++)] = forward ? node.right : id + 1;
      stack[static_cast<std::size_t>(depth++)] = forward ? id + 1 : node.right;
    }
  }
  static bool crosses(const Box3& b, Vec o, Vec inverse, double reach) {
    double enter = 0, leave = reach;
    for (int i = 0; i < 3; ++i) {
      double a = (b.lo[i] - o[i]) * inverse[i], c = (b.hi[i] - o[i]) * inverse[i];
      if (a > c) std::swap(a, c);
      enter = a > enter ? a : enter;  // comparisons with NaN (0 * inf) leave the interval as it is
      leave = c < leave ? c : leave;
    }
    return enter <= leave * (1 + 1e-12);
  }

  const std::vector<Polygon>& polygons_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
  double pad_ = 0;
};

// ----------------------------------------------------------------------------------------------------
// photometry

/// Candela over C and gamma, bilinear in the angles.
struct Distribution {
  std::vector<double> c_deg, g_deg;
  std::vector<double> candela;  // [C][gamma]
  double length_m = 0, width_m = 0;

  double value(std::size_t c, std::size_t g) const { return candela[c * g_deg.size() + g]; }
  static std::pair<std::size_t, double> place(const std::vector<double>& grid, double x) {
    if (grid.size() == 1) return {0, 0.0};
    auto k = static_cast<std::size_t>(std::upper_bound(grid.begin(), grid.end(), x) - grid.begin());
    k = std::clamp<std::size_t>(k, 1, grid.size() - 1);
    return {k - 1, std::clamp((x - grid[k - 1]) / (grid[k] - grid[k - 1]), 0.0, 1.0)};
  }
  /// C folded into the range that the file tabulates.
  double fold(double c) const {
    const double last = c_deg.back();
    if (c < 0) c += 360;
    if (last < 359 && c > 180) c = 360 - c;
    if (last < 179 && c > 90) c = 180 - c;
    return c;
  }
  double intensity(double c, double g) const {
    if (g < g_deg.front() - 1e-9 || g > g_deg.back() + 1e-9) return 0;
    const auto [gi, gf] = place(g_deg, g);
    const std::size_t gn = std::min(gi + 1, g_deg.size() - 1);
    if (c_deg.size() == 1) return (1 - gf) * value(0, gi) + gf * value(0, gn);
    const auto [ci, cf] = place(c_deg, fold(c));
    return (1 - cf) * ((1 - gf) * value(ci, gi) + gf * value(ci, gn)) +
           cf * ((1 - gf) * value(ci + 1, gi) + gf * value(ci + 1, gn));
  }
  /// Exact integral of the bilinear distribution over the sphere.
  double flux_lm() const {
    const auto ring = [&](std::size_t c) {  // integral over gamma of I sin(gamma)
      double sum = 0;
      for (std::size_t g = 0; g + 1 < g_deg.size(); ++g) {
        const double a = g_deg[g] * pi / 180, b = g_deg[g + 1] * pi / 180;
        const double slope = (value(c, g + 1) - value(c, g)) / (b - a), base = value(c, g) - slope * a;
        const auto primitive = [&](double x) {
          return -(base + slope * x) * std::cos(x) + slope * std::sin(x);
        };
        sum += primitive(b) - primitive(a);
      }
      return sum;
    };
    if (c_deg.size() == 1) return 2 * pi * ring(0);
    double sum = 0;
    for (std::size_t c = 0; c + 1 < c_deg.size(); ++c)
      sum += 0.5 * (ring(c) + ring(c + 1)) * (c_deg[c + 1] - c_deg[c]) * pi / 180;
    return sum * 360 / (c_deg.back() - c_deg.front());
  }
};

Distribution read_ies(const fs::path& path) {
  std::ifstream in(path);
  if (!in) fail("cannot open " + path.string());
  std::string line;
  bool tilt = false;
  while (!tilt && std::getline(in, line)) tilt = line.rfind("TILT=", 0) == 0;
  while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.pop_back();
  if (line != "TILT=NONE") fail(path.string() + ": only TILT=NONE is understood here");
  std::stringstream rest;
  rest << in.rdbuf();
  std::string text = rest.str();
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream numbers(text);
  const auto next = [&] {
    double x = 0;
    if (!(numbers >> x)) fail(path.string() + ": numbers missing or unreadable");
    return x;
  };
  next();  // lamps
  next();  // lumens per lamp
  const double multiplier = next();
  const auto n_g = static_cast<std::size_t>(next()), n_c = static_cast<std::size_t>(next());
  if (next() != 1) fail(path.string() + ": only type C photometry is understood here");
  const double to_m = next() == 1 ? 0.3048 : 1;
  Distribution d;
  d.width_m = next() * to_m;
  d.length_m = next() * to_m;
  const double height_m = next() * to_m;
  if (d.width_m < 0 || d.length_m < 0)
    fail(path.string() + ": only rectangular openings are understood here");
  if (height_m != 0)
    std::cerr << "reference_tracer: " << path.string()
              << ": luminous height ignored, opening taken as flat\n";
  const double ballast = next() * next();  // ballast factor, ballast-lamp factor
  next();                                  // watts
  for (std::size_t i = 0; i < n_g; ++i) d.g_deg.push_back(next());
  for (std::size_t i = 0; i < n_c; ++i) d.c_deg.push_back(next());
  for (std::size_t i = 0; i < n_g * n_c; ++i) d.candela.push_back(next() * multiplier * ballast);
  const double last = d.c_deg.back();
  if (d.c_deg.front() != 0 || (last != 0 && last != 90 && last != 180 && last != 360))
    fail(path.string() + ": horizontal angles are not 0, 0-90, 0-180 or 0-360");
  return d;
}

struct Luminaire {
  std::string name;
  Vec at, aim{0, 0, -1}, c0, c90;
  double length_m = 0, width_m = 0;
  double factor = 1;
  enum class Kind { file, isotropic, lambertian } kind = Kind::file;
  std::shared_ptr<const Distribution> distribution;
  std::array<double, 64>
      bound{};  // largest intensity in equal steps of cos(gamma) from -1 to 1, with its neighbours
  double bound_max = 0, half_diagonal_m = 0;

  double intensity(Vec d) const {  // d: unit, away from the luminaire
    const double cosine = dot(d, aim);
    if (kind == Kind::isotropic) return factor;
    if (kind == Kind::lambertian) return factor * std::max(0.0, cosine);
    const double c = std::atan2(dot(d, c90), dot(d, c0)) * 180 / pi;
    const double g = std::atan2(length(cross(aim, d)), cosine) * 180 / pi;
    return factor * distribution->intensity(c, g);
  }
  double flux_lm() const {
    if (kind == Kind::isotropic) return 4 * pi * factor;
    if (kind == Kind::lambertian) return pi * factor;
    return factor * distribution->flux_lm();
  }
  Vec sample(double u, double v) const {
    return at + ((u - 0.5) * length_m) * c0 + ((v - 0.5) * width_m) * c90;
  }
  bool is_point() const { return length_m == 0 && width_m == 0; }

  void finish() {
    half_diagonal_m = 0.5 * std::hypot(length_m, width_m);
    std::array<double, 64> raw{};
    for (int i = 0; i < 64 * 8; ++i)
      for (int j = 0; j < 72; ++j) {
        const double cosine = -1 + (i + 0.5) / 256, sine = std::sqrt(1 - cosine * cosine),
                     phi = 2 * pi * j / 72;
        const Vec d = cosine * aim + (sine * std::cos(phi)) * c0 + (sine * std::sin(phi)) * c90;
        auto& cell = raw[static_cast<std::size_t>(i / 8)];
        cell = std::max(cell, intensity(d));
      }
    for (std::size_t i = 0; i < 64; ++i)
      bound[i] = std::max({raw[i], raw[i > 0 ? i - 1 : 0], raw[i < 63 ? i + 1 : 63]});
    bound_max = *std::max_element(raw.begin(), raw.end());
  }
  /// About the most that this luminaire can give at p; positive wherever it can give anything at all.
  double estimate(Vec p, Vec n) const {
    const Vec from = p - at;
    const double r = std::max(length(from), 1e-6);
    const double tilt = -dot(from, n) / r + half_diagonal_m / r;
    if (tilt <= 0) return 0;
    const double cosine = std::clamp(dot(from, aim) / r, -1.0, 1.0);
    const auto cell = static_cast<std::size_t>(std::min(63.0, (cosine + 1) * 32));
    const double r2 = std::max(r * r, half_diagonal_m * half_diagonal_m);
    return (bound[cell] + 0.02 * bound_max) * std::min(1.0, tilt) / r2;
  }
};

// ---------------------------------------------------------------------------------------------------- the
// scene

struct MeasuringPoint {
  std::string plane;
  int number = 0;
  Vec p, n;
};

struct Scene {
  double metres = 1;
  std::vector<Polygon> polygons;
  std::vector<MeasuringPoint> points;
  std::vector<Luminaire> luminaires;
  std::unique_ptr<Hierarchy> hierarchy;
};

void only_keys(const toml::table& t, const std::set<std::string>& known, const std::string& what) {
  for (const auto& [key, node] : t)
    if (!known.contains(std::string(key.str())))
      fail(what + ", line " + std::to_string(node.source().begin.line) + ": '" + std::string(key.str()) +
           "' is not understood by the reference tracer");
}

double number(const toml::node* node, const std::string& what) {
  const auto x = node ? node->value<double>() : std::nullopt;
  if (!x) fail(what + ": a number is wanted");
  return *x;
}

std::vector<double> numbers(const toml::node* node, const std::string& what) {
  const toml::array* a = node ? node->as_array() : nullptr;
  if (!a) fail(what + ": a list of numbers is wanted");
  std::vector<double> out;
  for (const auto& x : *a) out.push_back(number(&x, what));
  return out;
}

Vec vector3(const toml::node* node, const std::string& what) {
  const auto a = numbers(node, what);
  if (a.size() != 3) fail(what + ": three numbers are wanted");
  return {a[0], a[1], a[2]};
}

std::string text(const toml::table& t, const char* key, const std::string& what) {
  const auto s = t[key].value<std::string>();
  if (!s) fail(what + ": '" + key + "' is missing");
  return *s;
}

const toml::array& blocks(const toml::table& t, const char* key) {
  static const toml::array none;
  const toml::array* a = t[key].as_array();
  return a ? *a : none;
}

Ring ring_of(const toml::node* node, double metres, const std::string& what) {
  const toml::array* a = node ? node->as_array() : nullptr;
  if (!a) fail(what + ": a list of vertices is wanted");
  Ring r;
  for (const auto& p : *a) r.push_back(metres * vector3(&p, what));
  return r;
}

using Finishes = std::map<std::string, double>;

Finishes read_finishes(const toml::table& zone, const fs::path& db) {
  Finishes out;
  const toml::table* finishes = zone["finishes"].as_table();
  if (!finishes) return out;
  for (const auto& [key, node] : *finishes) {
    const std::string name(key.str()), what = "finish '" + name + "'";
    if (const auto entry = node.value<std::string>()) {
      const toml::table file = toml::parse_file((db / "surfaces" / (*entry + ".toml")).string());
      if (file["specular"].value_or(0.0) != 0) fail(what + ": only diffuse finishes are understood here");
      out[name] = number(file.get("diffuse"), what);
    } else if (const toml::table* t = node.as_table()) {
      only_keys(*t, {"diffuse"}, what);
      out[name] = number(t->get("diffuse"), what);
    } else {
      out[name] = number(&node, what);
    }
    if (!(out[name] >= 0 && out[name] < 1)) fail(what + ": reflectance outside 0..1");
  }
  return out;
}

std::vector<Polygon> box_faces(const toml::table& t, const std::string& name, double metres,
                               double reflectance) {
  const Vec c = metres * vector3(t.get("corner"), name), s = metres * vector3(t.get("size"), name);
  const double turn = t["turn"].value_or(0.0) * pi / 180;
  const auto corner = [&](int x, int y, int z) {
    const double dx = x * s.x, dy = y * s.y;
    return c +
           Vec{dx * std::cos(turn) - dy * std::sin(turn), dx * std::sin(turn) + dy * std::cos(turn), z * s.z};
  };
  const std::array<std::pair<const char*, Ring>, 6> faces{{
      {"bottom", {corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0)}},
      {"top", {corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)}},
      {"south", {corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)}},
      {"north", {corner(0, 1, 0), corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0)}},
      {"west", {corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0)}},
      {"east", {corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1)}},
  }};
  std::vector<Polygon> out;
  for (const auto& [face, ring] : faces) {
    Polygon p;
    p.name = name + "." + face, p.rings = {ring}, p.reflectance = reflectance;
    out.push_back(p);
  }
  return out;
}

void read_planes(const toml::table& zone, Scene& scene) {
  for (const auto& node : blocks(zone, "plane")) {
    const toml::table& t = *node.as_table();
    const std::string name = text(t, "name", "plane");
    only_keys(t, {"name", "vertices", "spacing", "grid"}, name);
    Polygon p;
    p.name = name, p.rings = {ring_of(t.get("vertices"), scene.metres, name)};
    p.finish();
    const OwnRectangle r(p.rings[0], p.normal);
    int nu = 0, nv = 0;
    if (t.contains("grid")) {
      const auto g = numbers(t.get("grid"), name);
      nu = static_cast<int>(g.at(0)), nv = static_cast<int>(g.at(1));
    } else {
      const double spacing = scene.metres * number(t.get("spacing"), name + ": spacing");
      nu = static_cast<int>(std::ceil(r.length_u / spacing - 1e-9));
      nv = static_cast<int>(std::ceil(r.length_v / spacing - 1e-9));
    }
    int count = 0;
    for (int j = 0; j < nv; ++j)
      for (int i = 0; i < nu; ++i) {
        const Vec q = r.at((i + 0.5) / nu, (j + 0.5) / nv);
        if (p.contains(q)) scene.points.push_back({name, count++, q, p.normal});
      }
  }
  for (const auto& node : blocks(zone, "sensors")) {
    const toml::table& t = *node.as_table();
    const std::string name = text(t, "name", "sensors");
    only_keys(t, {"name", "points"}, name);
    int count = 0;
    for (const auto& x : *t["points"].as_array()) {
      const auto a = numbers(&x, name);
      if (a.size() != 6) fail(name + ": a sensor is x y z nx ny nz");
      scene.points.push_back({name, count++, scene.metres * Vec{a[0], a[1], a[2]}, unit({a[3], a[4], a[5]})});
    }
  }
}

/// "finishes.wall.diffuse=0.7": the only kind of override that a validation needs here.
void override_finish(toml::table& zone, const std::string& setting) {
  const auto dot1 = setting.find('.'), dot2 = setting.rfind('.'), equals = setting.find('=');
  const auto last = setting.rfind('.', equals);
  if (dot1 == std::string::npos || dot2 == std::string::npos || equals == std::string::npos || last <= dot1 ||
      setting.substr(0, dot1) != "finishes" || setting.substr(last + 1, equals - last - 1) != "diffuse")
    fail("--set understands finishes.NAME.diffuse=VALUE only");
  toml::table* t = zone["finishes"][setting.substr(dot1 + 1, last - dot1 - 1)].as_table();
  if (!t) fail("--set " + setting + ": no such inline finish");
  t->insert_or_assign("diffuse", std::stod(setting.substr(equals + 1)));
}

void read_zone(const fs::path& path, const fs::path& db, const std::vector<std::string>& settings,
               Scene& scene) {
  toml::table zone = toml::parse_file(path.string());
  for (const std::string& s : settings) override_finish(zone, s);
  only_keys(zone,
            {"dim", "name", "unit", "cell", "finishes", "surface", "box", "copy", "plane", "sensors", "view"},
            path.string());
  if (zone["dim"].value_or(std::string()) != "zone/1") fail(path.string() + ": not a zone/1 file");
  const std::map<std::string, double> units{
      {"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}, {"ft", 0.3048}, {"in", 0.0254}};
  const auto unit_name = zone["unit"].value_or(std::string("m"));
  if (!units.contains(unit_name)) fail("unit '" + unit_name + "' unknown");
  scene.metres = units.at(unit_name);
  const Finishes finishes = read_finishes(zone, db);
  const auto reflectance = [&](const toml::table& t, const std::string& what) {
    const auto f = finishes.find(text(t, "finish", what));
    if (f == finishes.end()) fail(what + ": unknown finish");
    return f->second;
  };

  std::map<std::string, std::vector<Polygon>> items;  // what a copy can be made of
  std::vector<std::string> order;
  const auto add = [&](const std::string& name, std::vector<Polygon> polygons) {
    if (!items.emplace(name, std::move(polygons)).second) fail("name '" + name + "' used twice");
    order.push_back(name);
  };
  for (const auto& node : blocks(zone, "surface")) {
    const toml::table& t = *node.as_table();
    Polygon p;
    p.name = text(t, "name", "surface");
    only_keys(t, {"name", "finish", "vertices", "holes", "sides", "on", "cell", "grid"}, p.name);
    p.rings = {ring_of(t.get("vertices"), scene.metres, p.name)};
    for (const auto& hole : blocks(t, "holes")) p.rings.push_back(ring_of(&hole, scene.metres, p.name));
    p.reflectance = reflectance(t, p.name);
    p.two_sided = t["sides"].value_or(1) == 2;
    p.on = t["on"].value_or(std::string());
    add(p.name, {p});
  }
  for (const auto& node : blocks(zone, "box")) {
    const toml::table& t = *node.as_table();
    const std::string name = text(t, "name", "box");
    only_keys(t, {"name", "finish", "corner", "size", "turn", "cell", "grid"}, name);
    add(name, box_faces(t, name, scene.metres, reflectance(t, name)));
  }
  for (const auto& node : blocks(zone, "copy")) {
    const toml::table& t = *node.as_table();
    const std::string of = text(t, "of", "copy");
    only_keys(t, {"of", "names", "by"}, "copy of '" + of + "'");
    if (!items.contains(of)) fail("copy of '" + of + "', which is not there");
    const toml::array &names = blocks(t, "names"), &by = blocks(t, "by");
    if (names.size() != by.size())
      fail("copy of '" + of + "': " + std::to_string(names.size()) + " names, " + std::to_string(by.size()) +
           " displacements");
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto name = names[i].value<std::string>().value();
      const Vec move = scene.metres * vector3(&by[i], of);
      std::vector<Polygon> copy = items.at(of);
      for (Polygon& p : copy) {
        p.name = name + p.name.substr(of.size());
        for (Ring& r : p.rings)
          for (Vec& v : r) v = v + move;
      }
      add(name, copy);
    }
  }
  for (const std::string& name : order)
    for (const Polygon& p : items.at(name)) scene.polygons.push_back(p);
  for (const Polygon& feature : scene.polygons) {
    if (feature.on.empty()) continue;
    const auto parent = std::find_if(scene.polygons.begin(), scene.polygons.end(),
                                     [&](const Polygon& p) { return p.name == feature.on; });
    if (parent == scene.polygons.end())
      fail("'" + feature.name + "' lies on '" + feature.on + "', which is not there");
    parent->rings.push_back(feature.rings.front());
  }
  for (Polygon& p : scene.polygons) p.finish();
  read_planes(zone, scene);
}

/// Every luminaire's opening as a black two-sided panel 0.1 mm behind it.
void add_black_bodies(Scene& scene) {
  constexpr double kBehind_m = 1e-4;
  for (const Luminaire& l : scene.luminaires) {
    if (l.length_m == 0 || l.width_m == 0) continue;
    const auto corner = [&](double u, double v) { return l.sample(u, v) - kBehind_m * l.aim; };
    Polygon p;
    p.name = l.name + ".body", p.two_sided = true;
    p.rings = {{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)}};
    p.finish();
    scene.polygons.push_back(p);
  }
}

fs::path find_fitting(const std::string& fitting, const fs::path& lights_folder, const fs::path& db) {
  if (fitting.ends_with(".ies") || fitting.ends_with(".IES")) return lights_folder / fitting;
  const fs::path entry = db / "fittings" / (fitting + ".toml");
  const toml::table t = toml::parse_file(entry.string());
  for (const auto& [key, node] : t)
    if (const auto s = node.value<std::string>(); s && s->ends_with(".ies")) return entry.parent_path() / *s;
  fail(entry.string() + ": names no .ies file");
}

void read_lights(const fs::path& path, const fs::path& db, Scene& scene) {
  const toml::table lights = toml::parse_file(path.string());
  only_keys(lights, {"dim", "luminaire"}, path.string());
  std::map<fs::path, std::shared_ptr<const Distribution>> files;
  for (const auto& node : blocks(lights, "luminaire")) {
    const toml::table& t = *node.as_table();
    const std::string name = text(t, "name", "luminaire");
    only_keys(t,
              {"name", "group", "fitting", "ideal", "intensity", "lumens", "at", "aim", "c0", "turn",
               "opening", "dim", "count", "pitch", "spectrum"},
              name);
    Luminaire l;
    if (t.contains("aim")) l.aim = unit(vector3(t.get("aim"), name));
    Vec c0 = std::abs(l.aim.x) > 1 - 1e-9 ? Vec{0, 1, 0} : Vec{1, 0, 0};
    if (t.contains("c0")) c0 = vector3(t.get("c0"), name);
    c0 = unit(c0 - dot(c0, l.aim) * l.aim);
    const Vec c90 = cross(c0, l.aim);
    const double turn = t["turn"].value_or(0.0) * pi / 180;
    l.c0 = std::cos(turn) * c0 + std::sin(turn) * c90;
    l.c90 = cross(l.c0, l.aim);
    if (const auto ideal = t["ideal"].value<std::string>()) {
      if (*ideal != "isotropic" && *ideal != "lambertian") fail(name + ": ideal '" + *ideal + "' unknown");
      l.kind = *ideal == "isotropic" ? Luminaire::Kind::isotropic : Luminaire::Kind::lambertian;
      l.factor = 1;
      l.factor = t.contains("intensity") ? number(t.get("intensity"), name)
                                         : number(t.get("lumens"), name) / l.flux_lm();
    } else {
      const fs::path file = find_fitting(text(t, "fitting", name), path.parent_path(), db);
      auto& d = files[file];
      if (!d) {
        d = std::make_shared<Distribution>(read_ies(file));
        std::cerr << "reference_tracer: " << file.filename().string() << ": " << d->flux_lm()
                  << " lm, opening " << d->length_m << " x " << d->width_m << " m\n";
      }
      l.distribution = d;
      l.length_m = d->length_m, l.width_m = d->width_m;
      if (t.contains("lumens")) l.factor = number(t.get("lumens"), name) / d->flux_lm();
    }
    if (const auto opening = t["opening"]; opening.is_array()) {
      const auto size = numbers(opening.node(), name);
      l.length_m = scene.metres * size.at(0), l.width_m = scene.metres * size.at(1);
    } else if (opening.value_or(std::string("file")) == "point") {
      l.length_m = l.width_m = 0;
    }
    l.factor *= t["dim"].value_or(1.0);
    const Vec first = scene.metres * vector3(t.get("at"), name);
    std::vector<double> count{1, 1}, pitch{0, 0};
    const bool array = t.contains("count");
    if (array) count = numbers(t.get("count"), name), pitch = numbers(t.get("pitch"), name);
    for (int j = 0; j < count.at(1); ++j)
      for (int i = 0; i < count.at(0); ++i) {
        l.name = array ? name + "[" + std::to_string(i) + "," + std::to_string(j) + "]" : name;
        l.at = first + scene.metres * Vec{i * pitch.at(0), j * pitch.at(1), 0};
        l.finish();
        scene.luminaires.push_back(l);
      }
  }
  if (scene.luminaires.empty()) fail(path.string() + ": no luminaires");
}

// ---------------------------------------------------------------------------------------------------- light

struct Tally {
  std::uint64_t rays = 0, escaped = 0, behind = 0, first = 0, first_behind = 0;
  void add(const Tally& t) {
    rays += t.rays, escaped += t.escaped, behind += t.behind, first += t.first,
        first_behind += t.first_behind;
  }
};

class Tracer {
 public:
  Tracer(const Scene& scene, int strata) : scene_(scene), strata_(strata), chance_(scene.luminaires.size()) {}

  Tally tally;

  /// Illuminance that luminaire l gives at p from the point (u, v) of its opening.
  double from(const Luminaire& l, Vec p, Vec n, int skip, double u, double v) {
    const Vec q = l.sample(u, v), to = q - p;
    const double cosine = dot(to, n);
    if (cosine <= 0) return 0;
    const double r2 = dot(to, to), r = std::sqrt(r2);
    const double intensity = l.intensity((-1 / r) * to);
    if (intensity == 0) return 0;
    ++tally.rays;
    return scene_.hierarchy->blocked(p, to, 1e-9 / r, skip) ? 0 : intensity * cosine / (r2 * r);
  }
  /// Direct illuminance from all luminaires, jittered strata of their openings.
  double direct(Vec p, Vec n, int skip, Random& random) {
    double sum = 0;
    for (const Luminaire& l : scene_.luminaires) {
      const int k = l.is_point() ? 1 : strata_;
      double part = 0;
      for (int i = 0; i < k; ++i)
        for (int j = 0; j < k; ++j) part += from(l, p, n, skip, (i + random()) / k, (j + random()) / k);
      sum += part / (k * k);
    }
    return sum;
  }
  /// Direct illuminance from one luminaire, picked by what it can give.
  double direct_one(Vec p, Vec n, int skip, Random& random) {
    double total = 0;
    for (std::size_t i = 0; i < chance_.size(); ++i)
      chance_[i] = total += scene_.luminaires[i].estimate(p, n);
    if (total <= 0) return 0;
    const double pick = random() * total;
    const auto i = std::min(
        static_cast<std::size_t>(std::upper_bound(chance_.begin(), chance_.end(), pick) - chance_.begin()),
        chance_.size() - 1);
    const double probability = (chance_[i] - (i > 0 ? chance_[i - 1] : 0)) / total;
    const double u = random(), v = random();
    return probability > 0 ? from(scene_.luminaires[i], p, n, skip, u, v) / probability : 0;
  }
  /// Illuminance by light reflected at least once, for one first direction.
  double reflected(Vec p, Vec n, int skip, double u1, double u2, Random& random) {
    double weight = 1, sum = 0;
    Vec d = cosine_direction(n, u1, u2);
    for (int depth = 0;; ++depth) {
      const Hit hit = scene_.hierarchy->nearest(p, d, 1e-9, skip);
      ++tally.rays, tally.first += depth == 0;
      if (hit.polygon < 0) return ++tally.escaped, sum;
      const Polygon& q = scene_.polygons[static_cast<std::size_t>(hit.polygon)];
      const bool front = dot(d, q.normal) < 0;
      if (!front && !q.two_sided) return ++tally.behind, tally.first_behind += depth == 0, sum;
      weight *= q.reflectance;
      if (weight == 0) return sum;
      p = p + hit.t * d, n = front ? q.normal : -1 * q.normal, skip = hit.polygon;
      sum += weight * direct_one(p, n, skip, random);
      if (weight < kMinWeight) {
        if (random() * kMinWeight >= weight) return sum;
        weight = kMinWeight;
      }
      const double a = random();
      d = cosine_direction(n, a, random());
    }
  }

 private:
  const Scene& scene_;
  int strata_;
  std::vector<double> chance_;
};

struct Estimate {
  double mean = 0, error = 0;
  static Estimate of(const std::vector<double>& batches) {
    const auto n = static_cast<double>(batches.size());
    double sum = 0, square = 0;
    for (double b : batches) sum += b;
    for (double b : batches) square += (b - sum / n) * (b - sum / n);
    return {sum / n, std::sqrt(square / (n * (n - 1)))};
  }
};

struct Options {
  fs::path zone, lights, db = "db";
  std::vector<std::string> settings;
  long samples = 65536;
  int strata = 4, threads = 1;
  std::uint64_t seed = 1;
  bool surfaces = false, bodies = false;
  std::string view, picture;
};

/// Runs `job(i, tracer)` for i in 0 … n-1 on all threads; each i has its own random numbers, so the order
/// does not matter.
template <class Job>
Tally for_all(std::size_t n, const Scene& scene, const Options& options, Job job) {
  std::atomic<std::size_t> next{0};
  std::vector<Tally> tallies(static_cast<std::size_t>(options.threads));
  std::vector<std::thread> threads;
  for (auto& tally : tallies)
    threads.emplace_back([&] {
      Tracer tracer(scene, options.strata);
      for (std::size_t i = next++; i < n; i = next++) job(i, tracer);
      tally = tracer.tally;
    });
  for (auto& t : threads) t.join();
  Tally all;
  for (const Tally& t : tallies) all.add(t);
  return all;
}

std::pair<long, long> first_strata(long samples) {
  const long n = std::max(1L, samples / kBatches), a = static_cast<long>(std::sqrt(static_cast<double>(n)));
  return {a, n / a};
}

void report(const Tally& t) {
  std::fprintf(stderr, "reference_tracer: %.3g M rays, %llu escaped, %llu met a back face\n",
               static_cast<double>(t.rays) / 1e6, static_cast<unsigned long long>(t.escaped),
               static_cast<unsigned long long>(t.behind));
}

void points(const Scene& scene, const Options& options, const std::string& command) {
  std::vector<Estimate> results(scene.points.size());
  std::vector<double> behind(scene.points.size());
  const auto [n1, n2] = first_strata(options.samples);
  const Tally tally =
      for_all(scene.points.size(), scene, options, [&, n1 = n1, n2 = n2](std::size_t i, Tracer& tracer) {
        const MeasuringPoint& m = scene.points[i];
        const Tally before = tracer.tally;
        std::vector<double> batches;
        for (int b = 0; b < kBatches; ++b) {
          Random random(options.seed * 0x9e3779b97f4a7c15u + i * kBatches + static_cast<std::size_t>(b));
          double sum = 0;
          for (long j = 0; j < n1; ++j)
            for (long k = 0; k < n2; ++k) {
              const double u1 = (static_cast<double>(j) + random()) / static_cast<double>(n1);
              const double u2 = (static_cast<double>(k) + random()) / static_cast<double>(n2);
              sum += tracer.reflected(m.p, m.n, -1, u1, u2, random);
            }
          batches.push_back(tracer.direct(m.p, m.n, -1, random) + sum / static_cast<double>(n1 * n2));
        }
        results[i] = Estimate::of(batches);
        behind[i] = static_cast<double>(tracer.tally.first_behind - before.first_behind) /
                    static_cast<double>(tracer.tally.first - before.first);
      });

  double sum = 0, square = 0, worst = 0;
  for (const Estimate& e : results) {
    sum += e.mean;
    const double relative = e.mean > 0 ? e.error / e.mean : 0;
    square += relative * relative, worst = std::max(worst, relative);
  }
  const auto n = static_cast<double>(results.size());
  std::printf("# %s\n", command.c_str());
  std::printf(
      "# %ld paths and %d direct samples per luminaire and point, %zu polygons, %zu luminaires, %zu points\n",
      n1 * n2 * kBatches, options.strata * options.strata * kBatches, scene.polygons.size(),
      scene.luminaires.size(), results.size());
  std::printf("# mean %.6g lx; standard error of a point: RMS %.3g %%, largest %.3g %%\n", sum / n,
              100 * std::sqrt(square / n), 100 * worst);
  std::printf("plane,point,x_m,y_m,z_m,nx,ny,nz,illuminance_lx,std_error_lx\n");
  for (std::size_t i = 0; i < results.size(); ++i) {
    const MeasuringPoint& m = scene.points[i];
    const auto tidy = [](double x) { return std::abs(x) < 1e-12 ? 0.0 : x; };
    std::printf("%s,%d,%.8g,%.8g,%.8g,%.8g,%.8g,%.8g,%.8g,%.3g\n", m.plane.c_str(), m.number, tidy(m.p.x),
                tidy(m.p.y), tidy(m.p.z), tidy(m.n.x), tidy(m.n.y), tidy(m.n.z), results[i].mean,
                results[i].error);
    if (behind[i] > 0.2)
      std::fprintf(stderr, "reference_tracer: warning: point %d of '%s' seems to lie inside a box\n",
                   m.number, m.plane.c_str());
  }
  report(tally);
}

/// Area means over the surfaces (both sides of a two-sided panel together), from random points on them.
void surfaces(const Scene& scene, const Options& options, const std::string& command) {
  std::vector<Estimate> results(scene.polygons.size());
  double total_m2 = 0;
  for (const Polygon& p : scene.polygons) total_m2 += p.area_m2;
  const double per_m2 = static_cast<double>(options.samples) * static_cast<double>(results.size()) / total_m2;
  const Tally tally = for_all(results.size(), scene, options, [&](std::size_t i, Tracer& tracer) {
    const Polygon& polygon = scene.polygons[i];
    const OwnRectangle rectangle(polygon.rings.front(), polygon.normal);
    std::vector<double> batches;
    for (int b = 0; b < kBatches; ++b) {
      Random random(options.seed * 0x9e3779b97f4a7c15u + i * kBatches + static_cast<std::size_t>(b));
      const long n = 2 + 2 * (std::max(options.samples / 8, static_cast<long>(per_m2 * polygon.area_m2)) /
                              (2 * kBatches));
      double sum = 0;
      for (long k = 0; k < n; ++k) {
        Vec p;
        do {
          const double u = random();
          p = rectangle.at(u, random());
        } while (!polygon.contains(p));
        const Vec normal = polygon.two_sided && k % 2 == 1 ? -1 * polygon.normal : polygon.normal;
        const double u1 = random(), u2 = random();
        sum += tracer.direct_one(p, normal, static_cast<int>(i), random) +
               tracer.reflected(p, normal, static_cast<int>(i), u1, u2, random);
      }
      batches.push_back(sum / static_cast<double>(n));
    }
    results[i] = Estimate::of(batches);
  });
  double emitted = 0, absorbed = 0, variance = 0;
  for (const Luminaire& l : scene.luminaires) emitted += l.flux_lm();
  std::printf("# %s\n", command.c_str());
  std::printf("surface,area_m2,reflectance,illuminance_mean_lx,std_error_lx\n");
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Polygon& p = scene.polygons[i];
    std::printf("%s,%.8g,%.4g,%.8g,%.3g\n", p.name.c_str(), p.area_m2, p.reflectance, results[i].mean,
                results[i].error);
    const double weight = p.area_m2 * (p.two_sided ? 2 : 1) * (1 - p.reflectance);
    absorbed += weight * results[i].mean, variance += weight * weight * results[i].error * results[i].error;
  }
  std::fprintf(stderr, "reference_tracer: emitted %.8g lm, absorbed %.8g +- %.3g lm\n", emitted, absorbed,
               std::sqrt(variance));
  report(tally);
}

/// Luminance seen by a view, as a PPM file, so that the scene can be looked at.
void picture(const Scene& scene, const Options& options) {
  const toml::table zone = toml::parse_file(options.zone.string());
  const toml::table* view = nullptr;
  for (const auto& node : blocks(zone, "view"))
    if ((*node.as_table())["name"].value_or(std::string()) == options.view) view = node.as_table();
  if (!view) fail("no view '" + options.view + "'");
  const Vec eye = scene.metres * vector3(view->get("eye"), "eye");
  const Vec ahead = unit(scene.metres * vector3(view->get("focus"), "focus") - eye);
  const Vec up = view->contains("up") ? vector3(view->get("up"), "up") : Vec{0, 0, 1};
  const Vec right = unit(cross(ahead, up)), above = cross(right, ahead);
  const double half = std::tan(number(view->get("fov"), "fov") * pi / 360);
  const int width = 800, height = 560;
  const long n = std::max(1L, options.samples);
  std::vector<double> luminance(static_cast<std::size_t>(width * height));
  for_all(static_cast<std::size_t>(height), scene, options, [&](std::size_t row, Tracer& tracer) {
    Random random(options.seed + row);
    for (int column = 0; column < width; ++column)
      for (long k = 0; k < n; ++k) {
        const double x = (2 * (column + random()) / width - 1) * half;
        const double y = (height - 2 * (static_cast<double>(row) + random())) / width * half;
        const Vec d = unit(ahead + x * right + y * above);
        const Hit hit = scene.hierarchy->nearest(eye, d, 1e-9, -1);
        double& pixel = luminance[row * width + static_cast<std::size_t>(column)];
        for (const Luminaire& l : scene.luminaires) {
          const double t = dot(l.at - eye, l.aim) / dot(d, l.aim);
          const Vec q = eye + t * d - l.at;
          if (t > 0 && t < hit.t && 2 * std::abs(dot(q, l.c0)) < l.length_m &&
              2 * std::abs(dot(q, l.c90)) < l.width_m)
            pixel += 1e4 / static_cast<double>(n);
        }
        if (hit.polygon < 0) continue;
        const Polygon& p = scene.polygons[static_cast<std::size_t>(hit.polygon)];
        const bool front = dot(d, p.normal) < 0;
        if (!front && !p.two_sided) continue;
        const Vec at = eye + hit.t * d, normal = front ? p.normal : -1 * p.normal;
        const double u1 = random(), u2 = random();
        const double lux = tracer.direct_one(at, normal, hit.polygon, random) +
                           tracer.reflected(at, normal, hit.polygon, u1, u2, random);
        pixel += p.reflectance * lux / pi / static_cast<double>(n);
      }
  });
  std::vector<double> sorted = luminance;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 9 / 10),
                   sorted.end());
  const double white = 1.1 * sorted[sorted.size() * 9 / 10];
  std::ofstream out(options.picture, std::ios::binary);
  out << "P6\n" << width << " " << height << "\n255\n";
  for (double l : luminance) {
    const auto byte =
        static_cast<char>(static_cast<unsigned char>(255 * std::pow(std::min(1.0, l / white), 1 / 2.2)));
    out << byte << byte << byte;
  }
}

constexpr const char* kUsage =
    "usage: reference_tracer ZONE.toml LIGHTS.toml [--db DIR] [--samples N] [--strata K] [--threads N] "
    "[--seed N]\n"
    "                        [--set finishes.NAME.diffuse=VALUE] [--bodies] [--surfaces] [--view NAME --picture "
    "FILE.ppm]\n"
    "  --samples N   paths per point (default 65536), per pixel with --picture; with --surfaces mean per "
    "surface,\n"
    "                shared out by area\n"
    "  --strata K    K x K strata of every opening in each of 64 batches of direct light (default 4)\n"
    "  --bodies      openings of luminaires are black panels, two-sided\n"
    "  --surfaces    area means over the surfaces and the flux balance in place of the measuring points\n";

Options parse(int argc, char** argv) {
  Options o;
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i) {
    const std::string a = argv[i];
    const auto value = [&]() -> std::string {
      if (++i >= argc) fail(a + " needs a value\n" + kUsage);
      return argv[i];
    };
    if (a == "--db")
      o.db = value();
    else if (a == "--samples")
      o.samples = std::stol(value());
    else if (a == "--strata")
      o.strata = std::stoi(value());
    else if (a == "--threads")
      o.threads = std::max(1, std::stoi(value()));
    else if (a == "--seed")
      o.seed = std::stoull(value());
    else if (a == "--set")
      o.settings.push_back(value());
    else if (a == "--surfaces")
      o.surfaces = true;
    else if (a == "--bodies")
      o.bodies = true;
    else if (a == "--view")
      o.view = value();
    else if (a == "--picture")
      o.picture = value();
    else if (a.rfind("--", 0) == 0)
      fail(a + " is not an option\n" + kUsage);
    else
      files.push_back(a);
  }
  if (files.size() != 2) fail(kUsage);
  o.zone = files[0], o.lights = files[1];
  return o;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Options options = parse(argc, argv);
    std::string command = "reference_tracer";
    for (int i = 1; i < argc; ++i) command += std::string(" ") + argv[i];
    Scene scene;
    read_zone(options.zone, options.db, options.settings, scene);
    read_lights(options.lights, options.db, scene);
    if (options.bodies) add_black_bodies(scene);
    scene.hierarchy = std::make_unique<Hierarchy>(scene.polygons);
    if (!options.picture.empty())
      picture(scene, options);
    else if (options.surfaces)
      surfaces(scene, options, command);
    else
      points(scene, options, command);
    return 0;
  } catch (const toml::parse_error& e) {
    std::cerr << "reference_tracer: error: " << e << "\n";
  } catch (const std::exception& e) {
    std::cerr << "reference_tracer: error: " << e.what() << "\n";
  }
  return 3;
}
