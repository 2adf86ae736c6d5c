#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {

/// The part of an LM-63 file before its numbers.
struct IesLabels {
  std::string identifier;  ///< empty where the file has none
  int format_year = 1986;
  std::vector<std::pair<std::string, std::string>> keywords;  ///< as in Photometry
  std::string tilt;                                           ///< what follows TILT=
  Place tilt_place;
};

/// Reads up to and including the TILT= line.
/// @throws InputError where there is no such line, or the text is not text
IesLabels read_ies_labels(TextScanner& scanner, Warnings& warnings);

}  // namespace dim
