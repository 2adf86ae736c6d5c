#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "common/program.hpp"
#include "scene/lights.hpp"
#include "scene/zone.hpp"
#include "spectrum/bands.hpp"

namespace dim {

/// Adds `--bands auto|N|EDGES`.
void add_bands_option(CLI::App& app, std::string& text);

/// The bands that the option asks for; `auto` chooses for the scene and says how many.
Bands chosen_bands(Program& program, const std::string& text, const Zone& zone, const Lights& lights);

}  // namespace dim
