#include "image/writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "base/atomic_file.hpp"

namespace dim {
namespace {

PictureNotes with_description(PictureNotes notes, const std::string& description) {
  if (notes.description.empty()) notes.description = description;
  return notes;
}

void note_size(PictureReport& report, int width, int height) {
  report.width = width;
  report.height = height;
}

void note_tone(PictureReport& report, const ToneResult& toned) {
  note_size(report, toned.picture.width, toned.picture.height);
  report.n_above_white = toned.n_above_white;
  report.n_out_of_gamut = toned.n_out_of_gamut;
}

// Says so where the light of the scene cannot be shown as white.
void note_white(PictureReport& report, const PictureOptions& options) {
  const Vec3& white = options.linear.scene_white_xyz;
  if (neutral_white(white, options.linear.display) == white) return;
  report.warnings.push_back({{},
                             "the light of this scene is too strongly coloured to be shown as white",
                             "the picture keeps its colour"});
}

EncodedPicture linear_png(const PictureModule& module, const Raster& raster, const PictureOptions& options) {
  EncodedPicture result;
  const ToneResult toned = tone_linear(raster, options.linear);
  note_tone(result.report, toned);
  note_white(result.report, options);
  result.report.display_white_cd_m2 = toned.display_white_cd_m2;
  result.report.automatic_exposure = !options.linear.display_white_cd_m2;
  const std::string words = fmt::format("linear tone, white = {:.4g} cd/m2", toned.display_white_cd_m2);
  result.bytes = module.png(toned.picture, with_description(options.notes, words));
  return result;
}

EncodedPicture stevens_png(const PictureModule& module, const Raster& raster, const PictureOptions& options) {
  EncodedPicture result;
  const StevensResult mapped = map_brightness(raster, options.stevens);
  ToneOptions tone = options.linear;
  tone.display_white_cd_m2 = options.stevens.screen_white_cd_m2;
  const ToneResult toned = tone_linear(mapped.shown, tone);
  note_tone(result.report, toned);
  note_white(result.report, options);
  result.report.scene_adaptation_cd_m2 = mapped.scene_adaptation_cd_m2;
  const std::string words =
      fmt::format("Stevens brightness mapping, eye adapted to {:.4g} cd/m2, screen of {:.4g} cd/m2",
                  mapped.scene_adaptation_cd_m2, options.stevens.screen_white_cd_m2);
  result.bytes = module.png(toned.picture, with_description(options.notes, words));
  return result;
}

EncodedPicture false_colour_png(const PictureModule& module, const Raster& raster,
                                const PictureOptions& options) {
  EncodedPicture result;
  const FalseColourResult painted = false_colour(raster, options.false_colour);
  const Picture8 sheet = with_legend(painted, options.false_colour.title, raster.scalar_unit, module);
  note_size(result.report, sheet.width, sheet.height);
  result.report.scale = painted.scale;
  result.report.n_below_scale = painted.n_below;
  result.report.n_above_scale = painted.n_above;
  const std::string words = fmt::format("false colour, {} scale {:g}..{:g} {}",
                                        painted.scale.kind == ScaleKind::linear ? "linear" : "logarithmic",
                                        painted.scale.low, painted.scale.high, raster.scalar_unit);
  if (!module.available()) {
    result.report.warnings.push_back({{}, "the legend has no words: " + module.no_font_reason(), words});
  }
  result.bytes = module.png(sheet, with_description(options.notes, words));
  return result;
}

EncodedPicture radiance_file(const PictureModule& module, const Raster& raster,
                             const PictureOptions& options) {
  EncodedPicture result;
  const LinearPicture pixels = radiance_pixels(raster);
  note_size(result.report, raster.width, raster.height);
  result.report.n_out_of_gamut = pixels.n_out_of_gamut;
  const std::string words = fmt::format("radiance W/(m2 sr), luminance = {:g} lm/W", kRadianceEfficacy_lm_W);
  result.bytes = module.radiance(pixels, with_description(options.notes, words));
  return result;
}

EncodedPicture exr_file(const PictureModule& module, const Raster& raster, const PictureOptions& options) {
  EncodedPicture result;
  note_size(result.report, raster.width, raster.height);
  note_white(result.report, options);
  const SpectralPixels spectral = spectral_pixels(raster);
  std::string words = "R = G = B = 1 is 1 cd/m2; luminance.Y in cd/m2";
  if (!spectral.empty()) words += "; S0.*: mean of each waveband, W/(m2 sr nm)";
  result.bytes = module.exr(exr_pixels(raster, options.linear.scene_white_xyz),
                            with_description(options.notes, words), spectral);
  return result;
}

}  // namespace

std::optional<PictureFormat> picture_format_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".png") return PictureFormat::png;
  if (ending == ".hdr" || ending == ".pic") return PictureFormat::radiance_hdr;
  if (ending == ".exr") return PictureFormat::exr;
  return std::nullopt;
}

EncodedPicture encode_picture(const PictureModule& module, const Raster& raster,
                              const PictureOptions& options) {
  switch (options.format) {
    case PictureFormat::radiance_hdr:
      return radiance_file(module, raster, options);
    case PictureFormat::exr:
      return exr_file(module, raster, options);
    case PictureFormat::png:
      break;
  }
  switch (options.tone) {
    case Tone::linear:
      return linear_png(module, raster, options);
    case Tone::stevens:
      return stevens_png(module, raster, options);
    case Tone::false_colour:
      break;
  }
  return false_colour_png(module, raster, options);
}

PictureReport write_picture(const std::string& library_dir, const std::string& path, const Raster& raster,
                            const PictureOptions& options, const Job& job) {
  const PictureModule module(library_dir);
  job.check();
  const EncodedPicture picture = encode_picture(module, raster, options);
  write_file(path, picture.bytes, job);
  return picture.report;
}

}  // namespace dim
