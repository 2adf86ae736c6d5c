#pragma once

#include <cstddef>
#include <string>

#include "image/legend.hpp"
#include "image/linear_rgb.hpp"
#include "image/module/abi.hpp"
#include "image/raster.hpp"
#include "image/spectral_pixels.hpp"

namespace dim {

/// What goes into a picture file beside its pixels. One line each; may be empty.
struct PictureNotes {
  std::string software;     ///< for example "DIM 0.1.0"
  std::string description;  ///< exposure or scale, as the program would print it
  /// Radiance only: what follows VIEW=, for example "-vtv -vp 0 0 1.6 -vd 0 1 0 -vu 0 0 1 -vh 70 -vv 55";
  /// tools such as evalglare need it.
  std::string radiance_view;
};

/// The picture module dimimage.so, which holds all use of OpenImageIO and OpenEXR. Loading it takes a while
/// (hundreds of libraries), so it is made only where a picture is written; it then stays loaded.
class PictureModule : public TextDrawer {
 public:
  /// @param library_dir  the folder that holds dimimage.so: `../lib/dim` seen from the program's own folder
  /// @throws IoError  the module is missing, cannot be loaded, or belongs to another version
  explicit PictureModule(const std::string& library_dir);

  /// The bytes of a PNG file: 8-bit sRGB.
  /// @throws IoError, InternalError  what OpenImageIO says
  std::string png(const Picture8& picture, const PictureNotes& notes) const;
  /// The bytes of a Radiance picture from radiance_pixels.
  std::string radiance(const LinearPicture& picture, const PictureNotes& notes) const;
  /// The bytes of an OpenEXR file from exr_pixels, with spectral channels beside them where there are any.
  std::string exr(const LinearPicture& picture, const PictureNotes& notes,
                  const SpectralPixels& spectral = {}) const;

  bool available() const override { return no_font_.empty(); }
  /// Why there can be no text; empty where there can.
  const std::string& no_font_reason() const { return no_font_; }
  TextExtent measure(const std::string& utf8, int size_px) const override;
  void draw(Picture8& picture, int x, int y, const std::string& utf8, int size_px,
            Rgb8 colour) const override;

 private:
  std::string encode(DimImagePicture picture, const PictureNotes& notes) const;

  std::string path_;
  DimImageEncodeFn encode_ = nullptr;
  DimImageMeasureFn measure_ = nullptr;
  DimImageDrawFn draw_ = nullptr;
  std::string no_font_;
};

}  // namespace dim
