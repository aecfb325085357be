// Colours, materials, textures, fog and the state of solids.
#include <fmt/format.h>

#include "campaign/ordinary/builder.h"

namespace plumbline::ordinary {
namespace {

std::string_view wrap(Builder& b) {
  if (b.choose.chance(65)) return "repeat";
  return b.choose.word({"mirrored_repeat", "clamp_to_edge", "clamp_to_edge", "clamp_to_border"});
}

// Of 8 to 128 texels a side, mostly a power of two, as the books have them; written out, of 1 to 4.
Object image(Builder& b) {
  Choices& c = b.choose;
  const auto side = [&] { return c.chance(85) ? c.of({8, 16, 32, 32, 64, 64, 64, 128}) : c.count(8, 100); };
  const std::string_view kind = c.word({"checker", "checker", "checker", "checker", "gradient", "bricks", "bricks",
                                        "uv_grid", "noise", "noise", "texels", "file", "file"});
  if (kind == "file") {
    return Object("file",
                  json_string(c.word({"leaf.png", "leaf.png", "leaf.tga", "rings.jpg", "rings.jpg", "glow.exr"})));
  }
  if (kind == "texels") {
    const int columns = c.count(1, 4), rows = c.count(1, 4);
    std::vector<std::string> lines;
    for (int i = 0; i < rows; ++i) lines.push_back(rgba_array(b, columns));
    return Object("texels", json_array(lines));
  }
  Object made;
  if (c.chance(80)) {
    const double width = side();
    made.put("width", width).put("height", c.chance(85) ? width : side());
  }
  if (kind == "checker" || kind == "bricks" || kind == "uv_grid") {
    made.put("columns", c.of({2, 4, 8, 8})).put("rows", c.of({2, 4, 8, 8}));
  }
  if (kind == "checker" || kind == "bricks") made.put("colors", rgba_array(b, 2));
  if (kind == "gradient") made.put("colors", rgba_array(b, 4));
  if (kind == "noise") made.put("seed", c.count(0, 999));
  return Object(kind, made.text());
}

}  // namespace

std::vector<double> color(Builder& b) {
  Choices& c = b.choose;
  if (c.chance(25)) {  // primaries, white, greys
    const double on = c.of({1, 1, 1, 0.5, 0.8});
    const int which = c.count(1, 7);
    return {(which & 1) != 0 ? on : 0, (which & 2) != 0 ? on : 0, (which & 4) != 0 ? on : 0};
  }
  return {c.number(0, 1), c.number(0, 1), c.number(0, 1)};
}

std::vector<double> opaque(Builder& b) {
  std::vector<double> out = color(b);
  out.push_back(1);
  return out;
}

std::vector<double> see_through(Builder& b) {
  std::vector<double> out = color(b);
  out.push_back(b.choose.of({0.2, 0.25, 0.3, 0.4, 0.5, 0.5, 0.6, 0.75}));
  return out;
}

std::string rgba_array(Builder& b, int count) {
  std::vector<std::string> out;
  for (int i = 0; i < count; ++i) out.push_back(json_numbers(b.choose.chance(90) ? opaque(b) : see_through(b)));
  return json_array(out);
}

std::string translate(const std::vector<double>& by) { return Object("translate", json_numbers(by)).text(); }
std::string scale(const std::vector<double>& by) { return Object("scale", json_numbers(by)).text(); }
std::string rotate(double degrees, const std::vector<double>& axis) {
  Object turn;
  turn.put("degrees", degrees).put_numbers("axis", axis);
  return Object("rotate", turn.text()).text();
}

std::string_view nearer(const Builder& b) { return b.greater_is_nearer ? "greater" : "less"; }
std::string_view nearer_or_equal(const Builder& b) { return b.greater_is_nearer ? "greater_equal" : "less_equal"; }

Object material(Builder& b) {
  Choices& c = b.choose;
  Object out;
  const std::vector<double> base = opaque(b);
  if (c.chance(90)) out.put_numbers("diffuse", base);
  if (c.chance(40)) out.put_numbers("ambient", c.chance(70) ? base : opaque(b));
  if (c.chance(45)) {
    out.put_numbers("specular", c.chance(60) ? std::vector<double>{1, 1, 1, 1} : opaque(b));
    out.put("shininess", c.of({1, 5, 8, 10, 16, 20, 25, 32, 32, 50, 64, 96.078431, 100, 128, c.number(0, 128)}));
  }
  if (c.chance(8)) out.put_numbers("emission", {c.number(0, 0.5), c.number(0, 0.5), c.number(0, 0.5), 1});
  return out;
}

Object fog(Builder& b) {
  Choices& c = b.choose;
  const std::string_view kind = c.word({"linear", "linear", "exp", "exp", "exp2"});
  Object out;
  if (c.chance(85)) out.put_numbers("color", color(b));
  if (kind == "linear") {
    const double start = c.number(0, 5);
    out.put("start", start).put("end", start + c.number(1, 20));
  } else {
    out.put("density", c.of({0.02, 0.05, 0.1, 0.1, 0.15, 0.2, 0.3, 0.35, 0.5, 1, c.number(0.01, 1)}));
  }
  return Object(kind, out.text());
}

std::string add_texture(Builder& b) {
  Choices& c = b.choose;
  if (b.texture_count > 0 && c.chance(35)) return fmt::format("t{}", c.count(0, b.texture_count - 1));
  Object out("image", image(b).text());
  if (c.chance(12))
    out.put_word("format", c.word({"rgb", "rgb", "rgba", "luminance", "luminance_alpha", "intensity", "alpha"}));
  if (c.chance(5)) out.put_word("texels", "float32");
  if (c.chance(75)) {
    out.put_word("min", c.word({"nearest", "nearest", "linear", "linear", "linear", "nearest_mipmap_nearest",
                                "linear_mipmap_nearest", "nearest_mipmap_linear", "linear_mipmap_linear",
                                "linear_mipmap_linear"}));
  }
  if (c.chance(60)) out.put_word("mag", c.word({"nearest", "linear"}));
  if (c.chance(40)) out.put_word("wrap_s", wrap(b)).put_word("wrap_t", wrap(b));
  if (c.chance(4)) out.put_numbers("border", opaque(b));
  if (c.chance(4)) out.put("lod_bias", c.number(-2, 2));
  const std::string name = fmt::format("t{}", b.texture_count++);
  b.textures.put(name, out);
  return name;
}

Object draw_texture(Builder& b, const std::string& name) {
  Object out("name", json_string(name));
  if (b.choose.chance(40)) {
    const std::string_view environment = b.choose.word({"replace", "replace", "modulate", "add", "blend"});
    out.put_word("environment", environment);
    if (environment == "blend") out.put_numbers("color", opaque(b));
  }
  return out;
}

void add_solid_state(Builder& b, Object& draw) {
  Choices& c = b.choose;
  if (c.chance(40)) draw.put_word("shading", c.word({"flat", "flat", "gouraud", "phong", "phong"}));
  if (c.chance(20)) draw.put_word("cull", c.word({"back", "back", "back", "front", "none"}));
  if (c.chance(4)) draw.put_word("normals", c.word({"rescale", "as_they_are"}));
  if (c.chance(6)) draw.put("back_material", material(b));
  if (c.chance(b.is_lit ? 6 : 60)) draw.put("lit", "false");
  if (!draw.has("texture") && c.chance(10)) {
    const std::string_view mode = c.word({"line", "line", "point"});
    draw.put_word("front_mode", mode);
    draw.put_word("back_mode", c.chance(70) ? mode : c.word({"fill", "line", "point"}));
    if (c.chance(30)) draw.put("line_width", c.count(1, 4));
    if (c.chance(30)) draw.put("point_size", c.count(1, 6));
    b.has_line_or_point = true;
  }
}

}  // namespace plumbline::ordinary
