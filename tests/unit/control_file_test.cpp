#include "climate/control_file.hpp"

#include "base/error.hpp"
#include "catch.hpp"
#include "climate/lighting_year.hpp"
#include "esp/level_file.hpp"

using namespace dim;

namespace {

const std::string kFile = R"(dim = "control/1"
area = 34.56

[occupancy]
hours = "08:00-18:00"
days = ["mon", "tue", "wed", "thu", "fri"]
summer_time = "03-29,10-25"
hold_on = 15

[[circuit]]
name = "window row"
luminaires = ["B[0,0]", "row A"]
sensors = ["desk points[0]"]
law = "dimming"
setpoint = 500
switch_off = 1.2
min_light = 0.05
min_power = "20 %"
delay = 2

[[circuit]]
name = "wall"
watts = 120
standby = 1.5
law = "occupancy"
occupancy = { presence = "people.csv" }
)";

std::string changed(const std::string& what, const std::string& by) {
  std::string text = kFile;
  const auto at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

}  // namespace

TEST_CASE("A control file gives its circuits", "[climate][control][unit]") {
  const auto plan = read_control(kFile, "c.toml");
  CHECK(plan.area_m2 == 34.56);
  REQUIRE(plan.circuits.size() == 2);
  const auto& row = plan.circuits[0];
  CHECK(row.luminaires == std::vector<std::string>{"B[0,0]", "row A"});
  CHECK(row.settings.law == Law::dimming);
  CHECK(row.settings.switch_off == 1.2);
  CHECK(row.settings.min_light == 0.05);
  CHECK(row.settings.min_power == 0.2);
  CHECK(row.settings.delay_steps == 2);
  CHECK_FALSE(row.watts);
  CHECK(row.occupancy.schedule.to_h == 18.0);
  CHECK_FALSE(row.occupancy.schedule.days[6]);
  CHECK(row.occupancy.schedule.summer_time->last.month == 10);
  CHECK(row.occupancy.hold_on_h == 0.25);
  CHECK(plan.circuits[1].occupancy.presence_file == "people.csv");
  CHECK(plan.circuits[1].occupancy.hold_on_h == 0.25);
  CHECK(plan.circuits[1].standby_W == 1.5);
  CHECK(read_control(kFile, "c.toml", {"circuit.wall.watts=60"}).circuits[1].watts == 60.0);
}

TEST_CASE("What is wrong in a control file is said with its place", "[climate][control][unit]") {
  const std::tuple<const char*, const char*, const char*> cases[] = {
      {"law = \"dimming\"", "law = \"dimmed\"", "c.toml:14:7"},
      {"law = \"dimming\"", "", "'law' is missing"},
      {"law = \"dimming\"", "law = \"closed-loop\"\nnight = 40", "'slope' is missing"},
      {"min_light = 0.05", "min_light = 1", "min_light"},
      {"setpoint = 500", "setpoint = -1", "setpoint"},
      {"delay = 2", "delay = -1", "delay"},
      {"sensors = [\"desk points[0]\"]", "", "needs sensors"},
      {"08:00-18:00", "18:00-08:00", "c.toml:5:9"},
      {"\"mon\"", "\"monday\"", "no day is called 'monday'"},
      {"03-29,10-25", "03-29", "summer time '03-29'"},
      {"watts = 120", "", "neither luminaires nor watts"},
      {"name = \"wall\"", "name = \"window row\"", "a second circuit 'window row'"},
      {"standby", "stand_by", "stand_by"},
      {"control/1", "control/2", "c.toml"},
  };
  for (const auto& [what, by, message] : cases) {
    CAPTURE(what, by);
    CHECK_THROWS_WITH(read_control(changed(what, by), "c.toml"), Catch::Contains(message));
  }
  CHECK_THROWS_WITH(read_control("dim = \"control/1\"", "c.toml"), Catch::Contains("no circuit"));
}

