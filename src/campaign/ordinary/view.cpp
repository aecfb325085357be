// Frame, camera, projection and lights.
#include "campaign/ordinary/builder.h"

namespace plumbline::ordinary {
namespace {

std::string_view color_format(Builder& b) {
  if (b.dialect == "gzrender" && b.choose.chance(30)) return "rgba12";
  if (b.choose.chance(88)) return "rgba8";
  return b.choose.word({"rgba12", "rgba16", "rgba16", "rgba32f"});
}

std::string_view depth_format(Builder& b) {
  if (b.dialect == "tinyrenderer" && b.choose.chance(25)) return "z8";
  if (b.choose.chance(75)) return "z24";
  return b.choose.word({"z16", "z16", "z32f", "z32f", "z8"});
}

Object antialias(Builder& b) {
  if (b.has_line_or_point)
    return Object("taps", json_string("gzrender"));  // the format's only kind for lines and points
  const std::string_view kind = b.choose.word({"samples", "samples", "supersample", "taps"});
  if (kind == "samples") return Object("samples", "4");
  if (kind == "taps") return Object("taps", json_string("gzrender"));
  return Object("supersample", json(b.choose.count(2, 3)));
}

Object spot(Builder& b, const std::vector<double>& from) {
  Object out;
  if (b.choose.chance(60)) {  // straight at the origin
    out.put_numbers("direction", {-from[0], -from[1], -from[2]});
  } else {
    out.put_numbers("direction", {b.choose.number(-1, 1), -1, b.choose.number(-1, 1)});
  }
  out.put("cutoff", b.choose.of({10, 15, 20, 25, 30, 35, 45, 60, 90, b.choose.number(5, 60)}));
  if (b.choose.chance(60)) out.put("exponent", b.choose.of({0, 1, 2, 4, 5, 10, 16, 20, 50, 64, 128}));
  return out;
}

Object light(Builder& b) {
  Choices& c = b.choose;
  Object out;
  if (c.chance(50)) {
    out.put_numbers("directional", {c.number(-3, 3), c.number(0.5, 3), c.number(-1, 3)});
  } else {
    const std::vector<double> from{c.number(-1.5, 1.5) * b.reach, c.number(0.3, 1.5) * b.reach,
                                   c.number(-1.5, 1.5) * b.reach};
    out.put_numbers("point", from);
    if (c.chance(40)) {
      out.put_numbers("attenuation", {c.of({1, 1, 1, 0.5}), c.of({0, 0, 0.05, 0.1, 0.2, 0.09}),
                                      c.of({0, 0, 0.01, 0.02, 0.05, 0.032})});
    }
    if (c.chance(40)) out.put("spot", spot(b, from));
  }
  if (c.chance(70)) out.put_numbers("diffuse", color(b));
  if (c.chance(50)) out.put_numbers("specular", color(b));
  if (c.chance(20)) out.put_numbers("ambient", {c.number(0, 0.2), c.number(0, 0.2), c.number(0, 0.2)});
  return out;
}

Object box(Builder& b, double half_height, double near, double far) {
  const double half_width = b.choose.chance(80) ? half_height * b.width / b.height : half_height;
  Object out;
  out.put("left", -half_width).put("right", half_width).put("bottom", -half_height).put("top", half_height);
  return out.put("near", near).put("far", far);
}

}  // namespace

Object frame(Builder& b) {
  Object out;
  out.put("width", b.width).put("height", b.height);
  const std::string_view colors = color_format(b), depths = depth_format(b);
  if (colors != "rgba8" || b.choose.chance(10)) out.put_word("color", colors);
  if (depths != "z24" || b.choose.chance(10)) out.put_word("depth", depths);
  if (b.choose.chance(50)) out.put_numbers("clear_color", opaque(b));
  if (b.wants_stencil) out.put_word("stencil", "s8");
  if (b.wants_stencil && b.choose.chance(10)) out.put("clear_stencil", b.choose.of({1, 128, 255}));
  if (b.choose.chance(b.has_line_or_point ? 2 : 8)) out.put("antialias", antialias(b));
  return out;
}

Object camera(Builder& b) {
  Choices& c = b.choose;
  b.width = c.chance(60) ? static_cast<int>(c.of({32, 48, 64, 64, 64, 80, 96, 100, 128})) : c.count(32, 110);
  b.height = c.chance(60) ? static_cast<int>(c.of({32, 48, 48, 64, 64, 72, 80, 96})) : c.count(32, 96);
  Object out;
  if (c.chance(30)) {  // the textbook's
    out.put_numbers("eye", {0, c.of({0, 0, 0.5, 1}), c.of({3, 4, 5, 6, 8})});
  } else {
    out.put_numbers("eye", {c.number(-4, 4), c.number(-0.5, 4), c.number(2.5, 9)});
  }
  const bool ahead = c.chance(60);
  out.put_numbers("center", ahead ? std::vector<double>{0, 0, 0}
                                  : std::vector<double>{c.number(-1, 1), c.number(-1, 1), c.number(-1, 1)});
  const bool rolled = c.chance(8);
  out.put_numbers("up", rolled ? std::vector<double>{c.number(-0.5, 0.5), 1, 0} : std::vector<double>{0, 1, 0});
  return out;
}

Object projection(Builder& b) {
  Choices& c = b.choose;
  const double fov = c.of({30, 35, 40, 45, 45, 45, 50, 55, 60, 60, 70, 75, 90, c.number(30, 90)});
  const double near = c.of({0.01, 0.1, 0.1, 0.1, 0.5, 1, 1, 1}), far = c.of({10, 15, 20, 30, 50, 100, 100, 1000});
  if (b.dialect == "gzrender") return Object("x_pi", Object().put("fov", fov).text());
  if (b.dialect == "tinyrenderer") {
    Object pinhole;
    if (c.chance(20)) pinhole.put("c", c.number(2, 10));
    return Object("pinhole", pinhole.text());
  }
  const double sign = b.dialect == "games101" ? -1 : 1;
  if (c.chance(80)) {
    Object perspective;
    perspective.put("fov_y", fov).put("near", sign * near).put("far", sign * far);
    return Object("perspective", perspective.text());
  }
  if (b.dialect == "games101" || c.chance(75)) {
    const double its_near = sign * c.of({0, 0.1, 1, -10}), half_height = c.number(1, 4);
    return Object("orthographic", box(b, half_height, its_near, sign * far).text());
  }
  return Object("frustum", box(b, near * c.number(0.3, 0.9), near, far).text());
}

std::string lights(Builder& b) {
  std::vector<std::string> out;
  const int count = static_cast<int>(b.choose.of({1, 1, 1, 1, 2, 2, 3}));
  for (int i = 0; i < count; ++i) out.push_back(light(b).text());
  return json_array(out);
}

Object light_model(Builder& b) {
  Choices& c = b.choose;
  Object out;
  if (c.chance(15)) out.put("local_viewer", "true");
  if (c.chance(12)) out.put_word("sides", "two");
  if (c.chance(8)) out.put("separate_specular", "true");
  if (b.dialect == "gzrender" && c.chance(50)) out.put_word("sides", "flip").put_word("specular", "reflection");
  if (b.dialect != "gzrender" && c.chance(3)) out.put_word("specular", "reflection");
  return out;
}

}  // namespace plumbline::ordinary
