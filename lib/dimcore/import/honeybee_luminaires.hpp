#pragma once

#include "import/json_node.hpp"

namespace dim {

/// Adds a Honeybee luminaire, once for each place it stands in. Its IES text becomes a file of the model.
void add_honeybee_luminaire(const JsonNode& luminaire, ImportedModel& model, Unknowns& unknowns,
                            const ImportInput& input);

}  // namespace dim
