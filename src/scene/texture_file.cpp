#include "scene/texture_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

// After fmt: OpenImageIO would include it as headers only, without exceptions, and this file's copy of fmt's functions
// would be the whole program's.
#include <OpenImageIO/imageio.h>

namespace plumbline {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, std::string_view expected, std::string_view found) {
  throw TextureError(fmt::format("{}: expected {}, found {}", file.string(), expected, found));
}

/// What a stored number is divided by. OpenImageIO converts codes to floats itself, rounding as it likes: they are read
/// as they are stored.
template <class T>
constexpr double kScale = std::is_integral_v<T> ? static_cast<double>(std::numeric_limits<T>::max()) : 1.0;

template <class T>
std::vector<double> read_values(OIIO::ImageInput& in, OIIO::TypeDesc type, std::size_t count, const fs::path& file) {
  std::vector<T> stored(count);
  if (!in.read_image(0, 0, 0, -1, type, stored.data())) fail(file, "an image that is whole", in.geterror());
  std::vector<double> values(count);
  std::transform(stored.begin(), stored.end(), values.begin(),
                 [](T value) { return static_cast<double>(value) / kScale<T>; });
  return values;
}

std::vector<double> read_values(OIIO::ImageInput& in, const OIIO::ImageSpec& spec, const fs::path& file) {
  const std::size_t count = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                            static_cast<std::size_t>(spec.nchannels);
  switch (spec.format.basetype) {
    case OIIO::TypeDesc::UINT8: return read_values<std::uint8_t>(in, OIIO::TypeDesc::UINT8, count, file);
    case OIIO::TypeDesc::UINT16: return read_values<std::uint16_t>(in, OIIO::TypeDesc::UINT16, count, file);
    case OIIO::TypeDesc::HALF:
    case OIIO::TypeDesc::FLOAT: return read_values<float>(in, OIIO::TypeDesc::FLOAT, count, file);
    default: fail(file, "codes of 8 or 16 bits, or floats", spec.format.c_str());
  }
}

}  // namespace

TextureImage load_texture_image(const fs::path& file, std::size_t most_texels) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  const std::vector<std::string> endings = {".png", ".jpg", ".jpeg", ".tga", ".exr"};
  if (std::find(endings.begin(), endings.end(), ending) == endings.end()) {
    fail(file, "an image ending in .png, .jpg, .jpeg, .tga or .exr", fmt::format("\"{}\"", ending));
  }
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  config.attribute("oiio:RawColor", 1);
  const auto in = OIIO::ImageInput::open(file.string(), &config);
  if (!in) fail(file, "an image", OIIO::geterror());
  if (in->seek_subimage(0, 1) || in->seek_subimage(1, 0) || !in->seek_subimage(0, 0)) {
    fail(file, "one image", "several (parts, frames or MIP levels)");
  }
  const OIIO::ImageSpec spec = in->spec();
  if (spec.width < 1 || spec.height < 1 || spec.depth != 1 || spec.deep || spec.nchannels < 1 || spec.nchannels > 4) {
    fail(file, "flat texels of 1 to 4 channels",
         fmt::format("{} channels of {} x {} x {}{}", spec.nchannels, spec.width, spec.height, spec.depth,
                     spec.deep ? ", deep" : ""));
  }
  if (spec.width > kLargestTexture || spec.height > kLargestTexture ||
      static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) > most_texels) {
    fail(file, fmt::format("at most {} texels a side, and {} more in all", kLargestTexture, most_texels),
         fmt::format("{} x {}", spec.width, spec.height));
  }
  const std::vector<double> values = read_values(*in, spec, file);
  const auto channels = static_cast<std::size_t>(spec.nchannels), width = static_cast<std::size_t>(spec.width);
  constexpr double kLargest = 65504;
  TextureImage image{{spec.width, spec.height, std::vector<glm::vec4>(values.size() / channels, glm::vec4(1))},
                     spec.nchannels};
  for (std::size_t i = 0; i < image.rgba.texels.size(); ++i) {
    const std::size_t x = i % width, row = static_cast<std::size_t>(spec.height) - 1 - i / width;  // files go down
    const double* from = &values[(row * width + x) * channels];
    for (std::size_t c = 0; c < channels; ++c) {
      if (!(std::abs(from[c]) <= kLargest)) {
        fail(file, fmt::format("finite numbers up to +-{}", kLargest),
             fmt::format("{} in channel {} of texel {}, {}", from[c], c, x, i / width));
      }
    }
    const auto value = [&](std::size_t c) { return static_cast<float>(from[c]); };
    glm::vec4& to = image.rgba.texels[i];
    to = channels < 3 ? glm::vec4(value(0), value(0), value(0), 1) : glm::vec4(value(0), value(1), value(2), 1);
    if (channels % 2 == 0) to.a = value(channels - 1);
  }
  return image;
}

}  // namespace plumbline
