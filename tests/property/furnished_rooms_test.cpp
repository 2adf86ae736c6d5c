// What must not change the answer, over a dozen random furnished rooms, each source and point of them.
#include "property/furnished_rooms.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "catch.hpp"

using namespace dim;
using namespace dim::test;

namespace {

constexpr std::uint64_t kRooms = 12;
// What is stored in single precision: one rounding is 6e-8.
constexpr double kRounding = 3e-7;

const RandomRoom& room_of(std::uint64_t seed) {
  static const std::vector<RandomRoom> rooms = [] {
    std::vector<RandomRoom> all;
    for (std::uint64_t s = 1; s <= kRooms; ++s) all.push_back(random_room(s));
    return all;
  }();
  return rooms[seed - 1];
}

bool has_bodies(const RandomRoom& room) {
  return std::any_of(room.lamps.begin(), room.lamps.end(), [](const RoomLamp& lamp) { return lamp.body; });
}

// The rooms as they are, lit with five seeds of the network's rays; each once in a run of the tests.
constexpr std::uint64_t kSeeds = 5;
const RoomAnswer& lit(std::uint64_t room, std::uint64_t seed = 1) {
  static std::map<std::pair<std::uint64_t, std::uint64_t>, RoomAnswer> known;
  const auto [at, added] = known.try_emplace({room, seed});
  if (added) at->second = answer(room_of(room), {}, {.seed = seed});
  return at->second;
}

std::vector<double> surface_lx(const SourceAnswer& source) {
  std::vector<double> lx;
  for (const auto& [name, value] : source.surface_lx) lx.push_back(value);
  return lx;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double x : values) sum += x;
  return sum / static_cast<double>(values.size());
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double x : values) sum += x * x;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

// RMS of factor a - b over RMS of b; 0 where both are dark.
double apart(const std::vector<double>& a, const std::vector<double>& b, double factor = 1.0) {
  REQUIRE(a.size() == b.size());
  std::vector<double> off(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) off[i] = factor * a[i] - b[i];
  const double of_all = root_mean_square(off);
  return of_all > 0.0 ? of_all / root_mean_square(b) : 0.0;
}

// Of each source: points, points' direct light and surfaces.
void check_close(const RoomAnswer& got, const RoomAnswer& expected, double tolerance, double factor = 1.0) {
  REQUIRE(got.size() == expected.size());
  for (const auto& [name, source] : expected) {
    CAPTURE(name);
    REQUIRE(got.contains(name));
    const SourceAnswer& same = got.at(name);
    REQUIRE(same.surface_lx.size() == source.surface_lx.size());
    CHECK(apart(same.point_direct_lx, source.point_direct_lx, factor) <= tolerance);
    CHECK(apart(same.point_lx, source.point_lx, factor) <= tolerance);
    CHECK(apart(surface_lx(same), surface_lx(source), factor) <= tolerance);
  }
}

bool same_bits(const SourceAnswer& a, const SourceAnswer& b) {
  return a.point_lx == b.point_lx && a.point_direct_lx == b.point_direct_lx && a.surface_lx == b.surface_lx;
}

void check_same_bits(const RoomAnswer& got, const RoomAnswer& expected) {
  REQUIRE(got.size() == expected.size());
  for (const auto& [name, source] : expected) {
    CAPTURE(name);
    REQUIRE(got.contains(name));
    CHECK(same_bits(got.at(name), source));
  }
}

// What a source's values are over the seeds: their mean, and the standard deviation of one of them, RMS.
struct Sampled {
  std::vector<double> mean;
  double deviation = 0.0;
};
template <class Values>
Sampled over_seeds(std::uint64_t room, const std::string& source, const Values& values) {
  Sampled result;
  std::vector<double> squares;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto lx = values(lit(room, seed).at(source));
    result.mean.resize(lx.size());
    squares.resize(lx.size());
    for (std::size_t i = 0; i < lx.size(); ++i) {
      result.mean[i] += lx[i] / static_cast<double>(kSeeds);
      squares[i] += lx[i] * lx[i];
    }
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < squares.size(); ++i)
    sum += (squares[i] - static_cast<double>(kSeeds) * result.mean[i] * result.mean[i]) / (kSeeds - 1.0);
  result.deviation = std::sqrt(sum / static_cast<double>(squares.size()));
  return result;
}

// How many standard deviations an answer with chances of its own is from the mean of the seeds.
class Deviations {
 public:
  void add(std::uint64_t room, const RoomAnswer& got) {
    for (const auto& [name, source] : got) {
      add(
          room, name, [](const SourceAnswer& s) { return s.point_lx; }, source);
      add(
          room, name, [](const SourceAnswer& s) { return surface_lx(s); }, source);
    }
  }
  double rms() const { return root_mean_square(all_); }
  double largest() const { return *std::max_element(all_.begin(), all_.end()); }

