#include "image/plane_map.hpp"

#include <algorithm>
#include <cmath>

#include "image/chart_parts.hpp"
#include "image/colour_map.hpp"

namespace dim {
namespace {

constexpr double kLongest_px = 640.0, kMargin_px = 20.0, kTop_px = 44.0, kLegendGap_px = 26.0;
constexpr double kLeastLegend_px = 160.0;

/// The plane's points as pixels.
class Sheet {
 public:
  explicit Sheet(const Polygon& plane) : frame_(plane.frame()) {
    if (frame_.n.z > 0.999) {
      frame_.u = {1, 0, 0};
      frame_.v = {0, 1, 0};
    }
    Vec2 high(-1e300);
    low_ = Vec2(1e300);
    for (const auto& ring : plane.corners()) {
      for (const Vec3& corner : ring) {
        low_ = glm::min(low_, frame_.to_local(corner));
        high = glm::max(high, frame_.to_local(corner));
      }
    }
    const Vec2 size_m = high - low_;
    scale_ = kLongest_px / std::max(size_m.x, size_m.y);
    size_px_ = scale_ * size_m;
  }
  const Vec2& size_px() const { return size_px_; }
  Vec2 at(const Vec3& p) const {
    const Vec2 local = scale_ * (frame_.to_local(p) - low_);
    return {kMargin_px + local.x, kTop_px + size_px_.y - local.y};
  }

 private:
  Frame frame_;
  Vec2 low_{0.0}, size_px_{0.0};
  double scale_ = 1.0;
};

std::vector<Vec2> square_round(const PlaneMap& map, const Sheet& sheet, const Vec3& point) {
  const Frame& frame = map.plane.frame();
  const Vec3 u = 0.5 * map.plane.size_m().x / map.nu * frame.u, v = 0.5 * map.plane.size_m().y / map.nv * frame.v;
  return {sheet.at(point - u - v), sheet.at(point + u - v), sheet.at(point + u + v), sheet.at(point - u + v)};
}

}  // namespace

Drawing plane_map_drawing(const PlaneMap& map) {
  std::vector<float> known;
  for (const auto& [point, value] : map.values)
    if (std::isfinite(value)) known.push_back(static_cast<float>(value));
  const Scale scale = automatic_scale(ScaleKind::linear, known);
  const Sheet sheet(map.plane);
  const double legend_px = std::max(sheet.size_px().y, kLeastLegend_px);
  Drawing drawing;
  drawing.width = static_cast<int>(kMargin_px + sheet.size_px().x + kLegendGap_px + chart::kLegendWidth_px);
  drawing.height = static_cast<int>(kTop_px + legend_px + kMargin_px);
  drawing.title = map.title;
  drawing.texts.push_back({{kMargin_px, 18.0}, map.title, chart::kFont_px + 2, TextAnchor::start, chart::kWords});
  for (const auto& [point, value] : map.values)
    drawing.areas.push_back({square_round(map, sheet, point),
                             std::isfinite(value) ? colour_map(scale.position(value)) : kNoValueColour});
  for (const auto& ring : map.plane.corners()) {
    DrawnLine outline{{}, 1.0, chart::kWords, false};
    for (const Vec3& corner : ring) outline.points.push_back(sheet.at(corner));
    outline.points.push_back(outline.points.front());
    drawing.lines.push_back(std::move(outline));
  }
  chart::add_legend(drawing, scale, {kMargin_px + sheet.size_px().x + kLegendGap_px, kTop_px}, legend_px, map.unit);
  return drawing;
}

}  // namespace dim
