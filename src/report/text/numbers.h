// Planes as compressed text for a page's script, without loss.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "capture/plane.h"

namespace plumbline::report {

/// A plane's numbers as unsigned integers, `channels` a pixel, row 0 first: the codes of values code / scale where
/// `scale` is above 0, the bits of floats where it is 0, else (below 0) whole numbers modulo 2^32.
struct Numbers {
  int width = 0, height = 0, channels = 1;
  double scale = -1;
  std::vector<std::uint32_t> values;

  bool empty() const { return values.empty(); }
};

/// Codes if `scale` is above 0 and each value is in the range of codes and within `off` [codes] of one; else floats.
Numbers numbers_of(const Plane<glm::vec4>& plane, double scale, double off = 0.01);
Numbers numbers_of(const Plane<double>& plane, double scale, double off = 0.01);
/// Whole numbers.
Numbers numbers_of(const Plane<std::int32_t>& plane);
Numbers numbers_of(const Plane<std::uint32_t>& plane);
Numbers numbers_of(const Plane<std::uint8_t>& plane);

/// The part of width x height numbers from (x, y) on, which must lie inside; empty if `numbers` is.
Numbers cropped(const Numbers& numbers, int x, int y, int width, int height);

/// Bytes per number: 1 or 2 for codes of up to 8 or 16 bits, else 4.
int bytes_of(const Numbers& numbers);
/// Packs in five steps: subtract `base`, if it has the same shape; subtract the pixel before, per channel; all lowest
/// bytes, then all second ones, ... (bytes_of()); deflate (RFC 1950); base64 (RFC 4648). Differences are modulo
/// 2^(8 bytes_of()).
std::string packed(const Numbers& numbers, const Numbers* base = nullptr);
/// A text, deflated, in base64.
std::string packed(std::string_view text);
bool same_shape(const Numbers& a, const Numbers& b);

}  // namespace plumbline::report
