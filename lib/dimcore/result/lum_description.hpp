#pragma once

#include <string>

#include "result/content.hpp"

namespace dim {

/// The lists of a `.lum` file's `/description`: sources, luminaires and photometry as JSON
/// (docs/formats.md).
std::string description_of(const ResultContent& content);

/// Fills those lists of `content`, whose bands are known; intensities and spectra are elsewhere in the file.
/// @throws IoError  naming the entry that is missing, of another type or out of range
void read_description(const std::string& text, const std::string& path, ResultContent& content);

}  // namespace dim
