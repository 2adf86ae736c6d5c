#pragma once

#include <string>
#include <string_view>

namespace dim {

/// What to do about a line that is no TOML, by the slips that people make: typographic or missing quotes,
/// decimal commas, per cent signs and units behind numbers, paths with backslashes, brackets and commas left
/// out. Empty where nothing of the kind is seen.
/// @param text  the whole file
/// @param line  that the parser stopped at, from 1
std::string syntax_cure(std::string_view text, int line);

}  // namespace dim
