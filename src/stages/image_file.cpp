#include "stages/image_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

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

std::uint8_t code(float value) {
  if (!(value > 0)) return 0;  // NaN, too
  return static_cast<std::uint8_t>(std::floor(std::min(value, 1.0f) * 255.0 + 0.5));
}

OIIO::ImageSpec spec_of(int width, int height, int channels, OIIO::TypeDesc type) {
  OIIO::ImageSpec spec(width, height, channels, type);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("compression", "zip");
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

/// The pixels of an open file in type T, all channels, from the top down.
template <class T>
std::vector<T> read_pixels(OIIO::ImageInput& in, const OIIO::ImageSpec& spec, const fs::path& file) {
  std::vector<T> pixels(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                        static_cast<std::size_t>(spec.nchannels));
  if (in.read_image(0, 0, 0, spec.nchannels, OIIO::BaseTypeFromC<T>::value, pixels.data())) return pixels;
  throw ImageError(fmt::format("{}: cannot be read: {}", file.string(), in.geterror()));
}

template <class T>
Plane<glm::vec4> plane_of(const std::vector<T>& pixels, const OIIO::ImageSpec& spec, double scale) {
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  const bool grey = channels < 3;
  Plane<glm::vec4> plane(spec.width, spec.height, glm::vec4(1));
  auto pixel = pixels.begin();
  for (int y = spec.height - 1; y >= 0; --y) {
    for (int x = 0; x < spec.width; ++x, pixel += static_cast<std::ptrdiff_t>(channels)) {
      const auto channel = [&](std::size_t c) {
        return static_cast<float>(static_cast<double>(pixel[static_cast<std::ptrdiff_t>(c)]) / scale);
      };
      glm::vec4& to = plane(x, y);
      for (std::size_t c = 0; c < 3; ++c) to[static_cast<int>(c)] = channel(grey ? 0 : c);
      if (channels == 2 || channels == 4) to.a = channel(channels - 1);
    }
  }
  return plane;
}

}  // namespace

Bytes encode_png(const fs::path& file, const Plane<glm::vec4>& plane) {
  require_ending(file, ".png");
  require_pixels(file, plane);
  std::vector<std::uint8_t> pixels;
  pixels.reserve(4 * plane.size());
  top_down(plane, [&](const glm::vec4& p) {
    for (int c = 0; c < 4; ++c) pixels.push_back(code(p[c]));
  });
  return encode(file, spec_of(plane.width(), plane.height(), 4, OIIO::TypeDesc::UINT8), pixels.data());
}

Bytes encode_exr(const fs::path& file, const Plane<glm::vec4>& plane) {
  require_ending(file, ".exr");
  require_pixels(file, plane);
  std::vector<glm::vec4> pixels;
  pixels.reserve(plane.size());
  top_down(plane, [&](const glm::vec4& p) { pixels.push_back(p); });
  return encode(file, spec_of(plane.width(), plane.height(), 4, OIIO::TypeDesc::FLOAT), pixels.data());
}

Bytes encode_depth_exr(const fs::path& file, const Plane<double>& plane) {
  require_depth_name(file);
  require_pixels(file, plane);
  std::vector<float> pixels;
  pixels.reserve(plane.size());
  top_down(plane, [&](double z) { pixels.push_back(static_cast<float>(z)); });
  OIIO::ImageSpec spec = spec_of(plane.width(), plane.height(), 1, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"Z"};
  spec.z_channel = 0;
  return encode(file, spec, pixels.data());
}

Bytes encode_image(const fs::path& file, const Plane<glm::vec4>& plane) {
  require_image_name(file);
  return ending_of(file) == ".png" ? encode_png(file, plane) : encode_exr(file, plane);
}

void require_image_name(const fs::path& file) {
  const std::string ending = ending_of(file);
  if (ending == ".png" || ending == ".exr") return;
  throw ImageError(fmt::format("{}: expected a file name ending in .png or .exr", file.string()));
}

void require_depth_name(const fs::path& file) { require_ending(file, ".exr"); }

void write_image(const fs::path& file, const Plane<glm::vec4>& plane) { write_file(file, encode_image(file, plane)); }

Plane<glm::vec4> read_image(const fs::path& file) {
  constexpr int kLargest = 16384;
  if (!fs::is_regular_file(file))
    throw ImageError(fmt::format("{}: expected an image file, found none", file.string()));
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  const auto in = OIIO::ImageInput::open(file.string(), &config);
  if (!in) throw ImageError(fmt::format("{}: cannot be read: {}", file.string(), OIIO::geterror()));
  const OIIO::ImageSpec& spec = in->spec();
  if (spec.width < 1 || spec.height < 1 || spec.depth != 1 || spec.width > kLargest || spec.height > kLargest ||
      spec.nchannels < 1 || spec.nchannels > 4) {
    throw ImageError(fmt::format("{}: expected 1 to 4 channels of up to {} x {} pixels, found {} of {} x {} x {}",
                                 file.string(), kLargest, kLargest, spec.nchannels, spec.width, spec.height,
                                 spec.depth));
  }
  if (spec.format == OIIO::TypeDesc::UINT8) return plane_of(read_pixels<std::uint8_t>(*in, spec, file), spec, 255);
  if (spec.format == OIIO::TypeDesc::UINT16) return plane_of(read_pixels<std::uint16_t>(*in, spec, file), spec, 65535);
  return plane_of(read_pixels<float>(*in, spec, file), spec, 1);
}

}  // namespace plumbline
