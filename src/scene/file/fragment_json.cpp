#include "scene/file/fragment_json.h"

#include "scene/names.h"

namespace plumbline {
namespace {

DepthFunc read_func(const JsonNode& node) { return node.choice<DepthFunc>(kNamesOf<DepthFunc>); }

DepthRange read_depth_range(const JsonNode& node) {
  const std::vector<JsonNode> n = node.elements(2, 2);
  return {static_cast<float>(n[0].number(0, 1)), static_cast<float>(n[1].number(0, 1))};
}

PolygonOffset read_polygon_offset(const JsonNode& node) {
  constexpr double kMost = 1e6;
  node.only({"factor", "units"});
  PolygonOffset out;
  if (const auto n = node.find("factor")) out.factor = static_cast<float>(n->number(-kMost, kMost));
  if (const auto n = node.find("units")) out.units = static_cast<float>(n->number(-kMost, kMost));
  return out;
}

AlphaTest read_alpha_test(const JsonNode& node) {
  node.only({"func", "reference"});
  AlphaTest out;
  out.func = read_func(node["func"]);
  if (const auto n = node.find("reference")) out.reference = static_cast<float>(n->number(0, 1));
  return out;
}

StencilOp read_stencil_op(const JsonNode& node) { return node.choice<StencilOp>(kNamesOf<StencilOp>); }

void read_stencil_face(const JsonNode& node, StencilFace& face) {
  const auto byte = [](const JsonNode& n) { return static_cast<std::uint8_t>(n.integer(0, 255)); };
  if (const auto n = node.find("func")) face.func = read_func(*n);
  if (const auto n = node.find("reference")) face.reference = byte(*n);
  if (const auto n = node.find("mask")) face.mask = byte(*n);
  if (const auto n = node.find("fail")) face.fail = read_stencil_op(*n);
  if (const auto n = node.find("depth_fail")) face.depth_fail = read_stencil_op(*n);
  if (const auto n = node.find("pass")) face.pass = read_stencil_op(*n);
  if (const auto n = node.find("write_mask")) face.write_mask = byte(*n);
}

Stencil read_stencil(const JsonNode& node) {
  node.only({"func", "reference", "mask", "fail", "depth_fail", "pass", "write_mask", "back"});
  Stencil out;
  read_stencil_face(node, out.front);
  out.back = out.front;
  if (const auto n = node.find("back")) {
    n->only({"func", "reference", "mask", "fail", "depth_fail", "pass", "write_mask"});
    read_stencil_face(*n, out.back);
  }
  return out;
}

LogicOp read_logic_op(const JsonNode& node) { return node.choice<LogicOp>(kNamesOf<LogicOp>); }

void read_blend_term(const JsonNode& node, BlendTerm& term) {
  constexpr std::span<const Name> kFactors(kNamesOf<BlendFactor>);
  if (const auto n = node.find("source")) term.source = n->choice<BlendFactor>(kFactors);
  if (const auto n = node.find("destination")) {  // source_alpha_saturate, the last, is a source factor only
    term.destination = n->choice<BlendFactor>(kFactors.first(kFactors.size() - 1));
  }
  if (const auto n = node.find("equation")) {
    term.equation = n->choice<BlendEquation>(kNamesOf<BlendEquation>);
  }
}

Blend read_blend(const JsonNode& node) {
  node.only({"source", "destination", "equation", "alpha", "color"});
  Blend blend;
  read_blend_term(node, blend.rgb);
  blend.alpha = blend.rgb;
  if (const auto n = node.find("alpha")) {
    n->only({"source", "destination", "equation"});
    read_blend_term(*n, blend.alpha);
  }
  if (const auto n = node.find("color")) blend.color = glm::vec4(n->vector<4>(0, 1));
  return blend;
}

glm::bvec4 read_color_mask(const JsonNode& node) {
  glm::bvec4 mask;
  const std::vector<JsonNode> channels = node.elements(4, 4);
  for (int i = 0; i < 4; ++i) mask[i] = channels[static_cast<std::size_t>(i)].boolean();
  return mask;
}

Scissor read_scissor(const JsonNode& node) {
  constexpr std::int64_t kMost = 16384;
  const std::vector<JsonNode> n = node.elements(4, 4);
  const auto pixels = [&](std::size_t i) { return static_cast<int>(n[i].integer(0, kMost)); };
  return {pixels(0), pixels(1), pixels(2), pixels(3)};
}

}  // namespace

void read_fragment_state(const JsonNode& node, Draw& draw) {
  if (const auto n = node.find("depth_func")) draw.depth_func = read_func(*n);
  if (const auto n = node.find("depth_range")) draw.depth_range = read_depth_range(*n);
  if (const auto n = node.find("polygon_offset")) draw.polygon_offset = read_polygon_offset(*n);
  if (const auto n = node.find("alpha_test")) draw.alpha_test = read_alpha_test(*n);
  if (const auto n = node.find("stencil")) draw.stencil = read_stencil(*n);
  if (const auto n = node.find("scissor")) draw.scissor = read_scissor(*n);
  if (const auto n = node.find("depth_mask")) draw.merge.depth_mask = n->boolean();
  if (const auto n = node.find("blend")) draw.merge.blend = read_blend(*n);
  if (const auto n = node.find("logic_op")) draw.merge.logic_op = read_logic_op(*n);
  if (const auto n = node.find("color_mask")) draw.merge.color_mask = read_color_mask(*n);
}

}  // namespace plumbline
