#include "dimray/band_option.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "transport/auto_bands.hpp"

namespace dim {
namespace {

constexpr int kMostBands = 400;

std::optional<double> number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

// "380,480,580,780"
std::optional<Bands> bands_of_edges(std::string_view text) {
  Bands bands;
  bands.edges_nm.clear();
  while (true) {
    const auto comma = text.find(',');
    const auto edge = number(text.substr(0, comma));
    if (!edge || (!bands.edges_nm.empty() && !(*edge > bands.edges_nm.back()))) return std::nullopt;
    bands.edges_nm.push_back(*edge);
    if (comma == std::string_view::npos) break;
    text.remove_prefix(comma + 1);
  }
  if (bands.size() < 1 || bands.size() > kMostBands || bands.edges_nm.front() != kVisibleLow_nm ||
      bands.edges_nm.back() != kVisibleHigh_nm)
    return std::nullopt;
  return bands;
}

std::optional<Bands> bands_of(const std::string& text) {
  if (text.find(',') != std::string::npos) return bands_of_edges(text);
  const auto n = number(text);
  if (!n || !(*n >= 1 && *n <= kMostBands) || *n != static_cast<int>(*n)) return std::nullopt;
  return Bands::uniform(static_cast<int>(*n));
}

constexpr std::string_view kAuto = "auto";

// "auto", or "auto:0.3" for another colour difference and luminances in proportion.
std::optional<BandAccuracy> automatic(std::string_view text) {
  constexpr double kFinest = 0.01, kCoarsest = 10.0;
  if (!text.starts_with(kAuto)) return std::nullopt;
  text.remove_prefix(kAuto.size());
  if (text.empty()) return BandAccuracy{};
  if (text.front() != ':') return std::nullopt;
  const auto delta_e = number(text.substr(1));
  if (!delta_e || !(*delta_e >= kFinest && *delta_e <= kCoarsest)) return std::nullopt;
  const BandAccuracy usual;
  return BandAccuracy{*delta_e, usual.luminance * *delta_e / usual.delta_e_2000};
}

}  // namespace

void add_bands_option(CLI::App& app, std::string& text) {
  const auto check = [](const std::string& value) -> std::string {
    if (automatic(value) || bands_of(value)) return {};
    return fmt::format(
        "'{}' is not auto, auto:DE00 within 0.01..10, a number of bands within 1..{}, or ascending edges "
        "from {} to {} nm",
        value, kMostBands, kVisibleLow_nm, kVisibleHigh_nm);
  };
  app.add_option(
         "--bands", text,
         "Wavebands over 380-780 nm: auto, the fewest that keep colours within dE00 0.5 (auto:DE00 for "
         "another) and luminances within 0.2 %; a number of equal ones; or their edges 380,480,...,780")
      ->check(CLI::Validator(check, ""))
      ->type_name("auto|N|EDGES")
      ->group("Accuracy");
}

BandChoice chosen_bands(Program& program, const std::string& text, const Zone& zone, const Lights& lights) {
  const LampSpectra lamps = lamp_spectra(lights);
  if (const auto accuracy = automatic(text)) {
    BandChoice choice = auto_bands(zone, lamps, *accuracy);
    if (choice.bands.size() > 1) program.say(in_words(choice));
    return choice;
  }
  BandChoice choice = judged_bands(zone, lamps, *bands_of(text));
  if (!choice.is_enough())
    program.warn({{{}, in_words(choice), "--bands auto takes as many as colours need"}});
  return choice;
}

}  // namespace dim
