// Legal float renderers in the small, for the tests of the oracle only: each transforms, cuts and snaps in float in
// a way of its own, covers in integers by the tie rule, and folds in draw order. Their winners must be legal answers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "capture/capture.h"
#include "capture/stages.h"
#include "reference/arithmetic/matrices.h"
#include "tests/cross/embree_scenes.h"
#include "tests/float_depth.h"

namespace plumbline::test {

/// Choices in which legal float renderers differ.
struct Habits {
  bool by_eye = false;                  ///< P (M p) rather than (P M) p
  bool in_double = false;               ///< the transform in double, rounded at the end
  bool snapped_planes = false;          ///< depth and colour by planes through the snapped corners
  bool reversed_clip = false;           ///< cut at the far plane first, at the right one last
  FloatDepth depth = FloatDepth::none;  ///< how depths and colours are interpolated in float; none: in double
  double jitter = 0;                    ///< largest relative error of a clip coordinate [2^-24]
};

struct FloatVertex {
  glm::vec4 clip;
  glm::dvec4 color;
};

/// Window z as the format holds it: the nearest code over the largest one; of z32f the nearest float.
inline double depth_code(DepthFormat format, double z) {
  const double scale = depth_scale(format);
  return scale > 0 ? std::nearbyint(z * scale) / scale : static_cast<double>(static_cast<float>(z));
}

class FloatRenderer {
 public:
  FloatRenderer(const Scene& scene, Habits habits) : scene_(scene), habits_(habits) {
    const FrameFormat& f = scene.frame;
    id = {f.width, f.height, kBackground};
    count = {f.width, f.height, 0};
    depth = {f.width, f.height, depth_code(f.depth, f.clear_depth)};
    color = {f.width, f.height, glm::dvec4(f.clear_color)};
    std::uint32_t primitive = 0;
    for (const Draw& draw : scene.draws) {
      const Mesh& mesh = scene.meshes[draw.mesh];
      const auto vertices = transform(draw, mesh);
      for (const glm::uvec3& t : mesh.triangles) {
        std::vector<FloatVertex> polygon{vertices[t.x], vertices[t.y], vertices[t.z]};
        if (draw.shading == Shading::flat) polygon[0].color = polygon[1].color = polygon[2].color;
        clip(polygon);
        for (std::size_t i = 2; i < polygon.size(); ++i)
          raster(draw, primitive, polygon[i - 1], polygon[i], polygon[0]);
        ++primitive;
      }
    }
  }

  Plane<std::int32_t> id;
  Plane<std::uint32_t> count;
  Plane<double> depth;
  Plane<glm::dvec4> color;

 private:
  std::vector<FloatVertex> transform(const Draw& draw, const Mesh& mesh) const {
    const Matrices<double> m = math::double_matrices(scene_, draw);
    const Matrices<double> rounded = math::float_matrices(scene_, draw);
    const glm::mat4 view(rounded.model_view), projection(rounded.projection), both = projection * view;
    std::vector<FloatVertex> out;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const glm::vec4 p(mesh.positions[i], 1);
      FloatVertex v;
      if (habits_.in_double) {
        v.clip = glm::vec4(m.projection * m.model_view * glm::dvec4(p));
      } else {
        v.clip = habits_.by_eye ? projection * (view * p) : both * p;
      }
      // Equal positions must move equally wherever they occur in the mesh.
      Random wobble(
          static_cast<unsigned>(std::hash<float>{}(p.x) * 31 + std::hash<float>{}(p.y) * 7 + std::hash<float>{}(p.z)));
      for (int c = 0; c < 4 && habits_.jitter > 0; ++c) {
        v.clip[c] += v.clip[c] * static_cast<float>(wobble.in(-habits_.jitter, habits_.jitter) / (1 << 24));
      }
      v.color = glm::dvec4(mesh.colors.empty() ? draw.material.diffuse : mesh.colors[i]);
      out.push_back(v);
    }
    return out;
  }

