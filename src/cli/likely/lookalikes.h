// Known faults that draw what a renderer drew: the scene is drawn with each of them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "capture/capture.h"
#include "capture/renderer.h"
#include "check/verdict/verdict.h"
#include "cli/likely/frames_apart.h"
#include "scene/scene.h"

namespace plumbline::cli {

/// Known faults whose frame is nearer to the one given than ours is, the nearest first, and how much of what differs
/// each explains. Faults are drawn by the conventions given, as far as SceneByConventions draws by them. Where all is
/// within a code of 8 bits and a step of depth, a half and a quarter count, if a fault explains that. Where none
/// explains nine tenths of them, and the nearest a third or more, each other fault is drawn together with it.
struct Lookalikes {
  std::size_t apart = 0;  ///< pixels that differ from ours: a channel by more than so many codes, or depth
  double codes = 1;       ///< 1, or half of one
  std::string text;       ///< lines for people
  std::string likely;     ///< "STAGE (fault NAME)", where the nearest explains nine tenths of them or more; else empty
  bool together = false;  ///< `likely` and `ties` are of two faults each, "STAGE (fault NAME) and STAGE (fault NAME)"
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
