#include "report/page/viewer_data.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <utility>

#include <nlohmann/json.hpp>

#include "report/text/comparison_json.h"

namespace plumbline::report {

namespace {

using Json = nlohmann::ordered_json;

struct Box {
  int x, y, width, height;
};

// The earlier side that has most numbers in common with side i: references often agree with each other.
const Numbers* base_of(const std::vector<Numbers>& sides, std::size_t i) {
  const Numbers* base = nullptr;
  std::ptrdiff_t most = -1;
  for (std::size_t k = 0; k < i; ++k) {
    if (sides[k].empty() || !same_shape(sides[k], sides[i])) continue;
    const std::vector<std::uint32_t>&a = sides[k].values, &b = sides[i].values;
    const std::ptrdiff_t common = std::inner_product(a.begin(), a.end(), b.begin(), std::ptrdiff_t{0}, std::plus(),
                                                     [](std::uint32_t v, std::uint32_t w) { return v == w ? 1 : 0; });
    if (common > most) base = &sides[k], most = common;
  }
  return base;
}

Json packed_layer(const Layer& layer, const Box& box) {
  std::vector<Numbers> numbers;
  for (const Numbers& n : layer.sides) numbers.push_back(cropped(n, box.x, box.y, box.width, box.height));
  Json sides = Json::array();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const Numbers& n = numbers[i];
    if (n.empty()) {
      sides.push_back(nullptr);
      continue;
    }
    const Numbers* base = base_of(numbers, i);
    Json side{{"scale", n.scale}, {"channels", n.channels}, {"bytes", bytes_of(n)}};
    side["base"] = base != nullptr ? Json(base - numbers.data()) : Json(nullptr);
    if (base == nullptr || base->values != n.values) side["data"] = packed(n, base);
    sides.push_back(std::move(side));
  }
  Json judged = Json::array();
  for (const Stage stage : layer.judged) judged.push_back(name_of(stage));
  return {{"name", layer.name}, {"says", layer.says}, {"paint", layer.paint}, {"judged", judged}, {"sides", sides}};
}

// Width of a frame's pixel in the comparison's pixels: `factor` for those of a pass, 1 for resolved ones.
int factor_of(const check::Comparison& c, int factor) { return c.stage == Stage::resolve ? 1 : factor; }

// 1: beyond the tolerance; 2: disputed.
std::string packed_marks(const check::Comparison& c, int factor, const Box& box) {
  Plane<std::uint8_t> marks(box.width, box.height);
  const auto mark = [&](const std::vector<glm::ivec2>& places, std::uint8_t as) {
    for (const glm::ivec2 place : places) {
      const glm::ivec2 at = place / factor_of(c, factor) - glm::ivec2(box.x, box.y);
      if (at.x >= 0 && at.y >= 0 && at.x < box.width && at.y < box.height) marks(at.x, at.y) = as;
    }
  };
  mark(c.measurement.disputed_at, 2);
  mark(c.measurement.differing_at, c.outcome == check::Outcome::dispute ? 2 : 1);
  Numbers numbers = numbers_of(marks);
  numbers.scale = 255;  // one byte each
  return packed(numbers);
}

Json viewed_json(const Viewed& viewed, std::span<const check::Comparison> comparisons, int factor, const Box& box) {
  Json out{{"title", viewed.title},
           {"width", viewed.width},
           {"height", viewed.height},
           {"from_top", viewed.from_top},
           {"x", box.x},
           {"y", box.y},
           {"columns", box.width},
           {"rows", box.height},
           {"sides", viewed.sides},
           {"layers", Json::array()},
           {"comparisons", ""},
           {"marks", Json::array()}};
  for (const Layer& layer : viewed.layers) out["layers"].push_back(packed_layer(layer, box));
  Json rows = Json::array();
  std::map<std::string, std::size_t> known;  // many rows are about the same pixels
  for (const check::Comparison& c : comparisons) {
    Json row = comparison_json(c);
    row.erase("scene");
    for (const char* worst : {"worst", "dispute"}) {
      if (!row.contains(worst) || row[worst].is_null() || !row[worst].contains("pixel")) continue;
      for (Json& coordinate : row[worst]["pixel"]) coordinate = coordinate.get<int>() / factor_of(c, factor);
    }
    if (!c.measurement.disputed_at.empty() || !c.measurement.differing_at.empty()) {
      const auto [at, is_new] = known.emplace(packed_marks(c, factor, box), known.size());
      if (is_new) out["marks"].push_back(at->first);
      row["mark"] = at->second;
    }
    rows.push_back(std::move(row));
  }
  out["comparisons"] = packed(rows.dump(-1, ' ', false, Json::error_handler_t::replace));
  return out;
}

// The part of `box` about a pixel, with the longer side cut to `percent`.
Box smaller(const Box& box, int percent, glm::ivec2 about, const Viewed& viewed) {
  Box out = box;
  (box.width > box.height ? out.width : out.height) = std::max(1, std::max(box.width, box.height) * percent / 100);
  out.x = std::clamp(about.x - out.width / 2, 0, viewed.width - out.width);
  out.y = std::clamp(about.y - out.height / 2, 0, viewed.height - out.height);
  return out;
}

glm::ivec2 worst_pixel(const Viewed& viewed, std::span<const check::Comparison> comparisons, int factor) {
  const check::Comparison* first = nullptr;  // of what differs, else of what is disputed
  for (const check::Comparison& c : comparisons) {
    if (c.outcome != check::Outcome::different && c.outcome != check::Outcome::dispute) continue;
    const auto rank = [](const check::Comparison& row) {
      return std::pair(row.outcome == check::Outcome::dispute, row.stage);
    };
    const check::Worst* worst = check::shown(c);  // null where only the budget of ambiguity is exceeded
    if (worst != nullptr && worst->place.x >= 0 && (first == nullptr || rank(c) < rank(*first))) first = &c;
  }
  if (first == nullptr) return {viewed.width / 2, viewed.height / 2};
  const check::Place& place = check::shown(*first)->place;
  return glm::ivec2(place.x, place.y) / factor_of(*first, factor);
}

Layer layer_of(std::string name, std::string says, std::string paint, std::vector<Stage> judged,
               std::span<const Planes* const> sides, auto numbers) {
  Layer out{std::move(name), std::move(says), std::move(paint), std::move(judged), {}};
  // Rounded to the nearest code, except on our side: unrounded numbers would take many times the bytes.
  for (const Planes* planes : sides) out.sides.push_back(numbers(*planes, planes == sides.front() ? 0.01 : 0.5));
  return out;
}

}  // namespace

