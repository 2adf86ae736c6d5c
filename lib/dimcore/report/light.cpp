#include <algorithm>
#include <cmath>

#include "image/render.hpp"
#include "report/packed.hpp"
#include "report/parts.hpp"
#include "result/point_error.hpp"

namespace dim {
namespace {

Json vector(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

// The views, smaller where all of them for all groups would make the page too large to send.
View fitted(View view, double share) {
  const double scale = std::min(1.0, std::sqrt(share / (static_cast<double>(view.width) * view.height)));
  view.width = std::max(1, static_cast<int>(view.width * scale));
  view.height = std::max(1, static_cast<int>(view.height * scale));
  return view;
}

Json picture_json(const PackedPicture& p) {
  Json part = {{"greatest", p.greatest_cd_m2}, {"luminance", p.luminance}, {"xy", {p.x, p.y}}};
  if (!p.one_colour) part["x"] = p.x_codes, part["y"] = p.y_codes;
  return part;
}

}  // namespace

Json groups_part(const LuminanceDatabase& database, const std::vector<LightGroup>& groups) {
  Json list = Json::array();
  for (const auto& group : groups) {
    double flux_lm = 0.0, error_lm = 0.0, watts = 0.0;
    Vec3 xyz(0.0);
    std::size_t n = 0;
    for (std::size_t s = 0; s < group.full.size(); ++s) {
      const double lm = group.full[s] * database.sources()[s].flux_lm;
      flux_lm += lm;
      error_lm += lm * stated_error(database, only(Mix(group.full.size(), 1.0), s));
      xyz += lm * source_xyz(database.sources()[s]);
    }
    const auto surfaces = surface_light(database, group.full).value_or(SurfaceLight{flux_lm, error_lm});
    for (const auto& luminaire : database.luminaires()) {
      if (group.daylight || group.full[luminaire.source] == 0.0) continue;
      const double its = database.photometry()[luminaire.photometry].watts;
      watts += its > 0.0 ? its : std::nan("");
      ++n;
    }
    list.push_back({{"name", group.name},
                    {"start", group.start},
                    {"kept", group.kept},
                    {"daylight", group.daylight},
                    {"luminaires", n},
                    {"flux_lm", flux_lm},
                    {"error_lm", error_lm},
                    {"surfaces_lm", surfaces.lm},
                    {"surfaces_error_lm", surfaces.error_lm},
                    {"watts", std::isnan(watts) ? Json(nullptr) : Json(watts)},
                    {"xyz", vector(xyz)}});
  }
  return list;
}

Json energy_part(const LuminanceDatabase& database, const std::vector<LightGroup>& groups) {
  Json list = Json::array();
  for (const auto& group : groups) {
    EnergyBalance sum;
    double open_W = 0.0;
    for (std::size_t s = 0; s < group.full.size(); ++s) {
      for (const auto& band : database.sources()[s].energy) {
        sum.emitted_W += group.full[s] * band.emitted_W;
        sum.absorbed_W += group.full[s] * band.absorbed_W;
        sum.escaped_W += group.full[s] * band.escaped_W;
        sum.lost_W += group.full[s] * band.lost_W;
        sum.dropped_W += group.full[s] * band.dropped_W;
        open_W += group.full[s] * band.imbalance * band.emitted_W;
      }
    }
    list.push_back({{"emitted_W", sum.emitted_W},
                    {"absorbed_W", sum.absorbed_W},
                    {"escaped_W", sum.escaped_W},
                    {"lost_W", sum.lost_W},
                    {"dropped_W", sum.dropped_W},
                    {"open_W", open_W}});
  }
  return list;
}

Json pictures_part(const LuminanceDatabase& database, const std::vector<LightGroup>& groups,
                   const ReportOptions& options, const Job& job) {
  Json list = Json::array();
  const auto& views = database.zone().views;
  const double share = kMostGroupPixels / std::max<double>(1.0, static_cast<double>(views.size() * groups.size()));
  for (const auto& view : views) {
    RenderOptions render;
    render.view = fitted(view, share);
    render.shading = options.shading;
    Json part = {{"name", view.name}, {"width", render.view.width}, {"height", render.view.height},
                 {"groups", Json::array()}};
    for (const auto& group : groups)
      part["groups"].push_back(
          picture_json(packed_picture(render_view(database, database.cells(), group.full, render, job))));
    list.push_back(std::move(part));
  }
  return list;
}

}  // namespace dim
