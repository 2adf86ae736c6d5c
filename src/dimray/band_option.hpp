#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "common/program.hpp"
#include "scene/lights.hpp"
#include "scene/zone.hpp"
#include "spectrum/band_choice.hpp"

namespace dim {

/// Adds `--bands auto|N|EDGES`.
void add_bands_option(CLI::App& app, std::string& text);

/// The bands that the option asks for and how far off they are for the scene, which is said where it matters:
/// how many `auto` found, or that the number asked for is too small.
BandChoice chosen_bands(Program& program, const std::string& text, const Zone& zone, const Lights& lights);

}  // namespace dim
