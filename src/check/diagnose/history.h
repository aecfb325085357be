// A pixel's history: every fragment that reached it, in each renderer, and why it lived or died.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "capture/renderer.h"
#include "check/judge/judge.h"
#include "scene/scene.h"

namespace plumbline::check {

/// What became of a fragment, by the first test that it did not pass, in OpenGL's order (2.1 spec, chapter 4.1).
enum class Fate {
  culled,       ///< of a culled triangle
  scissor,      ///< outside its draw's box
  alpha,        ///< alpha test
  stencil,      ///< stencil test
  depth,        ///< depth test
  discarded,    ///< passed every test by its own numbers, but was not drawn
  overwritten,  ///< drawn, and a later fragment was drawn over it
  winner        ///< the last that was drawn
};
std::string_view name_of(Fate fate);

/// One fragment at the pixel, by one renderer's numbers; empty where the renderer hands out none.
struct PixelFragment {
  std::uint32_t primitive = 0;
  std::size_t draw = 0;
  std::optional<std::uint32_t> triangle;  ///< its place among the renderer's window triangles
  bool front = true;                      ///< facing; true of lines and points
  std::optional<double> depth;            ///< window z, unrounded where the renderer hands it out unrounded
  std::optional<glm::dvec4> color;        ///< interpolated
  std::vector<std::pair<Varying, glm::dvec4>> varyings;
  std::optional<glm::dvec4> texel;
  std::optional<double> lod;
  std::optional<glm::dvec4> shaded;
  std::optional<bool> drawn;  ///< as the renderer says
  Fate fate = Fate::discarded;
  std::string why;                           ///< tests with their numbers, in codes where the frame has codes
  std::optional<double> held_depth;          ///< frame's depth before it, in the format; culled, scissored: none
  std::optional<std::uint8_t> held_stencil;  ///< likewise, in frames that have stencil values
};

/// One renderer's account of one pixel.
struct PixelHistory {
  std::string renderer;
  std::string absent;  ///< why there is none: "unsupported: ...", "missing: ...", "failed: ..."; else empty
  std::vector<PixelFragment> fragments;      ///< in draw order
  std::map<std::string, std::string> lacks;  ///< reasons by field ("fragments", "lod", ...) that it lacks
  std::optional<glm::vec4> color;            ///< the frame's
  std::optional<double> depth;
  std::optional<std::uint8_t> stencil;
  std::vector<std::string> notes;  ///< contradictions among the renderer's own numbers
  std::vector<LegalAnswer> legal;  ///< an oracle's, of the pixel
  /// Interval of the frame's colour that an oracle allows, not rounded to codes, where fragments are blended (Legal).
  std::optional<std::pair<glm::vec4, glm::vec4>> legal_colors;
};

/// One sample of the pixel: a pixel of one pass (antialias.h).
struct SampleHistory {
  std::size_t pass = 0;
  glm::ivec2 pixel{0};  ///< of the pass' frame
  std::vector<PixelHistory> renderers;
};

struct History {
  glm::ivec2 pixel{0};
  std::vector<SampleHistory> samples;  ///< one, where the scene is not antialiased
  std::vector<PixelHistory> resolved;  ///< of an antialiased scene: the frame's own colour and depth, no fragments
};

/// The pixel's history in the candidate and in each reference (as judge() takes them). Rows are counted as in the
/// scene's dialect: from the bottom, in gzrender from the top. A second drawing, without culling and without scissor
/// boxes that exclude the pixel, finds further fragments: each of them is Fate::scissor or Fate::culled. Throws
/// std::invalid_argument, naming the frame's size, where the frame has no such pixel.
History pixel_history(const Scene& scene, Renderer& candidate, std::span<const Reference> references, glm::ivec2 pixel);

}  // namespace plumbline::check
