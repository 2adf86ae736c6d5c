#include "climate/control_law.hpp"

#include "catch.hpp"
#include "climate/hunt.hpp"
#include "climate/paper_method.hpp"

using namespace dim;

namespace {

constexpr double kWatts = 864.0;

ControlSettings settings(Law law) {
  ControlSettings s;
  s.law = law;
  s.setpoint_lx = 500.0;
  s.switch_off = 1.5;
  s.min_light = 0.1;
  s.min_power = 0.3;
  s.night_lx = 44.5;
  s.slope_per_lx = -0.0278;
  return s;
}

/// Watts at 09:00, 10:00 and 11:00.
std::vector<double> watts(const ControlSettings& s, const std::vector<double>& daylight_lx) {
  Controller controller(s, 0);
  std::vector<double> result;
  for (const double e : daylight_lx) result.push_back(kWatts * controller.next(e, e, true).power);
  return result;
}

void check(const std::vector<double>& found, const std::vector<double>& expected) {
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == Approx(expected[i]).margin(0.01));
}

// Printed as 242.4, 302.0 and 338.2 lx: a tenth of a lux is 0.13 W of dimming and 1.5 W of integral reset. These
// three round to the printed ones and give all twelve figures of three laws to 0.01 W.
const std::vector<double> kMorning = {242.393, 302.000, 338.236};
const std::vector<double> kTenth = {24.2393, 30.2000, 33.8236};

}  // namespace

TEST_CASE("Lamps take the watts that ESP-r's simulator gives them", "[climate][control][unit]") {
  check(watts(settings(Law::on_off), kMorning), {864.0, 0.0, 0.0});
  auto half = settings(Law::step);
  half.min_power = 0.5;
  check(watts(half, kMorning), {864.0, 432.0, 432.0});
  check(watts(settings(Law::dimming), kMorning), {538.22, 458.11, 409.41});
  check(watts(settings(Law::integral_reset), kTenth), {497.96, 407.94, 353.22});
  check(watts(settings(Law::closed_loop), kTenth), {661.58, 611.80, 581.54});
  check(watts(settings(Law::on), kMorning), {864.0, 864.0, 864.0});
  check(watts(settings(Law::off), kMorning), {0.0, 0.0, 0.0});
}

TEST_CASE("A delay keeps lamps lit for so many steps, as in ESP-r", "[climate][control][unit]") {
  auto s = settings(Law::on_off);
  s.switch_off = 1.2;
  const std::vector<double> bright = {606.0, 755.0, 845.5};
  check(watts(s, bright), {0.0, 0.0, 0.0});
  s.delay_steps = 1;
  check(watts(s, bright), {864.0, 0.0, 0.0});
  s.delay_steps = 2;
  check(watts(s, bright), {864.0, 864.0, 0.0});
  // A cloud starts the count again.
  check(watts(s, {606.0, 0.0, 606.0, 606.0, 606.0}), {864.0, 864.0, 864.0, 864.0, 0.0});
}

TEST_CASE("Above their level dimmed and stepped lamps wait at least power, then go out",
          "[climate][control][unit]") {
  auto s = settings(Law::dimming);
  s.delay_steps = 1;
  check(watts(s, {700.0, 700.0, 460.0, 0.0}), {0.3 * kWatts, 0.0, 0.3 * kWatts, kWatts});
  s.law = Law::step;
  check(watts(s, {500.0, 500.0}), {0.3 * kWatts, 0.0});
  s.law = Law::integral_reset;
  check(watts(s, {61.0, 61.0}), {0.3 * kWatts, 0.0});
}

TEST_CASE("A dimmed lamp takes full power at full light and least at least", "[climate][control][unit]") {
  const auto s = settings(Law::dimming);
  CHECK(dimmed_power(1.0, s) == 1.0);
  CHECK(dimmed_power(0.1, s) == Approx(0.3));
}

