#include "property/furnished_rooms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <random>

#include "catch.hpp"
#include "network/point_places.hpp"
#include "property/transport_support.hpp"
#include "scene/lights_reader.hpp"
#include "scene/zone_reader.hpp"

namespace dim::test {
namespace {

// A fitting that no symmetry hides, with an oblong opening; a disc; a beam of some degrees.
std::string photometric_file(const std::string& name, double scale) {
  const bool turned = name == "aside.ies", narrow = name == "beam.ies";
  const Vec3 opening = scale * (turned ? Vec3(0.25, 0.9, 0) : narrow ? Vec3(0.0) : Vec3(-0.4, -0.4, 0));
  const int n_planes = turned ? 9 : 1, n_angles = narrow ? 31 : 19;
  std::string text = fmt::format("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 {} {} 1 2 {:.17g} {:.17g} 0 1 1 10\n",
                                 n_angles, n_planes, opening.x, opening.y);
  const auto angle_deg = [&](int i) { return narrow ? 2.0 * i : 5.0 * i; };
  for (int i = 0; i < n_angles; ++i) text += fmt::format("{} ", angle_deg(i));
  text += "\n";
  for (int i = 0; i < n_planes; ++i) text += fmt::format("{} ", 45.0 * i);
  for (int c = 0; c < n_planes; ++c) {
    text += "\n";
    for (int i = 0; i < n_angles; ++i) {
      const double gamma = radians(angle_deg(i)), plane = radians(45.0 * c - 50.0);
      const double cd = narrow   ? i == 30 ? 0.0 : 4000.0 * std::exp(-std::pow(angle_deg(i) / 15.0, 2))
                          : turned ? 300.0 * std::cos(gamma) * (1.0 + 0.8 * std::cos(plane) * std::sin(gamma))
                                 : 250.0 * std::pow(std::cos(gamma), 2);
      text += fmt::format("{:.4f} ", std::max(0.0, cd));
    }
  }
  return text + "\n";
}

class Maker {
 public:
  explicit Maker(std::uint64_t seed) : random_(seed) { room_.seed = seed; }

  RandomRoom make() {
    width_m_ = in(5.4, 7.4), depth_m_ = in(4.2, 5.4), height_m_ = in(2.4, 3.1);
    pitch_ = {(width_m_ - 2 * kMargin_m) / 3.0, (depth_m_ - 2 * kMargin_m) / 2.0};
    is_l_ = room_.seed % 2 == 1;
    room_.has_mirror = room_.seed % 4 == 2;
    add_shell();
    add_partition();
    add_furniture();
    add_lamps();
    add_points();
    return std::move(room_);
  }

 private:
  static constexpr double kMargin_m = 0.45;  // walls lean in by less

  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Vec2 slot(int i, int j) const { return Vec2(kMargin_m) + pitch_ * Vec2(i + 0.5, j + 0.5); }
  double reach_m() const { return 0.45 * std::min(pitch_.x, pitch_.y); }
  // Slots that neither the partition nor the corner left out of an L takes.
  std::vector<Vec2> free_slots() const {
    std::vector<Vec2> slots = {slot(0, 0), slot(2, 0), slot(0, 1), slot(1, 1)};
    if (!is_l_) slots.push_back(slot(2, 1));
    return slots;
  }

  void add_shell() {
    const auto lean = [&] { return in(0.0, 0.4); };
    const double w = width_m_, d = depth_m_;
    Ring2 plan = {{lean(), lean()}, {w - lean(), lean()}};
    if (is_l_) {
      const Vec2 inner = Vec2(kMargin_m) + pitch_ * Vec2(2, 1);
      plan.insert(plan.end(), {{w - lean(), inner.y + lean()}, inner, {inner.x + lean(), d - lean()}});
    } else {
      plan.push_back({w - lean(), d - lean()});
    }
    plan.push_back({lean(), d - lean()});
    south_ = {plan[0], plan[1]};
    Ring3 floor, ceiling;
    for (const Vec2& p : plan) floor.emplace_back(p, 0.0), ceiling.emplace_back(p, height_m_);
    std::reverse(ceiling.begin(), ceiling.end());
    room_.faces = {{"floor", "dark", floor}, {"ceiling", "light", ceiling}};
    for (std::size_t i = 0; i < plan.size(); ++i) {
      const Vec2 a = plan[i], b = plan[(i + 1) % plan.size()];
      const bool mirror = room_.has_mirror && i == 1;
      room_.faces.push_back({fmt::format("wall{}", i),
                             mirror ? "mirror" : "wall",
                             {Vec3(a, 0), Vec3(a, height_m_), Vec3(b, height_m_), Vec3(b, 0)}});
    }
  }

