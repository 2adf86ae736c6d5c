// The stated bound of what inter-reflection has left out, in rooms with mirrors and lobes.
#include <algorithm>
#include <limits>
#include <random>

#include "catch.hpp"
#include "property/transport_support.hpp"
#include "transport/contraction.hpp"
#include "transport/gather.hpp"

using namespace dim;
using namespace dim::test;

namespace {

enum class Kind { mirrors, lobes, both };

// A furnished room whose surfaces are matt, or shiny as `kind` says, at random.
Zone shiny_room(Kind kind, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Zone zone = furnished_room(0.5, 0.8);
  for (auto& surface : zone.surfaces) {
    surface.finish = add_grey(zone, 0.9 * uniform(random));
    if (uniform(random) < 0.5) continue;
    Finish& finish = zone.finishes.back();
    finish.specular = 0.2 + 0.8 * uniform(random);
    const bool lobe = kind == Kind::lobes || (kind == Kind::both && uniform(random) < 0.5);
    finish.roughness = lobe ? 0.2 + 0.2 * uniform(random) : 0.0;
    if (lobe)
      finish.ior = SpectralCurve(1.3 + 2.0 * uniform(random));
    else
      finish.specular_reflectance = SpectralCurve(0.95 * uniform(random));
  }
  return zone;
}

// A room ready to be solved for two columns of uneven direct light: on every cell, and on one surface.
class ShinyRoom {
 public:
  explicit ShinyRoom(const Zone& zone)
      : zone_(zone),
        cells_(zone_),
        network_(network_of(zone_, {8, 16})),
        classes_(classify(zone_, Bands::uniform(1))),
        caster_(plates_of(zone_), zone_.diameter_m),
        shine_(zone_, cells_, network_, classes_, caster_, MirrorRayOptions{}, Job{}),
        direct_(cells_.size(), 2) {
    reflectances_.class_of_column = {0, 0};
    for (const auto& surface : zone_.surfaces)
      reflectances_.of_surface.push_back(classes_.at(0, surface.finish).diffuse);
    direct_shine_.psi.assign(shine_.n_states() * 2, 0.0F);
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> lx(0.0, 100.0);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      direct_.column(0)[i] = lx(random);
      direct_.column(1)[i] = cells_.surface_of(i) == 0 ? 100.0 : 0.0;
    }
  }

  Gathered<double> solve(double tolerance) const {
    const GatherShine shine{shine_, zone_, direct_shine_};
    return gather(network_, cells_, direct_, Columns<double>(0, 2), reflectances_, {.tolerance = tolerance},
                  Job{}, shine_.any() ? &shine : nullptr);
  }

  struct Errors {
    double worst = 0.0, local = 0.0, mean = 0.0;
  };
  Errors errors(const Columns<double>& light, const Columns<double>& exact, std::size_t column) const {
    double flux = 0.0, lit_m2 = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const double e = exact.value(i, column), area_m2 = cells_.area_m2(i);
      flux += area_m2 * e;
      lit_m2 += e > 0.0 ? area_m2 : 0.0;
      sum += area_m2 * std::abs(light.value(i, column) - e);
    }
    const double mean = flux / lit_m2;
    Errors errors{0.0, 0.0, sum / flux};
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const double e = exact.value(i, column), error = std::abs(light.value(i, column) - e);
      errors.worst = std::max(errors.worst, error / mean);
      errors.local = std::max(errors.local, error / std::max(e, kIrradianceFloor * mean));
    }
    return errors;
  }

  const Shine& shine() const { return shine_; }
  bool has_lobes() const { return shine_.n_states() > 0; }

 private:
  const Zone zone_;
  const Cells cells_;
  const Network network_;
  const ReflectanceClasses classes_;
  const RayCaster caster_;
  const Shine shine_;
  Reflectances reflectances_;
  DirectShine direct_shine_;
  Columns<double> direct_;
};

