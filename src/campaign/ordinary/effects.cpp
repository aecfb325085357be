// The tutorials' effects: overlays, blending, alpha and stencil tests.
#include <fmt/format.h>

#include "campaign/ordinary/builder.h"

namespace plumbline::ordinary {
namespace {

Object solid_draw(Builder& b, const Solid& what, const std::string& transforms) {
  Object draw("mesh", what.mesh.text());
  draw.put("transforms", transforms);
  draw.put("material", material(b));
  return draw;
}

Object quad(Builder& b, double half_width, double half_height) {
  Object out;
  const double w = half_width, h = half_height;
  out.put("positions", json_array({json_numbers({-w, -h, 0}), json_numbers({w, -h, 0}), json_numbers({w, h, 0}),
                                   json_numbers({-w, h, 0})}));
  if (b.choose.chance(15)) out.put("colors", rgba_array(b, 4));
  return Object("quad", out.text());
}

std::string alpha_blend() { return R"({"source": "source_alpha", "destination": "one_minus_source_alpha"})"; }

std::string somewhere(Builder& b) {
  Choices& c = b.choose;
  std::vector<std::string> out{
      translate({c.number(-0.6, 0.6) * b.reach, c.number(-0.2, 0.4) * b.reach, c.number(-0.5, 0.7) * b.reach})};
  if (c.chance(40)) out.push_back(rotate(c.of({15, 30, 45, 60, -20, -45}), {0, 1, 0}));
  return json_array(out);
}

// A plain square on the floor, of half extent `r`, facing up.
Object floor_square(double r, double y) {
  return Object("quad", Object("positions", json_array({json_numbers({-r, y, r}), json_numbers({r, y, r}),
                                                        json_numbers({r, y, -r}), json_numbers({-r, y, -r})}))
                            .text());
}

}  // namespace

void add_wireframe(Builder& b) {
  Choices& c = b.choose;
  const Solid what = solid(b);
  const std::string where = place(b, what);
  const bool over = c.chance(60);
  if (over) {  // a solid pushed back, and its edges
    Object fill = solid_draw(b, what, where);
    if (c.chance(80)) {
      const double push = b.greater_is_nearer ? -1 : 1;
      fill.put("polygon_offset", Object().put("factor", push).put("units", push).text());
    }
    b.draws.push_back(fill);
  }
  Object wire("mesh", what.mesh.text());
  wire.put("transforms", where).put_word("front_mode", "line").put_word("back_mode", "line").put("lit", "false");
  wire.put("material", Object("diffuse", json_numbers(opaque(b))).text());
  if (over) wire.put_word("depth_func", nearer_or_equal(b));
  if (c.chance(30)) wire.put("line_width", c.of({2, 2, 3, 4}));
  if (c.chance(20)) wire.put_word("cull", "back");
  b.has_line_or_point = true;
  b.draws.push_back(wire);
}

// A smaller square in the plane of a larger one, drawn over it.
void add_decal(Builder& b) {
  Choices& c = b.choose;
  const std::string where = somewhere(b);
  const double r = b.reach * 0.4;
  Object below("mesh", quad(b, r, r).text()), above;
  const double half_width = r * c.of({0.4, 0.5, 0.7});
  above.put("mesh", quad(b, half_width, r * 0.5));
  below.put("transforms", where).put("material", material(b));
  above.put("transforms", where).put("material", material(b));
  const std::string_view how = c.word({"offset", "offset", "equal", "range"});
  const double pull = b.greater_is_nearer ? 1 : -1;
  if (how == "offset")
    above.put("polygon_offset", Object().put("factor", pull).put("units", pull * c.of({1, 1, 2, 10})).text());
  if (how == "equal") above.put_word("depth_func", nearer_or_equal(b));
  if (how == "range")
    above.put_numbers("depth_range", b.greater_is_nearer ? std::vector<double>{0.01, 1} : std::vector<double>{0, 0.99});
  if (c.chance(40)) above.put("texture", draw_texture(b, add_texture(b)));
  b.draws.push_back(below);
  b.draws.push_back(above);
}

void add_glass(Builder& b) {
  Choices& c = b.choose;
  const int panes = static_cast<int>(c.of({1, 1, 2, 3}));
  for (int i = 0; i < panes; ++i) {
    Object draw;
    if (c.chance(60)) {
      const double half_width = b.reach * c.number(0.2, 0.6), half_height = b.reach * c.number(0.2, 0.6);
      draw.put("mesh", quad(b, half_width, half_height)).put("transforms", somewhere(b));
    } else {
      const Solid what = solid(b);
      draw.put("mesh", what.mesh).put("transforms", place(b, what));
      if (c.chance(60)) draw.put_word("cull", "back");
    }
    draw.put("material", Object("diffuse", json_numbers(see_through(b))).text());
    draw.put("blend", alpha_blend());
    if (c.chance(60)) draw.put("lit", "false");
    if (c.chance(75)) draw.put("depth_mask", "false");
    b.draws.push_back(draw);
  }
}

// Light added up: particles, a flare.
void add_glow(Builder& b) {
  Choices& c = b.choose;
  Object draw;
  if (c.chance(50)) {
    draw.put("mesh", star_mesh(b, c.count(3, 30))).put("point_size", c.of({2, 3, 4, 6, 8}));
    b.has_line_or_point = true;
  } else {
    draw.put("mesh", quad(b, b.reach * 0.4, b.reach * 0.4)).put("transforms", somewhere(b));
    if (c.chance(60)) draw.put("texture", draw_texture(b, add_texture(b)));
  }
  draw.put("material", Object("diffuse", json_numbers(see_through(b))).text());
  const std::string_view source = c.word({"source_alpha", "source_alpha", "one"});
  draw.put("blend", Object("source", json_string(source)).put_word("destination", "one").text());
  draw.put("lit", "false").put("depth_mask", "false");
  b.draws.push_back(draw);
}

// Leaves and fences: a picture whose alpha says where it is.
void add_cut_out(Builder& b) {
  Choices& c = b.choose;
  Object leaf("image", Object("file", json_string("leaf.png")).text());
  leaf.put_word("min", c.word({"nearest", "linear", "linear_mipmap_linear"}))
      .put_word("mag", c.word({"nearest", "linear"}));
  b.textures.put("leaf", leaf);
  const int leaves = c.count(1, 3);
  for (int i = 0; i < leaves; ++i) {
    Object draw("mesh", Object("quad", "{}").text());
    draw.put("transforms", json_array({translate({c.number(-0.6, 0.6) * b.reach, c.number(-0.1, 0.3) * b.reach,
                                                  c.number(-0.6, 0.6) * b.reach}),
                                       rotate(c.number(-60, 60), {0, 1, 0}), scale({b.reach / 4, b.reach / 4, 1})}));
    draw.put("texture", R"({"name": "leaf", "environment": "replace"})").put("lit", "false");
    draw.put("alpha_test", Object("func", json_string(c.word({"greater", "greater_equal"})))
                               .put("reference", c.of({0.1, 0.5, 0.5, 0.9}))
                               .text());
    if (c.chance(30)) draw.put("blend", alpha_blend());
    b.draws.push_back(draw);
  }
}

// Mirror: the floor marks the stencil buffer, the solid is drawn upside down at the marks, the floor is blended over
// it.
void add_mirror(Builder& b) {
  Choices& c = b.choose;
  b.wants_stencil = true;
  const double y = -b.reach / 3, r = b.reach * c.of({0.6, 0.8, 1}), size = b.reach / 4;
  const Object square = floor_square(r, y);
  const Solid what = solid(b);
  const double x = c.number(-0.4, 0.4) * b.reach, z = c.number(-0.4, 0.4) * b.reach;
  Object mask("mesh", square.text());
  mask.put("stencil", R"({"func": "always", "reference": 1, "pass": "replace"})").put("lit", "false");
  mask.put("color_mask", "[false, false, false, false]").put("depth_mask", "false");
  Object image = solid_draw(b, what, json_array({translate({x, y - size, z}), scale({size, -size, size})}));
  Object real = solid_draw(b, what, json_array({translate({x, y + size, z}), scale({size, size, size})}));
  image.put("stencil", R"({"func": "equal", "reference": 1})");
  Object surface("mesh", square.text());
  surface.put("material", Object("diffuse", json_numbers(see_through(b))).text()).put("lit", "false");
  surface.put("blend", alpha_blend());
  for (Object* draw : {&mask, &image, &surface, &real}) b.draws.push_back(*draw);
}

// A solid, and its shadow: itself, flat and dark, on the floor, each pixel darkened once.
void add_shadow(Builder& b) {
  Choices& c = b.choose;
  b.wants_stencil = true;
  const double y = -b.reach / 3, size = b.reach / 4, x = c.number(-0.5, 0.5) * b.reach,
               z = c.number(-0.5, 0.5) * b.reach;
  const Solid what = solid(b);
  Object ground("mesh", floor_square(b.reach, y).text());
  ground.put("material", material(b)).put("lit", "false");
  b.draws.push_back(ground);
  b.draws.push_back(solid_draw(b, what, json_array({translate({x, y + 1.5 * size, z}), scale({size, size, size})})));
  Object shadow("mesh", what.mesh.text());
  shadow.put("transforms", json_array({translate({x + size, y + 0.01, z - size}), scale({size, 0.001, size})}));
  shadow.put("material", R"({"diffuse": [0, 0, 0, 0.5]})").put("lit", "false").put("blend", alpha_blend());
  shadow.put("stencil", R"({"func": "equal", "reference": 0, "pass": "increment"})");
  if (c.chance(50)) {
    const double pull = b.greater_is_nearer ? 1 : -1;
    shadow.put("polygon_offset", Object().put("factor", pull).put("units", pull).text());
  }
  b.draws.push_back(shadow);
}

// Outline: a solid marks its pixels in the stencil buffer; a larger one is drawn where no mark is.
void add_outline(Builder& b) {
  b.wants_stencil = true;
  const Solid what = solid(b);
  const double size = b.reach / 4;
  const std::string at = translate({b.choose.number(-0.5, 0.5) * b.reach, 0, b.choose.number(-0.5, 0.5) * b.reach});
  Object inner = solid_draw(b, what, json_array({at, scale({size, size, size})}));
  inner.put("stencil", R"({"func": "always", "reference": 1, "pass": "replace"})");
  const double larger = size * b.choose.of({1.05, 1.1, 1.2});
  Object outer = solid_draw(b, what, json_array({at, scale({larger, larger, larger})}));
  outer.put("stencil", R"({"func": "not_equal", "reference": 1, "mask": 255})").put("lit", "false");
  if (b.choose.chance(50)) outer.put_word("depth_func", "always");
  b.draws.push_back(inner);
  b.draws.push_back(outer);
}

// A solid cut off by a scissor box.
void add_inset(Builder& b) {
  Choices& c = b.choose;
  const Solid what = solid(b);
  Object draw = solid_draw(b, what, place(b, what));
  draw.put_numbers("scissor",
                   {static_cast<double>(c.count(0, b.width / 2)), static_cast<double>(c.count(0, b.height / 2)),
                    static_cast<double>(c.count(1, b.width / 2)), static_cast<double>(c.count(1, b.height / 2))});
  if (c.chance(40)) draw.put_word("depth_func", "always");
  b.draws.push_back(draw);
}

void add_oddity(Builder& b) {
  Choices& c = b.choose;
  const Solid what = solid(b);
  Object draw = solid_draw(b, what, place(b, what));
  const std::string_view kind = c.word({"logic", "mask", "range", "depth", "blend", "blend"});
  if (kind == "logic") draw.put_word("logic_op", c.word({"xor", "xor", "invert", "and", "or", "copy_inverted"}));
  if (kind == "mask") {
    draw.put("color_mask", std::string(c.word({"[true, false, false, true]", "[false, true, true, true]",
                                               "[true, true, true, false]", "[false, false, false, true]"})));
  }
  if (kind == "range") draw.put("depth_range", std::string(c.word({"[0, 0.5]", "[0.5, 1]", "[0, 0.1]", "[1, 0]"})));
  if (kind == "depth")
    draw.put_word("depth_func", c.word({"always", "less_equal", "greater", "not_equal", "equal", "never"}));
  if (kind == "blend") {
    Object blend("source", json_string(c.word({"source_alpha", "one", "destination_color", "zero", "constant_alpha"})));
    blend.put_word("destination", c.word({"one_minus_source_alpha", "one", "zero", "source_color",
                                          "one_minus_source_color", "constant_color"}));
    if (c.chance(30)) blend.put_word("equation", c.word({"add", "subtract", "reverse_subtract", "min", "max"}));
    if (c.chance(30)) blend.put_numbers("color", see_through(b));
    draw.put("blend", blend);
  }
  b.draws.push_back(draw);
}

}  // namespace plumbline::ordinary
