// The module of image_codec.h: the one file that includes OpenImageIO.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <vector>

#include "images/image_codec.h"

namespace plumbline {
namespace {

SampleType type_of(OIIO::TypeDesc type) {
  switch (type.basetype) {
    case OIIO::TypeDesc::UINT8: return SampleType::uint8;
    case OIIO::TypeDesc::INT8: return SampleType::int8;
    case OIIO::TypeDesc::UINT16: return SampleType::uint16;
    case OIIO::TypeDesc::INT16: return SampleType::int16;
    case OIIO::TypeDesc::UINT32: return SampleType::uint32;
    case OIIO::TypeDesc::INT32: return SampleType::int32;
    case OIIO::TypeDesc::HALF: return SampleType::float16;
    case OIIO::TypeDesc::FLOAT: return SampleType::float32;
    case OIIO::TypeDesc::DOUBLE: return SampleType::float64;
    default: return SampleType::other;
  }
}

OIIO::TypeDesc type_of(SampleType type) {
  switch (type) {
    case SampleType::uint8: return OIIO::TypeDesc::UINT8;
    case SampleType::int8: return OIIO::TypeDesc::INT8;
    case SampleType::uint16: return OIIO::TypeDesc::UINT16;
    case SampleType::int16: return OIIO::TypeDesc::INT16;
    case SampleType::uint32: return OIIO::TypeDesc::UINT32;
    case SampleType::int32: return OIIO::TypeDesc::INT32;
    case SampleType::float16: return OIIO::TypeDesc::HALF;
    case SampleType::float32: return OIIO::TypeDesc::FLOAT;
    case SampleType::float64: return OIIO::TypeDesc::DOUBLE;
    case SampleType::other: break;
  }
  return OIIO::TypeDesc::UNKNOWN;
}

class File : public OpenImage {
 public:
  explicit File(std::unique_ptr<OIIO::ImageInput> in) : in_(std::move(in)) {
    header_.several = in_->seek_subimage(0, 1) || in_->seek_subimage(1, 0) || !in_->seek_subimage(0, 0);
    const OIIO::ImageSpec& spec = in_->spec();
    header_.x = spec.x, header_.y = spec.y;
    header_.width = spec.width, header_.height = spec.height, header_.depth = spec.depth;
    header_.full_x = spec.full_x, header_.full_y = spec.full_y;
    header_.full_width = spec.full_width, header_.full_height = spec.full_height;
    header_.deep = spec.deep;
    header_.type = type_of(spec.format);
    header_.type_name = spec.format.c_str();
    for (int c = 0; c < spec.nchannels; ++c) {
      const OIIO::TypeDesc type = spec.channelformat(c);
      header_.channels.push_back({spec.channel_name(c), type_of(type), type.c_str()});
    }
  }
  bool read(int first, int last, SampleType as, void* to) override {
    return in_->read_image(0, 0, first, last, type_of(as), to);
  }
  std::string error() const override {
    std::string said = in_->geterror();
    said.resize(std::min(said.find('\n'), said.size()));  // further lines repeat the first
    return said.empty() ? "the file ends before its pixels do, or holds others than its header says" : said;
  }

 private:
  std::unique_ptr<OIIO::ImageInput> in_;
};

std::unique_ptr<OpenImage> open(const std::string& name, std::string& error) {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  config.attribute("oiio:RawColor", 1);
  auto in = OIIO::ImageInput::open(name, &config);
  if (!in) {
    error = OIIO::geterror();
    return nullptr;
  }
  return std::make_unique<File>(std::move(in));
}

// No threads of the libraries' own: for small pictures they cost more than they save, and a process with threads cannot
// fork safely.
[[maybe_unused]] const bool kNoThreads = OIIO::attribute("threads", 1) && OIIO::attribute("exr_threads", -1);

// Removes the eXIf chunk (length, type, data, CRC) of a PNG file: OpenImageIO 3.0 writes an empty one, 2.4 none, and a
// golden's name is the hash of its bytes.
void remove_exif(std::vector<unsigned char>& bytes) {
  constexpr std::size_t kSignature = 8, kFrame = 12;
  if (bytes.size() < kSignature || bytes[1] != 'P' || bytes[2] != 'N' || bytes[3] != 'G') return;
  for (std::size_t at = kSignature; at + kFrame <= bytes.size();) {
    std::size_t size = kFrame;
    for (std::size_t i = 0; i < 4; ++i) size += std::size_t{bytes[at + i]} << (8 * (3 - i));
    if (size > bytes.size() - at) return;
    const auto chunk = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    if (std::equal(chunk + 4, chunk + 8, "eXIf")) {
      bytes.erase(chunk, chunk + static_cast<std::ptrdiff_t>(size));
    } else {
      at += size;
    }
  }
}

std::string encode(const ImageToEncode& image, std::string& error) {
  OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(image.channels.size()), type_of(image.type));
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("compression", "zip");
  // An EXR file gets a fixed date: OpenImageIO would write today's, and no two files would be the same.
  if (image.type == SampleType::float32) spec.attribute("DateTime", "1970:01:01 00:00:00");
  spec.channelnames = image.channels;
  for (int c = 0; c < spec.nchannels; ++c) {
    if (spec.channel_name(c) == "Z") spec.z_channel = c;
  }
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput proxy(bytes);
  const auto out = OIIO::ImageOutput::create(image.name, &proxy);
  if (!out) {
    error = OIIO::geterror();
    return {};
  }
  if (!out->open(image.name, spec) || !out->write_image(spec.format, image.pixels) || !out->close()) {
    error = out->geterror();
    return {};
  }
  remove_exif(bytes);
  return {bytes.begin(), bytes.end()};
}

}  // namespace
}  // namespace plumbline

extern "C" __attribute__((visibility("default")))
const plumbline::ImageCodec plumbline_image_codec = {OIIO_VERSION_STRING, plumbline::open, plumbline::encode};