  // From the south wall into the room, some up to the ceiling.
  void add_partition() {
    const double x = slot(1, 0).x + in(-0.3, 0.3), t = (x - south_[0].x) / (south_[1].x - south_[0].x);
    const Vec2 a = south_[0] + t * (south_[1] - south_[0]);
    const Vec2 b = slot(1, 0) + Vec2(in(-0.4, 0.4), 0.4 * pitch_.y);
    const double top = room_.seed % 3 == 0 ? height_m_ : in(1.0, 1.9);
    room_.faces.push_back({"partition", "wall", {Vec3(a, 0), Vec3(b, 0), Vec3(b, top), Vec3(a, top)}, true});
  }

  void add_furniture() {
    int n = 0;
    for (const Vec2& at : free_slots()) {
      const double angle = in(0.0, 2.0 * kPi), r = reach_m(), share = in(0.3, 1.1);
      const Vec2 along(std::cos(angle), std::sin(angle)), across(-along.y, along.x);
      const std::string name = fmt::format("thing{}", n);
      switch (n++ % 4) {
        case 0:  // a cupboard on the floor
        case 2:  // a table board
        {
          const bool board = n == 3;
          const Vec3 size(2 * r * std::cos(share), 2 * r * std::sin(share), board ? 0.03 : in(0.5, 1.4));
          const Vec2 corner = at - size.x / 2 * along - size.y / 2 * across;
          room_.boxes.push_back({name, "wood", Vec3(corner, board ? 0.72 : 0.0), size, degrees(angle)});
          break;
        }
        case 1:  // a screen clear of the floor
          room_.faces.push_back({name,
                                 "wood",
                                 {Vec3(at - r * along, 0.05), Vec3(at + r * along, 0.05),
                                  Vec3(at + r * along, in(1.0, 1.6)), Vec3(at - r * along, 1.0)},
                                 true});
          room_.faces.back().ring[3].z = room_.faces.back().ring[2].z;
          break;
        default:
          break;
      }
    }
  }

  void add_lamps() {
    std::vector<Vec2> slots = free_slots();
    std::shuffle(slots.begin(), slots.end(), random_);
    const auto turned = [&] {
      const double angle = in(0.0, 2.0 * kPi);
      return Vec3(std::cos(angle), std::sin(angle), 0.0);
    };
    const bool body = room_.seed % 3 == 1;
    const Vec3 lean = 0.4 * turned() - Vec3(0, 0, 1);
    const double h = height_m_;
    std::vector<RoomLamp> kinds = {
        {"aside", "aside", "aside.ies", 1800, Vec3(slots[0], h - 0.5), lean, turned(), {0.9, 0.25}, body},
        {"panel",
         "panel",
         "lambertian",
         3000,
         Vec3(slots[1], h - 0.03),
         {0, 0, -1},
         turned(),
         {0.6, 0.6},
         body},
        {"bulb", "bulb", "isotropic", 400, Vec3(slots[2], h - 0.6)},
        {"disc", "disc", "disc.ies", 900, Vec3(slots[2], h - 0.2), {0, 0, -1}, turned(), {}, body},
        {"beam", "beam", "beam.ies", 500, Vec3(slots[3], h - 0.3), lean, turned()}};
    std::shuffle(kinds.begin() + 1, kinds.end(), random_);
    kinds.resize(2 + room_.seed % 3);
    // Two in one slot would hang in each other.
    for (std::size_t i = 0; i < kinds.size(); ++i) kinds[i].at = Vec3(slots[i], kinds[i].at.z);
    room_.lamps = kinds;
  }

