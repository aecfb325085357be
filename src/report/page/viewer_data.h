// What the pages' viewer (web/viewer.js) is given: planes of several sides as numbers, and what was found at which
// pixel.
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

/// One kind of numbers.
struct Layer {
  std::string name;            ///< such as "depth": unique among a viewer's layers
  std::string says;            ///< what its colours mean
  std::string paint;           ///< how numbers become colours: a painter of web/planes.js (PAINTERS)
  std::vector<Stage> judged;   ///< the stages whose rows are about it, the likeliest first
  std::vector<Numbers> sides;  ///< empty where a side hands out none; of the frame's size, or not shown
};

struct Viewed {
  std::string title;
  int width = 0, height = 0;
  bool from_top = false;           ///< row 0 is the uppermost (scene.h, rows_from_top)
  std::vector<std::string> sides;  ///< names; the first is the one that is judged
  std::vector<Layer> layers;
};

/// Colour, depth, winning primitives, fragments counted and stencil values: all that any side hands out of the
/// frame; but of the first, rounded to the frame's codes.
std::vector<Layer> frame_layers(const Scene& scene, std::span<const Planes* const> sides);

/// As JSON: the layers packed (numbers.h), of a side what differs from the one before that is most like it; the
/// comparisons (comparison_json.h; packed too), each with the pixels that it is about. Where that is more than `budget`
/// bytes, the part about the worst pixel alone, ever smaller, of 16 x 16 pixels at least. `factor`: pixels of a pass
/// beside one of the frame.
std::string viewer_json(const Viewed& viewed, std::span<const check::Comparison> comparisons, int factor = 1,
                        std::size_t budget = 40000);

/// JSON that may stand in HTML's script element.
std::string in_script(std::string json);

}  // namespace plumbline::report
