#include "import/room_figures.hpp"

#include <algorithm>
#include <unordered_map>

namespace dim {
namespace {

class RoomSums {
 public:
  explicit RoomSums(ImportReport& report) : report_(report) {
    for (std::size_t i = 0; i < report.rooms.size(); ++i) index_.emplace(report.rooms[i].name, i);
  }

  RoomFigures& of(const std::string& name) {
    const auto [found, is_new] = index_.emplace(name, report_.rooms.size());
    if (is_new) report_.rooms.emplace_back().name = name;
    return report_.rooms[found->second];
  }

 private:
  ImportReport& report_;
  std::unordered_map<std::string, std::size_t> index_;
};

/// Volume between a ring and the origin, seen from inside as the ring runs.
double volume_under(const Ring3& ring, const Vec3& origin) {
  return ring.empty() ? 0.0 : -glm::dot(newell(ring), ring[0] - origin) / 6.0;
}

/// Both sides of a sheet bound no volume; of a feature its parent does.
bool bounds(Lit lit, const std::string& room, const std::string& on) {
  return (lit == Lit::front || lit == Lit::open) && !room.empty() && on.empty();
}

}  // namespace

void count_read(const ImportedModel& model, ImportReport& report) {
  RoomSums sums(report);
  report.n_read = model.faces.size();
  const Vec3 origin = model.faces.front().outline.empty() ? Vec3(0.0) : model.faces.front().outline[0];
  for (const ImportedFace& face : model.faces) {
    Vec3 twice = newell(face.outline);
    for (const Ring3& hole : face.holes) {
      const Vec3 cut = newell(hole);
      twice -= glm::dot(cut, twice) > 0.0 ? cut : -cut;
    }
    const double area = face.lit == Lit::open ? 0.0 : glm::length(twice) / 2.0;
    report.area_read_m2 += area;
    if (face.lit == Lit::open) --report.n_read;
    if (!bounds(face.lit, face.room, face.on)) continue;
    RoomFigures& room = sums.of(face.room);
    if (face.lit == Lit::open)
      room.closed = false;
    else
      ++room.n_faces;
    room.area_before_m2 += area;
    const double under_outline = volume_under(face.outline, origin);
    room.volume_before_m3 += under_outline;
    for (const Ring3& hole : face.holes) {
      const bool same_way = glm::dot(newell(hole), twice) > 0.0;
      room.volume_before_m3 -= (same_way ? 1.0 : -1.0) * volume_under(hole, origin);
    }
  }
}

void count_rooms_after(const FaceMesh& mesh, const std::vector<FaceUse>& facings, ImportReport& report) {
  RoomSums sums(report);
  const Vec3 origin = mesh.points.empty() ? Vec3(0.0) : mesh.points[0];
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const MeshFace& face = mesh.faces[f];
    const MeshObject& object = mesh.objects[static_cast<std::size_t>(face.object)];
    if (facings[f] != stated_facing(face.lit) || !bounds(face.lit, object.room, object.on)) continue;
    RoomFigures& room = sums.of(object.room);
    if (facings[f] == FaceUse::front) room.area_after_m2 += area_m2(mesh, face);
    for (const CornerRing& ring : face.rings)
      room.volume_after_m3 += volume_under(corners_of(mesh, ring), origin);
  }
}

}  // namespace dim
