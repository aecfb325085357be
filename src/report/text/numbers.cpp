#include "report/text/numbers.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace plumbline::report {

namespace {

bool is_code(double value, double scale, double off) {
  const double code = value * scale;
  return code >= -off && code <= scale + off && std::abs(code - std::round(code)) <= off;
}

template <class T, class Visit>
void each_value(const Plane<T>& plane, Visit visit) {
  for (const T& value : plane.values()) visit(static_cast<double>(value));
}
template <class Visit>
void each_value(const Plane<glm::vec4>& plane, Visit visit) {
  for (const glm::vec4& color : plane.values()) {
    for (int c = 0; c < 4; ++c) visit(static_cast<double>(color[c]));
  }
}

template <class T>
Numbers codes_or_floats(const Plane<T>& plane, int channels, double scale, double off) {
  Numbers out{plane.width(), plane.height(), channels, scale, {}};
  if (scale > 0) each_value(plane, [&](double v) { out.scale = is_code(v, scale, off) ? out.scale : 0; });
  each_value(plane, [&](double v) {
    out.values.push_back(out.scale > 0 ? static_cast<std::uint32_t>(std::lround(std::clamp(v, 0.0, 1.0) * scale))
                                       : std::bit_cast<std::uint32_t>(static_cast<float>(v)));
  });
  return out;
}

template <class T>
Numbers whole(const Plane<T>& plane) {
  Numbers out{plane.width(), plane.height(), 1, -1, {}};
  for (const T v : plane.values()) out.values.push_back(static_cast<std::uint32_t>(v));
  return out;
}

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  const auto* in = reinterpret_cast<const Bytef*>(bytes.data());
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, in, static_cast<uLong>(bytes.size()),
                Z_DEFAULT_COMPRESSION) != Z_OK)
    throw std::runtime_error("zlib does not compress");
  out.resize(size);
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::string_view three = bytes.substr(i, 3);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (k < three.size() ? static_cast<std::uint8_t>(three[k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += k <= three.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

}  // namespace

Numbers numbers_of(const Plane<glm::vec4>& plane, double scale, double off) {
  return codes_or_floats(plane, 4, scale, off);
}
Numbers numbers_of(const Plane<double>& plane, double scale, double off) {
  return codes_or_floats(plane, 1, scale, off);
}
Numbers numbers_of(const Plane<std::int32_t>& plane) { return whole(plane); }
Numbers numbers_of(const Plane<std::uint32_t>& plane) { return whole(plane); }
Numbers numbers_of(const Plane<std::uint8_t>& plane) { return whole(plane); }

Numbers cropped(const Numbers& n, int x, int y, int width, int height) {
  if (n.empty() || (width == n.width && height == n.height)) return n;
  Numbers out{width, height, n.channels, n.scale, {}};
  for (int row = y; row < y + height; ++row) {
    const auto first = n.values.begin() + (static_cast<std::ptrdiff_t>(row) * n.width + x) * n.channels;
    out.values.insert(out.values.end(), first, first + static_cast<std::ptrdiff_t>(width) * n.channels);
  }
  return out;
}

int bytes_of(const Numbers& n) { return n.scale <= 0 || n.scale > 65535 ? 4 : n.scale > 255 ? 2 : 1; }

bool same_shape(const Numbers& a, const Numbers& b) {
  return a.width == b.width && a.height == b.height && a.channels == b.channels && a.scale == b.scale;
}

std::string packed(const Numbers& n, const Numbers* base) {
  const bool based = base != nullptr && same_shape(n, *base);
  const auto value = [&](std::size_t i) { return n.values[i] - (based ? base->values[i] : 0); };
  const auto channels = static_cast<std::size_t>(n.channels);
  std::string bytes;
  for (int byte = 0; byte < bytes_of(n); ++byte) {
    for (std::size_t i = 0; i < n.values.size(); ++i) {
      const std::uint32_t step = value(i) - (i >= channels ? value(i - channels) : 0);
      bytes += static_cast<char>(step >> (8 * byte) & 0xff);
    }
  }
  return packed(bytes);
}

std::string packed(std::string_view text) { return base64(deflated(text)); }

}  // namespace plumbline::report
