#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <future>

#include "base/version.hpp"
#include "common/in_file.hpp"
#include "common/option_checks.hpp"
#include "dimout/commands.hpp"
#include "image/picture_module.hpp"
#include "image/radiance_view.hpp"
#include "image/render.hpp"
#include "image/writer.hpp"

namespace dim {
namespace {

std::pair<int, int> parse_size(const std::string& text) {
  int width = 0, height = 0;
  const auto cross = text.find('x');
  const char *begin = text.data(), *end = begin + text.size();
  if (cross == std::string::npos || std::from_chars(begin, begin + cross, width).ptr != begin + cross ||
      std::from_chars(begin + cross + 1, end, height).ptr != end || width < 1 || height < 1 ||
      width > kMaxPictureSide || height > kMaxPictureSide)
    throw UsageError(fmt::format("--size '{}' is not WIDTHxHEIGHT within 1..{}", text, kMaxPictureSide));
  return {width, height};
}

// LOW:HIGH, either may be left out.
void parse_range(const std::string& text, FalseColourOptions& options) {
  if (text.empty()) return;
  const auto colon = text.find(':');
  const auto number = [&](const std::string& part) -> std::optional<double> {
    if (part.empty()) return {};
    char* end = nullptr;
    const double value = std::strtod(part.c_str(), &end);
    if (*end != '\0' || !std::isfinite(value)) throw UsageError("--range '" + text + "' is not LOW:HIGH");
    return value;
  };
  if (colon == std::string::npos) throw UsageError("--range '" + text + "' is not LOW:HIGH");
  options.low = number(text.substr(0, colon));
  options.high = number(text.substr(colon + 1));
}

std::string tone_words(const PictureOptions& picture, const PictureReport& report) {
  const std::string exposure =
      picture.tone == Tone::stevens
          ? fmt::format("eye adapted to {:.4g} cd/m2, screen of {:.4g} cd/m2", report.scene_adaptation_cd_m2,
                        picture.stevens.screen_white_cd_m2)
          : fmt::format("{:.4g} cd/m2 shown as white{}", report.display_white_cd_m2,
                        report.automatic_exposure ? " (automatic, highlights rolled off)" : "");
  return fmt::format("{} x {}, {}; {} pixels brighter, {} outside the display's colours", report.width,
                     report.height, exposure, report.n_above_white, report.n_out_of_gamut);
}

bool is_black(const Raster& raster) {
  return std::none_of(raster.xyz.begin(), raster.xyz.end(), [](float value) { return value > 0.0F; });
}

}  // namespace

ImageCommand::ImageCommand(Program& program) : program_(program) {
  image_ = add_command(program, input_, "image", "Picture of a view: PNG, Radiance HDR or OpenEXR",
                       "dimout image office.lum --view door -o door.png\n"
                       "  dimout image office.lum --view plan --tone falsecolour --range 0:1000 -o lux.png");
  auto& app = *image_;
  app.add_option("-o,--output", input_.output,
                 "Picture to write; the name's ending says the format: png, hdr, exr")
      ->required()
      ->type_name("FILE");
  app.add_option("--view", view_, "View of the zone file; its first one unless said")->type_name("NAME");
  app.add_option("--size", size_, "Picture size in pixels in place of the view's")->type_name("WxH");
  app.add_option("--samples", samples_, "Rays through each pixel: N x N")->check(CLI::Range(1, 16));
  app.add_option(
         "--shade", shade_,
         "cell: flat cells; smooth: interpolated within each surface; gather: direct light at every pixel")
      ->check(CLI::IsMember({"cell", "smooth", "gather"}));
  app.add_option(
         "--tone", tone_,
         "linear: display luminance in proportion; stevens: as bright on the screen as the scene looks; "
         "falsecolour: figures with a legend")
      ->check(CLI::IsMember({"linear", "stevens", "falsecolour"}));
  app.add_option("--white", white_cd_m2_, "Luminance shown as white, cd/m2; 0: found from the picture")
      ->check(number_within(0.0, HUGE_VAL))
      ->type_name("CD_M2")
      ->group("Linear tone");
  app.add_option("--screen-white", screen_white_cd_m2_, "Luminance of the screen's own white, cd/m2")
      ->check(number_within(0.0, HUGE_VAL, true))
      ->type_name("CD_M2")
      ->group("Stevens tone");
  app.add_flag("--spectral", spectral_, "Also the spectral radiance in each waveband, channels S0.*")
      ->group("OpenEXR");
  app.add_option("--quantity", quantity_, "What false colour shows")
      ->check(CLI::IsMember({"illuminance", "luminance"}))
      ->group("False colour");
  app.add_option("--range", range_, "Ends of the scale; either may be left out")
      ->type_name("LOW:HIGH")
      ->group("False colour");
  app.add_flag("--log", logarithmic_, "Logarithmic scale")->group("False colour");
}

bool ImageCommand::run() {
  if (!image_->parsed()) return false;
  render();
  return true;
}

View ImageCommand::chosen_view(const Zone& zone) const {
  View view = in_file(input_.path, [&] { return find_view(zone, view_); });
  if (!size_.empty()) std::tie(view.width, view.height) = parse_size(size_);
  if (view.round() && view.width != view.height)
    throw UsageError(fmt::format("--size '{}': view '{}' is round, its picture is square", size_, view.name));
  return view;
}

void ImageCommand::refuse_idle_options(PictureFormat format) const {
  if (format != PictureFormat::png)
    refuse_without_effect(*image_, {"--tone", "--white", "--screen-white", "--quantity", "--range", "--log"},
                          "with .hdr and .exr, which hold physical values");
  if (tone_ != "falsecolour")
    refuse_without_effect(*image_, {"--quantity", "--range", "--log"}, "without --tone falsecolour");
  if (tone_ != "linear") refuse_without_effect(*image_, {"--white"}, "without --tone linear");
  if (tone_ != "stevens") refuse_without_effect(*image_, {"--screen-white"}, "without --tone stevens");
}

void ImageCommand::render() {
  const auto format = picture_format_of(input_.output);
  if (!format) throw UsageError("-o '" + input_.output + "': the name must end in .png, .hdr or .exr");
  if (spectral_ && *format != PictureFormat::exr)
    throw UsageError("--spectral: -o '" + input_.output + "' must end in .exr, which alone holds spectra");
  refuse_idle_options(*format);
  program_.check_output(input_.output, {input_.path});
  PictureOptions picture;
  picture.format = *format;
  picture.tone = tone_ == "falsecolour" ? Tone::false_colour
                 : tone_ == "stevens"   ? Tone::stevens
                                        : Tone::linear;
  picture.notes.software = "DIM " + version();
  if (white_cd_m2_ > 0.0) picture.linear.display_white_cd_m2 = white_cd_m2_;
  picture.stevens.screen_white_cd_m2 = screen_white_cd_m2_;
  parse_range(range_, picture.false_colour);
  picture.false_colour.kind = logarithmic_ ? ScaleKind::logarithmic : ScaleKind::linear;
  picture.false_colour.title = quantity_ == "illuminance" ? "Illuminance" : "Luminance";

  program_.stage("read");
  const LuminanceDatabase database = open_database(program_, input_);
  const Cells& cells = database.cells();
  RenderOptions options;
  options.view = chosen_view(database.zone());
  picture.notes.radiance_view = radiance_view(options.view, database.zone().origin_m);
  options.samples = samples_;
  options.shading =
      shade_ == "cell" ? Shading::cell : (shade_ == "smooth" ? Shading::smooth : Shading::gather);
  options.scalar = quantity_ == "illuminance" ? ScalarQuantity::illuminance : ScalarQuantity::luminance;
  options.spectral = spectral_;
  // Hundreds of libraries come with it: they are loaded while the picture is drawn, and stay.
  const std::string library_dir = executable_folder() + "/../lib/dim";
  auto loaded = std::async(std::launch::async, [&] { const PictureModule module(library_dir); });
  program_.stage("render");
  const Mix mix = mix_of(database, input_);
  const Raster raster = render_view(database, cells, mix, options, program_.job());
  if (is_black(raster))
    program_.warn({{{},
                    fmt::format("view '{}' shows no light at all: the picture is black", options.view.name),
                    "check where its eye stands and looks (dimdis check), and --mix"}});
  picture.linear.scene_white_xyz = scene_white(database, mix);
  program_.stage(kWritingStage);
  loaded.get();
  const auto report = write_picture(library_dir, input_.output, raster, picture, program_.job());
  program_.stage("");
  program_.warn(report.warnings);
  if (*format == PictureFormat::png && picture.tone != Tone::false_colour)
    program_.say(tone_words(picture, report));
}

}  // namespace dim
