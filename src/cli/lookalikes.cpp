#include "cli/lookalikes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/options/renderers.h"
#include "scene/draw_index.h"

namespace plumbline::cli {

namespace {

constexpr float kCode = 1.0f / 255;

ColorAndDepth drawn(const Scene& scene, const std::string& fault) {
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

std::size_t pixels_apart(const Scene& scene, const ColorAndDepth& given, const ColorAndDepth& other, Eye eye) {
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
ColorAndDepth changed(const ColorAndDepth& from, Change change) {
  ColorAndDepth out = from;
  for (int y = 0; y < out.color.height(); ++y) {
    for (int x = 0; x < out.color.width(); ++x) change(out, x, y);
  }
  return out;
}

float encoded(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

using Measure = std::function<std::size_t(const ColorAndDepth&)>;

// A known mistake, and how many pixels it leaves apart.
struct Lookalike {
  std::string stage, name, says;
  std::size_t apart;
};

// Mistakes that are made of a right frame on its way into a file.
std::vector<Lookalike> of_files(const ColorAndDepth& right, const Measure& measure) {
  const int width = right.color.width(), height = right.color.height();
  const auto from = [&](ColorAndDepth& out, int x, int y, int from_x, int from_y) {
    out.color(x, y) = right.color(from_x, from_y);
    if (!out.depth.empty()) out.depth(x, y) = right.depth(from_x, from_y);
  };
  const auto reversed = [&](ColorAndDepth& out, int x, int y) { from(out, x, y, x, height - 1 - y); };
  const auto mirrored = [&](ColorAndDepth& out, int x, int y) { from(out, x, y, width - 1 - x, y); };
  const auto swapped = [](ColorAndDepth& out, int x, int y) { std::swap(out.color(x, y).r, out.color(x, y).b); };
  const auto srgb = [](ColorAndDepth& out, int x, int y) {
    const glm::vec4 c = glm::clamp(out.color(x, y), 0.0f, 1.0f);
    out.color(x, y) = glm::vec4(encoded(c.r), encoded(c.g), encoded(c.b), 1);
  };
  const auto of_ndc = [](ColorAndDepth& out, int x, int y) { out.depth(x, y) = 2 * out.depth(x, y) - 1; };
  const auto farthest_first = [](ColorAndDepth& out, int x, int y) { out.depth(x, y) = 1 - out.depth(x, y); };
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

bool has_one_color(const Plane<glm::vec4>& plane, const glm::vec4& color) {
  return std::ranges::none_of(plane.values(), [&](const glm::vec4& c) { return colors_apart(color, c, 1.5f); });
}

// Line for people about a frame whose pixels all have one colour and, where depth is known, the clear depth within a
// code of 16 bits. Empty of other frames, and where ours has one colour, too.
std::string said_of_blank(const FrameFormat& frame, const ColorAndDepth& given, const ColorAndDepth& right) {
  const glm::vec4 color = given.color.values().front();
  const auto drawn_at = [&](double z) { return !(std::abs(z - frame.clear_depth) <= 1.0 / 65535); };
  if (!has_one_color(given.color, color) || std::ranges::any_of(given.depth.values(), drawn_at)) return "";
  if (!colors_apart(frame.clear_color, color, 1.5f)) return "every pixel has the clear colour: nothing is drawn\n";
  if (has_one_color(right.color, right.color.values().front())) return "";
  return fmt::format(
      "every pixel has the colour {:.3g}, {:.3g}, {:.3g}, and not the clear colour: nothing of the scene "
      "is seen\n",
      color.r, color.g, color.b);
}

}  // namespace

Lookalikes lookalikes(const Scene& scene, const ColorAndDepth& given) {
  const ColorAndDepth right = drawn(scene, "");
  // Where all is within a code, half a code counts: truncation is no more.
  Eye eye;
  const bool coarse = pixels_apart(scene, given, right, eye) > 0;
  if (!coarse) eye = {0.5f, false};
  const Measure measure = [&](const ColorAndDepth& frame) { return pixels_apart(scene, given, frame, eye); };
  const std::size_t apart = measure(right);
  if (apart == 0) return {};
  if (std::string said = said_of_blank(scene.frame, given, right); !said.empty()) {
    Lookalikes out;
    out.apart = apart, out.codes = coarse ? 1 : 0.5, out.blank = true;
    out.text = std::move(said);
    return out;
  }
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

}  // namespace plumbline::cli
