#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "reflection/klems.hpp"

namespace dim {

/// The visible transmission from outside ("Transmission Front") of a BSDF file of LBNL WINDOW, full Klems
/// basis.
/// @param text       XML
/// @param file_name  for messages
/// @throws InputError  not such a file, of another basis, without those data, not 145 x 145 values; a value that is
///                     negative or not finite; light from some direction passed more than whole
std::shared_ptr<const KlemsMatrix> read_bsdf(std::string_view text, const std::string& file_name);

}  // namespace dim