void check_bounds(const ShinyRoom& room) {
  const auto exact = room.solve(1e-11);
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4}) {
    const auto gathered = room.solve(tolerance);
    for (std::size_t c = 0; c < 2; ++c) {
      const auto& report = gathered.columns[c];
      const auto error = room.errors(gathered.cell, exact.cell, c);
      CAPTURE(room.has_lobes(), tolerance, c, report.iterations, report.cut, error.worst, error.local, error.mean);
      CHECK(exact.columns[c].residual <= 1e-11);
      CHECK(report.residual <= tolerance);
      // What mirrors cut off is left out of the exact light as well.
      CHECK((room.has_lobes() ? error.mean : error.worst) <= report.error_bound + 1e-9);
      CHECK(error.local <= report.local_error_bound + 1e-6);
      CHECK(std::isfinite(report.error_bound));
    }
  }
}

}  // namespace

TEST_CASE("The bound holds with mirrors and with lobes", "[gather][shine][property]") {
  const Kind kind = GENERATE(Kind::mirrors, Kind::lobes, Kind::both);
  std::mt19937_64 random(GENERATE(range(1UL, 5UL)));
  check_bounds(ShinyRoom(shiny_room(kind, random)));
}

TEST_CASE("What a mirror hands on to mirrors is sent on where it comes down at last", "[gather][shine][unit]") {
  // Light that lands on a mirror is reflected diffusely or mirrored, and lands again, at most on a mirror alike.
  Zone zone = box_zone({4, 4, 3}, 0.45, 0.5);
  Finish mirror;
  mirror.name = "mirror";
  mirror.diffuse = SpectralCurve(0.3);
  mirror.specular = 0.5;
  mirror.roughness = 0.0;
  mirror.specular_reflectance = SpectralCurve(0.8);
  zone.finishes.push_back(mirror);
  for (std::size_t s = 2; s < 6; ++s) zone.surfaces[s].finish = 1;
  const ShinyRoom room(zone);
  const auto& slices = room.shine().slice_albedo(0, 1);
  const double mirrored = *std::max_element(slices.begin(), slices.end());
  REQUIRE(mirrored > 0.2);
  double landed = 0.0;
  for (double flux = 1.0; flux > 1e-15; flux *= mirrored) landed += flux;
  const SentOn by_mirror = most_sent_on(2, 0.3, &room.shine(), zone, 0);
  CHECK(by_mirror.share == Approx(0.3 * landed).epsilon(1e-12));
  CHECK(by_mirror.landing == Approx(landed).epsilon(1e-12));
  const SentOn by_floor = most_sent_on(0, 0.45, &room.shine(), zone, 0);
  CHECK(by_floor.share == 0.45);
  CHECK(by_floor.landing == 1.0);
}

TEST_CASE("Mirrors on four walls: the bound is no less than the error", "[gather][shine][unit]") {
  // A mirror reflects diffusely as well, and light that it passes on counts for the next reflection.
  Zone zone = box_zone({4, 4, 3}, 0.45, 0.5);
  Finish mirror;
  mirror.name = "mirror";
  mirror.diffuse = SpectralCurve(0.9);
  mirror.specular = 0.5;
  mirror.roughness = 0.0;
  mirror.specular_reflectance = SpectralCurve(0.9);
  zone.finishes.push_back(mirror);
  for (std::size_t s = 2; s < 6; ++s) zone.surfaces[s].finish = 1;
  check_bounds(ShinyRoom(zone));
}

TEST_CASE("Tracking states what it dropped", "[track][property]") {
  const Zone zone = furnished_room(0.7, 0.8);
  const auto lights = point_lamp({-1.5, 0.5, 1}, 100.0);
  const Network network = network_of(zone, {4, 8});
  SimulationOptions options;
  options.solver = Solver::track;
  options.track.threshold = 1e-9;
  const auto exact = solve(zone, lights, network, options);
  const Cells cells(zone);
  for (const double threshold : {1e-3, 1e-4, 1e-5}) {
    options.track.threshold = threshold;
    const auto solution = solve(zone, lights, network, options);
    double missing = 0.0, flux = 0.0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const double e = static_cast<double>(exact.cell_total[i]);
      missing += cells.area_m2(i) * std::abs(e - static_cast<double>(solution.cell_total[i]));
      flux += cells.area_m2(i) * e;
    }
    CHECK(missing / flux <= solution.sources[0].error_bound + 2e-7);
    CHECK(solution.sources[0].error_bound < 20.0 * missing / flux);
  }
}
