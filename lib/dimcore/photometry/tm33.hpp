#pragma once

#include <string>
#include <string_view>

#include "base/error.hpp"
#include "photometry/photometry.hpp"

namespace dim {

/// Whether a text is XML by its first character.
bool is_xml(std::string_view bytes);

/// Reads a TM-33 file (ANSI/IES TM-33-18 and -23, UNI 11733; XML): roots IESTM33, IESTM33-22, UNI11733 and
/// LuminaireOpticalData.
///
/// Taken from each Emitter: luminous intensity (type C; any symmetry; the horizontal angles say which), its
/// multiplier, and the ballast factor where the photometry is not absolute; input watts; rated lumens, colour
/// temperature and rendering index; spectral power. Emitters are added up: intensities, watts, and spectra
/// by their flux. The luminous opening is the rectangle round the emission areas of the bottom face (else of
/// the top), else the luminaire's own size. Length lies along C90-C270 (face C0 has a length), width along
/// C0-C180, metres; sizes above 20 are taken for millimetres.
///
/// Warnings: no emission areas; counts that differ from what is listed; lamp tilt and colour by direction,
/// which are not used; a spectrum that cannot be used; a stated flux that differs from the integral by more
/// than 2 %.
///
/// The result's keywords are those of LM-63: MANUFAC, LUMCAT, LUMINAIRE, TESTLAB, TEST, ISSUEDATE, LAMP.
///
/// @throws InputError  with the line: not well-formed or not TM-33, no luminous intensity (radiant or photon
///                     alone), an incomplete grid, negative or non-finite values, types A and B
Photometry read_tm33(std::string_view bytes, const std::string& file_name, Warnings& warnings);

}  // namespace dim
