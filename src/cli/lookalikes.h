// Known faults that draw what a renderer drew: the scene is drawn with each of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "capture/capture.h"
#include "capture/conventions.h"
#include "capture/plane.h"
#include "capture/renderer.h"
#include "check/verdict/verdict.h"
#include "scene/scene.h"

namespace plumbline::cli {

/// What a renderer left of a frame: rows in the scene's order. Depth, window z, may be empty.
struct ColorAndDepth {
  Plane<glm::vec4> color;
  Plane<double> depth;
};

/// A frame, by whose conventions it is drawn, and which of its pixels are legal.
struct GivenFrame : ColorAndDepth {
  Conventions conventions;
  /// 1: the pixel is legal. Where it differs from ours, it counts for no fault, and against none. Empty: not known.
  Plane<std::uint8_t> is_legal;
  bool has_alpha = false;  ///< else nothing is told by alpha
  StageSet right{};        ///< stages that are judged right, or given: their faults are no causes
};

/// Known faults whose frame is nearer to the one given than ours is, the nearest first, and how much of what differs
/// each explains. Faults are drawn by the conventions given, as far as SceneByConventions draws by them. Where all is
/// within a code of 8 bits and a step of depth, a half and a quarter count, if a fault explains that.
struct Lookalikes {
  std::size_t apart = 0;  ///< pixels that differ from ours: a channel by more than so many codes, or depth
  double codes = 1;       ///< 1, or half of one
  std::string text;       ///< lines for people
  std::string likely;     ///< "STAGE (fault NAME)", where the nearest explains nine tenths of them or more; else empty
  std::vector<std::string> ties;  ///< others that explain as much: the frame does not tell them apart
  bool whole = false;             ///< and all of them
  bool blank = false;             ///< all pixels have one colour, as by many faults: none is named, `text` says it
};
Lookalikes lookalikes(const Scene& scene, const GivenFrame& given);
/// The frame that a capture of `renderer` holds, as `verdict` judges it.
GivenFrame frame_of(const Capture& left, const RendererInfo& renderer, const check::SceneVerdict& verdict);
/// found.likely and found.ties; empty where fewer pixels differ from ours (found.apart) than half of those that a row
/// finds different at merge: the fault then resembles a legal rule of the renderer, not what is wrong with it.
std::vector<std::string> likely_of(const Lookalikes& found, const check::SceneVerdict& verdict);
/// The likely faults of a capture, which it does not tell apart, or "nothing of the scene is seen" where its pixels
/// have one colour; empty also where the scene is too large for a picture of each fault.
std::vector<std::string> likely_faults(const Scene& scene, const Capture& left, const RendererInfo& renderer,
                                       const check::SceneVerdict& verdict);

}  // namespace plumbline::cli
