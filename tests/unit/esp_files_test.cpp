#include <fmt/format.h>

#include "base/error.hpp"
#include "catch.hpp"
#include "esp/casual_gain_control.hpp"
#include "esp/temporal_file.hpp"

using namespace dim;

namespace {

TemporalGains a_day() {
  TemporalGains gains;
  gains.zone = "room";
  gains.tag = gains_tag("room");
  gains.begin_day = gains.end_day = 96;
  for (int hour = 0; hour < 24; ++hour) {
    GainRow row{};
    row[lights_convective] = 10.0 * hour;
    row[lights_radiant] = 20.25;
    gains.rows.push_back(row);
  }
  return gains;
}

CasualGainControl factors() {
  CasualGainControl control;
  control.description = "DIM daylight factors, zone room";
  control.slots = {2, 0, 0};
  control.active_hours = {{8, 16}, {0, 1}, {0, 1}};
  EspLightingZone zone;
  zone.share = 0.5;
  zone.sensors = {{{2, 4, 0.9}}, {{2, 2, 0.9}}};
  zone.windows = {{7, {0.03, 0.01}}};
  control.zones = {zone, zone};
  control.zones[1].law = 32;
  control.zones[1].night_lx = 44.5;
  control.zones[1].slope_per_lx = -0.0278;
  return control;
}

CasualGainControl coefficients() {
  CasualGainControl control = factors();
  int set = 0;
  for (auto& zone : control.zones) {
    zone.type = EspSensorType::coefficients;
    zone.windows.clear();
    for (auto& sensor : zone.sensors) {
      sensor.set = ++set;
      sensor.stages = {std::vector<double>(145), std::vector<double>(145, 0.5)};
      for (std::size_t p = 0; p < 145; ++p) sensor.stages[0][p] = 1e-3 * static_cast<double>(p) / set;
    }
  }
  return control;
}

std::string changed(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

}  // namespace

TEST_CASE("A temporal file has the lines that ESP-r reads", "[esp][unit]") {
  const std::string text = write_tdf(a_day());
  CHECK(
      text.starts_with("ASCIITDF3\n"
                       "# NWPR NITDF NTSPH year begin end columns\n"
                       "   20    1    1 1999   96   96    9\n"
                       "# NEXTRC NEXTCL NDBSTP\n"
                       "      1     10     24\n"
                       "*tdaid1,DIM zone lighting level\n"
                       "*tdaid2,zone room\n"
                       "*items\n"
                       "*tag,room_lights\n"
                       "*type,CASUAL3T\n"
                       "*menu,Casual separate OccLtEq\n"
                       "*aide,DIM lighting gains\n"
                       "*other,   0   9\n"
                       "*fields, 9\n"
                       "REAL  1   1      0.000 -10000.000 100000.000  Occup convec gain (W):\n"));
  CHECK(text.find("REAL  3   3      0.000      0.000 100000.000  Occup latent gain (W):\n") !=
        std::string::npos);
  CHECK(text.find("*end_item\n*pointers\n 5\n*tabular_data\n# time then columns\n"
                  " 96.041667,0.00,0.00,0.00,0.00,20.25,0.00,0.00,0.00,0.00\n"
                  " 96.083333,0.00,0.00,0.00,10.00,20.25,") != std::string::npos);
  CHECK(text.ends_with(" 97.000000,0.00,0.00,0.00,230.00,20.25,0.00,0.00,0.00,0.00\n*end_tabular_data\n"));
}

TEST_CASE("Temporal files come back as they were written", "[esp][unit]") {
  auto gains = a_day();
  CHECK(write_tdf(read_tdf(write_tdf(gains), "a.tdfa")) == write_tdf(gains));
  CHECK(read_tdf(write_tdf(gains), "a.tdfa").rows == gains.rows);
  gains.steps_per_hour = 60;
  gains.end_day = 97;
  gains.rows.assign(2 * 24 * 60, GainRow{});
  CHECK(write_tdf(read_tdf(write_tdf(gains), "a.tdfa")) == write_tdf(gains));
  CHECK(tdf_links(gains, "room.tdfa") == "*tdf ../nets/room.tdfa\nroom_lights CASUAL3T room\n* end tdf\n");
}

TEST_CASE("What ESP-r cannot read of a temporal file is refused by line and limit", "[esp][unit]") {
  const std::string good = write_tdf(a_day());
  const std::pair<std::string, std::pair<std::string, std::string>> cases[] = {
      {"a.tdfa:1: 'ASCIITDF2'", {"ASCIITDF3", "ASCIITDF2"}},
      {"a.tdfa:3: record width 19 is outside 20..", {"   20    1", "   19    1"}},
      {"a.tdfa:3: steps an hour 61 is outside 1..60", {"1    1 1999", "1   61 1999"}},
      {"a.tdfa:5: number of steps 25 is outside 24..24", {"     24\n", "     25\n"}},
      {"a.tdfa:9: the tag 'room_lights_no' has 14 characters", {"*tag,room_lights", "*tag,room_lights_no"}},
      {"a.tdfa:9: ' *tag,room_lights' stands where *tag should", {"*tag,", " *tag,"}},
      {"a.tdfa:10: type 'casual3t'", {"CASUAL3T", "casual3t"}},
      {"a.tdfa:15: column 2 is outside 1..1", {"REAL  1   1", "REAL  1   2"}},
      {"a.tdfa:29: time 96.083333, this row is of 96.041667", {" 96.041667", " 96.083333"}},
      {"a.tdfa:29: Lights radiant gain (W): 200000", {"20.25", "200000"}},
      {"a.tdfa:29: Occup latent gain (W): -1", {"0.00,0.00,0.00,0.00", "0.00,0.00,-1,0.00"}},
      {"a.tdfa:29: '7' is one word too many", {",0.00\n", ",0.00,7\n"}},
      {"a.tdfa:28: a blank line", {"# time then columns\n", "\n"}},
      {"has 25 characters, ESP-r reads 20 of a word", {"0.00", "0.0000000000000000000000"}},
      {"a.tdfa:54: 'more' after the end", {"*end_tabular_data\n", "*end_tabular_data\nmore\n"}},
      {"the file ends before", {"*end_tabular_data\n", ""}},
  };
  for (const auto& [what, change] : cases) {
    CAPTURE(what);
    CHECK_THROWS_WITH(read_tdf(changed(good, change.first, change.second), "a.tdfa"), Catch::Contains(what));
  }
}

TEST_CASE("Gains that ESP-r cannot hold are not written", "[esp][unit]") {
  auto gains = a_day();
  gains.rows[3][lights_radiant] = 1e6;
  CHECK_THROWS_WITH(write_tdf(gains), Catch::Contains("ESP-r takes -10000..100000"));
  gains = a_day();
  gains.steps_per_hour = 61;
  CHECK_THROWS_WITH(write_tdf(gains), Catch::Contains("61 steps an hour"));
  gains = a_day();
  gains.tag = "a tag too long";
  CHECK_THROWS_AS(write_tdf(gains), LimitError);
  CHECK(gains_tag("auditorium").size() == 12);
}

TEST_CASE("A casual gain control has the lines that ESP-r reads", "[esp][unit]") {
  const std::string text = write_cgc(factors());
  CHECK(text.starts_with("*Casual_gain_ctl\n*desc DIM daylight factors, zone room\n  2  0  0"));
  CHECK(text.find("\n  8 16  0  1  0  1") != std::string::npos);
  CHECK(text.find("\n 500.0 1.50 0.100 0.300 0") != std::string::npos);
  CHECK(text.find("\n 0.50 2 2") != std::string::npos);
  CHECK(text.find("\n  2.000   4.000   0.900   0.000   0.000   1.000") != std::string::npos);
  CHECK(text.find("\n  7 0.030000") != std::string::npos);
  CHECK(text.find("\n  44.500 -0.027800") != std::string::npos);
}

TEST_CASE("Casual gain controls come back as they were written", "[esp][unit]") {
  for (const auto& control : {factors(), coefficients()}) {
    const std::string text = write_cgc(control);
    CHECK(write_cgc(read_cgc(text, "a.cgc")) == text);
  }
  const auto back = read_cgc(write_cgc(coefficients()), "a.cgc");
  CHECK(back.zones[1].sensors[1].set == 4);
  CHECK(back.zones[1].sensors[1].stages[0][144] == Approx(1e-3 * 144 / 4));
  CHECK(back.zones[1].sensors[1].stages[1][7] == 0.5);
  for (std::size_t at = 0, end = 0; (end = write_cgc(coefficients()).find('\n', at)) != std::string::npos;
       at = end + 1)
    REQUIRE(end - at <= 124);
}

TEST_CASE("An inert external sensor may stand first", "[esp][unit]") {
  auto control = coefficients();
  EspLightingZone inert;
  inert.type = EspSensorType::external;
  inert.share = 0.0;
  inert.law = 0;
  inert.external_surface = 7;
  inert.sensors.resize(1);
  control.zones.insert(control.zones.begin(), inert);
  control.comments = {"a comment"};
  const std::string text = write_cgc(control);
  CHECK(text.find("\n# a comment\n") != std::string::npos);
  CHECK(read_cgc(text, "a.cgc").zones[0].external_surface == 7);
}

TEST_CASE("What ESP-r cannot read of a casual gain control is refused by line and limit", "[esp][unit]") {
  const std::string good = write_cgc(factors()), sets = write_cgc(coefficients());
  const std::pair<std::string, std::pair<std::string, std::string>> cases[] = {
      {"a.cgc:1: ", {"*Casual_gain_ctl", "*casual_gain_ctl"}},
      {"a.cgc:3: gain slot 8 is outside 0..7", {"  2  0  0", "  8  0  0"}},
      {"a.cgc:4: last active hour 7 is outside 8..24", {"  8 16", "  8  7"}},
      {"a.cgc:5: number of lighting zones 5 is outside 1..4",
       {"  2  # lighting zones", "  5  # lighting zones"}},
      {"a.cgc:6: switch-off factor 0.9 is outside 1..3", {"1.50 0.100", "0.90 0.100"}},
      {"a.cgc:6: minimum light 1 is outside 0..0.999", {"0.100 0.300 0", "1.000 0.300 0"}},
      {"a.cgc:6: switch-off delay 7 is outside 0..6", {"0.300 0 ", "0.300 7 "}},
      {"a.cgc:7: number of sensors 10 is outside 1..9", {" 0.50 2 2", " 0.50 10 2"}},
      {"a.cgc:7: sensor type 6 is outside 1..5", {" 0.50 2 2", " 0.50 2 6"}},
      {"shares of the lighting zones add up to 0.900", {" 0.50 2 2", " 0.40 2 2"}},
      {"a.cgc:13: control law 5 is none of -1, 0, 1, 2, 3, 4, 31, 32", {"  3  # dimming", "  5  # dimming"}},
      {"slope 0.0278 is outside", {"-0.027800", "0.0278"}},
      {"'x' is not a number", {" 500.0", " x"}},
  };
  for (const auto& [what, change] : cases) {
    CAPTURE(what);
    CHECK_THROWS_WITH(read_cgc(changed(good, change.first, change.second), "a.cgc"), Catch::Contains(what));
  }
  CHECK_THROWS_WITH(read_cgc(changed(sets, "5.000000E-01", "1.500000E+00"), "a.cgc"),
                    Catch::Contains("daylight coefficient 1.5 is outside -1..1"));
  CHECK_THROWS_WITH(read_cgc(changed(sets, "  2 2  # set", "  3 2  # set"), "a.cgc"),
                    Catch::Contains("set 3 where the sensor says 2"));
  CHECK_THROWS_WITH(read_cgc(sets.substr(0, sets.size() - 100), "a.cgc"),
                    Catch::Contains("is missing") || Catch::Contains("the file ends"));
}

TEST_CASE("Controls beyond ESP-r's limits are not written", "[esp][unit]") {
  auto control = factors();
  control.zones.resize(5, control.zones[0]);
  CHECK_THROWS_WITH(write_cgc(control), Catch::Contains("5 lighting zones, ESP-r takes 1..4"));
  control = factors();
  control.zones[0].sensors.resize(10);
  CHECK_THROWS_WITH(write_cgc(control), Catch::Contains("10 sensors in a lighting zone"));
  control = factors();
  control.zones[0].delay_steps = 7;
  CHECK_THROWS_WITH(write_cgc(control), Catch::Contains("a delay of 7 steps"));
  control = coefficients();
  control.zones[1].sensors[1].set = 6;
  CHECK_THROWS_WITH(write_cgc(control), Catch::Contains("6 sensors with daylight coefficients"));
}
