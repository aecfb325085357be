// Input of the pages' viewer (web/viewer.js): planes of several sides as numbers, and comparisons with their pixels.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "capture/capture.h"
#include "check/verdict/verdict.h"
#include "report/text/numbers.h"
#include "scene/scene.h"

namespace plumbline::report {

/// One kind of plane, of all sides.
struct Layer {
  std::string name;            ///< such as "depth": unique among a viewer's layers
  std::string says;            ///< what its colours mean
  std::string paint;           ///< how numbers become colours: a painter of web/planes.js (PAINTERS)
  std::vector<Stage> judged;   ///< the stages whose rows judge the layer, the likeliest first
  std::vector<Numbers> sides;  ///< one per side; empty: handed out by none; not shown in another size than the frame's
};

struct Viewed {
  std::string title;
  int width = 0, height = 0;
  bool from_top = false;           ///< row 0 is the uppermost (scene.h, rows_from_top)
  std::vector<std::string> sides;  ///< names; the first is the one that is judged
  std::vector<Layer> layers;
};

/// Layers of colour, depth, winning primitives, fragment counts and stencil values; without layers that no side hands
/// out. Colour and depth of all sides but the first are rounded to the frame's codes.
std::vector<Layer> frame_layers(const Scene& scene, std::span<const Planes* const> sides);

/// JSON of the layers (packed against the most similar earlier side, numbers.h) and of the comparisons
/// (comparison_json.h; packed, too), each with its differing and disputed pixels. If larger than `budget` bytes, cut to
/// ever smaller parts about the worst pixel, down to some 16 x 16 pixels. `factor`: width of a frame's pixel in pixels
/// of a pass.
std::string viewer_json(const Viewed& viewed, std::span<const check::Comparison> comparisons, int factor = 1,
                        std::size_t budget = 40000);

/// JSON that may stand in HTML's script element.
std::string in_script(std::string json);

}  // namespace plumbline::report
