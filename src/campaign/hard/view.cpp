// Frame, camera and projection.
#include <algorithm>
#include <cmath>

#include "campaign/hard/builder.h"

namespace plumbline::hard {
namespace {

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Point& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }
Point unit(const Point& a) {
  const double l = length(a);
  return {a[0] / l, a[1] / l, a[2] / l};
}

struct Angle {
  double degrees, tangent;  ///< of half the angle: written out, since libraries' tangents differ in the last bit
};
constexpr Angle kAngles[] = {{10, 0.0874886635}, {30, 0.267949192}, {45, 0.414213562}, {60, 0.577350269}, {90, 1},
                             {120, 1.73205081},  {150, 3.73205081}};

Angle angle(Builder& b) { return kAngles[b.choose.count(0, 6)]; }

Object antialias(Builder& b) {
  const std::string_view kind =
      b.has_line_or_point ? "taps" : b.choose.word({"samples", "samples", "samples", "supersample", "taps"});
  if (kind == "samples") return Object("samples", "4");
  if (kind == "taps") return Object("taps", json_string("gzrender"));
  return Object("supersample", json(b.choose.count(1, 3)));
}

void orient(View& v) {
  v.forward = unit(minus(v.center, v.eye));
  v.right = unit(cross(v.forward, v.up));
  v.upward = cross(v.right, v.forward);
}

// Chooses the distances of the near and far planes: usual ones, nearly equal ones, or ones far apart.
void choose_planes(Builder& b) {
  Choices& c = b.choose;
  b.view.near = c.of({1, 1, 1, 0.1, 0.5, 0.01, 3, 0.0001});
  b.view.far = c.chance(15) ? b.view.near * c.of({1.0001, 1.01, 2}) : c.of({6, 10, 20, 100, 100, 1000, 100000});
  if (!b.view.clamps) return;
  b.view.near = std::max(b.view.near, 0.1);  // positions and depths in float stay inside
  b.view.far = std::clamp(b.view.far, 1.01 * b.view.near, 1000 * b.view.near);
}

Object box(double left, double right, double bottom, double top) {
  Object out;
  out.put("left", left).put("right", right).put("bottom", bottom).put("top", top);
  return out;
}

// Projection in which world units are pixels: every window coordinate is exactly a world coordinate.
Object pixels(Builder& b) {
  View& v = b.view;
  v.of_pixels = true;
  v.eye = {0, 0, 5}, v.center = {0, 0, 0}, v.up = {0, 1, 0};
  orient(v);
  v.slope = 0, v.half_height = v.height / 2.0;
  return box(0, v.width, 0, v.height);
}

Object opengl(Builder& b) {
  Choices& c = b.choose;
  View& v = b.view;
  const bool turned = b.dialect == "games101";
  const double sign = turned ? -1 : 1;
  choose_planes(b);
  const auto with_planes = [&](Object out) { return out.put("near", sign * v.near).put("far", sign * v.far); };
  v.aspect = static_cast<double>(v.width) / v.height;
  const std::string_view kind = v.clamps ? "perspective"
                                         : c.word({"perspective", "perspective", "perspective", "orthographic",
                                                   "pixels", "pixels", turned ? "perspective" : "frustum"});
  if (kind == "pixels") {
    v.near = 1, v.far = c.of({9, 10, 17, 100});
    return Object("orthographic", with_planes(pixels(b)).text());
  }
  if (kind == "perspective") {
    const Angle fov = angle(b);
    v.slope = fov.tangent;
    return Object("perspective", with_planes(Object("fov_y", json(fov.degrees))).text());
  }
  const double half_height = c.of({1, 2, 0.5, 3});
  if (kind == "orthographic") {
    v.slope = 0, v.half_height = half_height;
    const bool mirrored = c.chance(8);
    const double half_width = half_height * v.aspect * (mirrored ? -1 : 1);
    return Object("orthographic", with_planes(box(-half_width, half_width, -half_height, half_height)).text());
  }
  v.slope = half_height;
  const double h = half_height * v.near, w = h * v.aspect, aside = c.of({0, 0, 0.25, -0.5});  // an oblique frustum
  return Object("frustum", with_planes(box(-w + aside * w, w + aside * w, -h, h)).text());
}

}  // namespace

