#include "cli/lookalikes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "capture/by_conventions.h"
#include "cli/options/renderers.h"
#include "report/text/conformance.h"
#include "scene/draw_index.h"

namespace plumbline::cli {

namespace {

constexpr float kCode = 1.0f / 255;

void encode(glm::vec4& color) {
  for (int i = 0; i < 3; ++i)
    color[i] = static_cast<float>(srgb_encoded(std::clamp(static_cast<double>(color[i]), 0.0, 1.0)));
}

ColorAndDepth drawn(const Scene& scene, const Conventions& conventions, const std::string& fault,
                    Sides sides = Sides::cut) {
  Request request;
  request.planes = WantedPlanes::picture;
  Planes planes = make_candidate(fault, sides)->capture(scene, request).planes;
  if (conventions.color_encoding == Conventions::Encoding::srgb) std::ranges::for_each(planes.color.values(), encode);
  return {std::move(planes.color), std::move(planes.depth)};
}

// Red, green or blue, and alpha if asked, differ by more than so many codes of 8 bits.
bool colors_apart(const glm::vec4& a, const glm::vec4& b, float codes, bool by_alpha = false) {
  const glm::vec4 off = glm::abs(glm::clamp(a, 0.0f, 1.0f) - glm::clamp(b, 0.0f, 1.0f));
  const float most = codes * kCode;
  const bool near = off.x <= most && off.y <= most && off.z <= most && !std::isnan(b.x + b.y + b.z);
  return !near || (by_alpha && (!(off.w <= most) || std::isnan(b.w)));
}

// Rule of what counts as a difference: more than so many codes of 8 bits, steps of depth, and what depths in float may
// be off; alpha, too.
struct Eye {
  float codes;
  double steps, float_depth;
  bool by_alpha = false;
};
constexpr float kUnseen = std::numeric_limits<float>::infinity();
enum Look { kCoarseByAlpha, kCoarse, kFineColor, kFineDepth };
constexpr bool is_fine(Look look) { return look >= kFineColor; }  // truncation is no more
constexpr std::array<Eye, 4> kEyes = {
    {{1.5f, 1.5, 0x1p-20, true}, {1.5f, 1.5, 0x1p-20}, {0.5f, kUnseen, 0}, {kUnseen, 0.25, 0}}};
using Apart = std::array<std::size_t, kEyes.size()>;  // pixels that differ, by each eye

// By pixel, 1 where the frames differ.
std::vector<std::uint8_t> apart_at(DepthFormat format, const ColorAndDepth& given, const ColorAndDepth& other,
                                   const Eye& eye) {
  const bool by_depth = !given.depth.empty() && given.depth.size() == other.depth.size();
  std::vector<std::uint8_t> out(given.color.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    bool apart = colors_apart(other.color.values()[i], given.color.values()[i], eye.codes, eye.by_alpha);
    if (by_depth && !apart) {
      const double z = other.depth.values()[i];
      const double most = std::max(eye.steps * depth_step(format, z), eye.float_depth);
      apart = !(std::abs(given.depth.values()[i] - z) <= most);
    }
    out[i] = apart ? 1 : 0;
  }
  return out;
}

// Pixels in which frames differ from the one given; where a legal one differs from ours, none.
class Pixels {
 public:
  Pixels(DepthFormat format, const GivenFrame& given, const ColorAndDepth& ours) : format_(format), given_(given) {
    for (std::size_t look = 0; look < kEyes.size(); ++look) {
      std::vector<std::uint8_t>& passed_over = passed_over_[look];
      passed_over.resize(given.color.size());
      if (given.is_legal.size() != given.color.size()) continue;
      passed_over = apart_at(format, given, ours, kEyes[look]);
      for (std::size_t i = 0; i < passed_over.size(); ++i) passed_over[i] &= given.is_legal.values()[i];
    }
  }
  Apart apart(const ColorAndDepth& frame) const {
    Apart out{};
    for (std::size_t look = 0; look < kEyes.size(); ++look) {
      const std::vector<std::uint8_t> differ = apart_at(format_, given_, frame, kEyes[look]);
      for (std::size_t i = 0; i < differ.size(); ++i) out[look] += differ[i] > passed_over_[look][i];
    }
    return out;
  }

