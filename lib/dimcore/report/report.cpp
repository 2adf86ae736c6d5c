#include "report/report.hpp"

#include "base/version.hpp"
#include "base/xml_text.hpp"
#include "image/colour_map.hpp"
#include "report/page_files.hpp"
#include "report/parts.hpp"

namespace dim {
namespace {

// Maintained over new light of each source.
std::vector<double> kept_shares(const LuminanceDatabase& database, const std::optional<Requirements>& requirements) {
  const Mix all(database.sources().size(), 1.0);
  return requirements ? maintained_mix(database, *requirements, all) : all;
}

// JSON that can stand in a script element: nothing in it ends the element.
std::string in_script(const Json& json) {
  std::string result;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<')
      result += "\\u003c";
    else
      result += c;
  }
  return result;
}

void put(std::string& page, const std::string& mark, std::string_view text) {
  page.replace(page.find(mark), mark.size(), text);
}

Json colour_scale() {
  Json colours = Json::array();
  constexpr int kSteps = 255;
  for (int i = 0; i <= kSteps; ++i) {
    const Rgb8 rgb = colour_map(static_cast<double>(i) / kSteps);
    colours.push_back({rgb[0], rgb[1], rgb[2]});
  }
  return colours;
}

Json inputs_part(const LuminanceDatabase& database, const ReportOptions& options) {
  return {{"program", "DIM " + version()},
          {"file", options.file},
          {"hash", database.hash()},
          {"rays_hash", database.rays_hash()},
          {"requirements", options.requirements_file},
          {"surfaces", database.zone().surfaces.size()},
          {"cells", database.n_cells()},
          {"points", database.zone().points.size()},
          {"bands", database.bands().size()},
          {"volume_m3", database.zone().closed ? Json(database.zone().volume_m3) : Json(nullptr)}};
}

}  // namespace

std::string report_page(const LuminanceDatabase& database, const ReportOptions& options, const Job& job) {
  const auto groups = light_groups(database, options.mix, kept_shares(database, options.requirements));
  const std::string title = database.zone().name.empty() ? "Room" : database.zone().name;
  const Json data = {{"title", title},
                     {"inputs", inputs_part(database, options)},
                     {"colours", colour_scale()},
                     {"groups", groups_part(database, groups)},
                     {"targets", targets_part(database, groups, options.requirements, job)},
                     {"requirements", requirements_part(database, options, job)},
                     {"luminaires", luminaires_part(database)},
                     {"glare", glare_part(database, groups, options.requirements, job)},
                     {"energy", energy_part(database, groups)},
                     {"pictures", pictures_part(database, groups, options, job)}};
  std::string page(page_file("report.html"));
  std::string script;
  for (const char* file : {"unpack.js", "colour.js", "field.js", "plan.js", "judge.js", "tables.js", "report.js"})
    script += page_file(file);
  // What comes from the user last, so that no mark is looked for in it.
  put(page, "@STYLE@", page_file("report.css"));
  put(page, "@SCRIPT@", script);
  put(page, "@DATA@", in_script(data));
  put(page, "@TITLE@", xml_text(title));
  return page;
}

}  // namespace dim
