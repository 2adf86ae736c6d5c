#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "photometry/photometry.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {

/// Gives the bytes of the file that a line TILT=name names; the name holds no folder. May throw any Error;
/// what the file holds is not quoted in messages.
using TiltResolver = std::function<std::string(const std::string& name)>;

/// Reads an LM-63 file (IES; editions 1986, 1991, 1995, 2002, 2019), photometric types A, B and C, any
/// symmetry. In types A and B horizontal angles from 0 up are reflected in the plane H = 0; outside the
/// listed angles there is no light.
///
/// Intensity = candela value x candela multiplier x ballast factor, for absolute photometry (lumens -1) as
/// well as relative; times the ballast-lamp photometric factor in the editions that have one (1986 and 1991).
/// The same place is "future use" in 1995 and 2002 and the file generation type in 2019, never a factor.
/// TILT factors are kept in the result for whoever knows how the luminaire hangs (tilt_factor): they are
/// relative to the position it was measured in, where the factor is 1.
///
/// In type C, vertical angles that stop short of 0, 90 or 180 with light left are carried on and warned of.
///
/// Accepted: lines ended by LF, CR LF, CR or CR CR LF; lists wrapped anywhere and separated by blanks or
/// commas; a byte order mark; blank lines first; identifiers such as `ANSI/IES LM-63-19` or `IESNA:
/// LM-63-2002`; TILT=NONE; and TILT=FILE name; keywords in any case, in UTF-8, Shift-JIS or Windows-1252; no
/// identifier line (1986); anything after the last candela value (numbers there give a warning). Warnings,
/// with both figures: the intensity integrates to more than 1.02 x the lamps' lumens, or differs by more than
/// 2 % from the luminaire lumens that a keyword such as [_ABSOLUTELUMENS] states.
///
/// @param bytes      the whole file
/// @param file_name  for messages
/// @param resolver   for TILT=name; without one such a file is an error
/// @throws InputError  with line and column: not LM-63, counts, ranges or order of angles,
///                     negative or non-finite values, truncation, size above kMaxPhotometryBytes
Photometry read_ies(std::string_view bytes, const std::string& file_name, Warnings& warnings,
                    const TiltResolver& resolver = {});

}  // namespace dim