 private:
  DepthFormat format_;
  const GivenFrame& given_;
  std::array<std::vector<std::uint8_t>, kEyes.size()> passed_over_;
};

template <class Change>
ColorAndDepth changed(const ColorAndDepth& from, Change change) {
  ColorAndDepth out = from;
  for (int y = 0; y < out.color.height(); ++y) {
    for (int x = 0; x < out.color.width(); ++x) change(out, x, y);
  }
  return out;
}

using Measure = std::function<Apart(const ColorAndDepth&)>;

// A known mistake, and how many pixels it leaves apart.
struct Lookalike {
  std::string stage, name, says;
  Apart apart;
};

// The frame moved by whole pixels; what moves in is clear.
ColorAndDepth moved(const FrameFormat& frame, const ColorAndDepth& right, glm::ivec2 by) {
  const auto inside = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < right.color.width() && y < right.color.height();
  };
  return changed(right, [&](ColorAndDepth& out, int x, int y) {
    const bool is_inside = inside(x - by.x, y - by.y);
    out.color(x, y) = is_inside ? right.color(x - by.x, y - by.y) : frame.clear_color;
    if (!out.depth.empty()) out.depth(x, y) = is_inside ? right.depth(x - by.x, y - by.y) : frame.clear_depth;
  });
}

// Scene whose samples lie half a pixel from the centres: the picture moves as far the other way.
Scene half_a_pixel_off(const Scene& scene, glm::ivec2 by) {
  Scene out = scene;
  out.frame.pass.shift += 0.5 * glm::dvec2(by);
  return out;
}

using Draws = std::function<ColorAndDepth(const Scene&)>;

// Mistakes of a pixel in the viewport, or of half a pixel in the sample's place, to the eight sides.
std::vector<Lookalike> of_neighbours(const Scene& scene, const ColorAndDepth& right, const Draws& draws,
                                     const Measure& measure) {
  std::vector<Lookalike> out;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      if (x == 0 && y == 0) continue;
      const std::string side = fmt::format("{}{}{}",
                                           x == 0  ? ""
                                           : x < 0 ? "left"
                                                   : "right",
                                           x != 0 && y != 0 ? " and " : "",
                                           y == 0  ? ""
                                           : y < 0 ? "down"
                                                   : "up");
      out.push_back({"window", "window.one_pixel_off", "the picture lies one pixel too far " + side,
                     measure(moved(scene.frame, right, {x, y}))});
      out.push_back({"window", "window.sample_off_centre",
                     fmt::format("samples are not pixels' centres: the picture lies half a pixel too far {}", side),
                     measure(draws(half_a_pixel_off(scene, {x, y})))});
    }
  }
  return out;
}

// Scene whose depth test is turned round, and whose depth is cleared to the other end.
Scene farthest_kept(const Scene& scene) {
  Scene out = scene;
  out.frame.clear_depth = 1 - out.frame.clear_depth;
  for (Draw& draw : out.draws) {
    using enum DepthFunc;
    DepthFunc& f = draw.depth_func;
    f = f == less            ? greater
        : f == less_equal    ? greater_equal
        : f == greater       ? less
        : f == greater_equal ? less_equal
                             : f;
  }
  return out;
}

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
  const auto srgb = [](ColorAndDepth& out, int x, int y) { encode(out.color(x, y)); };
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

