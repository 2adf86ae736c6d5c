#include "photometry/photometry.hpp"

namespace dim {

const char* symmetry_name(Symmetry symmetry) {
  switch (symmetry) {
    case Symmetry::kAxial:
      return "axial";
    case Symmetry::kQuadrilateral:
      return "quadrilateral";
    case Symmetry::kBilateral0_180:
      return "bilateral 0-180";
    case Symmetry::kBilateral90_270:
      return "bilateral 90-270";
    case Symmetry::kNone:
      break;
  }
  return "none";
}

std::string Photometry::keyword(const std::string& name) const {
  for (const auto& [key, value] : keywords)
    if (key == name) return value;
  return {};
}

}  // namespace dim
