#include "import/esp_blocks.hpp"

#include <cmath>

namespace dim {

std::vector<ImportedFace> esp_block_faces(const std::array<Vec3, 8>& corners, const std::string& name,
                                          int material) {
  static constexpr std::size_t kFaces[6][4] = {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6},
                                               {3, 0, 4, 7}, {4, 5, 6, 7}, {0, 3, 2, 1}};
  static constexpr const char* kNames[6] = {"front", "right", "back", "left", "top", "base"};
  std::vector<ImportedFace> faces;
  for (std::size_t f = 0; f < 6; ++f) {
    ImportedFace face;
    for (const std::size_t i : kFaces[f]) face.outline.push_back(corners[i]);
    face.name = name + "." + kNames[f];
    face.material = material;
    face.lit = Lit::outside;
    faces.push_back(std::move(face));
  }
  return faces;
}

std::array<Vec3, 8> esp_block_corners(const Vec3& origin, Vec3 edges, double turn_deg, double tilt_deg) {
  Vec3 low(0.0);
  for (int axis = 0; axis < 3; ++axis)
    if (edges[axis] < 0.0) low[axis] = edges[axis], edges[axis] = -edges[axis];
  const double ca = std::cos(radians(turn_deg)), sa = std::sin(radians(turn_deg));
  const double cb = std::cos(radians(tilt_deg)), sb = std::sin(radians(tilt_deg));
  std::array<Vec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) {
    const std::size_t k = i % 4;
    const Vec3 p = low + edges * Vec3(k == 1 || k == 2 ? 1 : 0, k >= 2 ? 1 : 0, i >= 4 ? 1 : 0);
    const Vec3 tilted(p.x * cb - p.z * sb, p.y, p.x * sb + p.z * cb);
    corners[i] = origin + Vec3(tilted.x * ca - tilted.y * sa, tilted.x * sa + tilted.y * ca, tilted.z);
  }
  return corners;
}

}  // namespace dim