 private:
  template <class Values>
  void add(std::uint64_t room, const std::string& name, const Values& values, const SourceAnswer& source) {
    const Sampled expected = over_seeds(room, name, values);
    const auto lx = values(source);
    REQUIRE(lx.size() == expected.mean.size());
    std::vector<double> off(lx.size());
    for (std::size_t i = 0; i < lx.size(); ++i) off[i] = lx[i] - expected.mean[i];
    all_.push_back(root_mean_square(off) / (expected.deviation * std::sqrt(1.0 + 1.0 / kSeeds)));
  }
  std::vector<double> all_;
};

// A luminaire's opening cut into 3 x 2.
RandomRoom with_openings_cut(const RandomRoom& room) {
  RandomRoom cut = room;
  cut.lamps.clear();
  for (const RoomLamp& lamp : room.lamps) {
    if (lamp.opening_m.x == 0.0) {
      cut.lamps.push_back(lamp);
      continue;
    }
    const Vec3 aim = glm::normalize(lamp.aim), c0 = glm::normalize(lamp.c0 - glm::dot(lamp.c0, aim) * aim);
    const Vec3 along = lamp.opening_m.x / 3.0 * c0, across = lamp.opening_m.y / 2.0 * glm::cross(c0, aim);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 2; ++j) {
        RoomLamp part = lamp;
        part.name = fmt::format("{}{}{}", lamp.name, i, j);
        part.lumens /= 6.0;
        part.opening_m /= Vec2(3, 2);
        part.at += (i - 1.0) * along + (j - 0.5) * across;
        cut.lamps.push_back(part);
      }
    }
  }
  return cut;
}

}  // namespace

TEST_CASE("The random rooms are of every kind", "[rooms][property]") {
  std::set<std::string> fittings;
  int n_l = 0, n_mirrors = 0, n_bodies = 0, n_full_partitions = 0;
  for (std::uint64_t seed = 1; seed <= kRooms; ++seed) {
    const RandomRoom& room = room_of(seed);
    CHECK(room.lamps.size() >= 2);
    CHECK(lit(seed).begin()->second.point_lx.size() >= 12);
    for (const auto& lamp : room.lamps) fittings.insert(lamp.fitting);
    n_l += room.faces[0].ring.size() == 6;
    n_mirrors += room.has_mirror;
    n_bodies += has_bodies(room);
    for (const auto& face : room.faces)
      n_full_partitions += face.name == "partition" && face.ring[2].z == room.faces[1].ring[0].z;
  }
  CHECK(fittings.size() == 5);
  CHECK(std::min({n_l, n_mirrors, n_bodies, n_full_partitions}) >= 3);
}

TEST_CASE("What else shines does not change a source's light by a bit", "[rooms][property]") {
  for (std::uint64_t seed = 1; seed <= kRooms; ++seed) {
    const RandomRoom& room = room_of(seed);
    for (const RoomLamp& lamp : room.lamps) {
      RandomRoom alone = room;
      if (has_bodies(room)) {  // which stay where they are
        for (auto& other : alone.lamps)
          if (other.name != lamp.name) other.lumens = 0.0;
      } else {
        alone.lamps = {lamp};
      }
      CAPTURE(seed, lamp.name);
      CHECK(same_bits(answer(alone).at(lamp.name), lit(seed).at(lamp.name)));
    }
  }
}

TEST_CASE("Names do not change the light by a bit", "[rooms][property]") {
  for (std::uint64_t seed = 1; seed <= kRooms; ++seed) {
    CAPTURE(seed);
    check_same_bits(answer(room_of(seed), {.renamed = true}), lit(seed));
  }
}

TEST_CASE("The order of surfaces, corners and luminaires does not change the light", "[rooms][property]") {
  for (std::uint64_t seed = 1; seed <= kRooms; ++seed) {
    CAPTURE(seed);
    check_close(answer(room_of(seed), {.backwards = true}), lit(seed), kRounding);
  }
}

TEST_CASE("Two halves of a source at one place are the source, to the bit", "[rooms][property]") {
  for (std::uint64_t seed = 1; seed <= kRooms; ++seed) {
    RandomRoom halves = room_of(seed);
    for (auto& lamp : halves.lamps) lamp.lumens /= 2.0;
    const auto first = halves.lamps;
    for (auto& lamp : halves.lamps) lamp.name += "1";
    for (const auto& lamp : first) {
      halves.lamps.push_back(lamp);
      halves.lamps.back().name += "2";
    }
    CAPTURE(seed);
    check_same_bits(answer(halves), lit(seed));
  }
}

TEST_CASE("A furnished room is lit the same a thousand metres away", "[rooms][property]") {
  for (std::uint64_t seed = 1; seed <= kRooms; ++seed) {
    CAPTURE(seed);
    check_close(answer(room_of(seed), {.offset_m = {1234.5, -987.25, 31.0}}), lit(seed), kRounding);
  }
}

TEST_CASE("A furnished room of another size is lit by one over the square", "[rooms][property]") {
  // Bodies lie a tenth of a millimetre behind their openings in a room of any size: some rays change sides.
  constexpr double kOfBodies = 2e-3;
  for (std::uint64_t seed = 1; seed <= kRooms; ++seed) {
    for (const double scale : {0.25, 3.7}) {
      CAPTURE(seed, scale);
      check_close(answer(room_of(seed), {.scale = scale}), lit(seed),
                  has_bodies(room_of(seed)) ? kOfBodies : kRounding, scale * scale);
    }
  }
}

