// Lights files: any text is read for a small room, or refused with InputError; what is read has a finite flux.
#include <cmath>
#include <cstdlib>

#include "rooms.hpp"
#include "scene/lights_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  static const dim::Zone zone = dim::test::box_zone({4, 3, 2.5}, 0.5, 1.0);
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  dim::Warnings warnings;
  const dim::FileLoader none = [](const std::string& path) -> std::string {
    throw dim::InputError({{path, 0, 0}, "there is no such file", ""});
  };
  try {
    const dim::Lights lights = dim::read_lights(text, "fuzz.toml", {}, zone, {}, warnings, none);
    for (const auto& luminaire : lights.luminaires) {
      const auto& fitting = lights.fittings.at(static_cast<std::size_t>(luminaire.fitting));
      if (!std::isfinite(luminaire.factor * fitting.flux_lm)) std::abort();
      if (std::abs(glm::dot(luminaire.aim, luminaire.c0)) > 1e-6) std::abort();
    }
  } catch (const dim::InputError&) {
  }
  return 0;
}
