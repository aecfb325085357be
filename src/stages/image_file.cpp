#include "stages/image_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

// After fmt: OpenImageIO would include it as headers only, without exceptions, and this file's copy of fmt's functions
// would be the whole program's.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "stages/atomic_path.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

/// Calls add(value) for each pixel in a file's order: from the top row down.
template <class T, class Add>
void top_down(const Plane<T>& plane, Add add) {
  for (int y = plane.height() - 1; y >= 0; --y) {
    for (int x = 0; x < plane.width(); ++x) add(plane(x, y));
  }
}

unsigned code(float value, double largest) {
  if (!(value > 0)) return 0;  // NaN, too
  return static_cast<unsigned>(std::floor(std::min(value, 1.0f) * largest + 0.5));
}

/// The largest code that a file holds: that of the frame, or of 8 bits where the frame is float.
int largest_of(ColorFormat format) {
  return format == ColorFormat::rgba32f ? 255 : static_cast<int>(color_scale(format));
}

/// The plane's codes in a file's order, `channels` of each pixel.
std::vector<unsigned> codes_of(const Plane<glm::vec4>& plane, int channels, double largest) {
  std::vector<unsigned> codes;
  codes.reserve(static_cast<std::size_t>(channels) * plane.size());
  top_down(plane, [&](const glm::vec4& p) {
    for (int c = 0; c < channels; ++c) codes.push_back(code(p[c], largest));
  });
  return codes;
}

OIIO::ImageSpec spec_of(int width, int height, int channels, OIIO::TypeDesc type) {
  OIIO::ImageSpec spec(width, height, channels, type);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("compression", "zip");
  return spec;
}

/// Of an EXR file: without a date OpenImageIO writes today's, and no two files were the same.
OIIO::ImageSpec exr_spec_of(int width, int height, int channels) {
  OIIO::ImageSpec spec = spec_of(width, height, channels, OIIO::TypeDesc::FLOAT);
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  return spec;
}

/// The file's bytes; its ending says the format.
Bytes encode(const fs::path& file, const OIIO::ImageSpec& spec, const void* pixels) {
  const std::string name = file.string();
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput proxy(bytes);
  const auto out = OIIO::ImageOutput::create(name, &proxy);
  if (!out) throw ImageError(fmt::format("{}: cannot be encoded: {}", name, OIIO::geterror()));
  if (!out->open(name, spec) || !out->write_image(spec.format, pixels) || !out->close()) {
    throw ImageError(fmt::format("{}: cannot be encoded: {}", name, out->geterror()));
  }
  return {bytes.begin(), bytes.end()};
}

std::string ending_of(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

void require_ending(const fs::path& file, std::string_view ending) {
  if (ending_of(file) == ending) return;
  throw ImageError(fmt::format("{}: expected a file name ending in {}", file.string(), ending));
}

template <class T>
void require_pixels(const fs::path& file, const Plane<T>& plane) {
  if (!plane.empty()) return;
  throw ImageError(fmt::format("{}: expected an image with pixels, found an empty plane", file.string()));
}

/// Adds the channels from `first` to before `last`, read as `type`, which is T.
template <class T>
void add_channels(OIIO::TypeDesc type, OIIO::ImageInput& in, const OIIO::ImageSpec& spec, int first, int last,
                  const fs::path& file, StoredImage& image) {
  const auto count = static_cast<std::size_t>(last - first);
  std::vector<T> pixels(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) * count);
  if (!in.read_image(0, 0, first, last, type, pixels.data())) {
    throw ImageError(fmt::format("{}: cannot be read: {}", file.string(), in.geterror()));
  }
  constexpr double kScale = std::is_integral_v<T> ? static_cast<double>(std::numeric_limits<T>::max()) : 1.0;
  for (std::size_t c = 0; c < count; ++c) {
    Plane<double> values(spec.width, spec.height);
    auto from = pixels.begin() + static_cast<std::ptrdiff_t>(c);
    for (int y = spec.height - 1; y >= 0; --y) {
      for (int x = 0; x < spec.width; ++x, from += last - first) values(x, y) = static_cast<double>(*from);
    }
    image.channels.push_back({spec.channelnames.at(static_cast<std::size_t>(first) + c), kScale, std::move(values)});
  }
}

