#pragma once

#include <cstddef>
#include <cstdint>

/// What passes between dimcore and the picture module, `dimimage.so`: plain C structs and functions only. No
/// exception crosses, nothing allocated on one side is freed on the other. Each entry point returns
/// kDimImageOk, or another status and a text of at most error_size bytes, ended by 0.
extern "C" {

/// To be raised with every change below; the loader refuses another number.
enum { kDimImageAbi = 2 };

enum DimImageStatus : std::int32_t { kDimImageOk = 0, kDimImageFailed = 1, kDimImageBroken = 2 };

enum DimImageFormat : std::int32_t { kDimImagePng = 1, kDimImageRadiance = 2, kDimImageExr = 3 };

/// A text that goes into the file under a name.
struct DimImageAttribute {
  const char* name;
  const char* value;
};

struct DimImagePicture {
  std::int32_t format;  ///< a DimImageFormat
  std::int32_t width, height;
  std::int32_t n_channels;                ///< PNG, Radiance: 3; OpenEXR: 3 or 4 (R, G, B, luminance)
  const std::uint8_t* coded;              ///< PNG: [height][width][3]
  const float* linear;                    ///< Radiance, OpenEXR: [height][width][n_channels]
  double primaries_xy[8];                 ///< red, green, blue, white
  double white_luminance_cd_m2;           ///< OpenEXR: luminance of R = G = B = 1
  const char* unit;                       ///< OpenEXR: attribute `unit`
  std::int32_t n_more_channels;           ///< OpenEXR: channels beside those, 0 for none
  const char* const* more_channel_names;  ///< [n_more_channels]
  const float* more;                      ///< [height][width][n_more_channels]
  std::int32_t n_attributes;              ///< OpenEXR: further texts, 0 for none
  const DimImageAttribute* attributes;    ///< [n_attributes]
  const char* software;                   ///< name and version of the program
  const char* description;                ///< one line; may be empty
  const char* view;                       ///< Radiance: what follows VIEW=; may be empty
};

/// Takes bytes of the file in order. @returns 0, or another number to stop.
typedef std::int32_t (*DimImageSink)(void* user, const std::uint8_t* bytes, std::size_t n);

struct DimImageText {
  const char* utf8;
  std::int32_t size_px;
  std::int32_t x, y;  ///< left end of the baseline
  std::uint8_t colour[3];
};

struct DimImageExtent {
  std::int32_t width, above, below;
};

typedef std::int32_t (*DimImageAbiFn)();
typedef std::int32_t (*DimImageEncodeFn)(const DimImagePicture* picture, DimImageSink sink, void* user,
                                         char* error, std::size_t error_size);
/// Fails where there is no font.
typedef std::int32_t (*DimImageMeasureFn)(const DimImageText* text, DimImageExtent* extent, char* error,
                                          std::size_t error_size);
/// rgb: [height][width][3], drawn on.
typedef std::int32_t (*DimImageDrawFn)(const DimImageText* text, std::uint8_t* rgb, std::int32_t width,
                                       std::int32_t height, char* error, std::size_t error_size);
}
