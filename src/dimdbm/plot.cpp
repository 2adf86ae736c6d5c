#include <fmt/format.h>

#include <cmath>

#include "base/atomic_file.hpp"
#include "base/version.hpp"
#include "common/database_option.hpp"
#include "database/finish_figures.hpp"
#include "dimdbm/commands.hpp"
#include "image/colour_space.hpp"
#include "image/picture_module.hpp"
#include "image/polar_diagram.hpp"
#include "image/spectrum_diagram.hpp"
#include "image/writer.hpp"
#include "spectrum/named_spectra.hpp"
#include "spectrum/white.hpp"

namespace dim {
namespace {

std::string title_of(const FittingRecord& record) {
  return fmt::format("{}: {:.4g} lm, {:.4g} cd", record.entry.name, record.photometry.flux_lm,
                     record.photometry.max_cd);
}

Rgb8 display_colour(const Vec3& xyz) {
  const auto primaries = kSrgbPrimaries;
  const Vec3 rgb = bring_into_gamut(xyz_to_rgb(primaries) * xyz, luminance_weights(primaries)).rgb;
  Rgb8 colour{};
  for (int c = 0; c < 3; ++c)
    colour[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(std::lround(255.0 * srgb_encode(rgb[c])));
  return colour;
}

SpectralCurve reflectance_curve(const Finish& finish) {
  std::vector<std::pair<double, double>> points;
  for (double nm = 380.0; nm <= 780.0; nm += 1.0) points.emplace_back(nm, reflectance_at(finish, nm));
  return SpectralCurve(std::move(points));
}

Drawing drawing_of_light(const SpectrumEntry& spectrum) {
  const Vec3 xyz = white_xyz(spectrum.power);
  const double cct_K = white_point(xyz).cct_K, most = spectrum.power.max();
  auto points = spectrum.power.points();
  for (auto& [nm, power] : points) power /= most;
  return spectrum_diagram({{"power", SpectralCurve(std::move(points))}}, display_colour(xyz),
                          std::isnan(cct_K)
                              ? spectrum.name + ": relative power"
                              : fmt::format("{}: relative power, {:.0f} K", spectrum.name, cct_K));
}

Drawing drawing_of(const Found& found) {
  if (const auto* record = found.fitting())
    return polar_diagram(IntensityTable(record->photometry.distribution), title_of(*record));
  if (const auto* spectrum = found.spectrum()) return drawing_of_light(*spectrum);
  const Finish& finish = *found.finish();
  const Vec3 xyz = finish_xyz(finish, find_spectrum("d65"));
  const bool glazing = finish.kind == FinishKind::glazing;
  std::vector<NamedCurve> curves;
  if (glazing) curves.push_back({"transm.", finish.transmittance});
  curves.push_back({"reflect.", reflectance_curve(finish)});
  return spectrum_diagram(
      curves, display_colour(xyz),
      fmt::format("{}: {} {:.3f} (D65)", finish.name, glazing ? "transmittance" : "reflectance", xyz.y));
}

}  // namespace

PlotCommand::PlotCommand(Program& program) : program_(program) {
  plot_ = program.add_command("plot", "Polar curve of a fitting, spectrum of a surface or a lamp: SVG or PNG",
                              "  dimdbm plot troffer-3600 -o troffer.svg");
  plot_
      ->add_option("ENTRY|FILE", what_,
                   "Entry, spectrum by name, or an .ies, .ldt, .xml or entry's .toml file")
      ->required()
      ->type_name("");
  plot_
      ->add_option("-o,--output", output_,
                   "Picture; its ending says the format: svg, png; - for SVG on standard output")
      ->required()
      ->type_name("FILE");
  add_database_option(*plot_, db_);
  program.add_common_options(*plot_);
}

bool PlotCommand::run() {
  if (!plot_->parsed()) return false;
  const bool png = picture_format_of(output_) == PictureFormat::png;
  const bool svg =
      output_ == "-" || (output_.size() > 4 && (output_.ends_with(".svg") || output_.ends_with(".SVG")));
  if (!png && !svg) throw UsageError("-o '" + output_ + "': the name must end in .svg or .png");
  program_.check_output(output_, {what_});
  Warnings warnings;
  const Found found = find_entry_or_file(database_search(db_, "-"), what_, warnings);
  program_.check_output(output_, found.files());
  const Drawing drawing = drawing_of(found);
  program_.warn(warnings);
  program_.stage(kWritingStage);
  if (svg) {
    write_file(output_, svg_text(drawing));
    return true;
  }
  const PictureModule module(executable_folder() + "/../lib/dim");
  if (!module.available()) program_.warn({{{}, "no words on the picture: " + module.no_font_reason(), ""}});
  write_file(output_, module.png(rasterised(drawing, module), {"DIM " + version(), drawing.title, ""}));
  return true;
}

}  // namespace dim
