#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "base/job.hpp"
#include "image/false_colour.hpp"
#include "image/picture_module.hpp"
#include "image/raster.hpp"
#include "image/stevens.hpp"
#include "image/tone.hpp"

/// From a rendered view to a picture file: the one header a program needs.
namespace dim {

enum class PictureFormat { png, radiance_hdr, exr };

/// By the name's ending (.png, .hdr or .pic, .exr, in either case); nothing for another ending.
std::optional<PictureFormat> picture_format_of(const std::string& path);

enum class Tone { linear, stevens, false_colour };

/// An OpenEXR picture holds spectral channels where the raster has radiance by band (see spectral_pixels).
struct PictureOptions {
  PictureFormat format = PictureFormat::png;
  /// PNG only; the other two hold physical values, whatever the tone.
  Tone tone = Tone::linear;
  /// Linear tone; of these, Stevens' tone takes the primaries, the scene's white and the dithering.
  ToneOptions linear;
  StevensOptions stevens;
  FalseColourOptions false_colour;
  PictureNotes notes;
};

/// What was done, to be printed.
struct PictureReport {
  int width = 0;  ///< of the file, legend included
  int height = 0;
  double display_white_cd_m2 = 0;  ///< linear PNG: luminance shown as white
  bool automatic_exposure = false;
  double scene_adaptation_cd_m2 = 0;  ///< Stevens PNG: log-mean luminance of the view
  std::size_t n_above_white = 0;   ///< linear, Stevens PNG: pixels shown as white because they are brighter
  std::size_t n_out_of_gamut = 0;  ///< PNG, HDR: pixels whose colour was brought in
  Scale scale;                     ///< false colour: the scale used
  std::size_t n_below_scale = 0;
  std::size_t n_above_scale = 0;
  Warnings warnings;  ///< a legend without words, light too coloured to be shown as white
};

struct EncodedPicture {
  std::string bytes;
  PictureReport report;
};

/// Makes the whole file in memory. The description in the file is the notes' own, or where that is empty, the
/// exposure, the scale or the unit in words.
/// @throws InputError  impossible exposure, range or white
/// @throws IoError, LimitError, InternalError  see PictureModule, check_raster
EncodedPicture encode_picture(const PictureModule& module, const Raster& raster,
                              const PictureOptions& options);

/// Loads the module, makes the picture and writes it whole or not at all.
/// @param library_dir  folder of the picture module, see PictureModule
/// @param path         file to write; its format is options.format, whatever the name
/// @throws IoError     also where the path cannot be written
/// @throws Interrupted  as the job asks
PictureReport write_picture(const std::string& library_dir, const std::string& path, const Raster& raster,
                            const PictureOptions& options, const Job& job = {});

}  // namespace dim
