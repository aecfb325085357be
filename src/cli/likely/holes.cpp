#include "cli/likely/holes.h"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

#include "capture/by_conventions.h"
#include "cli/likely/known_faults.h"

namespace plumbline::cli {

namespace {

constexpr float kCodes = 1.5f;  // of 8 bits

// Whether the pixel has the clear colour and, where depths are known, the clear depth.
bool is_cleared(const FrameFormat& format, const ColorAndDepth& frame, std::size_t i) {
  const bool has_clear_depth = frame.depth.empty() || is_clear_depth(format, frame.depth.values()[i]);
  return has_clear_depth && !colors_apart(format.clear_color, frame.color.values()[i], kCodes);
}

// Where the surface at the pixel lies, by a depth outside 0 to 1.
enum class Beyond { neither, near_plane, far_plane };
Beyond beyond_planes(const ColorAndDepth& frame, std::size_t i) {
  constexpr double kOfFloat = 0x1p-20;  // the error of depths in float [window z]
  if (frame.depth.empty()) return Beyond::neither;
  const double z = frame.depth.values()[i];
  return z > 1 + kOfFloat ? Beyond::far_plane : z < -kOfFloat ? Beyond::near_plane : Beyond::neither;
}

// Whether depths 0 and 1 are those of the planes, and both cut.
bool is_cut_at_0_and_1(const Scene& scene) {
  const auto is_whole = [](const Draw& draw) { return draw.depth_range == DepthRange{}; };
  return !scene.depth_clamp && std::ranges::all_of(scene.draws, is_whole);
}

std::string beyond_text(std::size_t pixels, const char* plane) {
  if (pixels == 0) return "";
  return fmt::format("depths beyond the {} plane, where all is clipped: {} of these pixels\n", plane, pixels);
}

}  // namespace

std::string holes_text(const Scene& scene, const GivenFrame& given) {
  if (antialiased(scene)) return "";
  const SceneByConventions seen(scene, given.conventions);
  const ColorAndDepth ours = draw_with({}, *seen, given.conventions);
  if (ours.color.size() != given.color.size()) return "";
  const bool knows_legal = given.is_legal.size() == given.color.size();
  std::size_t wrong = 0, holes = 0, drawn = 0, before_near = 0, beyond_far = 0;
  for (std::size_t i = 0; i < given.color.size(); ++i) {
    const bool is_wrong = knows_legal ? given.is_legal.values()[i] == 0
                                      : colors_apart(ours.color.values()[i], given.color.values()[i], kCodes);
    if (!is_wrong) continue;
    ++wrong;
    const bool is = is_cleared(seen->frame, given, i), expected = is_cleared(seen->frame, ours, i);
    holes += is && !expected;
    drawn += !is && expected;
    before_near += beyond_planes(given, i) == Beyond::near_plane;
    beyond_far += beyond_planes(given, i) == Beyond::far_plane;
  }
  if (wrong == 0 || 2 * (holes + drawn) < wrong) return "";
  const std::string counted = fmt::format(
      "of {} wrong pixels, {} are as cleared where a surface is to be seen, {} show one where none is: coverage, what "
      "is clipped or culled before it, a test of depth, stencil or alpha, or the clear\n",
      wrong, holes, drawn);
  if (!is_cut_at_0_and_1(*seen)) return counted;
  return counted + beyond_text(before_near, "near") + beyond_text(beyond_far, "far");
}

}  // namespace plumbline::cli