  void add_points() {
    const double angle = in(0.0, 0.5);
    const Vec3 middle(width_m_ / 2, depth_m_ / 2, 0.8 + in(0.0, 0.3));
    const Vec3 x = (width_m_ / 2 - 0.9) * Vec3(std::cos(angle), std::sin(angle), 0.0),
               y = (depth_m_ / 2 - 0.9) * Vec3(-std::sin(angle), std::cos(angle), 0.0);
    room_.plane = {middle - x - y, middle + x - y, middle + x + y, middle - x + y};
    for (const Vec2& at : free_slots()) {
      const Vec2 p = at + reach_m() * Vec2(in(-1, 1), in(-1, 1));
      room_.sensors.push_back(
          {Vec3(p, in(0.1, height_m_ - 0.7)), glm::normalize(Vec3(in(-1, 1), in(-1, 1), in(-0.5, 1)))});
    }
  }

  std::mt19937_64 random_;
  RandomRoom room_;
  double width_m_ = 0.0, depth_m_ = 0.0, height_m_ = 0.0;
  Vec2 pitch_{0.0};
  bool is_l_ = false;
  std::array<Vec2, 2> south_;
};

class Writer {
 public:
  Writer(const RandomRoom& room, const Writing& how, double cell_m)
      : room_(room), how_(how), cell_m_(cell_m) {}

  std::string zone() const {
    std::string text = fmt::format(
        "dim = \"zone/1\"\nname = \"{}\"\ncell = {:.17g}\n[finishes]\ndark = 0.25\nlight = 0.8\nwall = 0.55\n"
        "wood = 0.4\nmirror = {{ diffuse = 0, specular = 1, specular_reflectance = 0.85 }}\n",
        name("room"), cell_m_ * how_.scale);
    for (const auto& face : listed(room_.faces)) {
      Ring3 ring = face.ring;
      if (how_.backwards) std::rotate(ring.begin(), ring.begin() + 1, ring.end());
      text += fmt::format("[[surface]]\nname = \"{}\"\nfinish = \"{}\"\nsides = {}\nvertices = {}\n",
                          name(face.name), face.finish, face.two_sided ? 2 : 1, ring_text(ring));
    }
    for (const auto& box : listed(room_.boxes))
      text += fmt::format("[[box]]\nname = \"{}\"\nfinish = \"{}\"\ncorner = {}\nsize = {}\nturn = {:.17g}\n",
                          name(box.name), box.finish, place(box.corner), vector(how_.scale * box.size),
                          box.turn_deg + 90.0 * how_.quarter_turns);
    text += fmt::format("[[plane]]\nname = \"{}\"\ngrid = [5, 4]\nvertices = {}\n", name("plane"),
                        ring_text(room_.plane));
    text += fmt::format("[[sensors]]\nname = \"{}\"\npoints = [", name("odd"));
    for (const auto& sensor : room_.sensors) {
      const Vec3 p = placed(sensor.position), n = turned(sensor.normal);
      text += fmt::format("[{:.17g}, {:.17g}, {:.17g}, {:.17g}, {:.17g}, {:.17g}],", p.x, p.y, p.z, n.x, n.y,
                          n.z);
    }
    return text + "]\n";
  }

  std::string lights() const {
    std::string text = "dim = \"lights/1\"\n";
    for (const auto& lamp : listed(room_.lamps)) {
      const bool file = lamp.fitting.ends_with(".ies");
      text += fmt::format(
          "[[luminaire]]\nname = \"{}\"\ngroup = \"{}\"\n{} = \"{}\"\nat = {}\naim = {}\nc0 = {}\n",
          name(lamp.name), name(lamp.group), file ? "fitting" : "ideal", lamp.fitting, place(lamp.at),
          vector(turned(lamp.aim)), vector(turned(lamp.c0)));
      text += fmt::format("lumens = {:.17g}\n", lamp.lumens);
      if (lamp.opening_m.x > 0.0)
        text += fmt::format("opening = [{:.17g}, {:.17g}]\n", how_.scale * lamp.opening_m.x,
                            how_.scale * lamp.opening_m.y);
      if (lamp.body) text += "body = { reflectance = 0.3 }\n";
    }
    return text;
  }

  // A name that comes elsewhere in the alphabet.
  std::string name(const std::string& own) const {
    return how_.renamed ? std::string(own.rbegin(), own.rend()) : own;
  }
  Vec3 own_direction(Vec3 v) const {
    for (int i = 0; i < how_.quarter_turns; ++i) v = {v.y, -v.x, v.z};
    return v;
  }
  Vec3 own_place(const Vec3& p) const { return own_direction((p - how_.offset_m) / how_.scale); }
  // The name that a surface of the zone has in the room as it was made.
  std::string own_name(const std::string& written) const {
    const auto base = std::min(written.find('.'), written.size());
    return name(written.substr(0, base)) + written.substr(base);
  }

