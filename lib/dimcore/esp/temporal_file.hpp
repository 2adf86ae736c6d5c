#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace dim {

/// Columns of a CASUAL3T item: convective, radiant and latent watts of occupants, lights and equipment.
inline constexpr std::size_t kGainColumns = 9;
using GainRow = std::array<double, kGainColumns>;
enum GainColumn : std::size_t {
  occupant_convective,
  occupant_radiant,
  occupant_latent,
  lights_convective,
  lights_radiant
};

/// A *.tdfa file with one item, the casual gains of a zone.
struct TemporalGains {
  std::string zone;        ///< of the ESP-r model
  std::string tag;         ///< of the item, at most 12 characters
  int steps_per_hour = 1;  ///< 1..60
  int year = 1999;
  int begin_day = 1, end_day = 365;  ///< of the year, both with it
  std::vector<GainRow> rows;         ///< [days x 24 x steps_per_hour], W
};

/// The item's tag for a zone: its name and "_lights", cut to the 12 characters that ESP-r reads.
std::string gains_tag(const std::string& zone);

/// The text of the file. @throws LimitError  what ESP-r cannot hold
std::string write_tdf(const TemporalGains& gains);

/// Reads such a file strictly. @throws InputError  everything outside the grammar and its limits, with file
/// and line
TemporalGains read_tdf(std::string_view text, const std::string& file);

/// Lines for the user's .cfg that tie the file to a zone.
std::string tdf_links(const TemporalGains& gains, const std::string& file_name);

}  // namespace dim
