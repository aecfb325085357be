#include "scene/texture/texture_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "images/image_codec.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, std::string_view expected, std::string_view found) {
  throw TextureError(fmt::format("{}: expected {}, found {}", file.string(), expected, found));
}

/// Divisor of stored numbers: the largest code, 1 for floats. Codes are read as stored, since OpenImageIO's own
/// conversion to float rounds in its own way.
template <class T>
constexpr double kScale = std::is_integral_v<T> ? static_cast<double>(std::numeric_limits<T>::max()) : 1.0;

template <class T>
std::vector<double> read_values(OpenImage& in, SampleType type, const fs::path& file) {
  const ImageHeader& header = in.header();
  const std::size_t count =
      static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height) * header.channels.size();
  std::vector<T> stored(count);
  if (!in.read(0, static_cast<int>(header.channels.size()), type, stored.data())) {
    fail(file, "an image that is whole", in.error());
  }
  std::vector<double> values(count);
  std::transform(stored.begin(), stored.end(), values.begin(),
                 [](T value) { return static_cast<double>(value) / kScale<T>; });
  return values;
}

std::vector<double> read_values(OpenImage& in, const fs::path& file) {
  switch (in.header().type) {
    case SampleType::uint8: return read_values<std::uint8_t>(in, SampleType::uint8, file);
    case SampleType::uint16: return read_values<std::uint16_t>(in, SampleType::uint16, file);
    case SampleType::float16:
    case SampleType::float32: return read_values<float>(in, SampleType::float32, file);
    default: fail(file, "codes of 8 or 16 bits, or floats", in.header().type_name);
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
  std::string error;
  const auto in = image_codec().open(file.string(), error);
  if (!in) fail(file, "an image", error);
  const ImageHeader& header = in->header();
  if (header.several) fail(file, "one image", "several (parts, frames or MIP levels)");
  const std::size_t channels = header.channels.size();
  if (header.width < 1 || header.height < 1 || header.depth != 1 || header.deep || channels < 1 || channels > 4) {
    fail(file, "flat texels of 1 to 4 channels",
         fmt::format("{} channels of {} x {} x {}{}", channels, header.width, header.height, header.depth,
                     header.deep ? ", deep" : ""));
  }
  if (header.width > kLargestTexture || header.height > kLargestTexture ||
      static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height) > most_texels) {
    fail(file, fmt::format("at most {} texels a side, and {} more in all", kLargestTexture, most_texels),
         fmt::format("{} x {}", header.width, header.height));
  }
  const std::vector<double> values = read_values(*in, file);
  const auto width = static_cast<std::size_t>(header.width);
  constexpr double kLargest = 65504;
  TextureImage image{{header.width, header.height, std::vector<glm::vec4>(values.size() / channels, glm::vec4(1))},
                     static_cast<int>(channels)};
  for (std::size_t i = 0; i < image.rgba.texels.size(); ++i) {
    const std::size_t x = i % width, row = static_cast<std::size_t>(header.height) - 1 - i / width;  // files go down
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
