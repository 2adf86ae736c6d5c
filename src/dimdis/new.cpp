#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <vector>

#include "base/atomic_file.hpp"
#include "common/option_checks.hpp"
#include "dimdis/options.hpp"
#include "scene/zone_starter.hpp"

namespace dim {
namespace {

constexpr double kLeast_m = 0.5, kMostAlong_m = 200.0, kMostHeight_m = 100.0;

double most_m(std::size_t i) { return i < 2 ? kMostAlong_m : kMostHeight_m; }

/// The lengths that stand between the signs `x`; none where one of them is no number.
std::vector<double> lengths_in(const std::string& text) {
  std::vector<double> lengths;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    double length = 0.0;
    const auto [behind, error] = std::from_chars(at, end, length, std::chars_format::general);
    if (error != std::errc() || !std::isfinite(length)) return {};
    lengths.push_back(length);
    if (behind == end) return lengths;
    if (*behind != 'x') return {};
    at = behind + 1;
  }
}

bool probable(const std::vector<double>& lengths_m) {
  for (std::size_t i = 0; i < lengths_m.size(); ++i)
    if (!(lengths_m[i] >= kLeast_m && lengths_m[i] <= most_m(i))) return false;
  return true;
}

std::string joined(const std::vector<double>& lengths) {
  std::string text;
  for (const double length : lengths) text += fmt::format("{}{:.9g}", text.empty() ? "" : "x", length);
  return text;
}

/// What to write in place of lengths that no room has: mostly they are in another unit.
std::string cure_for(const std::string& option, std::vector<double> lengths) {
  for (const double unit_m : {0.001, 0.01}) {
    auto metres = lengths;
    for (double& length : metres) length *= unit_m;
    if (probable(metres)) return fmt::format("lengths are in metres: write {} {}", option, joined(metres));
  }
  return fmt::format("lengths are in metres, within {:g} to {:g}, a height up to {:g}", kLeast_m,
                     kMostAlong_m, kMostHeight_m);
}

/// @param form  how the option is written, with as many lengths as it must have
std::vector<double> lengths_m(const std::string& option, const std::string& text, const std::string& form) {
  const auto lengths = lengths_in(text);
  if (lengths.size() != lengths_in(form).size())
    throw UsageError(fmt::format(
        "{} '{}' does not read like {}\n        write lengths in metres with x between "
        "them, no units{}",
        option, text, form, text.find(',') == std::string::npos ? "" : "; decimals take a point"));
  for (std::size_t i = 0; i < lengths.size(); ++i)
    if (!(lengths[i] >= kLeast_m && lengths[i] <= most_m(i)))
      throw UsageError(fmt::format("{} '{}': {:.9g} m is no {} of a room\n        {}", option, text,
                                   lengths[i], i < 2 ? "length" : "height", cure_for(option, lengths)));
  return lengths;
}

StarterRoom room_of(const std::string& shape, const std::string& size, const std::string& leg) {
  const auto lengths = lengths_m("--size", size, "6x4x2.8");
  StarterRoom room{
      lengths[0], lengths[1], lengths[2], {}, fmt::format("dimdis new {} --size {}", shape, size)};
  if (shape == "box") return room;
  const auto leg_lengths = lengths_m("--leg", leg, "3x3");
  room.leg = {leg_lengths[0], leg_lengths[1]};
  room.command += " --leg " + leg;
  // Any narrower a step would hardly have been meant.
  if (room.leg->along_x_m > room.along_x_m - 0.1)
    throw UsageError(
        fmt::format("--leg '{}': the leg stands on the room's north wall, {:.9g} m long, and must be "
                    "narrower than that\n        give --leg a first length of at most {:.9g}, or use box",
                    leg, room.along_x_m, room.along_x_m - 0.1));
  return room;
}

}  // namespace

NewCommand::NewCommand(Program& program) : program_(program) {
  command_ =
      program.add_command("new", "Write a zone file to begin with: a bare room, and lights for it",
                          "  dimdis new box --size 6x4x2.8 -o room.zone.toml --lights-out room.lights.toml\n"
                          "  dimdis new l --size 6x4x2.8 --leg 3x3 -o room.zone.toml");
  command_->add_option("SHAPE", shape_, "box, or l: a box with a leg on its north side")
      ->type_name("")
      ->required()
      ->check(CLI::IsMember({"box", "l"}));
  command_->add_option("--size", size_, "Length along x, width along y and height, m")
      ->type_name("LxWxH")
      ->required();
  command_->add_option("--leg", leg_, "Of l: how wide the leg is along x, how far it reaches along y, m")
      ->type_name("LxW");
  command_->add_option("--lights-out", lights_, "Also write a lights file: a grid of ideal luminaires")
      ->type_name("FILE");
  command_->add_option("-o,--output", output_, "Zone file to write, - for standard output")
      ->type_name("FILE");
  program.add_common_options(*command_);
}

bool NewCommand::run() {
  if (!command_->parsed()) return false;
  if (shape_ == "box") refuse_without_effect(*command_, {"--leg"}, "on a box");
  if (shape_ == "l" && leg_.empty())
    throw UsageError("an l needs --leg\n        write for example --leg 3x3");
  const StarterRoom room = room_of(shape_, size_, leg_);
  refuse_existing(output_);
  if (!lights_.empty()) {
    refuse_existing(lights_);
    refuse_both_on_stdout(output_, lights_);
    program_.check_output(lights_, {output_});
  }
  program_.check_output(output_, {});
  program_.stage(kWritingStage);
  write_file(output_, starter_zone(room));
  if (!lights_.empty()) write_file(lights_, starter_lights(room));
  program_.stage("");
  return true;
}

void NewCommand::refuse_existing(const std::string& path) const {
  // Unlike what other commands write, these files are worked on afterwards.
  if (path != "-" && std::filesystem::is_regular_file(path))
    throw UsageError(fmt::format(
        "'{}' is there already, perhaps changed by hand\n        give another name, or remove it", path));
}

}  // namespace dim
