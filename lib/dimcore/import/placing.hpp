#pragma once

#include <optional>

#include "import/imported_model.hpp"

namespace dim {

/// Puts everything of the model into metres with z up.
/// @param unit_m  in place of what the model states; nothing there either: metres
/// @param up      in place of what the model states
/// @throws InputError  a coordinate beyond 1e9 m or not finite
void place_model(ImportedModel& model, std::optional<double> unit_m, std::optional<UpAxis> up);

/// Warns where no room is as large, or as small, as the model, with the unit that would make one of it.
void warn_of_improbable_size(const ImportedModel& model, double unit_m, Warnings& warnings);

}  // namespace dim
