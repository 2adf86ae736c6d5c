#include "image/picture_module.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <new>

#include "base/error.hpp"

namespace dim {
namespace {

using ErrorText = std::array<char, 1024>;

std::int32_t append(void* user, const std::uint8_t* bytes, std::size_t n) {
  try {
    static_cast<std::string*>(user)->append(reinterpret_cast<const char*>(bytes), n);
    return 0;
  } catch (const std::bad_alloc&) {
    return 1;
  }
}

void check_status(std::int32_t status, const ErrorText& error, const std::string& path) {
  if (status == kDimImageOk) return;
  const std::string what = error.data();
  if (status == kDimImageBroken) throw InternalError("picture module: " + what);
  throw IoError(path, "cannot make the picture: " + what);
}

template <typename Function>
Function find(void* library, const char* name, const std::string& path) {
  void* symbol = dlsym(library, name);
  if (!symbol) throw IoError(path, fmt::format("not a picture module of this program: no '{}' in it", name));
  return reinterpret_cast<Function>(symbol);
}

void* open_library(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    throw IoError(path, "the module that writes pictures is missing; it is installed with the programs");
  }
  // Never closed: the libraries behind it keep threads and exit handlers of their own.
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library)
    throw IoError(path, fmt::format("the module that writes pictures cannot be loaded: {}", dlerror()));
  return library;
}

}  // namespace

PictureModule::PictureModule(const std::string& library_dir)
    : path_((std::filesystem::path(library_dir) / "dimimage.so").lexically_normal().string()) {
  void* library = open_library(path_);
  const auto abi = find<DimImageAbiFn>(library, "dim_image_abi", path_)();
  if (abi != kDimImageAbi) {
    throw IoError(path_, fmt::format("picture module of another version ({}, this program needs {})", abi,
                                     static_cast<int>(kDimImageAbi)));
  }
  encode_ = find<DimImageEncodeFn>(library, "dim_image_encode", path_);
  measure_ = find<DimImageMeasureFn>(library, "dim_image_measure", path_);
  draw_ = find<DimImageDrawFn>(library, "dim_image_draw", path_);

  ErrorText error{};
  DimImageExtent extent{};
  const DimImageText probe{"0", 16, 0, 0, {}};
  if (measure_(&probe, &extent, error.data(), error.size()) != kDimImageOk) no_font_ = error.data();
}

std::string PictureModule::encode(DimImagePicture picture, const PictureNotes& notes) const {
  picture.software = notes.software.c_str();
  picture.description = notes.description.c_str();
  picture.view = notes.radiance_view.c_str();
  std::string bytes;
  ErrorText error{};
  check_status(encode_(&picture, append, &bytes, error.data(), error.size()), error, path_);
  return bytes;
}

std::string PictureModule::png(const Picture8& picture, const PictureNotes& notes) const {
  DimImagePicture plain{};
  plain.format = kDimImagePng;
  plain.width = picture.width;
  plain.height = picture.height;
  plain.n_channels = 3;
  plain.coded = picture.rgb.data();
  return encode(plain, notes);
}

namespace {

DimImagePicture plain_linear(const LinearPicture& picture, DimImageFormat format) {
  DimImagePicture plain{};
  plain.format = format;
  plain.width = picture.width;
  plain.height = picture.height;
  plain.n_channels = picture.n_channels;
  plain.linear = picture.values.data();
  const Primaries& p = picture.primaries;
  std::size_t i = 0;
  for (const Chromaticity& c : {p.red, p.green, p.blue, p.white}) {
    plain.primaries_xy[i++] = c.x;
    plain.primaries_xy[i++] = c.y;
  }
  plain.white_luminance_cd_m2 = 1.0;
  plain.unit = "cd/m2";
  return plain;
}

}  // namespace

std::string PictureModule::radiance(const LinearPicture& picture, const PictureNotes& notes) const {
  return encode(plain_linear(picture, kDimImageRadiance), notes);
}

std::string PictureModule::exr(const LinearPicture& picture, const PictureNotes& notes,
                               const SpectralPixels& spectral) const {
  DimImagePicture plain = plain_linear(picture, kDimImageExr);
  if (spectral.empty()) return encode(plain, notes);
  std::vector<const char*> names;
  for (const std::string& name : spectral.channels) names.push_back(name.c_str());
  const std::array<DimImageAttribute, 3> attributes = {{{"spectralLayoutVersion", kSpectralLayoutVersion},
                                                        {"emissiveUnits", kEmissiveUnits},
                                                        {"bandEdges_nm", spectral.band_edges_nm.c_str()}}};
  plain.n_more_channels = static_cast<std::int32_t>(names.size());
  plain.more_channel_names = names.data();
  plain.more = spectral.values.data();
  plain.n_attributes = static_cast<std::int32_t>(attributes.size());
  plain.attributes = attributes.data();
  return encode(plain, notes);
}

TextExtent PictureModule::measure(const std::string& utf8, int size_px) const {
  ErrorText error{};
  DimImageExtent extent{};
  const DimImageText text{utf8.c_str(), size_px, 0, 0, {}};
  check_status(measure_(&text, &extent, error.data(), error.size()), error, path_);
  return {extent.width, extent.above, extent.below};
}

void PictureModule::draw(Picture8& picture, int x, int y, const std::string& utf8, int size_px,
                         Rgb8 colour) const {
  ErrorText error{};
  const DimImageText text{utf8.c_str(), size_px, x, y, {colour[0], colour[1], colour[2]}};
  check_status(draw_(&text, picture.rgb.data(), picture.width, picture.height, error.data(), error.size()),
               error, path_);
}

}  // namespace dim
