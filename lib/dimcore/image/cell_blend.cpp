#include "image/cell_blend.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "geometry/box_tree.hpp"
#include "geometry/segment.hpp"

namespace dim {
namespace {

bool crosses(const Segment2& s, const Segment2& t) {
  const Vec2 ds = s.b - s.a, dt = t.b - t.a;
  return (cross(ds, t.a - s.a) > 0.0) != (cross(ds, t.b - s.a) > 0.0) &&
         (cross(dt, s.a - t.a) > 0.0) != (cross(dt, s.b - t.a) > 0.0);
}

Box3 box_of(const Vec2& low, const Vec2& high) {
  Box3 box;
  box.add(Vec3(low, 0.0));
  box.add(Vec3(high, 0.0));
  return box;
}

Box3 box_of(const Segment2& s) { return box_of(glm::min(s.a, s.b), glm::max(s.a, s.b)); }

// Squares, polygons' edges and joints of the surfaces that are one plane of features and their parents.
struct Group {
  std::size_t root = 0;
  std::vector<std::size_t> members;
};

std::vector<Group> groups_of(const std::vector<Surface>& surfaces) {
  std::vector<std::size_t> root(surfaces.size());
  std::vector<Group> groups(surfaces.size());
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    root[s] = s;
    while (surfaces[root[s]].parent >= 0) root[s] = static_cast<std::size_t>(surfaces[root[s]].parent);
    groups[root[s]].root = root[s];
    groups[root[s]].members.push_back(s);
  }
  std::erase_if(groups, [](const Group& group) { return group.members.empty(); });
  return groups;
}

}  // namespace

class CellBlendBuilder {
 public:
  CellBlendBuilder(const Zone& zone, const Cells& cells, const std::vector<std::vector<Segment2>>& joints,
                   CellBlend& blend)
      : zone_(zone), cells_(cells), joints_(joints), blend_(blend), lists_(cells.size()) {}

  void build() {
    for (const auto& group : groups_of(zone_.surfaces)) {
      const std::size_t s = group.root;
      if (group.members.size() == 1 && cells_.grid(s).regular())
        blend_.regular_[s] = 1;
      else
        add(group);
    }
    blend_.first_.assign(cells_.size() + 1, 0);
    for (std::size_t c = 0; c < cells_.size(); ++c) blend_.first_[c + 1] = blend_.first_[c] + lists_[c].size();
    blend_.listed_.reserve(blend_.first_.back());
    for (const auto& list : lists_) blend_.listed_.insert(blend_.listed_.end(), list.begin(), list.end());
  }

 private:
  // What light does not blend across, and what lies beyond an edge.
  struct Plane {
    std::vector<Segment2> joints, edges;
    std::vector<std::size_t> members;
  };

  Vec2 square_m(std::size_t s) const {
    const CellGrid& grid = cells_.grid(s);
    return blend_.size_m_[s] / Vec2(grid.nu(), grid.nv());
  }

  void place(const Group& group) {
    const Frame& base = zone_.surfaces[group.root].polygon.frame();
    for (const std::size_t s : group.members) {
      const Frame& frame = zone_.surfaces[s].polygon.frame();
      const auto in_base = [&](const Vec3& d) { return Vec2(glm::dot(d, base.u), glm::dot(d, base.v)); };
      blend_.placing_[s] = {base.to_local(frame.origin), in_base(frame.u), in_base(frame.v)};
    }
  }

  void raise_tents(std::size_t s) {
    const auto& placing = blend_.placing_[s];
    const Vec2 square = square_m(s);
    const Vec2 half(std::abs(square.x * placing.u.x) + std::abs(square.y * placing.v.x),
                    std::abs(square.x * placing.u.y) + std::abs(square.y * placing.v.y));
    for (std::size_t c = cells_.first(s); c < cells_.first(s + 1); ++c) {
      const GridCell& cell = cells_[c];
      blend_.tents_[c] = {placing.of(cell.centroid), 1.0 / half, cell.area_m2 / (square.x * square.y)};
    }
  }

  Plane plane_of(const Group& group) const {
    Plane plane{{}, {}, group.members};
    for (const std::size_t s : group.members) {
      const auto& placing = blend_.placing_[s];
      for (const auto& joint : joints_[s]) plane.joints.push_back({placing.of(joint.a), placing.of(joint.b)});
      for (const auto& ring : zone_.surfaces[s].polygon.rings())
        for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
          plane.edges.push_back({placing.of(ring[j]), placing.of(ring[i])});
    }
    return plane;
  }

