#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "geometry/area_sampler.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/ray_caster.hpp"
#include "import/face_mesh.hpp"
#include "import/face_sides.hpp"

namespace dim {

/// What sides of faces see, by rays.
class SideSight {
 public:
  /// @param mesh  must outlive this
  explicit SideSight(const FaceMesh& mesh);

  static constexpr std::uint32_t kNothing = 0xffffffffu;

  /// For rays from points spread over the sides of a part (cosine-weighted directions): the side that each
  /// meets, or kNothing. Points where another face lies against the one they are on are left out.
  std::vector<std::uint32_t> seen_from(const SidePart& part, int n_rays) const;

  /// The same from a point in space, in all directions.
  std::vector<std::uint32_t> seen_from(const Vec3& point, int n_rays) const;

  /// A face that lies against most of `face`, and is not `face`; nothing where there is none.
  std::optional<std::uint32_t> lies_against(std::uint32_t face) const;

 private:
  std::uint32_t side_met(const Vec3& from, const Vec3& direction, int skip) const;
  std::optional<std::uint32_t> face_at(const Vec3& point, std::uint32_t but) const;

  Vec3 origin_{0.0};
  double tolerance_m_;
  std::deque<Polygon> polygons_;
  std::vector<AreaSampler> samplers_;
  std::optional<BoxTree> tree_;
  std::optional<RayCaster> caster_;
};

}  // namespace dim
