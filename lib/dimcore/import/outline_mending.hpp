#pragma once

#include "import/face_mesh.hpp"
#include "import/import_report.hpp"

namespace dim {

/// Makes faces that a zone file would refuse into such as it takes: outlines that cross or touch themselves
/// and holes that leave or touch their outline are clipped, and what is then still refused, bent faces with
/// holes among them, is cut into triangles.
void mend_outlines(FaceMesh& mesh, ImportReport& report);

}  // namespace dim
