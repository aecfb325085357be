#include "stages/image_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <string>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "stages/atomic_path.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

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

/// The file's bytes; `name`, for the message, also says the format by its ending.
Bytes encode(const std::string& name, const OIIO::ImageSpec& spec, const void* pixels) {
  Bytes bytes;
  OIIO::Filesystem::IOVecOutput proxy(bytes);
  const auto out = OIIO::ImageOutput::create(name, &proxy);
  if (!out) throw ImageError(fmt::format("{}: cannot be written: {}", name, OIIO::geterror()));
  if (!out->open(name, spec) || !out->write_image(spec.format, pixels) || !out->close()) {
    throw ImageError(fmt::format("{}: cannot be written: {}", name, out->geterror()));
  }
  return bytes;
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

void write_file(const fs::path& file, const Bytes& bytes) {
  try {
    AtomicPath atomic(file);
    std::ofstream out(atomic.path(), std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) throw ImageError(fmt::format("{}: cannot be written", file.string()));
    if (fs::is_directory(file)) throw ImageError(fmt::format("{}: cannot be written: a folder", file.string()));
    atomic.commit();
  } catch (const fs::filesystem_error& error) {
    throw ImageError(fmt::format("{}: cannot be written: {}", file.string(), error.what()));
  }
}

template <class T>
void require_pixels(const std::string& name, const Plane<T>& plane) {
  if (plane.empty()) throw ImageError(fmt::format("{}: expected an image with pixels, found an empty plane", name));
}

Bytes encode_png(const std::string& name, const Plane<glm::vec4>& plane) {
  require_pixels(name, plane);
  Bytes pixels;
  pixels.reserve(4 * plane.size());
  top_down(plane, [&](const glm::vec4& p) {
    for (int c = 0; c < 4; ++c) pixels.push_back(code(p[c]));
  });
  return encode(name, spec_of(plane.width(), plane.height(), 4, OIIO::TypeDesc::UINT8), pixels.data());
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

std::vector<std::uint8_t> encode_png(const Plane<glm::vec4>& plane) { return encode_png("image.png", plane); }

void write_png(const fs::path& file, const Plane<glm::vec4>& plane) {
  require_ending(file, ".png");
  write_file(file, encode_png(file.string(), plane));
}

void write_exr(const fs::path& file, const Plane<glm::vec4>& plane) {
  require_ending(file, ".exr");
  require_pixels(file.string(), plane);
  std::vector<glm::vec4> pixels;
  pixels.reserve(plane.size());
  top_down(plane, [&](const glm::vec4& p) { pixels.push_back(p); });
  const OIIO::ImageSpec spec = spec_of(plane.width(), plane.height(), 4, OIIO::TypeDesc::FLOAT);
  write_file(file, encode(file.string(), spec, pixels.data()));
}

void write_depth_exr(const fs::path& file, const Plane<double>& plane) {
  require_ending(file, ".exr");
  require_pixels(file.string(), plane);
  std::vector<float> pixels;
  pixels.reserve(plane.size());
  top_down(plane, [&](double z) { pixels.push_back(static_cast<float>(z)); });
  OIIO::ImageSpec spec = spec_of(plane.width(), plane.height(), 1, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"Z"};
  spec.z_channel = 0;
  write_file(file, encode(file.string(), spec, pixels.data()));
}

void write_image(const fs::path& file, const Plane<glm::vec4>& plane) {
  const std::string ending = ending_of(file);
  if (ending == ".png") return write_png(file, plane);
  if (ending == ".exr") return write_exr(file, plane);
  throw ImageError(fmt::format("{}: expected a file name ending in .png or .exr", file.string()));
}

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
