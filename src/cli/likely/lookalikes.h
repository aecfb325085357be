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

/// Known faults whose frames are nearer to the given frame than ours is. Faults are drawn by the given conventions, as
/// far as SceneByConventions applies them. A fault explains `apart` less the pixels that differ from the fault's
/// frame. Where no single fault explains nine tenths of them, but the nearest a third, pairs of it with each other
/// fault are drawn. Fine differences (Look) count only where there are no coarse ones, and a fault explains them.
struct Lookalikes {
  std::size_t apart = 0;     ///< pixels that differ from ours by the look that counts
  double codes = 1;          ///< 1 (coarse) or 1/2 (fine) code of 8 bits, for people
  bool by_color = false;     ///< by colour alone, as no fault explains nine tenths with depth
  bool by_nearness = false;  ///< pixels are explained where a fault's frame is four times as near as ours (Look)
  std::string text;          ///< lines for people, the nearest fault first
  std::string likely;  ///< "STAGE (fault NAME)": the nearest, if it explains 9/10 of `apart` (FramesApart); else empty
  bool together = false;  ///< `likely` and `ties` are of two faults each, "STAGE (fault NAME) and STAGE (fault NAME)"
  std::vector<std::string> ties;  ///< other faults that explain as many pixels
  bool whole = false;             ///< `likely` explains all pixels
  bool blank = false;             ///< all pixels have one colour, as by many faults: none is named, `text` says so
};
Lookalikes lookalikes(const Scene& scene, const GivenFrame& given);
/// The frame that a capture of `renderer` holds, as `verdict` judges it.
GivenFrame frame_of(const Capture& left, const RendererInfo& renderer, const check::SceneVerdict& verdict);
/// found.likely and found.ties. Empty where found.apart is less than half of the pixels that a row finds different at
/// merge, or where records are wrong and the frame is legal: the fault then resembles a legal rule of the renderer, not
/// its mistake.
std::vector<std::string> likely_of(const Lookalikes& found, const check::SceneVerdict& verdict);
/// Whether causes are sought: at most 20,000 primitives and 200,000 pixels, as each cause is a drawing.
bool is_small(const Scene& scene);
/// likely_of() the capture's frame; empty also for an antialiased scene. Else one sentence: the frame has one colour,
/// or the scene is not is_small().
std::vector<std::string> likely_faults(const Scene& scene, const Capture& left, const RendererInfo& renderer,
                                       const check::SceneVerdict& verdict);

}  // namespace plumbline::cli