// Mistakes whose frames one eye sees nearer than ours, the nearest first.
Lookalikes ranked(std::vector<Lookalike> all, const Apart& ours, Look look) {
  const std::size_t apart = ours[look];
  const auto left = [&](const Lookalike& l) { return l.apart[look]; };
  Lookalikes out;
  out.apart = apart;
  if (is_fine(look)) out.codes = 0.5;
  std::erase_if(all, [&](const Lookalike& l) { return left(l) >= apart; });
  std::ranges::stable_sort(all, {}, left);
  if (all.empty()) {
    out.text = "no known fault draws a frame that is nearer\n";
    return out;
  }
  constexpr std::size_t kShown = 8;
  out.text = "explains  pixels left  fault\n";
  for (const Lookalike& l : std::span(all).first(std::min(all.size(), kShown))) {
    const double explained = 100.0 * static_cast<double>(apart - left(l)) / static_cast<double>(apart);
    out.text += fmt::format("{:>6.1f} % {:>12}  {:<36} {}\n", explained, left(l), l.name, l.says);
  }
  const Lookalike& nearest = all.front();
  out.whole = left(nearest) == 0;
  if (10 * left(nearest) > apart) return out;
  const auto text_of = [](const Lookalike& l) { return fmt::format("{} (fault {})", l.stage, l.name); };
  out.likely = text_of(nearest);
  for (const Lookalike& l : all) {
    const std::string text = text_of(l);
    if (left(l) == left(nearest) && text != out.likely && std::ranges::count(out.ties, text) == 0)
      out.ties.push_back(text);
  }
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

// Whether the fault is what the conventions declare.
bool is_declared(const std::string_view fault, const Conventions& conventions) {
  constexpr auto kDown = Conventions::Rounding::down;
  return (fault == "merge.truncated" && conventions.color_rounding == kDown) ||
         (fault == "depth.truncated" && conventions.depth_rounding == kDown);
}

// All known mistakes, but of stages that are right.
std::vector<Lookalike> mistakes(const Scene& scene, const GivenFrame& given, const ColorAndDepth& right,
                                const Measure& measure) {
  const auto cuts = [&](Sides sides) {
    const Request clipped{{Stage::clip}, false, {}, {}, Request().memory_budget, WantedPlanes::none};
    const Capture drawn = make_candidate("", sides)->capture(scene, clipped);
    return std::ranges::count(drawn.records.polygons.vertices, true, &ClipVertex<double>::cut);
  };
  const bool sides_cut = cuts(Sides::cut) != cuts(Sides::kept);
  // Pixels that the fault leaves: in a renderer that cuts polygons at the frame's sides, or in one that does not.
  const auto left_by = [&](const Scene& drawn_scene, const std::string& fault) {
    Apart out = measure(drawn(drawn_scene, given.conventions, fault));
    if (!sides_cut) return out;
    const Apart kept = measure(drawn(drawn_scene, given.conventions, fault, Sides::kept));
    std::ranges::transform(out, kept, out.begin(), [](std::size_t a, std::size_t b) { return std::min(a, b); });
    return out;
  };
  const auto is_right = [&](std::string_view stage) {
    const auto at = std::ranges::find(kStageNames, stage);  // "file" is none
    return at != kStageNames.end() && given.right.has(static_cast<Stage>(at - kStageNames.begin()));
  };
  const Draws draws = [&](const Scene& drawn_scene) { return drawn(drawn_scene, given.conventions, ""); };
  std::vector<Lookalike> all = of_files(right, measure);
  std::ranges::move(of_neighbours(scene, right, draws, measure), std::back_inserter(all));
  if (given.has_alpha) {
    all.push_back({"merge", "merge.alpha_not_written", "alpha is as it was cleared",
                   measure(changed(right, [&](ColorAndDepth& out, int x, int y) {
                     out.color(x, y).a = scene.frame.clear_color.a;
                   }))});
  }
  all.push_back({"visibility", "visibility.farthest_kept",
                 "the depth test is turned round, and the depth cleared to the other end",
                 left_by(farthest_kept(scene), "")});
  std::erase_if(all, [&](const Lookalike& l) { return is_right(l.stage); });
  for (const FaultInfo& fault : fault_infos()) {
    const std::string name(fault.name);
    const bool is_of_window = name.starts_with("matrices.viewport") || name == "matrices.depth_range_not_mapped";
    if (is_right(is_of_window ? "window" : fault.stage) || is_declared(name, given.conventions)) continue;
    all.push_back({std::string(fault.stage), name, std::string(fault.changes), left_by(scene, name)});
  }
  return all;
}

}  // namespace

