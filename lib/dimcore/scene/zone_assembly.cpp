#include "scene/zone_assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "geometry/area_sampler.hpp"
#include "scene/inside_test.hpp"
#include "scene/openings.hpp"
#include "scene/outline_check.hpp"
#include "scene/placement_check.hpp"
#include "scene/surface_overlap.hpp"
#include "scene/zone_shell.hpp"

namespace dim {
namespace {

struct Bounds {
  Vec3 low{std::numeric_limits<double>::max()};
  Vec3 high{std::numeric_limits<double>::lowest()};
};

Bounds bounds_of(const std::vector<FaceSource>& faces) {
  Bounds bounds;
  for (const auto& face : faces) {
    for (const auto& p : face.outline) {
      bounds.low = glm::min(bounds.low, p);
      bounds.high = glm::max(bounds.high, p);
    }
  }
  return bounds;
}

std::vector<std::string> keys(const std::map<std::string, int>& map) {
  std::vector<std::string> result;
  for (const auto& [key, value] : map) result.push_back(key);
  return result;
}

class ZoneAssembly {
 public:
  ZoneAssembly(const ZoneParts& parts, Problems& problems, Warnings& warnings)
      : parts_(parts), problems_(problems), warnings_(warnings) {
    zone_.name = parts.name;
    zone_.finishes = parts.finishes;
    frame_.unit_m = zone_.unit_m = parts.unit_m;
  }

  Zone assemble(const AddReceivers& add_receivers) {
    const auto& faces = parts_.faces;
    place_zone(faces);
    const double cell_m = parts_.cell_m > 0.0 ? parts_.cell_m : std::min(kDefaultCell_m, zone_.diameter_m / 20.0);
    check_parents(faces);
    for (const auto& face : faces) add_surface(face, cell_m);
    add_receivers(frame_, cell_m, zone_);
    problems_.throw_if_any();
    shape_zone();
    problems_.throw_if_any();
    return std::move(zone_);
  }

 private:
  void place_zone(const std::vector<FaceSource>& faces) {
    if (faces.empty()) return;
    const Bounds bounds = bounds_of(faces);
    if (bounds.low.x > bounds.high.x) return;  // nothing but empty outlines, reported one by one
    frame_.centre = bounds.low + (bounds.high - bounds.low) / 2.0;
    zone_.origin_m = frame_.centre * frame_.unit_m;
    zone_.diameter_m = glm::length((bounds.high - bounds.low) * frame_.unit_m);
  }

  void check_parents(const std::vector<FaceSource>& faces) {
    std::map<std::string, int> names;
    for (const auto& face : faces) {
      names.emplace(face.name, 0);
      if (face.two_sided) names.emplace(face.name + ".back", 0);
    }
    for (const auto& face : faces) {
      if (!face.on.empty() && !names.contains(face.on))
        problems_.add(face.on_place,
                      fmt::format("surface '{}': no surface '{}' to lie on", face.name, face.on),
                      did_you_mean(face.on, keys(names)));
    }
    // Features of box faces, and their own; parents may follow.
    for (const auto& face : faces)
      if (face.of_box) of_boxes_.insert(face.name);
    for (bool more = true; more;) {
      more = false;
      for (const auto& face : faces)
        more = (of_boxes_.contains(face.on) && of_boxes_.insert(face.name).second) || more;
    }
  }

  int finish_of(const FaceSource& face) { return finish_of(face, face.finish, face.finish_place); }

  int finish_of(const FaceSource& face, const std::string& name, const Place& place) {
    if (finish_index_.empty()) {
      for (std::size_t i = 0; i < zone_.finishes.size(); ++i)
        finish_index_.emplace(zone_.finishes[i].name, static_cast<int>(i));
    }
    const auto found = finish_index_.find(name);
    if (found != finish_index_.end()) return found->second;
    // The six faces of a box share one place.
    if (!reported_finishes_.emplace(place.line, place.column).second) return -1;
    auto cure = did_you_mean(name, keys(finish_index_));
    if (cure.empty()) cure = fmt::format("write it in [finishes]: {} = 0.5", name);
    problems_.add(place, fmt::format("surface '{}': no finish '{}'", face.name, name), cure);
    return -1;
  }

  void add_surface(const FaceSource& face, double cell_m) {
    const int finish = finish_of(face);
    Ring3 outline = face.outline;
    auto holes = face.holes;
    for (auto& p : outline) p = frame_.to_zone(p);
    for (auto& hole : holes)
      for (auto& p : hole) p = frame_.to_zone(p);
    if (!check_outline(outline, holes, fmt::format("surface '{}'", face.name), face.vertices_place,
                       problems_) ||
        finish < 0)
      return;
    Surface surface;
    surface.name = face.name;
    surface.polygon = Polygon(outline, holes);
    surface.finish = finish;
    surface.cell_m = face.cell ? *face.cell * frame_.unit_m : cell_m;
    surface.grid = face.grid;
    surface.outside = face.outside;
    surface.bounding = !face.of_box && !face.two_sided && !face.outside;
    surface.place = face.vertices_place;
    set_window(face, surface);
    planarity_m_ = std::max(planarity_m_, planarity_error_m(outline));
    links_.push_back({face.on, face.on_place, face.of_box});
    zone_.surfaces.push_back(std::move(surface));
    if (face.two_sided) add_back();
  }