void add_channels_of_type(OIIO::TypeDesc type, OIIO::ImageInput& in, const OIIO::ImageSpec& spec, int first, int last,
                          const fs::path& file, StoredImage& image) {
  switch (type.basetype) {
    case OIIO::TypeDesc::UINT8: return add_channels<std::uint8_t>(type, in, spec, first, last, file, image);
    case OIIO::TypeDesc::INT8: return add_channels<std::int8_t>(type, in, spec, first, last, file, image);
    case OIIO::TypeDesc::UINT16: return add_channels<std::uint16_t>(type, in, spec, first, last, file, image);
    case OIIO::TypeDesc::INT16: return add_channels<std::int16_t>(type, in, spec, first, last, file, image);
    case OIIO::TypeDesc::UINT32: return add_channels<std::uint32_t>(type, in, spec, first, last, file, image);
    case OIIO::TypeDesc::INT32: return add_channels<std::int32_t>(type, in, spec, first, last, file, image);
    case OIIO::TypeDesc::HALF:
    case OIIO::TypeDesc::FLOAT:
    case OIIO::TypeDesc::DOUBLE:
      return add_channels<double>(OIIO::TypeDesc::DOUBLE, in, spec, first, last, file, image);
    default:
      throw ImageError(
          fmt::format("{}: expected integers of up to 32 bits or floats, found {}", file.string(), type.c_str()));
  }
}

}  // namespace

namespace {

Bytes encode_bytes(const fs::path& file, const Plane<glm::vec4>& plane) {
  require_pixels(file, plane);
  const std::vector<unsigned> codes = codes_of(plane, 4, 255);
  const std::vector<std::uint8_t> pixels(codes.begin(), codes.end());
  return encode(file, spec_of(plane.width(), plane.height(), 4, OIIO::TypeDesc::UINT8), pixels.data());
}

}  // namespace

Bytes encode_png(const fs::path& file, const Plane<glm::vec4>& plane, ColorFormat format) {
  require_ending(file, ".png");
  const auto largest = static_cast<unsigned>(largest_of(format));
  if (largest == 255) return encode_bytes(file, plane);
  require_pixels(file, plane);
  std::vector<std::uint16_t> pixels;
  for (unsigned c : codes_of(plane, 4, largest)) {
    pixels.push_back(static_cast<std::uint16_t>((c * 65535u + largest / 2) / largest));
  }
  return encode(file, spec_of(plane.width(), plane.height(), 4, OIIO::TypeDesc::UINT16), pixels.data());
}

Bytes encode_tga(const fs::path& file, const Plane<glm::vec4>& plane, ColorFormat format) {
  require_ending(file, ".tga");
  require_image_name(file, format);
  return encode_bytes(file, plane);
}

// OpenImageIO 2.4 writes codes of more than 8 bits least byte first, which no reader takes, itself neither.
Bytes encode_ppm(const fs::path& file, const Plane<glm::vec4>& plane, ColorFormat format) {
  require_ending(file, ".ppm");
  require_pixels(file, plane);
  const int largest = largest_of(format);
  Bytes out = fmt::format("P6\n{} {}\n{}\n", plane.width(), plane.height(), largest);
  for (unsigned c : codes_of(plane, 3, largest)) {
    if (largest > 255) out.push_back(static_cast<char>(c >> 8));
    out.push_back(static_cast<char>(c & 0xffu));
  }
  return out;
}

Bytes encode_exr(const fs::path& file, const Plane<glm::vec4>& plane) {
  require_ending(file, ".exr");
  require_pixels(file, plane);
  std::vector<glm::vec4> pixels;
  pixels.reserve(plane.size());
  top_down(plane, [&](const glm::vec4& p) { pixels.push_back(p); });
  return encode(file, exr_spec_of(plane.width(), plane.height(), 4), pixels.data());
}

Bytes encode_depth_exr(const fs::path& file, const Plane<double>& plane) {
  require_depth_name(file);
  require_pixels(file, plane);
  std::vector<float> pixels;
  pixels.reserve(plane.size());
  top_down(plane, [&](double z) { pixels.push_back(static_cast<float>(z)); });
  OIIO::ImageSpec spec = exr_spec_of(plane.width(), plane.height(), 1);
  spec.channelnames = {"Z"};
  spec.z_channel = 0;
  return encode(file, spec, pixels.data());
}

Bytes encode_depth_codes(const fs::path& file, const Plane<double>& plane, DepthFormat format) {
  Plane<double> codes = plane;
  const double scale = depth_scale(format);
  if (scale > 0) {
    for (double& z : codes.values()) z = std::round(z * scale);
  }
  return encode_depth_exr(file, codes);
}

Bytes encode_image(const fs::path& file, const Plane<glm::vec4>& plane, ColorFormat format) {
  require_image_name(file, format);
  const std::string ending = ending_of(file);
  if (ending == ".png") return encode_png(file, plane, format);
  if (ending == ".tga") return encode_tga(file, plane, format);
  return ending == ".ppm" ? encode_ppm(file, plane, format) : encode_exr(file, plane);
}

void require_image_name(const fs::path& file, ColorFormat format) {
  const std::string ending = ending_of(file);
  if (ending == ".tga" && largest_of(format) > 255) {
    throw ImageError(
        fmt::format("{}: TGA holds 8 bits a channel, the frame ({}) more: expected a file name ending in .png, .ppm or "
                    ".exr",
                    file.string(), format == ColorFormat::rgba12 ? "rgba12" : "rgba16"));
  }
  if (ending == ".png" || ending == ".tga" || ending == ".ppm" || ending == ".exr") return;
  throw ImageError(fmt::format("{}: expected a file name ending in .png, .tga, .ppm or .exr", file.string()));
}