TEST_CASE("Circuits use the mean of their sensors, and energy adds up", "[climate][control][unit]") {
  const SensorYear near{"near", {400, 400, 0}, {100, 0, 0}}, far{"far", {100, 100, 0}, {0, 0, 0}};
  Circuit circuit;
  circuit.name = "row";
  circuit.watts = 100.0;
  circuit.standby_W = 2.0;
  circuit.sensors = {0, 1};
  circuit.settings.law = Law::dimming;
  circuit.present = {true, true, false};
  const auto years = run_circuits({circuit}, {near, far}, 3);
  // (500 - 300)/500 and (500 - 250)/500 of light.
  CHECK(years[0].lamps[0].light == Approx(0.4));
  CHECK(years[0].lamps[1].light == Approx(0.5));
  CHECK(years[0].watts[2] == 0.0);
  const auto energy = energy_of(circuit, years[0], 0.5);
  CHECK(energy.lamps_kWh == Approx(0.0005 * (years[0].watts[0] + years[0].watts[1])));
  CHECK(energy.standby_kWh == Approx(0.003));
  CHECK(energy.uncontrolled_kWh == Approx(0.1));
  CHECK(leni_kWh_m2({energy, energy}, 10.0) == Approx(0.2 * (energy.lamps_kWh + energy.standby_kWh)));
}

TEST_CASE("A control file says when blinds close", "[climate][control][unit]") {
  const auto plan = read_control(
      "dim = \"control/1\"\n"
      "[[blind]]\nwindows = \"south\"\nclosed = \"blind\"\nlaw = \"direct-sun\"\npoints = [\"workplane\"]\n"
      "[[blind]]\nwindows = \"west\"\nclosed = \"screen\"\nlaw = \"irradiance\"\nclose_above = 150\n",
      "c.toml");
  REQUIRE(plan.blinds.size() == 2);
  CHECK(plan.blinds[0].law == BlindLaw::direct_sun);
  CHECK(plan.blinds[0].most_sun_lx == 1000.0);
  CHECK(plan.blinds[0].most_points == 0.02);
  CHECK(plan.blinds[0].points == std::vector<std::string>{"workplane"});
  CHECK(plan.blinds[1].law == BlindLaw::irradiance);
  CHECK(plan.blinds[1].open_below == 150.0);
  const auto bad = [](const std::string& rest) {
    return [rest] {
      read_control("dim = \"control/1\"\n[[blind]]\nwindows = \"a\"\nclosed = \"b\"\n" + rest, "c.toml");
    };
  };
  CHECK_THROWS_WITH(bad("law = \"dusk\"")(), Catch::Contains("c.toml:5"));
  CHECK_THROWS_WITH(bad("law = \"irradiance\"")(), Catch::Contains("close_above"));
  CHECK_THROWS_WITH(bad("law = \"illuminance\"\nclose_above = 10\nopen_below = 20")(), Catch::Contains("opens below"));
  CHECK_THROWS_WITH(bad("law = \"direct-sun\"\nclose_above = 10")(), Catch::Contains("close_above"));
}

TEST_CASE("A zone lighting level file has a row a step", "[esp][unit]") {
  ZoneLightingLevels levels;
  levels.about = {{"weather", "a.epw"}};
  levels.steps = {{{2001, 6, 21, 12.0}, 73.5, 179.25, 800.0, 120.0}};
  levels.sensors = {{"desk, left[0]", {250.5F}, {50.0F}}};
  levels.circuit_names = {"row"};
  levels.circuits = {{{{0.4, 0.5}}, {43.2}}};
  CHECK(write_levels(levels) ==
        "# weather: a.epw\n"
        "year,month,day,hour,sun_altitude_deg,sun_azimuth_deg,direct_normal_W_m2,diffuse_horizontal_W_m2,"
        "\"desk, left[0]:sun_lx\",\"desk, left[0]:sky_lx\",\"desk, "
        "left[0]:total_lx\",row:light,row:power,row:watts,"
        "watts\n"
        "2001,6,21,12,73.5000,179.2500,800,120,50,250.5,300.5,0.4,0.5,43.2,43.2\n");
}
