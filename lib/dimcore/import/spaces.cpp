#include "import/spaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "import/side_sight.hpp"

namespace dim {

FaceUse stated_facing(Lit lit) {
  switch (lit) {
    case Lit::both:
      return FaceUse::both;
    case Lit::outside:
      return FaceUse::outside;
    case Lit::outside_sheet:
      return FaceUse::outside_sheet;
    case Lit::open:
      return FaceUse::open;
    default:
      return FaceUse::front;
  }
}

namespace {

constexpr std::uint32_t kOutside = 0xffffffffu;
constexpr std::uint32_t kUndecided = 0xfffffffeu;
constexpr int kRays = 192;
constexpr const char* kInsideCure = "give --inside a point of the room, metres, z up";

/// Closed, or enclosing more than a bent sheet does: a cube encloses 0.068 of its area to the power of 1.5,
/// and a room that lacks a wall and its ceiling has an openness of 0.35.
bool seems_to_enclose(const SidePart& part) {
  if (!(part.volume_m3 > 0.0)) return false;
  return part.closed || (part.openness < 0.5 && part.volume_m3 > 0.003 * std::pow(part.area_m2, 1.5));
}

class Spaces {
 public:
  Spaces(FaceMesh& mesh, Warnings& warnings)
      : mesh_(mesh), warnings_(warnings), sides_(join_sides(mesh)), sight_(mesh) {
    space_.assign(sides_.parts.size(), kUndecided);
    for (std::uint32_t p = 0; p < sides_.parts.size(); ++p)
      if (seems_to_enclose(sides_.parts[p])) space_[p] = p;
    look_around();
    open_into_larger();
    follow_votes();
    find_rooms();
  }

  /// Keeps the room alone that the point lies in.
  void choose(const Vec3& inside) {
    std::map<std::uint32_t, int> votes;
    for (const std::uint32_t side : sight_.seen_from(inside, 4 * kRays))
      ++votes[side == SideSight::kNothing ? kOutside : space_of(side)];
    const auto most = std::max_element(votes.begin(), votes.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most->first == kOutside)
      throw InputError({{},
                        fmt::format("the point [{:g}, {:g}, {:g}] lies in no space that faces enclose",
                                    inside.x, inside.y, inside.z),
                        kInsideCure});
    rooms_ = {most->first};
  }

  std::vector<FaceUse> decide(ImportReport& report) {
    std::vector<FaceUse> facings;
    if (rooms_.empty())
      warnings_.push_back(
          {{},
           "the faces enclose no room: they stay as they are, lit from where their corners run "
           "counter-clockwise",
           "close the shell, or give --gap a larger size"});
    for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f) facings.push_back(decide(f, report));
    lay_sheets_on(facings, report);
    for (const std::uint32_t room : rooms_) report.rooms.push_back(figures(room, report.rooms.size()));
    return facings;
  }

 private:
  std::uint32_t space_of(std::uint32_t side) const { return space_[sides_.part_of[side]]; }
  bool is_room(std::uint32_t space) const {
    return std::find(rooms_.begin(), rooms_.end(), space) != rooms_.end();
  }

  /// What each part sees that does not surely enclose a space of its own.
  void look_around() {
    seen_.resize(sides_.parts.size());
    for (std::uint32_t p = 0; p < sides_.parts.size(); ++p) {
      if (space_[p] == p && sides_.parts[p].closed) continue;
      for (const std::uint32_t side : sight_.seen_from(sides_.parts[p], kRays)) {
        const std::uint32_t met = side == SideSight::kNothing ? kOutside : sides_.part_of[side];
        if (met != p) ++seen_[p][met];
      }
    }
  }

  /// An open drawer, or a room beyond a doorway, is a part of the larger space that it opens into.
  void open_into_larger() {
    for (std::uint32_t p = 0; p < sides_.parts.size(); ++p) {
      if (space_[p] != p || sides_.parts[p].closed) continue;
      for (const auto& [met, n] : seen_[p])
        if (met != kOutside && n > kRays / 50 && seems_to_enclose(sides_.parts[met]) &&
            sides_.parts[met].volume_m3 > sides_.parts[p].volume_m3)
          space_[p] = kUndecided;
    }
  }

