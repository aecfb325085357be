#include "cli/options/pixel_argument.h"

#include <charconv>
#include <stdexcept>

#include <fmt/format.h>

namespace plumbline::cli {

glm::ivec2 parse_pixel(const std::string& option, const std::string& text, const FrameFormat& frame) {
  glm::ivec2 out(-1);
  const char* const end = text.data() + text.size();
  const auto [comma, bad_x] = std::from_chars(text.data(), end, out.x);
  const bool two = bad_x == std::errc() && comma != end && *comma == ',';
  const auto [rest, bad_y] = std::from_chars(two ? comma + 1 : end, end, out.y);
  const bool inside = out.x >= 0 && out.y >= 0 && out.x < frame.width && out.y < frame.height;
  if (two && bad_y == std::errc() && rest == end && inside) return out;
  throw std::invalid_argument(fmt::format("{} {}: expected X,Y, a pixel of the frame's {} x {}, from 0,0 to {},{}",
                                          option, text, frame.width, frame.height, frame.width - 1, frame.height - 1));
}

}  // namespace plumbline::cli