 private:
  template <class T>
  std::vector<T> listed(std::vector<T> things) const {
    if (how_.backwards) std::reverse(things.begin(), things.end());
    return things;
  }
  Vec3 turned(Vec3 v) const {
    for (int i = 0; i < how_.quarter_turns; ++i) v = {-v.y, v.x, v.z};
    return v;
  }
  Vec3 placed(const Vec3& p) const { return how_.offset_m + how_.scale * turned(p); }
  static std::string vector(const Vec3& v) {
    return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x, v.y, v.z);
  }
  std::string place(const Vec3& p) const { return vector(placed(p)); }
  std::string ring_text(const Ring3& ring) const {
    std::string text;
    for (const Vec3& p : ring) text += (text.empty() ? "" : ", ") + place(p);
    return "[" + text + "]";
  }

  const RandomRoom& room_;
  const Writing& how_;
  double cell_m_;
};

// A plane's points are numbered along its longest edge from its first corner, which depends on how it is
// written.
std::vector<std::size_t> order_of_points(const Zone& zone, const Writer& writer) {
  std::map<std::array<long, 6>, std::size_t> by_place;
  for (std::size_t i = 0; i < zone.points.size(); ++i) {
    if (!zone.points[i].valid) continue;
    const Vec3 p = writer.own_place(zone.points[i].position + zone.origin_m),
               n = writer.own_direction(zone.points[i].normal);
    std::array<long, 6> key{};
    for (int axis = 0; axis < 3; ++axis) {
      key[static_cast<std::size_t>(axis)] = std::lround(1e5 * p[axis]);
      key[static_cast<std::size_t>(axis) + 3] = std::lround(1e5 * n[axis]);
    }
    by_place[key] = i;
  }
  std::vector<std::size_t> order;
  for (const auto& [key, i] : by_place) order.push_back(i);
  return order;
}

std::vector<double> ordered(const std::vector<std::size_t>& order, const std::vector<double>& values) {
  std::vector<double> result;
  for (const std::size_t i : order) result.push_back(values[i]);
  return result;
}

}  // namespace

RandomRoom random_room(std::uint64_t seed) { return Maker(seed).make(); }

RoomAnswer answer(const RandomRoom& room, const Writing& writing, const RoomRun& run) {
  const Writer writer(room, writing, run.cell_m);
  Warnings warnings;
  Zone zone = read_zone(writer.zone(), "room.toml", {}, 0.0, {}, warnings);
  const Lights lights =
      read_lights(writer.lights(), "lights.toml", {}, zone, {}, warnings, [&](const std::string& path) {
        return photometric_file(path.substr(path.find_last_of('/') + 1), writing.scale);
      });
  INFO("room " << room.seed << (warnings.empty() ? "" : ": " + warnings[0].what));
  // A room of millimetres or kilometres is wondered at.
  if (writing.scale == 1.0) REQUIRE(warnings.empty());
  REQUIRE(zone.closed);
  const Cells cells(zone);
  NetworkOptions options;
  options.patches = run.patches;
  options.point_patches = run.point_patches;
  options.seed = run.seed;
  const Network network = build_network(zone, cells, options, Job{});
  judge_points(network, zone);
  const Solution solution =
      solve(zone, lights, network, {.combine = Combine::group, .gather = {.tolerance = 1e-7}});
  const auto order = order_of_points(zone, writer);
  RoomAnswer result;
  for (std::size_t s = 0; s < solution.sources.size(); ++s) {
    SourceAnswer& source = result[writer.name(solution.sources[s].group)];
    source.point_lx = ordered(order, point_lx(solution, s));
    source.point_direct_lx =
        ordered(order, illuminance_lx(solution, solution.point_direct, s, solution.n_points));
    const auto lx = cell_lx(solution, s);
    for (std::size_t surface = 0; surface < zone.surfaces.size(); ++surface) {
      double sum = 0.0, area = 0.0;
      for (std::size_t i = cells.first(surface); i < cells.first(surface + 1); ++i) {
        sum += cells.area_m2(i) * lx[i];
        area += cells.area_m2(i);
      }
      if (area > 0.0) source.surface_lx[writer.own_name(zone.surfaces[surface].name)] = sum / area;
    }
  }
  return result;
}

}  // namespace dim::test
