#include <algorithm>
#include <cstring>
#include <exception>
#include <stdexcept>

#include "image/module/abi.hpp"
#include "image/module/encode.hpp"
#include "image/module/text.hpp"

namespace {

void say(const char* what, char* error, std::size_t error_size) {
  if (error_size == 0) return;
  const std::size_t n = std::min(std::strlen(what), error_size - 1);
  std::memcpy(error, what, n);
  error[n] = '\0';
}

template <typename Work>
std::int32_t guarded(const Work& work, char* error, std::size_t error_size) {
  try {
    work();
    return kDimImageOk;
  } catch (const std::logic_error& broken) {
    say(broken.what(), error, error_size);
    return kDimImageBroken;
  } catch (const std::exception& failed) {
    say(failed.what(), error, error_size);
    return kDimImageFailed;
  } catch (...) {
    say("unknown failure in the picture module", error, error_size);
    return kDimImageBroken;
  }
}

std::vector<std::uint8_t> encode(const DimImagePicture& picture) {
  using namespace dim::image_module;
  switch (picture.format) {
    case kDimImagePng:
      return encode_png(picture);
    case kDimImageRadiance:
      return encode_radiance(picture);
    case kDimImageExr:
      return encode_exr(picture);
    default:
      throw std::logic_error("unknown picture format");
  }
}

}  // namespace

#define DIM_EXPORT extern "C" __attribute__((visibility("default")))

DIM_EXPORT std::int32_t dim_image_abi() { return kDimImageAbi; }

DIM_EXPORT std::int32_t dim_image_encode(const DimImagePicture* picture, DimImageSink sink, void* user,
                                         char* error, std::size_t error_size) {
  return guarded(
      [&] {
        const std::vector<std::uint8_t> bytes = encode(*picture);
        if (sink(user, bytes.data(), bytes.size()) != 0) throw std::runtime_error("out of memory");
      },
      error, error_size);
}

DIM_EXPORT std::int32_t dim_image_measure(const DimImageText* text, DimImageExtent* extent, char* error,
                                          std::size_t error_size) {
  return guarded([&] { *extent = dim::image_module::measure_text(*text); }, error, error_size);
}

DIM_EXPORT std::int32_t dim_image_draw(const DimImageText* text, std::uint8_t* rgb, std::int32_t width,
                                       std::int32_t height, char* error, std::size_t error_size) {
  return guarded([&] { dim::image_module::draw_text(*text, rgb, width, height); }, error, error_size);
}
