#include "import/import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "geometry/box_tree.hpp"
#include "import/dae.hpp"
#include "import/esp_geometry.hpp"
#include "import/flat_faces.hpp"
#include "import/gbxml.hpp"
#include "import/gltf.hpp"
#include "import/hbjson.hpp"
#include "import/obj.hpp"
#include "import/outline_mending.hpp"
#include "import/placing.hpp"
#include "import/ply.hpp"
#include "import/radiance.hpp"
#include "import/room_figures.hpp"
#include "import/spaces.hpp"
#include "import/stl.hpp"
#include "import/welding.hpp"
#include "import/zone_numbers.hpp"
#include "import/zone_writer.hpp"
#include "scene/face_source.hpp"

namespace dim {
namespace {

struct Format {
  const char* name;
  std::vector<const char*> endings;
  ImportedModel (*read)(const ImportInput&);
};

const std::vector<Format>& formats() {
  static const std::vector<Format> all = {
      {"obj", {".obj"}, read_obj},           {"ply", {".ply"}, read_ply},
      {"stl", {".stl"}, read_stl},           {"gltf", {".gltf", ".glb"}, read_gltf},
      {"dae", {".dae"}, read_dae},           {"radiance", {".rad"}, read_radiance},
      {"hbjson", {".hbjson"}, read_hbjson},  {"gbxml", {".gbxml", ".xml"}, read_gbxml},
      {"esp-r", {".geo"}, read_esp_geometry}};
  return all;
}

std::string in_small_letters(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

double size_of(const ImportedModel& model) {
  Box3 box;
  for (const ImportedFace& face : model.faces)
    for (const Vec3& p : face.outline) box.add(p);
  return glm::length(box.high - box.low);
}

std::string conventions(const ImportedModel& model, const ImportOptions& options, double unit_m,
                        double gap_m) {
  const bool unit_said = options.unit_m || model.unit_m;
  const UpAxis up = options.up.value_or(model.up);
  const bool up_said = options.up || model.up_stated;
  return fmt::format("{}, unit {:g} m{}, {} up{}, gaps up to {:.3g} mm closed", model.format, unit_m,
                     unit_said ? "" : " (assumed: --unit)", up == UpAxis::y ? "y" : "z",
                     up_said ? "" : " (assumed: --up)", gap_m * 1000.0);
}

void clean(FaceMesh& mesh, ImportReport& report) {
  join_doubles(mesh, report);
  split_bent_faces(mesh, report);
  node_edges(mesh);
  merge_flat_faces(mesh, report);
  mend_outlines(mesh, report);
  join_doubles(mesh, report);
}

}  // namespace

const std::vector<std::string>& import_formats() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Format& format : formats()) all.emplace_back(format.name);
    return all;
  }();
  return names;
}

std::string import_format_of(const std::string& path) {
  const std::string small = in_small_letters(path);
  for (const Format& format : formats())
    for (const char* ending : format.endings)
      if (small.ends_with(ending)) return format.name;
  return "";
}

double default_gap_m(double size_m) { return std::min(1e-4, 1e-5 * size_m); }

ImportResult import_file(const ImportInput& input, const std::string& format, const ImportOptions& options) {
  const auto known = std::find_if(formats().begin(), formats().end(),
                                  [&](const Format& candidate) { return candidate.name == format; });
  ImportedModel model = known->read(input);
  if (model.faces.empty()) throw InputError({input.place(0), "no face in it that could be read", ""});
  ImportResult result;
  result.warnings = std::move(model.warnings);
  const double unit_m = options.unit_m.value_or(model.unit_m.value_or(1.0));
  if (options.unit_m && model.unit_m && *options.unit_m != *model.unit_m)
    result.warnings.push_back({{},
                               fmt::format("--unit: {:g} m in place of the {:g} m that the file states",
                                           *options.unit_m, *model.unit_m),
                               ""});
  place_model(model, options.unit_m, options.up);
  warn_of_improbable_size(model, unit_m, result.warnings);

  const double size_m = size_of(model), gap_m = options.gap_m.value_or(default_gap_m(size_m));
  if (!(size_m > 0.0) || gap_m < 1e-9 * size_m || gap_m > 0.01 * size_m)
    throw InputError(
        {input.place(0),
         fmt::format("gaps of up to {:g} m cannot be closed in a model of {:g} m", gap_m, size_m),
         "give --gap a length between 1e-9 and 0.01 of the model's size"});
  result.conventions = conventions(model, options, unit_m, gap_m);
  ImportReport& report = result.report;
  count_read(model, report);
  input.job.check();
  FaceMesh mesh = weld(model.faces, size_m, gap_m, report);
  model.faces.clear();
  clean(mesh, report);
  input.job.check();
  if (mesh.faces.size() > kMaxSurfaces)
    throw LimitError(fmt::format("{}: {} faces are left when those in one plane are merged; a zone has at most {}\n        "
                                 "import a part of the model, or one with fewer details",
                                 input.name, mesh.faces.size(), kMaxSurfaces));
  const auto facings = face_rooms(mesh, options.inside, report, result.warnings);
  count_rooms_after(mesh, facings, report);
  straighten_edges(mesh);
  const ZoneHeading heading = {options.zone_name, fmt::format("{} ({})", input.name, model.format)};
  result.zone = zone_text(model, mesh, facings, heading, report, result.warnings);
  if (!model.luminaires.empty()) result.lights = lights_text(model, heading);
  result.files = std::move(model.files);
  return result;
}

namespace {

void line_if(std::vector<std::string>& lines, std::size_t n, const std::string& what) {
  if (n > 0) lines.push_back(fmt::format("{} {}", n, what));
}

}  // namespace

std::vector<std::string> summary_lines(const ImportReport& report) {
  std::vector<std::string> lines = {
      fmt::format("{} faces of {:.6g} m2 read, {} surfaces of {:.6g} m2 written", report.n_read,
                  report.area_read_m2, report.n_written, report.area_written_m2)};
  line_if(lines, report.n_degenerate, "faces without area dropped");
  line_if(lines, report.n_copies, "faces dropped that were there already");
  line_if(lines, report.n_pairs, "pairs of faces back to back made one each");
  line_if(lines, report.n_split, "faces that were not flat cut into triangles");
  line_if(lines, report.n_mended, "faces whose outline or holes crossed or touched clipped");
  line_if(lines, report.n_merged, "faces merged into larger ones in their plane");
  line_if(lines, report.n_turned, "surfaces turned round to face the room they bound");
  line_if(lines, report.n_outside, "surfaces are seen from outside only: external obstructions");
  if (!report.hidden.empty())
    lines.push_back(fmt::format("{} faces inside bodies or other rooms left out: {}", report.hidden.size(),
                                list_of(report.hidden)));
  lines.insert(lines.end(), report.changes.begin(), report.changes.end());
  for (const RoomFigures& room : report.rooms)
    lines.push_back(
        fmt::format("{}: {} surfaces, {:.6g} m2 before, {:.6g} m2 after; {:.6g} m3 before, {:.6g} m3 after{}",
                    room.name, room.n_faces, room.area_before_m2, room.area_after_m2, room.volume_before_m3,
                    room.volume_after_m3, room.closed ? "" : "; not closed"));
  return lines;
}

}  // namespace dim
