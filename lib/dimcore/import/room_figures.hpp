#pragma once

#include "import/face_mesh.hpp"
#include "import/import_report.hpp"
#include "import/spaces.hpp"

namespace dim {

/// Counts faces and their area; of rooms that the file names also the volume, by the divergence theorem.
void count_read(const ImportedModel& model, ImportReport& report);

/// The same of the rooms that the file names, once the faces are cleaned up.
void count_rooms_after(const FaceMesh& mesh, const std::vector<FaceUse>& facings, ImportReport& report);

}  // namespace dim
