#pragma once

#include <string>
#include <string_view>

#include "base/error.hpp"
#include "photometry/photometry.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {

/// Reads an EULUMDAT file (.ldt; A. Stockmar 1990), one field a line.
///
/// Intensity = value (cd/klm) x flux of the first lamp set / 1000 x conversion factor. The flux of a set is
/// for all its lamps. A negative number of lamps means absolute photometry: the flux is the luminaire's own.
/// Further lamp sets are alternatives; they are kept in Photometry::lamp_sets, and warned of.
///
/// Isym 0 lists every plane, 1 one, 2 C0-C180, 3 C270-C90 (by way of C0), 4 C0-C90; planes may be unequally
/// spaced. Length and diameter lie along C90-C270, the width along C0-C180; width 0 means round.
///
/// Accepted: line ends LF, CR LF, CR and CR CR LF; decimal points and commas; a byte order mark; text in
/// UTF-8, Shift-JIS or Windows-1252; empty fields for 0. The tilt during measurement is not applied.
/// Warnings: more than one lamp set; a tilt; numbers after the intensities that Isym asks for; gamma that
/// stops short of 0, 90 or 180 with light left (carried on); the light output ratio times the lamps' flux
/// differs from the integral by more than 2 %.
///
/// The result's keywords are those of LM-63 where that has them: MANUFAC, TEST, LUMINAIRE, LUMCAT,
/// _FILENAME, ISSUEDATE, LAMP.
///
/// @throws InputError  with the line: not EULUMDAT, truncated, counts, ranges or order of angles, negative or
///                     non-finite values, no lamp flux, size above kMaxPhotometryBytes
Photometry read_eulumdat(std::string_view bytes, const std::string& file_name, Warnings& warnings);

}  // namespace dim