  void clip(std::vector<FloatVertex>& polygon) const {
    std::array<glm::vec4, 6> planes{glm::vec4(-1, 0, 0, 1), {1, 0, 0, 1}, {0, -1, 0, 1},
                                    {0, 1, 0, 1},           {0, 0, 1, 1}, {0, 0, -1, 1}};
    if (habits_.reversed_clip) std::reverse(planes.begin(), planes.end());
    for (const glm::vec4& plane : planes) {
      std::vector<FloatVertex> kept;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const FloatVertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const float da = glm::dot(plane, a.clip), db = glm::dot(plane, b.clip);
        if (da >= 0) kept.push_back(a);
        if ((da >= 0) == (db >= 0)) continue;
        const bool a_first = da >= 0;  // from the inside end, whichever way the edge runs
        const FloatVertex &in = a_first ? a : b, &out = a_first ? b : a;
        const float d_in = a_first ? da : db, d_out = a_first ? db : da;
        const float t = d_in / (d_in - d_out);
        kept.push_back(
            {in.clip + t * (out.clip - in.clip), in.color + static_cast<double>(t) * (out.color - in.color)});
      }
      polygon = kept;
    }
  }

  struct WindowPoint {
    glm::dvec2 p;
    double z, inv_w;
    glm::i64vec2 snapped;
    glm::dvec4 color;
  };
  WindowPoint to_window(const FloatVertex& v) const {
    const float inv = 1.0f / v.clip.w;
    const glm::vec2 half(0.5f * static_cast<float>(scene_.frame.width), 0.5f * static_cast<float>(scene_.frame.height));
    const glm::vec2 p = glm::vec2(v.clip) * inv * half + half;
    WindowPoint out{
        glm::dvec2(p), static_cast<double>(v.clip.z * inv * 0.5f + 0.5f), static_cast<double>(inv), {}, v.color};
    out.snapped = {std::llrint((out.p.x - 0.5) * kSubpixel), std::llrint((out.p.y - 0.5) * kSubpixel)};
    if (habits_.snapped_planes) out.p = glm::dvec2(out.snapped) / static_cast<double>(kSubpixel) + 0.5;
    return out;
  }

  void raster(const Draw& draw, std::uint32_t primitive, const FloatVertex& a, const FloatVertex& b,
              const FloatVertex& c) {
    std::array<WindowPoint, 3> v{to_window(a), to_window(b), to_window(c)};
    const auto cross = [](auto p, auto q) { return p.x * q.y - p.y * q.x; };
    const std::int64_t area = cross(v[1].snapped - v[0].snapped, v[2].snapped - v[0].snapped);
    if (area == 0 || (draw.cull != Cull::none && (area > 0) == (draw.cull == Cull::front))) return;
    if (area < 0) std::swap(v[1], v[2]);
    double flat = cross(v[1].p - v[0].p, v[2].p - v[0].p);
    if (!(flat > 0)) {  // turned over by snapping: no plane but through the snapped positions
      for (WindowPoint& p : v) p.p = glm::dvec2(p.snapped) / static_cast<double>(kSubpixel) + 0.5;
      flat = cross(v[1].p - v[0].p, v[2].p - v[0].p);
    }
    for (int y = 0; y < scene_.frame.height; ++y) {
      for (int x = 0; x < scene_.frame.width; ++x) {
        const glm::i64vec2 centre(kSubpixel * x, kSubpixel * y);
        bool inside = true;
        for (std::size_t i = 0; i < 3 && inside; ++i) {
          const glm::i64vec2 edge = v[(i + 1) % 3].snapped - v[i].snapped;
          const std::int64_t e = cross(edge, centre - v[i].snapped);
          inside = e > 0 || (e == 0 && (edge.y < 0 || (edge.y == 0 && edge.x > 0)));
        }
        if (inside) fragment(draw, primitive, v, flat, x, y);
      }
    }
  }

  void fragment(const Draw& draw, std::uint32_t primitive, const std::array<WindowPoint, 3>& v, double area, int x,
                int y) {
    const glm::dvec2 centre(x + 0.5, y + 0.5);
    double z = 0, inv_w = 0;
    glm::dvec4 c(0);
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec2 j = v[(i + 1) % 3].p, k = v[(i + 2) % 3].p;
      const double b = ((k.x - j.x) * (centre.y - j.y) - (k.y - j.y) * (centre.x - j.x)) / area;
      z += b * v[i].z;
      inv_w += b * v[i].inv_w;
      c += b * v[i].inv_w * v[i].color;
    }
    if (habits_.depth != FloatDepth::none) {
      const auto in_float = [&](auto value_of) {
        const auto corner = [&](std::size_t i) { return glm::dvec3(v[i].p, value_of(v[i])); };
        return static_cast<double>(depth_in_float(habits_.depth, {corner(0), corner(1), corner(2)}, glm::vec2(centre)));
      };
      const double z_in_float = in_float([](const WindowPoint& p) { return p.z; });
      if (std::isfinite(z_in_float)) {
        z = z_in_float;
        inv_w = in_float([](const WindowPoint& p) { return p.inv_w; });
        for (int k = 0; k < 4; ++k) c[k] = in_float([k](const WindowPoint& p) { return p.inv_w * p.color[k]; });
      }
    }
    ++count(x, y);
    const double code = depth_code(scene_.frame.depth, std::clamp(z, 0.0, 1.0));
    if (!passes(draw.depth_func, code, depth(x, y))) return;
    id(x, y) = static_cast<std::int32_t>(primitive);
    depth(x, y) = code;
    color(x, y) = c / inv_w;
  }

  static bool passes(DepthFunc func, double z, double held) {
    switch (func) {
      case DepthFunc::never: return false;
      case DepthFunc::less: return z < held;
      case DepthFunc::equal: return z == held;
      case DepthFunc::less_equal: return z <= held;
      case DepthFunc::greater: return z > held;
      case DepthFunc::not_equal: return z != held;
      case DepthFunc::greater_equal: return z >= held;
      case DepthFunc::always: return true;
    }
    return false;
  }

  const Scene& scene_;
  Habits habits_;
};

}  // namespace plumbline::test
