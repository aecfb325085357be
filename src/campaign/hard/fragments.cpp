// State of a draw's fragments: tests, blending, logic operations and masks, each of small numbers that meet.
#include "campaign/hard/builder.h"

namespace plumbline::hard {
namespace {

std::string_view compare(Builder& b) {
  return b.choose.word({"never", "less", "equal", "less_equal", "greater", "not_equal", "greater_equal", "always"});
}

std::string_view stencil_op(Builder& b) {
  return b.choose.word(
      {"keep", "zero", "replace", "increment", "increment_wrap", "decrement", "decrement_wrap", "invert"});
}

void add_stencil_face(Builder& b, Object& out) {
  Choices& c = b.choose;
  if (c.chance(80)) out.put_word("func", compare(b));
  if (c.chance(70)) out.put("reference", c.of({0, 1, 2, 3, 255}));
  if (c.chance(40)) out.put("mask", c.of({255, 1, 6, 0}));
  for (const char* when : {"fail", "depth_fail", "pass"}) {
    if (c.chance(60)) out.put_word(when, stencil_op(b));
  }
  if (c.chance(30)) out.put("write_mask", c.of({255, 3, 240, 0}));
}

std::string_view factor(Builder& b) {
  return b.choose.word({"zero", "one", "source_color", "one_minus_source_color", "destination_color",
                        "one_minus_destination_color", "source_alpha", "one_minus_source_alpha", "destination_alpha",
                        "one_minus_destination_alpha", "constant_color", "one_minus_constant_color", "constant_alpha",
                        "one_minus_constant_alpha"});
}

void add_blend_term(Builder& b, Object& out) {
  Choices& c = b.choose;
  if (c.chance(85)) out.put_word("source", c.chance(8) ? "source_alpha_saturate" : factor(b));
  if (c.chance(85)) out.put_word("destination", factor(b));
  if (c.chance(40)) out.put_word("equation", c.word({"add", "subtract", "reverse_subtract", "min", "max"}));
}

Object blend(Builder& b) {
  Object out;
  add_blend_term(b, out);
  if (b.choose.chance(40)) {
    Object alpha;
    add_blend_term(b, alpha);
    out.put("alpha", alpha);
  }
  if (b.choose.chance(50)) out.put_numbers("color", rgba(b));
  return out;
}

std::string bools(Builder& b) {
  std::vector<std::string> out;
  for (int i = 0; i < 4; ++i) out.push_back(b.choose.chance(60) ? "true" : "false");
  return json_array(out);
}

Object stencil(Builder& b) {
  Object out;
  add_stencil_face(b, out);
  if (b.choose.chance(40)) {
    Object back;
    add_stencil_face(b, back);
    out.put("back", back);
  }
  return out;
}

std::string scissor(Builder& b) {
  Choices& c = b.choose;
  const double x = c.count(0, b.view.width), y = c.count(0, b.view.height);
  const double width = c.of({0, 1, 8, b.view.width * 0.5, 16384});
  return json_numbers({x, y, static_cast<double>(static_cast<int>(width)), static_cast<double>(c.count(0, 80))});
}

}  // namespace

void add_fragment_state(Builder& b, Object& draw) {
  Choices& c = b.choose;
  const int percent = static_cast<int>(c.of({5, 10, 20, 50}));  // how crowded
  if (c.chance(percent)) draw.put("blend", blend(b));
  if (c.chance(percent) && b.color_format != "rgba32f") {
    draw.put_word("logic_op",
                  c.word({"clear", "and", "and_reverse", "copy", "and_inverted", "noop", "xor", "or", "nor",
                          "equivalent", "invert", "or_reverse", "copy_inverted", "or_inverted", "nand", "set"}));
  }
  if (c.chance(percent)) draw.put("color_mask", bools(b));
  if (c.chance(percent)) draw.put("depth_mask", c.chance(80) ? "false" : "true");
  if (c.chance(percent)) draw.put("scissor", scissor(b));
  if (c.chance(percent)) draw.put_numbers("depth_range", {c.of({0, 0, 0.25, 1}), c.of({1, 1, 0.75, 0, 0.25})});
  if (c.chance(percent)) {
    Object test("func", json_string(compare(b)));
    if (c.chance(90)) test.put("reference", c.of({0, 0.25, 0.5, 127.5 / 255, 1}));
    draw.put("alpha_test", test);
  }
  if (c.chance(percent)) {
    Object offset;
    if (c.chance(80)) offset.put("factor", c.of({-1, 1, 0.5, -2, 0, 100}));
    if (c.chance(80)) offset.put("units", c.of({-1, 1, 4, -16, 0, 100000}));
    draw.put("polygon_offset", offset);
  }
  if (b.has_stencil && c.chance(60)) draw.put("stencil", stencil(b));
  if (c.chance(40)) draw.put_word("depth_func", compare(b));
}

}  // namespace plumbline::hard