  /// Gives each undecided part the space that most of what it sees belongs to, the surest first.
  void follow_votes() {
    for (bool sure = true; true;) {
      bool changed = false;
      for (std::uint32_t p = 0; p < sides_.parts.size(); ++p) {
        if (space_[p] != kUndecided) continue;
        std::map<std::uint32_t, int> votes;
        int n_decided = 0, n_all = 0;
        for (const auto& [met, n] : seen_[p]) {
          const std::uint32_t space = met == kOutside ? kOutside : space_[met];
          n_all += n;
          if (space == kUndecided) continue;
          n_decided += n;
          votes[space] += n;
        }
        if (votes.empty() || (sure && 2 * n_decided < n_all)) continue;
        space_[p] = std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) {
                      return a.second < b.second;
                    })->first;
        changed = true;
        if (!sure) break;
      }
      if (!changed && !sure) break;
      sure = changed;
    }
    std::replace(space_.begin(), space_.end(), kUndecided, kOutside);
  }

  /// Spaces but those inside bodies: most of what such a body shows outwards is seen from another space.
  void find_rooms() {
    for (std::uint32_t p = 0; p < sides_.parts.size(); ++p) {
      if (space_[p] != p) continue;
      double in_space_m2 = 0.0;
      for (const std::uint32_t side : sides_.parts[p].sides) {
        const std::uint32_t behind = sides_.part_of[side ^ 1u];
        if (space_[behind] != kOutside && space_[behind] != behind)
          in_space_m2 += area_m2(mesh_, mesh_.faces[side / 2]);
      }
      if (2.0 * in_space_m2 <= sides_.parts[p].area_m2) rooms_.push_back(p);
    }
  }

  FaceUse decide(std::uint32_t f, ImportReport& report) {
    MeshFace& face = mesh_.faces[f];
    if (face.lit != Lit::unknown) return stated_facing(face.lit);
    if (rooms_.empty()) return face.back_material >= 0 ? FaceUse::both : FaceUse::front;
    const std::uint32_t front = space_of(2 * f), back = space_of(2 * f + 1);
    if (is_room(front) && is_room(back)) return front == back ? FaceUse::both : FaceUse::two_spaces;
    if (is_room(front)) return FaceUse::front;
    if (is_room(back)) {
      turn(face, report);
      return FaceUse::front;
    }
    if (front != kOutside && back != kOutside) return FaceUse::hidden;
    if (front != kOutside) turn(face, report);
    return front == back && !sides_.parts[sides_.part_of[2 * f]].closed ? FaceUse::outside_sheet
                                                                        : FaceUse::outside;
  }

  static void turn(MeshFace& face, ImportReport& report) {
    // A face that the file had from both sides faced the right way, too.
    if (face.back_material < 0) ++report.n_turned;
    turn_round(face);
  }

  /// A sheet that lies on a wall, which says nothing by what it sees, is lit as the wall is.
  void lay_sheets_on(std::vector<FaceUse>& facings, ImportReport& report) {
    for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f) {
      MeshFace& face = mesh_.faces[f];
      const bool is_sheet = !sides_.parts[sides_.part_of[2 * f]].closed && facings[f] != FaceUse::front;
      if (!is_sheet || face.lit != Lit::unknown) continue;
      const auto under = sight_.lies_against(f);
      if (!under || facings[*under] != FaceUse::front) continue;
      facings[f] = FaceUse::front;
      if (glm::dot(newell(mesh_, face), newell(mesh_, mesh_.faces[*under])) < 0.0) turn(face, report);
    }
  }

  RoomFigures figures(std::uint32_t room, std::size_t number) const {
    RoomFigures room_figures;
    room_figures.name = fmt::format("space {}", number + 1);
    room_figures.closed = sides_.parts[room].closed;
    room_figures.volume_before_m3 = room_figures.volume_after_m3 = sides_.parts[room].volume_m3;
    for (std::uint32_t side = 0; side < sides_.part_of.size(); ++side) {
      if (space_of(side) != room) continue;
      ++room_figures.n_faces;
      room_figures.area_after_m2 += area_m2(mesh_, mesh_.faces[side / 2]);
    }
    room_figures.area_before_m2 = room_figures.area_after_m2;
    return room_figures;
  }

  FaceMesh& mesh_;
  Warnings& warnings_;
  SideParts sides_;
  SideSight sight_;
  std::vector<std::uint32_t> space_;                ///< [parts] the part that encloses the space it is in
  std::vector<std::map<std::uint32_t, int>> seen_;  ///< [parts] rays that met each part
  std::vector<std::uint32_t> rooms_;
};

/// The room that most of what is seen from the point belongs to.
std::string room_around(const FaceMesh& mesh, const Vec3& inside) {
  std::map<std::string, int> votes;
  for (const std::uint32_t side : SideSight(mesh).seen_from(inside, 4 * kRays))
    if (side != SideSight::kNothing && side % 2 == 0)
      ++votes[mesh.objects[static_cast<std::size_t>(mesh.faces[side / 2].object)].room];
  votes.erase("");
  if (votes.empty())
    throw InputError(
        {{},
         fmt::format("the point [{:g}, {:g}, {:g}] lies in no room", inside.x, inside.y, inside.z),
         kInsideCure});
  return std::max_element(votes.begin(), votes.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

/// Leaves out faces of other rooms.
void keep_room(const FaceMesh& mesh, const std::string& room, std::vector<FaceUse>& facings) {
  for (std::size_t f = 0; f < facings.size(); ++f) {
    const std::string& own = mesh.objects[static_cast<std::size_t>(mesh.faces[f].object)].room;
    if (!own.empty() && own != room) facings[f] = FaceUse::hidden;
  }
}

std::vector<FaceUse> as_stated(const FaceMesh& mesh) {
  std::vector<FaceUse> facings;
  for (const MeshFace& face : mesh.faces) facings.push_back(stated_facing(face.lit));
  return facings;
}

}  // namespace

std::vector<FaceUse> face_rooms(FaceMesh& mesh, const std::optional<Vec3>& inside, ImportReport& report,
                               Warnings& warnings) {
  const bool is_stated = std::none_of(mesh.faces.begin(), mesh.faces.end(),
                                      [](const MeshFace& face) { return face.lit == Lit::unknown; });
  if (is_stated) {
    auto facings = as_stated(mesh);
    if (inside) keep_room(mesh, room_around(mesh, *inside), facings);
    return facings;
  }
  Spaces spaces(mesh, warnings);
  if (inside) spaces.choose(*inside);
  return spaces.decide(report);
}

}  // namespace dim
