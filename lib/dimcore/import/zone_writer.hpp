#pragma once

#include <string>
#include <vector>

#include "import/face_mesh.hpp"
#include "import/import_report.hpp"
#include "import/spaces.hpp"

namespace dim {

/// What a zone file says of a model beside its faces.
struct ZoneHeading {
  std::string name;    ///< of the zone
  std::string source;  ///< "office.obj (OBJ)"
};

/// The zone file: metres, z up, finishes by the materials' names (those that no surface has are left out), a
/// surface for each face that is seen, sensors. Counts surfaces and areas in the report, lists what names
/// became, and what materials do not state.
/// @param facings  [mesh.faces]
std::string zone_text(const ImportedModel& model, const FaceMesh& mesh, const std::vector<FaceUse>& facings,
                      const ZoneHeading& heading, ImportReport& report, Warnings& warnings);

/// The lights file of the model's luminaires, metres.
std::string lights_text(const ImportedModel& model, const ZoneHeading& heading);

}  // namespace dim