std::vector<Layer> frame_layers(const Scene& scene, std::span<const Planes* const> sides) {
  std::vector<Layer> out;
  const double color = color_scale(scene.frame.color), depth = depth_scale(scene.frame.depth);
  out.push_back(layer_of("colour", "the frame", "color", {Stage::resolve, Stage::merge, Stage::shade}, sides,
                         [&](const Planes& p, double off) { return numbers_of(p.color, color, off); }));
  out.push_back(layer_of("depth", "window z: the nearest yellow, the farthest blue, 20 contour lines", "depth",
                         {Stage::depth}, sides,
                         [&](const Planes& p, double off) { return numbers_of(p.depth, depth, off); }));
  out.push_back(layer_of("primitives", "a colour for each winning primitive", "id", {Stage::visibility}, sides,
                         [](const Planes& p, double) { return numbers_of(p.id); }));
  out.push_back(layer_of("fragments", "fragments at each pixel: 1 blue, 8 or more yellow", "count", {Stage::coverage},
                         sides, [](const Planes& p, double) { return numbers_of(p.count); }));
  out.push_back(layer_of("stencil", "stencil values: 0 black, 255 yellow", "stencil", {Stage::visibility}, sides,
                         [](const Planes& p, double) { return numbers_of(p.stencil); }));
  std::erase_if(out, [](const Layer& layer) { return std::ranges::all_of(layer.sides, &Numbers::empty); });
  return out;
}

std::string viewer_json(const Viewed& given, std::span<const check::Comparison> comparisons, int factor,
                        std::size_t budget) {
  Viewed viewed = given;
  for (Layer& layer : viewed.layers) {
    for (Numbers& n : layer.sides) {
      if (n.width != viewed.width || n.height != viewed.height) n = {};
    }
  }
  constexpr int kMost = 1 << 19, kFew = 1 << 8;  // pixels; more than that many are not even tried
  const glm::ivec2 about = worst_pixel(viewed, comparisons, factor);
  Box box{0, 0, viewed.width, viewed.height};
  while (true) {
    int percent = 50;
    if (box.width <= kMost / box.height) {
      const std::string json =
          viewed_json(viewed, comparisons, factor, box).dump(-1, ' ', false, Json::error_handler_t::replace);
      if (json.size() <= budget || box.width <= kFew / box.height) return json;
      percent = std::clamp(static_cast<int>(110 * budget / json.size()), 25, 90);  // rather once more than too small
    }
    box = smaller(box, percent, about, viewed);
  }
}

std::string in_script(std::string json) {
  for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos;) json.replace(at, 1, "\\u003c");
  return json;
}

}  // namespace plumbline::report