void require_depth_name(const fs::path& file) { require_ending(file, ".exr"); }

void write_image(const fs::path& file, const Plane<glm::vec4>& plane) { write_file(file, encode_image(file, plane)); }

StoredImage read_stored(const fs::path& file) {
  constexpr int kLargest = 16384;
  constexpr std::int64_t kMostValues = std::int64_t{1} << 28;
  const std::string name = file.string();
  if (!fs::is_regular_file(file)) throw ImageError(fmt::format("{}: expected an image file, found none", name));
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  config.attribute("oiio:RawColor", 1);
  const auto in = OIIO::ImageInput::open(name, &config);
  if (!in) throw ImageError(fmt::format("{}: cannot be read: {}", name, OIIO::geterror()));
  if (in->seek_subimage(0, 1) || in->seek_subimage(1, 0) || !in->seek_subimage(0, 0)) {
    throw ImageError(fmt::format("{}: expected one image, found several (parts, frames or MIP levels)", name));
  }
  const OIIO::ImageSpec spec = in->spec();
  if (spec.width < 1 || spec.height < 1 || spec.depth != 1 || spec.deep || spec.width > kLargest ||
      spec.height > kLargest || spec.nchannels < 1 ||
      spec.nchannels > kMostValues / (std::int64_t{spec.width} * spec.height)) {
    throw ImageError(fmt::format(
        "{}: expected flat pixels, up to {} x {} of them and 2^28 values, found {} channels of {} x {} x {}{}", name,
        kLargest, kLargest, spec.nchannels, spec.width, spec.height, spec.depth, spec.deep ? ", deep" : ""));
  }
  StoredImage image;
  image.data = {spec.x, spec.y, spec.width, spec.height};
  image.display = {spec.full_x, spec.full_y, spec.full_width, spec.full_height};
  if (spec.channelformats.empty()) {
    add_channels_of_type(spec.format, *in, spec, 0, spec.nchannels, file, image);
  } else {
    for (int c = 0; c < spec.nchannels; ++c) {
      add_channels_of_type(spec.channelformat(c), *in, spec, c, c + 1, file, image);
    }
  }
  return image;
}

Plane<glm::vec4> read_image(const fs::path& file) {
  const StoredImage image = read_stored(file);
  const std::size_t channels = image.channels.size();
  if (channels > 4) throw ImageError(fmt::format("{}: expected 1 to 4 channels, found {}", file.string(), channels));
  Plane<glm::vec4> plane(image.data.width, image.data.height, glm::vec4(1));
  const auto copy = [&](std::size_t from, int to) {
    const StoredImage::Channel& c = image.channels[from];
    for (std::size_t i = 0; i < plane.size(); ++i) {
      plane.values()[i][to] = static_cast<float>(c.values.values()[i] / c.scale);
    }
  };
  for (int c = 0; c < 3; ++c) copy(channels < 3 ? 0 : static_cast<std::size_t>(c), c);
  if (channels == 2 || channels == 4) copy(channels - 1, 3);
  return plane;
}

namespace {

void require_channels(const fs::path& file, const StoredImage& image, std::size_t count, double scale) {
  if (image.channels.size() == count && image.channels[0].scale == scale) return;
  throw ImageError(fmt::format("{}: expected {} channels of {}, found {} of {}", file.string(), count,
                               scale == 1 ? "floats" : fmt::format("codes up to {}", scale), image.channels.size(),
                               image.channels[0].scale));
}

}  // namespace

Plane<glm::vec4> frame_color(const fs::path& file, const StoredImage& image, ColorFormat format) {
  const double largest = color_scale(format);
  const double scale = largest == 0 ? 1 : largest == 255 ? 255 : 65535;  // 12-bit codes are spread over 16 bits
  require_channels(file, image, 4, scale);
  Plane<glm::vec4> out(image.data.width, image.data.height);
  for (int c = 0; c < 4; ++c) {
    const std::vector<double>& stored = image.channels[static_cast<std::size_t>(c)].values.values();
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double code = largest == 0 ? stored[i] : std::round(stored[i] * largest / scale);
      out.values()[i][c] =
          largest == 0 ? static_cast<float>(code) : static_cast<float>(code) / static_cast<float>(largest);
    }
  }
  return out;
}

Plane<double> frame_depth(const fs::path& file, const StoredImage& image, DepthFormat format) {
  require_channels(file, image, 1, 1);
  Plane<double> out = image.channels[0].values;
  if (const double scale = depth_scale(format); scale > 0) {
    for (double& z : out.values()) z /= scale;
  }
  return out;
}

std::string image_library_version() { return OIIO_VERSION_STRING; }

}  // namespace plumbline