  void add(const Group& group) {
    place(group);
    std::vector<std::size_t> all;
    std::vector<Box3> tents;
    for (const std::size_t s : group.members) {
      raise_tents(s);
      for (std::size_t c = cells_.first(s); c < cells_.first(s + 1); ++c) {
        const auto& tent = blend_.tents_[c];
        all.push_back(c);
        tents.push_back(box_of(tent.middle - 1.0 / tent.per_m, tent.middle + 1.0 / tent.per_m));
      }
    }
    const Plane plane = plane_of(group);
    std::vector<Box3> joint_boxes, edge_boxes;
    for (const auto& joint : plane.joints) joint_boxes.push_back(box_of(joint));
    for (const auto& edge : plane.edges) edge_boxes.push_back(box_of(edge));
    const BoxTree tree(std::move(tents)), joints(std::move(joint_boxes)), edges(std::move(edge_boxes));
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, all.size(), 64), [&](const auto& range) {
      for (std::size_t k = range.begin(); k != range.end(); ++k) {
        const std::size_t c = all[k];
        tree.for_meeting(bounds(c), [&](std::size_t other) {
          if (c == all[other] || joined(c, all[other], plane, joints, edges))
            lists_[c].push_back(static_cast<std::uint32_t>(all[other]));
        });
        std::sort(lists_[c].begin(), lists_[c].end());
      }
    });
  }

  Box3 bounds(std::size_t c) const {
    const auto& placing = blend_.placing_[cells_.surface_of(c)];
    const GridCell& cell = cells_[c];
    Box3 box;
    for (const Vec2& p : {cell.low, cell.high, Vec2(cell.low.x, cell.high.y), Vec2(cell.high.x, cell.low.y)})
      box.add(Vec3(placing.of(p), 0.0));
    return box;
  }

  bool joined(std::size_t a, std::size_t b, const Plane& plane, const BoxTree& joints,
              const BoxTree& edges) const {
    const Segment2 way{blend_.tents_[a].middle, blend_.tents_[b].middle};
    bool free = true;
    joints.for_meeting(box_of(way), [&](std::size_t j) { free = free && !crosses(way, plane.joints[j]); });
    if (!free) return false;
    edges.for_meeting(box_of(way), [&](std::size_t e) {
      free = free && (!crosses(way, plane.edges[e]) || goes_on(way, plane.edges[e], plane));
    });
    return free;
  }

  // Whether there is surface on both sides of an edge where the way crosses it: that of a feature and its parent.
  bool goes_on(const Segment2& way, const Segment2& edge, const Plane& plane) const {
    constexpr double kStep = 1e-3;  // of the way
    const Vec2 d = way.b - way.a, e = edge.b - edge.a;
    const double t = cross(edge.a - way.a, e) / cross(d, e);
    return on_surface(way.a + (t - kStep) * d, plane) && on_surface(way.a + (t + kStep) * d, plane);
  }

  bool on_surface(const Vec2& p, const Plane& plane) const {
    return std::any_of(plane.members.begin(), plane.members.end(), [&](std::size_t s) {
      const auto& placing = blend_.placing_[s];
      const Vec2 d = p - placing.origin, local(glm::dot(d, placing.u), glm::dot(d, placing.v));
      const Vec2 size = blend_.size_m_[s];
      return local.x >= 0.0 && local.y >= 0.0 && local.x <= size.x && local.y <= size.y &&
             zone_.surfaces[s].polygon.contains(local);
    });
  }

  const Zone& zone_;
  const Cells& cells_;
  const std::vector<std::vector<Segment2>>& joints_;
  CellBlend& blend_;
  std::vector<std::vector<std::uint32_t>> lists_;
};

CellBlend::CellBlend(const Zone& zone, const Cells& cells, const std::vector<std::vector<Segment2>>& joints)
    : cells_(cells),
      regular_(zone.surfaces.size(), 0),
      placing_(zone.surfaces.size()),
      tents_(cells.size()) {
  for (const auto& surface : zone.surfaces) size_m_.push_back(surface.polygon.size_m());
  CellBlendBuilder(zone, cells, joints, *this).build();
}

}  // namespace dim