  // What a glazed surface has beyond others; both belong to nothing else.
  void set_window(const FaceSource& face, Surface& surface) {
    const auto glazed = [&](int finish) {
      return zone_.finishes[static_cast<std::size_t>(finish)].kind == FinishKind::glazing;
    };
    if (!glazed(surface.finish)) {
      if (!face.group.empty() || !face.states.empty())
        problems_.add(face.finish_place,
                      fmt::format("surface '{}' has a window's group or states, but its finish '{}' is no glazing",
                                  face.name, face.finish),
                      "take a finish of kind = \"glazing\"");
      return;
    }
    if (of_boxes_.contains(face.name) || face.two_sided)
      problems_.add(face.finish_place,
                    fmt::format("surface '{}' is glazed, but not part of the zone's shell: glass inside a zone is "
                                "not modelled",
                                face.name),
                    "model one zone on each side, or leave the glass out");
    if (face.outside) return;
    surface.group = face.group.empty() ? face.name : face.group;
    for (const auto& state : face.states) {
      const int finish = finish_of(face, state.finish, state.place);
      if (finish < 0) continue;
      if (!glazed(finish))
        problems_.add(state.place,
                      fmt::format("surface '{}': state '{}' has the finish '{}', which is no glazing", face.name,
                                  state.name, state.finish),
                      "a drawn blind is a glazing too, by what glass and blind let pass");
      surface.states.push_back({state.name, finish});
    }
  }

  void refuse_inner(const Surface& surface) {
    problems_.add(surface.place,
                  fmt::format("surface '{}' is glazed and has the zone on both sides: glass inside a zone is not "
                              "modelled",
                              surface.name),
                  "model one zone on each side, or leave the glass out");
  }

  // Glass behind whose outer face the zone goes on. Surfaces are whole still, so that rays meet all of the shell.
  void refuse_inner_windows() {
    const InsideTest inside(zone_.surfaces, zone_.diameter_m, zone_.closed);
    const double step_m = 1e-5 * zone_.diameter_m;
    for (const auto& surface : zone_.surfaces) {
      if (!zone_.closed || !is_window(zone_, surface)) continue;
      const Polygon& polygon = surface.polygon;
      const Vec3 on_glass = polygon.frame().to_world(AreaSampler(polygon.rings()).point(0.5, 0.5));
      if (!inside.outside(on_glass - step_m * polygon.normal())) refuse_inner(surface);
    }
  }

  // Two [[surface]] back to back are known as a partition once contacts are found.
  void refuse_windows_in_partitions() {
    for (const auto& surface : zone_.surfaces)
      if (surface.twin >= 0 && is_window(zone_, surface)) refuse_inner(surface);
    problems_.throw_if_any();
  }

  void add_back() {
    Surface back = zone_.surfaces.back();
    const int front = static_cast<int>(zone_.surfaces.size()) - 1;
    back.name += ".back";
    back.polygon = back.polygon.reversed();
    back.twin = front;
    zone_.surfaces.back().twin = front + 1;
    links_.push_back({"", {}, false});
    zone_.surfaces.push_back(std::move(back));
  }

  // What needs every surface: cutting, overlaps, closedness. Only reached when each is sound by itself.
  void shape_zone() {
    const double touch_m = touch_tolerance_m(zone_.surfaces);
    join_features(zone_.surfaces, links_, touch_m, problems_);
    problems_.throw_if_any();
    auto cut = zone_.surfaces;
    cut_features(cut, touch_m);
    const auto overlaps = find_overlaps(zone_.surfaces, cut, links_, touch_m, warnings_);
    cut_overlaps(cut, zone_.surfaces, overlaps, touch_m);
    const auto cuts = check_whole(overlaps, touch_m);
    problems_.throw_if_any();
    cut_at_shell(cut, links_, cuts, touch_m);
    zone_.surfaces = std::move(cut);
    remove_contacts(zone_.surfaces, links_, touch_m, warnings_);
    refuse_windows_in_partitions();
  }

  // Closedness and volume, size, and what stands where; features are still part of their parents.
  std::vector<ShellCut> check_whole(const std::vector<SurfaceOverlap>& overlaps, double touch_m) {
    auto whole = zone_.surfaces;
    cut_overlaps(whole, zone_.surfaces, of_bounding(overlaps, zone_.surfaces), touch_m);
    const double meet_m = std::max(touch_m, 2.0 * planarity_m_);
    const auto shell = check_shell(whole, frame_, meet_m, problems_, warnings_);
    zone_.volume_m3 = shell.volume_m3;
    zone_.closed = shell.closed;
    if (!shell.closed) zone_.openings = find_openings(whole, shell.leaking, meet_m);
    warn_of_size(zone_, parts_.unit_place, warnings_);
    auto cuts = warn_of_placement(zone_, links_, parts_.eyes, frame_, touch_m, warnings_);
    refuse_inner_windows();
    return cuts;
  }

  const ZoneParts& parts_;
  Problems& problems_;
  Warnings& warnings_;
  ZoneFrame frame_;
  double planarity_m_ = 0.0;
  std::map<std::string, int> finish_index_;
  std::set<std::pair<int, int>> reported_finishes_;
  std::vector<SurfaceLink> links_;
  std::set<std::string> of_boxes_;  // faces of boxes and what lies on them
  Zone zone_;
};

}  // namespace

Zone assemble_zone(const ZoneParts& parts, const AddReceivers& add_receivers, Problems& problems,
                   Warnings& warnings) {
  return ZoneAssembly(parts, problems, warnings).assemble(add_receivers);
}

}  // namespace dim
