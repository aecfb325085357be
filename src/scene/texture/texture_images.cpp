#include "scene/texture/texture_images.h"

namespace plumbline {
namespace {

/// Image whose texel (x, y) is color(x, y).
template <class Color>
TextureLevel make(int width, int height, Color color) {
  TextureLevel out{width, height, {}};
  out.texels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) out.texels.push_back(color(x, y));
  }
  return out;
}

/// Cell of texel i's centre, of `cells` along `size` texels; exact, in integers.
int cell(int i, int size, int cells) {
  return static_cast<int>((2 * static_cast<std::int64_t>(i) + 1) * cells / (2 * static_cast<std::int64_t>(size)));
}

/// True: texel i is the first of its cell.
bool begins(int i, int size, int cells) { return i == 0 || cell(i, size, cells) != cell(i - 1, size, cells); }

/// Hash of an integer (Wellons' lowbias32).
std::uint32_t mixed(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

}  // namespace

TextureLevel make_checker(int width, int height, int columns, int rows, const std::array<glm::vec4, 2>& colors) {
  return make(width, height, [&](int x, int y) {
    return colors[static_cast<std::size_t>((cell(x, width, columns) + cell(y, height, rows)) % 2)];
  });
}

TextureLevel make_gradient(int width, int height, const std::array<glm::vec4, 4>& corners) {
  const auto share = [](int i, int size) { return size == 1 ? 0.5 : static_cast<double>(i) / (size - 1); };
  return make(width, height, [&](int x, int y) {
    const double s = share(x, width), t = share(y, height);
    const glm::dvec4 low = (1 - s) * glm::dvec4(corners[0]) + s * glm::dvec4(corners[1]);
    const glm::dvec4 high = (1 - s) * glm::dvec4(corners[3]) + s * glm::dvec4(corners[2]);
    return glm::vec4((1 - t) * low + t * high);
  });
}

TextureLevel make_bricks(int width, int height, int columns, int rows, const glm::vec4& brick,
                         const glm::vec4& mortar) {
  return make(width, height, [&](int x, int y) {
    const int shift = cell(y, height, rows) % 2 == 1 ? width / (2 * columns) : 0;
    const bool joint = begins(y, height, rows) || begins((x + shift) % width, width, columns);
    return joint ? mortar : brick;
  });
}

TextureLevel make_uv_grid(int width, int height, int columns, int rows) {
  return make(width, height, [&](int x, int y) {
    const bool line = begins(x, width, columns) || begins(y, height, rows);
    return glm::vec4((x + 0.5) / width, (y + 0.5) / height, line ? 1 : 0, 1);
  });
}

TextureLevel make_noise(int width, int height, std::uint32_t seed) {
  return make(width, height, [&](int x, int y) {
    glm::vec4 color;
    for (int c = 0; c < 4; ++c) {
      const std::uint32_t place = mixed(mixed(mixed(seed) + static_cast<std::uint32_t>(x)) +
                                        static_cast<std::uint32_t>(y) * 4 + static_cast<std::uint32_t>(c));
      color[c] = static_cast<float>(place >> 24) / 255.0f;
    }
    return color;
  });
}

}  // namespace plumbline