TEST_CASE("Hunt's probability is that of his curve", "[climate][control][unit]") {
  const std::pair<double, double> curve[] = {{7, 0.9998},   {16, 0.9418},   {31.4, 0.8017},
                                             {50, 0.6283},  {66.4, 0.5007}, {100, 0.3204},
                                             {200, 0.1110}, {300, 0.0494},  {500, 0.0106}};
  for (const auto& [lx, p] : curve) CHECK(switch_on_probability(lx) == Approx(p).margin(5e-5));
  CHECK(switch_on_probability(6.8) == 1.0);
  CHECK(switch_on_probability(0.0) == 1.0);
  CHECK(switch_on_probability(-3.0) == 1.0);
  CHECK(switch_on_probability(657.0) == 0.0);
}

TEST_CASE("Arrivals switch on as often as the curve says, alike for a seed", "[climate][control][unit]") {
  int n = 0;
  for (std::uint64_t step = 0; step < 20000; ++step) {
    n += switches_on(66.4, 7, 1, step);
    REQUIRE(switches_on(66.4, 7, 1, step) == switches_on(66.4, 7, 1, step));
  }
  // Three standard deviations of 20,000 tosses.
  CHECK(n / 20000.0 == Approx(0.5007).margin(0.0107));
  int n_same = 0;
  for (std::uint64_t step = 0; step < 1000; ++step)
    n_same += switches_on(66.4, 7, 1, step) == switches_on(66.4, 8, 1, step);
  CHECK(n_same < 600);
}

TEST_CASE("Lights switched on at arrival stay until the room empties", "[climate][control][unit]") {
  auto s = settings(Law::hunt);
  Controller controller(s, 0);
  CHECK(controller.next(0.0, 0.0, false).power == 0.0);
  CHECK(controller.next(0.0, 0.0, true).power == 1.0);
  CHECK(controller.next(5000.0, 5000.0, true).power == 1.0);
  CHECK(controller.next(5000.0, 5000.0, false).power == 0.0);
  CHECK(controller.next(5000.0, 5000.0, true).power == 0.0);
  // Dark later: nobody arrives, nobody switches on.
  CHECK(controller.next(0.0, 0.0, true).power == 0.0);
}

TEST_CASE("Laws are called by the words of the control file", "[climate][control][unit]") {
  for (const auto& word : law_words()) CHECK(word_of(law_of(word).value()) == word);
  CHECK_FALSE(law_of("dimmed"));
}

TEST_CASE("Efficacies of the paper are those of its equations", "[climate][unit]") {
  const std::pair<double, double> beam[] = {{0, 17.7}, {10, 54.3}, {30, 90.9}, {60, 101.0}, {90, 101.7}};
  for (const auto& [altitude, lm_W] : beam) CHECK(beam_efficacy_lm_W(altitude) == Approx(lm_W).margin(0.05));
  // (91.2 + 21.06 - 5.67)(1.22 - 0.1592 + 0.03184) at 30 degrees and 100 W/m2.
  CHECK(overcast_efficacy_lm_W(30.0, 100.0) == Approx(106.59 * 1.09264).epsilon(1e-9));
  // Below 3 degrees as at 3; Delta at most 500.
  CHECK(overcast_efficacy_lm_W(0.0, 10.0) == overcast_efficacy_lm_W(3.0, 10.0));
  CHECK(overcast_efficacy_lm_W(30.0, 1000.0) == Approx(106.59 * (1.22 - 0.398 + 0.199)).epsilon(1e-9));
}

TEST_CASE("The paper's sensor under a covered, a clear and no sky", "[climate][unit]") {
  CHECK(cloud_cover(0.0, 0.0) == 0.0);
  CHECK(cloud_cover(80.0, 100.0) == Approx(0.64));
  // All diffuse: the overcast efficacy alone.
  CHECK(paper_illuminance_lx({30.0, 0.0, 100.0, 100.0}, 0.05, 0.4) ==
        Approx(0.05 * 100.0 * overcast_efficacy_lm_W(30.0, 100.0)));
  // Beam without diffuse: F alone.
  CHECK(paper_illuminance_lx({30.0, 500.0, 0.0, 250.0}, 0.05, 0.4) ==
        Approx(500.0 * 90.86 * 0.4).epsilon(1e-4));
  CHECK(paper_illuminance_lx({-5.0, 500.0, 10.0, 10.0}, 0.0, 0.4) == 0.0);
}