Point View::at(double x, double y, double distance) const {
  if (clamps) {
    const auto inside = [](double v, double low, double high) {
      const double margin = (high - low) / 100;
      return std::clamp(v, low + margin, high - margin);
    };
    x = inside(x, 0, width), y = inside(y, 0, height), distance = inside(distance, near, far);
  }
  const double h = half_height + slope * distance, across = (2 * x / width - 1) * h * aspect,
               above = (2 * y / height - 1) * h;
  Point out = {x, y, eye[2] - distance};  // of pixels
  for (std::size_t k = 0; k < 3; ++k) {
    if (!of_pixels) out[k] = eye[k] + forward[k] * distance + right[k] * across + upward[k] * above;
    out[k] = std::clamp(out[k], -1e6, 1e6);  // the format's
  }
  return out;
}

double distance(Builder& b) {
  Choices& c = b.choose;
  const View& v = b.view;
  const double end = v.far < 12 ? v.far : 12;
  switch (c.count(0, 19)) {
    case 0: return v.near;
    case 1: return v.far;
    case 2: return v.near * c.of({0.5, 0.999999, 1.000001, 1.5});
    case 3: return v.far * c.of({0.999999, 1.000001, 2});
    case 4: return c.of({0, 1e-6, -1e-6, 1e-3, -1e-3});  // w near 0
    case 5: return c.number(-6, 0);                      // behind the eye
    default: return end > v.near ? v.near + (end - v.near) * c.number(0, 1) : v.near;
  }
}

Object frame(Builder& b) {
  Choices& c = b.choose;
  Object out;
  out.put("width", b.view.width).put("height", b.view.height);
  if (b.color_format != "rgba8" || c.chance(10)) out.put_word("color", b.color_format);
  const std::string_view depth = c.word({"z24", "z24", "z24", "z16", "z16", "z8", "z32f"});
  if (depth != "z24" || c.chance(10)) out.put_word("depth", depth);
  if (c.chance(60)) out.put_numbers("clear_color", rgba(b));
  if (c.chance(20)) out.put("clear_depth", c.of({0, 0.5, 0.7, 1}));
  if (b.has_stencil) out.put_word("stencil", "s8");
  if (!b.has_stencil && c.chance(5)) out.put_word("stencil", "none");
  if (b.has_stencil && c.chance(50)) out.put("clear_stencil", c.of({0, 1, 2, 3, 127, 128, 255}));
  if (c.chance(10)) out.put("antialias", antialias(b));
  return out;
}

void choose_view(Builder& b) {
  Choices& c = b.choose;
  View& v = b.view;
  b.view.width = c.chance(60) ? static_cast<int>(c.of({16, 31, 32, 48, 64, 64, 65, 80})) : c.count(1, 80);
  b.view.height = c.chance(60) ? static_cast<int>(c.of({16, 31, 32, 48, 64, 64, 65, 80})) : c.count(1, 80);
  if (v.width == 79 || v.height == 79)
    v.width = 384, v.height = 288;  // 1 in 100: an edge function takes more than 32 bits
  if (c.chance(50)) {
    v.eye = {0, 0, c.of({4, 5, 5, 3})};
  } else {
    v.eye = {c.number(-4, 4), c.number(-3, 4), c.number(1, 8)};
    v.center = {c.number(-1, 1), c.number(-1, 1), c.number(-1, 0.5)};
  }
  if (c.chance(15)) v.up = {c.number(-1, 1), 1, c.number(-0.5, 0.5)};
  if (length(cross(minus(v.center, v.eye), v.up)) < 1e-3) v.up = {1, 0, 0};
  orient(v);
}

Object projection(Builder& b) {
  View& v = b.view;
  if (b.dialect == "gzrender") {
    const Angle fov = angle(b);
    v.half_height = 1, v.slope = fov.tangent, v.near = 0.01, v.far = 20;
    return Object("x_pi", Object("fov", json(fov.degrees)).text());
  }
  if (b.dialect == "tinyrenderer") {
    Object out;
    double c = length(minus(v.center, v.eye));
    if (b.choose.chance(40)) out.put("c", c = b.choose.of({1, 2, 3, 5, 10}));
    v.slope = 1 / c, v.near = c / 4, v.far = 2 * c;
    return Object("pinhole", out.text());
  }
  return opengl(b);
}

Object camera(const Builder& b) {
  const auto numbers = [](const Point& p) { return std::vector<double>(p.begin(), p.end()); };
  Object out;
  out.put_numbers("eye", numbers(b.view.eye)).put_numbers("center", numbers(b.view.center));
  return out.put_numbers("up", numbers(b.view.up));
}

}  // namespace plumbline::hard
