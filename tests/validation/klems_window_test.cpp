#include "reflection/glazing.hpp"
#include "reflection/klems.hpp"
#include "validation/daylight_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

const std::string kWindow = "[[surface]]\nname = \"w\"\non = \"wall-s\"\nfinish = \"glass\"\n"
                            "vertices = [[0.5,0,0.9],[0.5,0,2.7],[3.5,0,2.7],[3.5,0,0.9]]\n";
const std::string kPoints = "[[sensors]]\nname = \"p\"\npoints = [[2,3,0.8, 0,0,1],[1,1,0.8, 0,0,1],[3,5,0.8, 0,0,1],"
                            "[2,4,1.5, 0,-1,0]]\n";
constexpr std::size_t kPoints_n = 4;

/// A side-lit room with this glazing; a matrix in its place where there is one.
Zone room(const std::string& glass, std::shared_ptr<const KlemsMatrix> matrix = nullptr) {
  std::string text = box_text({4, 6, 3}, 0.5, kWindow + kPoints);
  text.replace(text.find("[finishes]\n"), 11, "[finishes]\nglass = { kind = \"glazing\", " + glass + " }\n");
  Zone zone = read(text);
  for (auto& finish : zone.finishes) {
    if (finish.name != "glass" || !matrix) continue;
    finish.angular_law = "bsdf";
    finish.bsdf = matrix;
    finish.transmittance = SpectralCurve(matrix->hemispherical_transmittance());
  }
  return zone;
}

std::shared_ptr<const KlemsMatrix> even(double transmittance) {
  return std::make_shared<const KlemsMatrix>(
      std::vector<double>(klems::kPatches * klems::kPatches, transmittance / kPi));
}

/// What a slab lets pass straight, patch by patch.
std::shared_ptr<const KlemsMatrix> clear(double ior, double normal) {
  const Slab slab(ior, normal);
  std::vector<double> values(klems::kPatches * klems::kPatches, 0.0);
  for (std::size_t p = 0; p < klems::kPatches; ++p) {
    constexpr int kSteps = 64;
    double mean = 0.0;
    for (int i = 0; i < kSteps; ++i) mean += slab.transmittance(klems::direction(p, (i + 0.5) / kSteps, 0.5).z) / kSteps;
    values[p * klems::kPatches + p] = mean / klems::projected_solid_angle_sr(p);
  }
  return std::make_shared<const KlemsMatrix>(std::move(values));
}

double lx(const DaylitRoom& room, std::size_t point) {
  double sum = 0.0;
  for (std::size_t s = 0; s < room.solution.sources.size(); ++s) sum += room.total_lx(point, s);
  return sum;
}

}  // namespace

TEST_CASE("A BSDF that scatters evenly is the diffusing pane", "[daylight][bsdf][validation]") {
  const std::string opal = "transmittance = 0.4, reflectance = 0, angular_law = \"diffusing\"";
  for (const char* sky : {"model = \"cie-overcast\"\nhorizontal = 10000\n",
                          "model = \"cie-12\"\nhorizontal = 10000\ndirect_normal = 50000\n"
                          "sun = { altitude = 40, azimuth = 170 }\n"}) {
    const auto diffusing = daylit(room(opal), sky), klems = daylit(room(opal, even(0.4)), sky);
    for (std::size_t p = 0; p < kPoints_n; ++p) CHECK(lx(klems, p) == Approx(lx(diffusing, p)).epsilon(1e-5));
  }
}

TEST_CASE("A clear pane as a BSDF is the glass, its light blurred over patches", "[daylight][bsdf][validation]") {
  const std::string glass = "transmittance = 0.7, ior = 1.52, reflectance = 0";
  // The same from all sides: nothing to blur but the transmittance inside a patch.
  const std::string even_sky = "model = \"uniform\"\nhorizontal = 10000\nground = 0.999999\n";
  const auto clear_even = daylit(room(glass), even_sky), klems_even = daylit(room(glass, clear(1.52, 0.7)), even_sky);
  for (std::size_t p = 0; p < kPoints_n; ++p) CHECK(lx(klems_even, p) == Approx(lx(clear_even, p)).epsilon(5e-3));
  // The flux that comes in is that of the glass under any sky.
  const std::string sky = "model = \"cie-overcast\"\nhorizontal = 10000\n";
  const auto flux = [](const DaylitRoom& of) { return of.solution.sources[0].flux_lm; };
  CHECK(flux(daylit(room(glass, clear(1.52, 0.7)), sky)) == Approx(flux(daylit(room(glass), sky))).epsilon(5e-3));
}

TEST_CASE("Light through a BSDF is absorbed to the last lumen", "[daylight][bsdf][validation]") {
  const std::string glass = "transmittance = 0.7, ior = 1.52, reflectance = 0";
  const auto klems = daylit(room(glass, clear(1.52, 0.7)), "model = \"cie-overcast\"\nhorizontal = 10000\n", {16, 32});
  CHECK(std::abs(worst_balance(klems.solution.sources).imbalance) < 3e-3);
}