Lookalikes lookalikes(const Scene& scene, const GivenFrame& given) {
  const SceneByConventions seen(scene, given.conventions);
  const ColorAndDepth right = drawn(*seen, given.conventions, "");
  const Pixels pixels(seen->frame.depth, given, right);
  const Measure measure = [&](const ColorAndDepth& frame) { return pixels.apart(frame); };
  Apart apart = measure(right);
  if (!given.has_alpha) apart[kCoarseByAlpha] = 0;
  const auto differs = std::ranges::find_if(apart, [](std::size_t n) { return n > 0; });
  if (differs == apart.end()) return {};  // right
  Lookalikes blank;
  blank.text = said_of_blank(seen->frame, given, right);
  if (!blank.text.empty()) {
    blank.apart = *differs, blank.blank = true;
    return blank;
  }
  const std::vector<Lookalike> all = mistakes(*seen, given, right, measure);
  std::vector<Lookalikes> found;
  for (const Look look : {kCoarseByAlpha, kCoarse, kFineColor, kFineDepth}) {
    if (is_fine(look) && !found.empty()) return found.front();  // no cause of what is coarse
    if (apart[look] == 0) continue;
    Lookalikes seen_by = ranked(all, apart, look);
    if (!seen_by.likely.empty()) return seen_by;
    if (!is_fine(look)) found.push_back(std::move(seen_by));
  }
  return {};  // rounded otherwise
}

namespace {

bool tells_legal_colors(const check::Comparison& row) {
  return row.stage == Stage::merge && judges_legality(row.judge, row.stage) && was_compared(row);
}

// 1 where no row that knows what is legal finds a pixel wrong; empty where no pixel is wrong, or not all are told.
Plane<std::uint8_t> legal_pixels(const Planes& planes, const check::SceneVerdict& verdict) {
  if (std::ranges::none_of(verdict.comparisons, tells_legal_colors)) return {};
  Plane<std::uint8_t> out(planes.color.width(), planes.color.height(), 1);
  bool any_wrong = false;
  for (const check::Comparison& row : verdict.comparisons) {
    if (row.outcome != check::Outcome::different || !judges_legality(row.judge, row.stage)) continue;
    if (row.measurement.differing_at.size() < row.measurement.differing) return {};
    for (const glm::ivec2 p : row.measurement.differing_at) out(p.x, p.y) = 0, any_wrong = true;
  }
  return any_wrong ? out : Plane<std::uint8_t>();
}

}  // namespace

GivenFrame frame_of(const Capture& left, const RendererInfo& renderer, const check::SceneVerdict& verdict) {
  GivenFrame out{{left.planes.color, left.planes.depth}, renderer.conventions, legal_pixels(left.planes, verdict)};
  out.has_alpha = true;
  for (std::size_t i = 0; i < static_cast<std::size_t>(Stage::merge); ++i) {
    const auto stage = static_cast<Stage>(i);
    if (renderer[stage].given || report::is_right(verdict, stage)) out.right.add(stage);
  }
  return out;
}

std::vector<std::string> likely_of(const Lookalikes& found, const check::SceneVerdict& verdict) {
  std::uint64_t wrong = 0;
  for (const check::Comparison& c : verdict.comparisons) {
    if (c.stage == Stage::merge && c.outcome == check::Outcome::different)
      wrong = std::max(wrong, c.measurement.differing);
  }
  if (found.likely.empty() || 2 * found.apart < wrong) return {};
  std::vector<std::string> out = {found.likely};
  out.insert(out.end(), found.ties.begin(), found.ties.end());
  return out;
}

std::vector<std::string> likely_faults(const Scene& scene, const Capture& left, const RendererInfo& renderer,
                                       const check::SceneVerdict& verdict) {
  constexpr std::size_t kMostPrimitives = 20'000, kMostPixels = 200'000;  // each fault is a picture
  const Plane<glm::vec4>& color = left.planes.color;
  if (color.empty() || color.size() > kMostPixels || DrawIndex(scene).primitives() > kMostPrimitives ||
      scene.frame.antialias.kind != Antialias::Kind::none || color.width() != scene.frame.width ||
      color.height() != scene.frame.height)
    return {};
  const Lookalikes found = lookalikes(scene, frame_of(left, renderer, verdict));
  if (found.blank) return {"nothing of the scene is seen"};
  return likely_of(found, verdict);
}

}  // namespace plumbline::cli
