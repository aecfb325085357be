// Planes as text for a page's script: every number, exact, and small.
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

/// Codes if `scale` is above 0 and each value is one, or no more than `off` of a code from one in the range; else
/// floats.
Numbers numbers_of(const Plane<glm::vec4>& plane, double scale, double off = 0.01);
Numbers numbers_of(const Plane<double>& plane, double scale, double off = 0.01);
/// Whole numbers.
Numbers numbers_of(const Plane<std::int32_t>& plane);
Numbers numbers_of(const Plane<std::uint32_t>& plane);
Numbers numbers_of(const Plane<std::uint8_t>& plane);

/// The part of it; empty of an empty one.
Numbers cropped(const Numbers& numbers, int x, int y, int width, int height);

/// Bytes a number: 1, 2 or 4, as its scale wants.
int bytes_of(const Numbers& numbers);
/// The numbers less those of `base`, if that is of the same shape; of these what each is more than the one a pixel
/// before; their first bytes, then their second, ...; deflated (RFC 1950); in base64 (RFC 4648). All modulo 2^(8
/// bytes).
std::string packed(const Numbers& numbers, const Numbers* base = nullptr);
/// A text, deflated, in base64.
std::string packed(std::string_view text);
bool same_shape(const Numbers& a, const Numbers& b);

}  // namespace plumbline::report
