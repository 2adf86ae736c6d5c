#include "climate/control_law.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "climate/hunt.hpp"

namespace dim {
namespace {

constexpr std::array<std::pair<Law, const char*>, 9> kLaws = {{{Law::on, "on"},
                                                               {Law::off, "off"},
                                                               {Law::on_off, "on-off"},
                                                               {Law::step, "step"},
                                                               {Law::dimming, "dimming"},
                                                               {Law::hunt, "hunt"},
                                                               {Law::integral_reset, "integral-reset"},
                                                               {Law::closed_loop, "closed-loop"},
                                                               {Law::occupancy, "occupancy"}}};
constexpr LampState kFull{1.0, 1.0};
constexpr LampState kOff{0.0, 0.0};

/// Whether a law puts the lights out where daylight, with what the lamps would add, exceeds its level.
bool is_above(double daylight_lx, const ControlSettings& s) {
  const double level_lx = s.switch_off * s.setpoint_lx;
  switch (s.law) {
    case Law::on_off:
      return daylight_lx + s.setpoint_lx >= level_lx;
    case Law::step:
      return daylight_lx + 0.5 * s.setpoint_lx >= level_lx;
    case Law::dimming:
      return daylight_lx + s.min_light * s.setpoint_lx >= level_lx;
    case Law::integral_reset:
      return daylight_lx >= (1.0 - s.min_light) * s.switch_off * s.night_lx;
    default:
      return false;
  }
}

}  // namespace

std::optional<Law> law_of(const std::string& word) {
  for (const auto& [law, name] : kLaws)
    if (word == name) return law;
  return std::nullopt;
}

std::string word_of(Law law) {
  for (const auto& [known, name] : kLaws)
    if (law == known) return name;
  return "";
}

std::vector<std::string> law_words() {
  std::vector<std::string> words;
  for (const auto& [law, name] : kLaws) words.emplace_back(name);
  return words;
}

double dimmed_power(double light, const ControlSettings& s) {
  return s.min_power + (1.0 - s.min_power) * (light - s.min_light) / (1.0 - s.min_light);
}

LampState Controller::next(double daylight_lx, double least_lx, bool present) {
  LampState state = kOff;
  if (present) {
    state = lit(daylight_lx, least_lx);
    n_above_ = is_above(daylight_lx, settings_) ? n_above_ + 1 : 0;
  } else {
    n_above_ = 0;
    is_lit_ = false;
  }
  was_present_ = present;
  ++step_;
  return state;
}

LampState Controller::switched_off(const LampState& waiting) const {
  return n_above_ >= settings_.delay_steps ? kOff : waiting;
}

LampState Controller::lit(double daylight_lx, double least_lx) {
  const ControlSettings& s = settings_;
  const LampState least{s.min_light, s.min_power};
  const LampState half{0.5, s.min_power};
  const bool above = is_above(daylight_lx, s);
  const auto dimmed = [&](double light) { return LampState{light, dimmed_power(light, s)}; };
  switch (s.law) {
    case Law::on:
    case Law::occupancy:
      return kFull;
    case Law::off:
      return kOff;
    case Law::on_off:
      return above ? switched_off(kFull) : kFull;
    case Law::step:
      if (above) return switched_off(half);
      return daylight_lx + 0.5 * s.setpoint_lx >= s.setpoint_lx ? half : kFull;
    case Law::dimming:
      if (above) return switched_off(least);
      if (daylight_lx >= (1.0 - s.min_light) * s.setpoint_lx) return least;
      return dimmed((s.setpoint_lx - daylight_lx) / s.setpoint_lx);
    case Law::hunt:
      if (!was_present_) is_lit_ = switches_on(least_lx, s.seed, circuit_, step_);
      return is_lit_ ? kFull : kOff;
    case Law::integral_reset:
      if (above) return switched_off(least);
      if (daylight_lx > (1.0 - s.min_light) * s.night_lx) return least;
      return dimmed(std::max(s.min_light, 1.0 - daylight_lx / s.night_lx));
    case Law::closed_loop: {
      const double output =
          (1.0 + s.slope_per_lx * (daylight_lx - s.night_lx)) / (1.0 - s.slope_per_lx * s.night_lx);
      return dimmed(std::clamp(output, s.min_light, 1.0));
    }
  }
  return kOff;
}

}  // namespace dim
