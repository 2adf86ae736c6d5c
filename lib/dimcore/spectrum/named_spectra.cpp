#include "spectrum/named_spectra.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>

#include "base/error.hpp"
#include "spectrum/observer.hpp"
#include "spectrum/rendering.hpp"
#include "spectrum/tables/illuminants.hpp"
#include "spectrum/white.hpp"

namespace dim {
namespace {

std::array<std::span<const TabulatedSpectrum>, 4> families() {
  return {standard_illuminants(), fluorescent_lamps(), discharge_lamps(), led_lamps()};
}

// A family with a temperature in its name.
struct Whites {
  std::string_view prefix;
  std::string_view example;
  TemperatureRange range;
  std::function<SpectralCurve(double)> make;
};

std::array<Whites, 3> whites() {
  return {Whites{"blackbody-", "blackbody-2700", {kCoolestWhite_K, kHottestWhite_K}, blackbody},
          Whites{"daylight-", "daylight-6500", {kCoolestDaylight_K, kHottestDaylight_K}, cie_daylight},
          Whites{"led-", "led-4000", led_white_range(), led_white}};
}

std::optional<double> number_after(std::string_view name, std::string_view prefix) {
  if (!name.starts_with(prefix)) return std::nullopt;
  const std::string_view digits = name.substr(prefix.size());
  double value = 0.0;
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

struct PhosphorLed {
  FiveNanometreTable values;
  Vec3 xyz;
  double cct_K;
};

// LED-B1..LED-B5 stand first in their table, in order of temperature.
const std::array<PhosphorLed, 5>& phosphor_leds() {
  const auto led = [](std::size_t i) {
    const FiveNanometreTable values = led_lamps()[i].values;
    const Vec3 xyz = light_responses(curve_of(values)).xyz;
    return PhosphorLed{values, xyz, white_point(xyz).cct_K};
  };
  static const std::array<PhosphorLed, 5> all = {led(0), led(1), led(2), led(3), led(4)};
  return all;
}

SpectralCurve mixture(const PhosphorLed& warm, const PhosphorLed& cool, double share) {
  std::array<double, kTableSize> sum{};
  for (std::size_t i = 0; i < kTableSize; ++i)
    sum[i] = (1.0 - share) * warm.values[i] / warm.xyz.y + share * cool.values[i] / cool.xyz.y;
  return curve_of(sum);
}

}  // namespace

TemperatureRange led_white_range() { return {phosphor_leds().front().cct_K, phosphor_leds().back().cct_K}; }

SpectralCurve led_white(double cct_K) {
  const auto& leds = phosphor_leds();
  std::size_t cooler = 1;
  while (cooler + 1 < leds.size() && leds[cooler].cct_K < cct_K) ++cooler;
  const PhosphorLed &warm = leds[cooler - 1], &cool = leds[cooler];
  // XYZ are additive: the temperature of a mixture needs no spectrum.
  double low = 0.0, high = 1.0;
  constexpr int kHalvings = 40;
  for (int i = 0; i < kHalvings; ++i) {
    const double share = (low + high) / 2.0;
    const Vec3 xyz = (1.0 - share) * warm.xyz / warm.xyz.y + share * cool.xyz / cool.xyz.y;
    (white_point(xyz).cct_K < cct_K ? low : high) = share;
  }
  return mixture(warm, cool, (low + high) / 2.0);
}

SpectralCurve find_spectrum(std::string_view name) {
  if (name == "e") return SpectralCurve(1.0);
  for (const auto family : families()) {
    for (const auto& spectrum : family)
      if (spectrum.name == name) return curve_of(spectrum.values);
  }
  for (const auto& white : whites()) {
    const auto temperature_K = number_after(name, white.prefix);
    if (!temperature_K) continue;
    // The ends of the LEDs' range are not whole kelvins.
    constexpr double kRounding_K = 0.5;
    if (*temperature_K >= white.range.low_K - kRounding_K &&
        *temperature_K <= white.range.high_K + kRounding_K)
      return white.make(*temperature_K);
    throw InputError(
        Problem{{},
                fmt::format("spectrum '{}': {:g} K is outside {:.0f} to {:.0f} K", name, *temperature_K,
                            white.range.low_K, white.range.high_K),
                "choose a temperature within, another spectrum, or give it as [[nm, value], ...]"});
  }
  throw InputError(Problem{
      {}, fmt::format("no spectrum is called '{}'", name), name_cure(std::string(name), spectrum_names())});
}

std::vector<std::string> spectrum_names() {
  std::vector<std::string> names{"e"};
  for (const auto& white : whites()) names.emplace_back(white.example);
  for (const auto family : families()) {
    for (const auto& spectrum : family) names.emplace_back(spectrum.name);
  }
  return names;
}

}  // namespace dim