TEST_CASE("A furnished room turned by right angles is lit the same but for sampling", "[rooms][property]") {
  // Rays have other chances in a turned room. Direct light of points is found along lines where something
  // hides part of an opening: 0.3 % RMS of what is hidden in part.
  Deviations deviations;
  std::vector<double> direct;
  for (std::uint64_t seed = 1; seed <= kRooms; ++seed) {
    for (const int quarters : {1, 2, 3}) {
      CAPTURE(seed, quarters);
      const RoomAnswer turned = answer(room_of(seed), {.quarter_turns = quarters});
      deviations.add(seed, turned);
      for (const auto& [name, source] : turned) {
        direct.push_back(apart(source.point_direct_lx, lit(seed).at(name).point_direct_lx));
        CHECK(direct.back() < 3e-3);
      }
    }
  }
  CHECK(root_mean_square(direct) < 5e-4);
  CHECK(deviations.rms() < 1.5);
  CHECK(deviations.largest() < 5.0);
}

TEST_CASE("A furnished room is lit the same by any number of threads, to the bit", "[rooms][property]") {
  for (std::uint64_t seed = 1; seed <= kRooms; ++seed) {
    CAPTURE(seed);
    for (const std::size_t n_threads : {1U, 3U}) {
      const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, n_threads);
      check_same_bits(answer(room_of(seed)), lit(seed));
    }
  }
}

TEST_CASE("Seeds change the light by what more rays take away", "[rooms][property]") {
  // Reflected light at 2,048 patches a point and 288 a cell: 1 % RMS by the study in the design notes (1.4 %
  // at 128 patches). Four times the rays have at most half the error: then the seeds' mean is right to its
  // own.
  Deviations deviations;
  std::vector<double> spreads;
  for (std::uint64_t seed = 1; seed <= kRooms; ++seed) {
    CAPTURE(seed);
    deviations.add(seed,
                   answer(room_of(seed), {}, {.patches = {24, 48}, .point_patches = {64, 128}, .seed = 77}));
    for (const auto& [name, source] : lit(seed)) {
      CHECK(lit(seed, 2).at(name).point_direct_lx == source.point_direct_lx);
      CHECK(lit(seed, 2).at(name).point_lx != source.point_lx);
      const auto reflected = [](const SourceAnswer& s) {
        std::vector<double> lx = s.point_lx;
        for (std::size_t i = 0; i < lx.size(); ++i) lx[i] -= s.point_direct_lx[i];
        return lx;
      };
      const Sampled sampled = over_seeds(seed, name, reflected);
      spreads.push_back(sampled.deviation / root_mean_square(sampled.mean));
    }
  }
  CHECK(root_mean_square(spreads) < 1.2e-2);
  CHECK(deviations.rms() < 0.8);  // sqrt((1/5 + 1/4) / (1 + 1/5)) = 0.61 where more rays take half of it away
  CHECK(deviations.largest() < 3.0);
}

TEST_CASE("Cells halved change the light by the error of cells, which halves with them",
          "[rooms][property]") {
  std::vector<double> coarse, fine;
  for (std::uint64_t seed = 1; seed <= kRooms; ++seed) {
    const auto& whole = lit(seed);
    const auto half = answer(room_of(seed), {}, {.cell_m = 0.25}),
               quarter = answer(room_of(seed), {}, {.cell_m = 0.125});
    for (const auto& [name, source] : whole) {
      coarse.push_back(mean(source.point_lx) / mean(half.at(name).point_lx) - 1.0);
      fine.push_back(mean(half.at(name).point_lx) / mean(quarter.at(name).point_lx) - 1.0);
      CAPTURE(seed, name);
      CHECK(half.at(name).point_direct_lx == source.point_direct_lx);
      CHECK(std::abs(coarse.back()) < 2e-2);
    }
  }
  // The study in the design notes: -0.4 % on a work plane at 0.5 m, -0.17 % at 0.25 m.
  CHECK(std::abs(mean(coarse)) < 4e-3);
  CHECK(std::abs(mean(fine)) < 0.6 * std::abs(mean(coarse)));
  CHECK(root_mean_square(fine) < 0.6 * root_mean_square(coarse));
}

TEST_CASE("Openings cut into parts give the light of the whole", "[rooms][property]") {
  std::vector<double> of_points;
  for (std::uint64_t seed = 1; seed <= kRooms; ++seed) {
    const RoomAnswer cut = answer(with_openings_cut(room_of(seed)));
    for (const auto& [name, source] : lit(seed)) {
      CAPTURE(seed, name);
      REQUIRE(cut.contains(name));
      of_points.push_back(apart(cut.at(name).point_direct_lx, source.point_direct_lx));
      CHECK(of_points.back() < 5e-3);
      CHECK(apart(surface_lx(cut.at(name)), surface_lx(source)) < 5e-3);
    }
  }
  CHECK(root_mean_square(of_points) < 1e-3);
}
