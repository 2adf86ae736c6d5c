#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>

#include <array>
#include <cstring>
#include <stdexcept>

#include "image/module/encode.hpp"

namespace dim::image_module {
namespace {

class MemoryStream : public Imf::OStream {
 public:
  MemoryStream() : Imf::OStream("picture") {}

  void write(const char c[], int n) override {
    const auto count = static_cast<std::size_t>(n);
    if (bytes_.size() < at_ + count) bytes_.resize(at_ + count);
    std::memcpy(bytes_.data() + at_, c, count);
    at_ += count;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

// Luminance is in a layer of its own: a channel plain "Y" would make readers take the file for
// luminance-chroma.
constexpr std::array<const char*, 4> kChannels = {"R", "G", "B", "luminance.Y"};

Imf::Header make_header(const DimImagePicture& picture) {
  Imf::Header header(picture.width, picture.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (std::size_t c = 0; c < static_cast<std::size_t>(picture.n_channels); ++c) {
    header.channels().insert(kChannels.at(c), Imf::Channel(Imf::FLOAT));
  }
  for (int c = 0; c < picture.n_more_channels; ++c) {
    header.channels().insert(picture.more_channel_names[c], Imf::Channel(Imf::FLOAT));
  }
  const auto point = [&](int i) {
    return Imath::V2f(static_cast<float>(picture.primaries_xy[2 * i]),
                      static_cast<float>(picture.primaries_xy[2 * i + 1]));
  };
  Imf::addChromaticities(header, Imf::Chromaticities(point(0), point(1), point(2), point(3)));
  Imf::addAdoptedNeutral(header, point(3));
  Imf::addWhiteLuminance(header, static_cast<float>(picture.white_luminance_cd_m2));
  if (*picture.description) Imf::addComments(header, picture.description);
  header.insert("unit", Imf::StringAttribute(picture.unit));
  header.insert("software", Imf::StringAttribute(picture.software));
  for (int i = 0; i < picture.n_attributes; ++i) {
    header.insert(picture.attributes[i].name, Imf::StringAttribute(picture.attributes[i].value));
  }
  return header;
}

// Channel `c` of pixels that hold n_channels values each. The library reads through this pointer only, but
// its interface is not const.
Imf::Slice slice_of(const float* pixels, int c, int n_channels, int width) {
  const std::size_t pixel_stride = sizeof(float) * static_cast<std::size_t>(n_channels);
  return {Imf::FLOAT, reinterpret_cast<char*>(const_cast<float*>(pixels + c)), pixel_stride,
          pixel_stride * static_cast<std::size_t>(width)};
}

}  // namespace

std::vector<std::uint8_t> encode_exr(const DimImagePicture& picture) {
  if (picture.n_channels < 3 || picture.n_channels > 4)
    throw std::logic_error("OpenEXR picture: 3 or 4 channels");
  MemoryStream stream;
  {
    Imf::OutputFile file(stream, make_header(picture));
    Imf::FrameBuffer frame;
    for (int c = 0; c < picture.n_channels; ++c) {
      frame.insert(kChannels.at(static_cast<std::size_t>(c)),
                   slice_of(picture.linear, c, picture.n_channels, picture.width));
    }
    for (int c = 0; c < picture.n_more_channels; ++c) {
      frame.insert(picture.more_channel_names[c],
                   slice_of(picture.more, c, picture.n_more_channels, picture.width));
    }
    file.setFrameBuffer(frame);
    file.writePixels(picture.height);
  }
  return stream.take();
}

}  // namespace dim::image_module
