#pragma once

#include <nlohmann/json.hpp>

#include "report/light_groups.hpp"
#include "report/report.hpp"

/// What the page is made of, as its script reads it (page/report.js). Lengths are metres in the zone file's axes, on
/// plans in the plan's own; figures that do not exist are null; lists named `groups` are in the groups' order.
namespace dim {

using Json = nlohmann::ordered_json;

Json groups_part(const LuminanceDatabase& database, const std::vector<LightGroup>& groups);

/// Receivers: measuring planes, sensors, and the surfaces that requirements name. Each with its values and stated
/// errors by group at full output.
Json targets_part(const LuminanceDatabase& database, const std::vector<LightGroup>& groups,
                  const std::optional<Requirements>& requirements, const Job& job);

/// The schedule of fittings, and where each luminaire is.
Json luminaires_part(const LuminanceDatabase& database);

/// What each eye's UGR follows from: by group the sum of L^2 omega / p^2 and the background luminance.
Json glare_part(const LuminanceDatabase& database, const std::vector<LightGroup>& groups,
                const std::optional<Requirements>& requirements, const Job& job);

/// Findings as `check` has them.
Json requirements_part(const LuminanceDatabase& database, const ReportOptions& options, const Job& job);

Json energy_part(const LuminanceDatabase& database, const std::vector<LightGroup>& groups);

Json pictures_part(const LuminanceDatabase& database, const std::vector<LightGroup>& groups,
                   const ReportOptions& options, const Job& job);

}  // namespace dim
