#pragma once

#include <optional>
#include <string>

#include "database/fitting_entry.hpp"
#include "database/toml_reader.hpp"
#include "scene/fitting_shelf.hpp"
#include "scene/sky_light.hpp"
#include "scene/zone.hpp"

namespace dim {

/// Reads the [sky] of a lights file:
///   model       cie-1 ... cie-15, cie-overcast, uniform, perez, file; tregenza, reinhart (coefficients)
///   horizontal  lx, of the sky alone; or diffuse_horizontal, W/m2 (perez: required)
///   sun         { altitude, azimuth, spectrum }, degrees; or { time, spectrum }, local standard time of the site
///   direct_normal  of the beam: lx beside horizontal, W/m2 beside diffuse_horizontal
///   subdivision 2 or 4, of reinhart; file: CSV of 145 luminances
///   ground      reflectance; spectrum, of sky and ground
/// @param site    of the zone
/// @param folder  that `file` is relative to
/// @returns nothing where there is none, or something is wrong, which is reported
std::optional<SkyLight> read_sky(const TomlTable& root, const std::optional<Site>& site, const std::string& folder,
                                 const FileLoader& load, const SpectrumFinder& spectra);

}  // namespace dim
