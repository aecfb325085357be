// plumb diagnose --picture, and the last lines of other diagnoses: what a frame alone can tell.
#include "cli/lookalikes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "capture/files/image_file.h"
#include "cli/commands.h"
#include "cli/options/renderers.h"
#include "scene/draw_index.h"

namespace plumbline::cli {

namespace {

constexpr float kCode = 1.0f / 255;

Pictured drawn(const Scene& scene, const std::string& fault) {
  Request request;
  request.planes = WantedPlanes::picture;
  Planes planes = make_candidate(fault)->capture(scene, request).planes;
  return {std::move(planes.color), std::move(planes.depth)};
}

// Red, green or blue differ by more than so many codes of 8 bits.
bool colors_apart(const glm::vec4& a, const glm::vec4& b, float codes) {
  const glm::vec3 off = glm::abs(glm::clamp(glm::vec3(a), 0.0f, 1.0f) - glm::clamp(glm::vec3(b), 0.0f, 1.0f));
  const float most = codes * kCode;
  return !(off.x <= most && off.y <= most && off.z <= most) || std::isnan(b.x + b.y + b.z);
}

// Rule of what counts as a difference: depths differ by more than a step of their format, and by what planes in float
// may.
struct Eye {
  float codes = 1.5f;
  bool sees_depth = true;
};
constexpr double kFloatDepth = 0x1p-20;

std::size_t pixels_apart(const Scene& scene, const Pictured& given, const Pictured& other, Eye eye) {
  const bool by_depth = eye.sees_depth && !given.depth.empty() && given.depth.size() == other.depth.size();
  std::size_t count = 0;
  for (std::size_t i = 0; i < given.color.size(); ++i) {
    bool apart = colors_apart(other.color.values()[i], given.color.values()[i], eye.codes);
    if (by_depth && !apart) {
      const double z = other.depth.values()[i];
      const double most = std::max(1.5 * depth_step(scene.frame.depth, z), kFloatDepth);
      apart = !(std::abs(given.depth.values()[i] - z) <= most);
    }
    count += apart;
  }
  return count;
}

template <class Change>
Pictured changed(const Pictured& from, Change change) {
  Pictured out = from;
  for (int y = 0; y < out.color.height(); ++y) {
    for (int x = 0; x < out.color.width(); ++x) change(out, x, y);
  }
  return out;
}

float encoded(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

using Measure = std::function<std::size_t(const Pictured&)>;

// A known mistake, and how many pixels it leaves apart.
struct Lookalike {
  std::string stage, name, says;
  std::size_t apart;
};

// Mistakes that are made of a right frame on its way into a file.
std::vector<Lookalike> of_files(const Pictured& right, const Measure& measure) {
  const int width = right.color.width(), height = right.color.height();
  const auto from = [&](Pictured& out, int x, int y, int from_x, int from_y) {
    out.color(x, y) = right.color(from_x, from_y);
    if (!out.depth.empty()) out.depth(x, y) = right.depth(from_x, from_y);
  };
  const auto reversed = [&](Pictured& out, int x, int y) { from(out, x, y, x, height - 1 - y); };
  const auto mirrored = [&](Pictured& out, int x, int y) { from(out, x, y, width - 1 - x, y); };
  const auto swapped = [](Pictured& out, int x, int y) { std::swap(out.color(x, y).r, out.color(x, y).b); };
  const auto srgb = [](Pictured& out, int x, int y) {
    const glm::vec4 c = glm::clamp(out.color(x, y), 0.0f, 1.0f);
    out.color(x, y) = glm::vec4(encoded(c.r), encoded(c.g), encoded(c.b), 1);
  };
  const auto of_ndc = [](Pictured& out, int x, int y) { out.depth(x, y) = 2 * out.depth(x, y) - 1; };
  const auto farthest_first = [](Pictured& out, int x, int y) { out.depth(x, y) = 1 - out.depth(x, y); };
  std::vector<Lookalike> out;
  const auto add = [&](const char* name, const char* says, auto change) {
    out.push_back({"file", name, says, measure(changed(right, change))});
  };
  add("file.rows_reversed", "the rows are written from the other end", reversed);
  add("file.mirrored", "the columns are written from the other end", mirrored);
  add("file.bgr", "red and blue are swapped", swapped);
  add("file.srgb", "colours are encoded as sRGB once more", srgb);
  if (right.depth.empty()) return out;
  add("file.depth_of_ndc", "depths are in [-1, 1], those of normalized device coordinates", of_ndc);
  add("file.depth_reversed", "depths are 1 at the near plane and 0 at the far one", farthest_first);
  return out;
}

// Mistakes whose frames are nearer than ours, the nearest first.
Lookalikes ranked(std::vector<Lookalike> all, std::size_t apart) {
  Lookalikes out;
  out.apart = apart;
  std::erase_if(all, [&](const Lookalike& l) { return l.apart >= apart; });
  std::ranges::stable_sort(all, {}, &Lookalike::apart);
  if (all.empty()) {
    out.text = "no known fault draws a frame that is nearer\n";
    return out;
  }
  constexpr std::size_t kShown = 8;
  out.text = "explains  pixels left  fault\n";
  for (const Lookalike& l : std::span(all).first(std::min(all.size(), kShown))) {
    const double explained = 100.0 * static_cast<double>(apart - l.apart) / static_cast<double>(apart);
    out.text += fmt::format("{:>6.1f} % {:>12}  {:<36} {}\n", explained, l.apart, l.name, l.says);
  }
  const Lookalike& nearest = all.front();
  if (10 * nearest.apart <= apart) out.likely = fmt::format("{} (fault {})", nearest.stage, nearest.name);
  out.whole = nearest.apart == 0;
  return out;
}

// A picture's rows are the file's from its end, whatever the scene's order is.
template <class T>
Plane<T> in_scenes_order(const Scene& scene, Plane<T> plane) {
  return rows_from_top(scene.dialect) ? upside_down(plane) : plane;
}

template <class T>
void require_size(const std::string& file, const Plane<T>& plane, const Scene& scene) {
  if (plane.width() == scene.frame.width && plane.height() == scene.frame.height) return;
  throw std::runtime_error(fmt::format("{}: expected a picture of the scene's {} x {} pixels, found one of {} x {}",
                                       file, scene.frame.width, scene.frame.height, plane.width(), plane.height()));
}

}  // namespace

Lookalikes lookalikes(const Scene& scene, const Pictured& given) {
  const Pictured right = drawn(scene, "");
  // Where all is within a code, half a code counts: truncation is no more.
  Eye eye;
  const bool coarse = pixels_apart(scene, given, right, eye) > 0;
  if (!coarse) eye = {0.5f, false};
  const Measure measure = [&](const Pictured& frame) { return pixels_apart(scene, given, frame, eye); };
  const std::size_t apart = measure(right);
  if (apart == 0) return {};
  std::vector<Lookalike> all = of_files(right, measure);
  for (const FaultInfo& fault : fault_infos()) {
    const std::string name(fault.name);
    all.push_back({std::string(fault.stage), name, std::string(fault.changes), measure(drawn(scene, name))});
  }
  Lookalikes out = ranked(std::move(all), apart);
  if (!coarse && out.likely.empty()) return {};  // rounded otherwise
  if (!coarse) out.codes = 0.5;
  return out;
}

std::string likely_of(const Lookalikes& found, const check::SceneVerdict& verdict) {
  std::uint64_t wrong = 0;
  for (const check::Comparison& c : verdict.comparisons) {
    if (c.stage == Stage::merge && c.outcome == check::Outcome::different)
      wrong = std::max(wrong, c.measurement.differing);
  }
  return 2 * found.apart < wrong ? "" : found.likely;
}

std::string likely_fault(const Scene& scene, const Capture& left, const check::SceneVerdict& verdict) {
  constexpr std::size_t kMostPrimitives = 20'000, kMostPixels = 200'000;  // each fault is a picture
  const Plane<glm::vec4>& color = left.planes.color;
  if (color.empty() || color.size() > kMostPixels || DrawIndex(scene).primitives() > kMostPrimitives ||
      scene.frame.antialias.kind != Antialias::Kind::none || color.width() != scene.frame.width ||
      color.height() != scene.frame.height)
    return "";
  return likely_of(lookalikes(scene, {color, left.planes.depth}), verdict);
}

int diagnose_picture(const DiagnoseOptions& o) {
  const Scene scene = o.scene_arguments.load(o.scene);
  require_budget(scene, plane_bytes(scene), Request{}.memory_budget);
  Pictured given;
  given.color = in_scenes_order(scene, read_image(o.picture));
  require_size(o.picture, given.color, scene);
  if (!o.depth.empty() && std::filesystem::path(o.depth).extension() != ".exr") {
    throw std::invalid_argument(fmt::format("--depth: expected an .exr file of window z, found {}", o.depth));
  }
  if (!o.depth.empty()) {
    const Plane<glm::vec4> depth = in_scenes_order(scene, read_image(o.depth));
    require_size(o.depth, depth, scene);
    given.depth = Plane<double>(depth.width(), depth.height());
    std::ranges::transform(depth.values(), given.depth.values().begin(), [](const glm::vec4& z) { return z.r; });
  }
  const Lookalikes found = lookalikes(scene, given);
  fmt::print("{}: {} of {} pixels are more than {}/255{} from ours\n", o.picture, found.apart, given.color.size(),
             found.codes, o.depth.empty() ? "" : ", or a step of depth,");
  if (found.apart == 0) return kHolds;
  fmt::print("{}", found.text);
  if (!found.likely.empty()) fmt::print("likely stage: {}\n", found.likely);
  return kDiffers;
}

}  // namespace plumbline::cli
