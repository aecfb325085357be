#include "capture/files/image_file.h"

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

#include "base/atomic_path.h"
#include "images/image_codec.h"
#include "scene/names.h"

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

/// The file's bytes; its ending says the format. `pixels` are of the type, all channels of each.
template <class T>
Bytes encode(const fs::path& file, const Plane<T>& plane, std::vector<std::string> channels, SampleType type,
             const void* pixels) {
  std::string error;
  Bytes out =
      image_codec().encode({file.string(), plane.width(), plane.height(), std::move(channels), type, pixels}, error);
  if (out.empty()) throw ImageError(fmt::format("{}: cannot be encoded: {}", file.string(), error));
  return out;
}

const std::vector<std::string> kRgba = {"R", "G", "B", "A"};

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
void add_channels(SampleType type, OpenImage& in, int first, int last, const fs::path& file, StoredImage& image) {
  const ImageHeader& header = in.header();
  const auto count = static_cast<std::size_t>(last - first);
  std::vector<T> pixels(static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height) * count);
  if (!in.read(first, last, type, pixels.data())) {
    throw ImageError(fmt::format("{}: cannot be read: {}", file.string(), in.error()));
  }
  constexpr double kScale = std::is_integral_v<T> ? static_cast<double>(std::numeric_limits<T>::max()) : 1.0;
  for (std::size_t c = 0; c < count; ++c) {
    Plane<double> values(header.width, header.height);
    auto from = pixels.begin() + static_cast<std::ptrdiff_t>(c);
    for (int y = header.height - 1; y >= 0; --y) {
      for (int x = 0; x < header.width; ++x, from += last - first) values(x, y) = static_cast<double>(*from);
    }
    image.channels.push_back({header.channels.at(static_cast<std::size_t>(first) + c).name, kScale, std::move(values)});
  }
}

void add_channels_of_type(OpenImage& in, int first, int last, const fs::path& file, StoredImage& image) {
  const ImageHeader::Channel& channel = in.header().channels.at(static_cast<std::size_t>(first));
  switch (channel.type) {
    case SampleType::uint8: return add_channels<std::uint8_t>(channel.type, in, first, last, file, image);
    case SampleType::int8: return add_channels<std::int8_t>(channel.type, in, first, last, file, image);
    case SampleType::uint16: return add_channels<std::uint16_t>(channel.type, in, first, last, file, image);
    case SampleType::int16: return add_channels<std::int16_t>(channel.type, in, first, last, file, image);
    case SampleType::uint32: return add_channels<std::uint32_t>(channel.type, in, first, last, file, image);
    case SampleType::int32: return add_channels<std::int32_t>(channel.type, in, first, last, file, image);
    case SampleType::float16:
    case SampleType::float32:
    case SampleType::float64: return add_channels<double>(SampleType::float64, in, first, last, file, image);
    case SampleType::other: break;
  }
  throw ImageError(
      fmt::format("{}: expected integers of up to 32 bits or floats, found {}", file.string(), channel.type_name));
}

}  // namespace

namespace {

Bytes encode_bytes(const fs::path& file, const Plane<glm::vec4>& plane) {
  require_pixels(file, plane);
  const std::vector<unsigned> codes = codes_of(plane, 4, 255);
  const std::vector<std::uint8_t> pixels(codes.begin(), codes.end());
  return encode(file, plane, kRgba, SampleType::uint8, pixels.data());
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
  return encode(file, plane, kRgba, SampleType::uint16, pixels.data());
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
  return encode(file, plane, kRgba, SampleType::float32, pixels.data());
}

Bytes encode_depth_exr(const fs::path& file, const Plane<double>& plane) {
  require_depth_name(file);
  require_pixels(file, plane);
  std::vector<float> pixels;
  pixels.reserve(plane.size());
  top_down(plane, [&](double z) { pixels.push_back(static_cast<float>(z)); });
  return encode(file, plane, {"Z"}, SampleType::float32, pixels.data());
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
                    file.string(), name_of(format)));
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
  std::string error;
  const auto in = image_codec().open(name, error);
  if (!in) throw ImageError(fmt::format("{}: cannot be read: {}", name, error));
  const ImageHeader& header = in->header();
  if (header.several) {
    throw ImageError(fmt::format("{}: expected one image, found several (parts, frames or MIP levels)", name));
  }
  const auto channels = static_cast<int>(header.channels.size());
  if (header.width < 1 || header.height < 1 || header.depth != 1 || header.deep || header.width > kLargest ||
      header.height > kLargest || channels < 1 ||
      channels > kMostValues / (std::int64_t{header.width} * header.height)) {
    throw ImageError(fmt::format(
        "{}: expected flat pixels, up to {} x {} of them and 2^28 values, found {} channels of {} x {} x {}{}", name,
        kLargest, kLargest, channels, header.width, header.height, header.depth, header.deep ? ", deep" : ""));
  }
  StoredImage image;
  image.data = {header.x, header.y, header.width, header.height};
  image.display = {header.full_x, header.full_y, header.full_width, header.full_height};
  if (std::ranges::all_of(header.channels, [&](const auto& c) { return c.type == header.channels[0].type; })) {
    add_channels_of_type(*in, 0, channels, file, image);
  } else {
    for (int c = 0; c < channels; ++c) add_channels_of_type(*in, c, c + 1, file, image);
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
  const auto other = std::ranges::find_if(image.channels, [&](const auto& c) { return c.scale != scale; });
  if (image.channels.size() == count && other == image.channels.end()) return;
  const auto numbers = [](double largest) { return largest == 1 ? "floats" : fmt::format("codes up to {}", largest); };
  throw ImageError(fmt::format("{}: expected {} channels of {}, found {}{}", file.string(), count, numbers(scale),
                               image.channels.size(),
                               other == image.channels.end() ? "" : ", one of " + numbers(other->scale)));
}

}  // namespace

Plane<glm::vec4> frame_color(const fs::path& file, const StoredImage& image, ColorFormat format) {
  const double largest = color_scale(format);
  const double scale = largest == 0 ? 1 : largest == 255 ? 255 : 65535;  // 12-bit codes are spread over 16 bits
  require_channels(file, image, 4, scale);
  Plane<glm::vec4> out(image.data.width, image.data.height);
  for (int c = 0; c < 4; ++c) {
    const auto& stored = image.channels[static_cast<std::size_t>(c)].values.values();
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

std::string image_library_version() { return image_codec().version; }

}  // namespace plumbline
