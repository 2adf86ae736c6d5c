#include <cmath>

#include "image/polar_diagram.hpp"
#include "report/packed.hpp"
#include "report/parts.hpp"

namespace dim {
namespace {

constexpr int kDiagram_px = 420;

Json vector(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

const char* shape_name(OpeningShape shape) {
  switch (shape) {
    case OpeningShape::kPoint: return "point";
    case OpeningShape::kLine: return "line";
    case OpeningShape::kRectangle: return "rectangle";
    case OpeningShape::kBox: return "box";
    case OpeningShape::kEllipse: return "ellipse";
    case OpeningShape::kVerticalCylinder: return "cylinder, upright";
    case OpeningShape::kEllipsoid: return "ellipsoid";
    case OpeningShape::kHorizontalCylinder: return "cylinder, level";
    case OpeningShape::kVerticalEllipse: return "ellipse, upright";
  }
  return "";
}

// Luminaires of one photometry, one factor and one opening are one line of the schedule.
struct ScheduleLine {
  std::size_t photometry = 0;
  double factor = 1.0;
  LuminousOpening opening;
  std::size_t count = 0;

  bool holds(const ShownLuminaire& l) const {
    return l.photometry == photometry && l.factor == factor && l.opening.shape == opening.shape &&
           l.opening.length_m == opening.length_m && l.opening.width_m == opening.width_m &&
           l.opening.height_m == opening.height_m;
  }
};

Json fitting_json(const LuminanceDatabase& database, const ScheduleLine& fitting) {
  const ShownPhotometry& light = database.photometry()[fitting.photometry];
  const std::string diagram = svg_text(polar_diagram(database.intensities()[fitting.photometry], light.name, kDiagram_px));
  return {{"name", light.name},
          {"count", fitting.count},
          {"flux_lm", light.flux_lm * fitting.factor},
          {"watts", light.watts > 0.0 ? Json(light.watts) : Json(nullptr)},
          {"shape", shape_name(fitting.opening.shape)},
          {"opening_m", {fitting.opening.length_m, fitting.opening.width_m, fitting.opening.height_m}},
          {"polar", "data:image/svg+xml;base64," + base64(std::as_bytes(std::span(diagram)))}};
}

}  // namespace

Json luminaires_part(const LuminanceDatabase& database) {
  std::vector<ScheduleLine> fittings;
  Json places = Json::array();
  for (const auto& luminaire : database.luminaires()) {
    std::size_t f = 0;
    while (f < fittings.size() && !fittings[f].holds(luminaire)) ++f;
    if (f == fittings.size()) fittings.push_back({luminaire.photometry, luminaire.factor, luminaire.opening, 0});
    ++fittings[f].count;
    places.push_back({{"name", luminaire.name},
                      {"group", database.sources()[luminaire.source].group},
                      {"fitting", f},
                      {"at", vector(luminaire.at + database.zone().origin_m)},
                      {"aim", vector(luminaire.aim)}});
  }
  Json schedule = Json::array();
  for (const auto& fitting : fittings) schedule.push_back(fitting_json(database, fitting));
  return {{"fittings", schedule}, {"places", places}};
}

}  // namespace dim
