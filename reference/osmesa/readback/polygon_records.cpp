#include "reference/osmesa/readback/polygon_records.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstring>

#include <fmt/format.h>

#include "reference/osmesa/gl/feedback.h"
#include "reference/osmesa/scene/default_state.h"
#include "reference/osmesa/scene/light_program.h"
#include "reference/osmesa/scene/light_state.h"

namespace plumbline::osmesa {
namespace {

// A corner of a primitive, as it is fed. `tag` is a texture coordinate, which clipping interpolates: x and y are the
// low and high 16 bits of the primitive's number, the same at all corners and so at all cuts; z and w are (1,0), (0,1),
// (0,0) at the corners, and none of these at a cut.
struct FedCorner {
  glm::vec3 position, normal;
  glm::vec4 color, tag;
};

// A vertex and a triangle (or line or point) of GL_4D_COLOR_TEXTURE feedback.
struct FedVertex {
  glm::vec4 p_win_w;  // window x, y, z; clip w
  glm::vec4 color, tag;
};
struct FedTriangle {
  std::array<FedVertex, 3> v;  // a line repeats its last vertex, a point has three equal ones
  std::uint32_t corners;
};
constexpr std::size_t kVertex = sizeof(FedVertex) / sizeof(float);
static_assert(kVertex == 12);
// Number of feedback values of one primitive: token, count of vertices (triangles only), vertices.
constexpr std::size_t values_of(std::size_t corners) { return (corners == 3 ? 2 : 1) + corners * kVertex; }

// Primitives fed at a time, which bounds the feedback buffer.
constexpr std::size_t kBatch = 1 << 15;

std::vector<std::uint32_t> wanted_primitives(const DrawRange& range, const std::vector<std::uint32_t>& only) {
  std::vector<std::uint32_t> primitives;
  const std::uint32_t end = range.first_primitive + range.primitive_count;
  if (only.empty()) {
    for (std::uint32_t p = range.first_primitive; p < end; ++p) primitives.push_back(p);
  } else {
    std::copy_if(only.begin(), only.end(), std::back_inserter(primitives),
                 [&](std::uint32_t p) { return p >= range.first_primitive && p < end; });
  }
  return primitives;
}

// Corners of the primitives, as feedback mode is fed with them; color(vertex) is a corner's colour.
template <class Color>
std::vector<FedCorner> fed_corners(const Mesh& mesh, std::uint32_t first_primitive,
                                   std::span<const std::uint32_t> primitives, const Color& color) {
  constexpr std::array<glm::vec2, 3> kCornerTags = {glm::vec2(1, 0), glm::vec2(0, 1), glm::vec2(0, 0)};
  std::vector<FedCorner> corners;
  const auto count = static_cast<int>(corner_count(mesh.topology));
  corners.reserve(static_cast<std::size_t>(count) * primitives.size());
  for (const std::uint32_t primitive : primitives) {
    const glm::uvec3 triangle = mesh.triangles[primitive - first_primitive];
    const glm::vec2 number(static_cast<float>(primitive & 0xffffu), static_cast<float>(primitive >> 16));
    for (int i = 0; i < count; ++i) {
      const std::uint32_t v = triangle[i];
      corners.push_back(
          {mesh.positions[v], mesh.normals[v], color(v), glm::vec4(number, kCornerTags[static_cast<std::size_t>(i)])});
    }
  }
  return corners;
}

// Draws the corners from client memory, as feedback mode never frees a buffer object that it has read (Mesa 22.3).
void draw_corners(const Gl& gl, const std::vector<FedCorner>& corners, Topology topology, bool colors) {
  const SavedArrays arrays(gl);
  gl.VertexPointer(3, GL_FLOAT, sizeof(FedCorner), &corners[0].position);
  gl.NormalPointer(GL_FLOAT, sizeof(FedCorner), &corners[0].normal);
  gl.ColorPointer(4, GL_FLOAT, sizeof(FedCorner), &corners[0].color);
  gl.TexCoordPointer(4, GL_FLOAT, sizeof(FedCorner), &corners[0].tag);
  gl.EnableClientState(GL_VERTEX_ARRAY);
  gl.EnableClientState(GL_NORMAL_ARRAY);
  if (colors) gl.EnableClientState(GL_COLOR_ARRAY);
  gl.EnableClientState(GL_TEXTURE_COORD_ARRAY);
  gl.DrawArrays(gl_mode(topology), 0, static_cast<GLsizei>(corners.size()));
}

std::size_t corners_by_token(float token) {
  if (token == static_cast<float>(GL_POLYGON_TOKEN)) return 3;
  if (token == static_cast<float>(GL_LINE_TOKEN) || token == static_cast<float>(GL_LINE_RESET_TOKEN)) return 2;
  if (token == static_cast<float>(GL_POINT_TOKEN)) return 1;
  throw RendererFailed(fmt::format("OpenGL: feedback token {}, not that of what was drawn", token));
}

std::vector<FedTriangle> triangles_of(std::span<const float> values) {
  std::vector<FedTriangle> triangles;
  while (!values.empty()) {
    const std::size_t corners = corners_by_token(values[0]), size = values_of(corners);
    if (values.size() < size || (corners == 3 && values[1] != 3)) {
      throw RendererFailed("OpenGL: feedback is not of whole primitives");
    }
    FedTriangle& t = triangles.emplace_back();
    std::memcpy(t.v.data(), values.first(size).last(corners * kVertex).data(), corners * sizeof(FedVertex));
    std::fill(t.v.begin() + static_cast<std::ptrdiff_t>(corners), t.v.end(), t.v[corners - 1]);
    t.corners = static_cast<std::uint32_t>(corners);
    values = values.subspan(size);
  }
  return triangles;
}

std::uint32_t primitive_of(const FedTriangle& t) {
  const glm::vec4& tag = t.v[0].tag;
  for (const FedVertex& v : t.v) {
    if (v.tag.x == tag.x && v.tag.y == tag.y) continue;
    throw RendererFailed(
        fmt::format("OpenGL: feedback's tags ({}, {}) and ({}, {}) in one triangle", tag.x, tag.y, v.tag.x, v.tag.y));
  }
  return static_cast<std::uint32_t>(tag.x) | static_cast<std::uint32_t>(tag.y) << 16;
}

bool is_cut(const FedVertex& v) {
  const float a = v.tag.z, b = v.tag.w;
  return !((a == 0 || a == 1) && (b == 0 || b == 1));
}

class ToClip {
 public:
  explicit ToClip(const Matrices<double>& m) : scale_(m.win_scale), translate_(m.win_translate) {}
  ClipVertex<double> operator()(const FedVertex& v) const {
    const double w = static_cast<double>(v.p_win_w.w);
    const glm::dvec3 p_ndc = (glm::dvec3(v.p_win_w) - translate_) / scale_;
    return {glm::dvec4(p_ndc * w, w), v.color, is_cut(v)};
  }

 private:
  glm::dvec3 scale_, translate_;
};

// Appends the polygons. Successive triangles of one primitive are the fan (1, 2, 0), (2, 3, 0) ... of a clipped
// polygon.
void add_polygons(std::span<const FedTriangle> triangles, const ToClip& to_clip, ClipPolygons<double>& out) {
  for (const FedTriangle& t : triangles) {
    for (const FedVertex& v : t.v) {
      const glm::vec4 p = v.p_win_w;
      if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::isfinite(p.w)) continue;
      throw Unsupported(
          fmt::format("OpenGL's clipping of primitive {} goes beyond the range of float", primitive_of(t)));
    }
  }
  for (std::size_t i = 0; i < triangles.size();) {
    const std::uint32_t primitive = primitive_of(triangles[i]);
    const auto first = static_cast<std::uint32_t>(out.vertices.size());
    const auto& fan = triangles[i].v;
    if (triangles[i].corners < 3) {
      for (std::uint32_t k = 0; k < triangles[i].corners; ++k) out.vertices.push_back(to_clip(fan[k]));
      out.polygons.push_back({primitive, first, triangles[i].corners});
      ++i;
      continue;
    }
    for (const int corner : {2, 0, 1}) out.vertices.push_back(to_clip(fan[static_cast<std::size_t>(corner)]));
    for (++i; i < triangles.size() && primitive_of(triangles[i]) == primitive; ++i) {
      if (triangles[i].v[2].p_win_w != fan[2].p_win_w || triangles[i].v[0].p_win_w != triangles[i - 1].v[1].p_win_w) {
        throw RendererFailed(fmt::format("OpenGL: feedback of primitive {} is no fan", primitive));
      }
      out.vertices.push_back(to_clip(triangles[i].v[1]));
    }
    out.polygons.push_back({primitive, first, static_cast<std::uint32_t>(out.vertices.size()) - first});
  }
}

bool outlined(const Mesh& mesh, const Draw& draw) { return mesh.topology == Topology::triangles && !is_filled(draw); }

// Throws Unsupported if the view volume cuts an unfilled triangle. OpenGL 2.1, section 2.12: "edges introduced by
// clipping are flagged as boundary". Mesa draws those made by user clip planes, but none made by the view volume; of
// their corners, as points, one of two.
[[noreturn]] void refuse_cut(std::uint32_t primitive) {
  throw Unsupported(
      fmt::format("Mesa draws no edges where the view volume cuts a triangle that is not filled, such as primitive {} "
                  "(OpenGL 2.1, section 2.12: they are boundary edges)",
                  primitive));
}

// Throws Unsupported if the view volume cuts a triangle. `filled`: feedback of the triangles, drawn filled.
void require_uncut(std::span<const FedTriangle> filled) {
  for (std::size_t i = 0; i < filled.size(); ++i) {
    const FedTriangle& t = filled[i];
    // A cut very close to a corner has the corner's tag; then the fan shows the cut.
    const bool fan = i > 0 && primitive_of(filled[i - 1]) == primitive_of(t);
    if (fan || std::any_of(t.v.begin(), t.v.end(), is_cut)) refuse_cut(primitive_of(t));
  }
}

// Throws Unsupported unless a triangle has three edges or corners. `outlines`: feedback of the unfilled triangles; Mesa
// leaves one edge or corner out where two cuts have corners' tags and the fan is one triangle.
void require_three_each(std::span<const FedTriangle> outlines) {
  for (std::size_t i = 0, end = 0; i < outlines.size(); i = end) {
    const std::uint32_t primitive = primitive_of(outlines[i]);
    while (end < outlines.size() && primitive_of(outlines[end]) == primitive) ++end;
    if (outlines[i].corners < 3 && end - i != 3) refuse_cut(primitive);
  }
}

// Snapping by the rule of stages.h, in float as in Mesa's rasterizer.
int snap(float window) { return static_cast<int>(std::lrint((window - 0.5f) * static_cast<float>(kSubpixel))); }

std::int64_t doubled_area(const WindowTriangle<double>& t) {
  const auto edge = [&](std::size_t i) { return glm::i64vec2(t.v[i].snapped) - glm::i64vec2(t.v[0].snapped); };
  return edge(1).x * edge(2).y - edge(1).y * edge(2).x;
}

// Appends the triangles that are not culled. Feedback mode culls by the area of the unsnapped positions, the rasterizer
// by that of the snapped ones (measured: on slivers the two differ, and the pixels are the rasterizer's). So GL's
// culling is off here, and triangles are culled by the snapped area; GL's own culling shows in the planes.
void add_triangles(std::span<const FedTriangle> triangles, const Draw& draw, std::vector<WindowTriangle<double>>& out) {
  for (const FedTriangle& fed : triangles) {
    WindowTriangle<double> t;
    t.primitive = primitive_of(fed);
    for (std::size_t i = 0; i < 3; ++i) {
      const FedVertex& v = fed.v[i];
      t.v[i] = {v.p_win_w, 1.0 / static_cast<double>(v.p_win_w.w), {snap(v.p_win_w.x), snap(v.p_win_w.y)}, v.color};
    }
    t.corners = fed.corners;
    if (t.corners < 3) t.width = static_cast<std::uint32_t>(t.corners == 2 ? draw.line_width : draw.point_size);
    const std::int64_t area = fed.corners < 3 ? 1 : doubled_area(t);
    t.front = area > 0;
    if (fed.corners == 3 && (area == 0 || draw.cull == (t.front ? Cull::front : Cull::back))) continue;
    out.push_back(t);
  }
}

// Whether feedback mode must light the draw: read_polygons()' `lit` has the colours of front faces only.
bool feeds_two_sides(const Scene& scene, const Draw& draw) {
  return is_lit_per_vertex(draw) && scene.light_model.sides == LightModel::Sides::two;
}

// Mesa's major version, such as 25 of "4.5 (Compatibility Profile) Mesa 25.0.7-2+deb13u1"; 0: not Mesa.
int major_version_of_mesa(std::string_view gl_version) {
  constexpr std::string_view kMesa = "Mesa ";
  const std::size_t at = gl_version.find(kMesa);
  int version = 0;
  if (at != gl_version.npos)
    std::from_chars(gl_version.data() + at + kMesa.size(), gl_version.data() + gl_version.size(), version);
  return version;
}

}  // namespace

bool crashes_in_feedback(const Scene& scene, MesaDriver driver, std::string_view gl_version) {
  constexpr int kFirstThatCrashes = 25;
  if (driver != MesaDriver::llvmpipe || major_version_of_mesa(gl_version) < kFirstThatCrashes) return false;
  return std::ranges::any_of(scene.draws, [&](const Draw& draw) {
    return feeds_two_sides(scene, draw) && needs_light_program(scene, draw) && !scene.lights.empty();
  });
}

void read_polygons(const Gl& gl, const SceneInGl& scene, std::span<const Lit<double>> lit, const Request& request,
                   Records<double>& records) {
  const bool clip = request.records.has(Stage::clip), window = request.records.has(Stage::window);
  const PassState state(gl);
  Feedback feedback(gl, GL_4D_COLOR_TEXTURE);
  set_lights(gl, scene.scene());
  for (std::size_t i = 0; i < scene.ranges().size(); ++i) {
    const DrawRange& range = scene.ranges()[i];
    const Draw& draw = scene.scene().draws[i];
    const Mesh& mesh = scene.scene().meshes[draw.mesh];
    const std::vector<std::uint32_t> wanted = wanted_primitives(range, request.primitives);
    scene.set_matrices(i);
    // Other draws pass their colours through: lit again, they would cost a shader of their own.
    const bool two_sided = feeds_two_sides(scene.scene(), draw);
    if (two_sided) {
      scene.set_vertex_light(i);
    } else {
      gl.Disable(GL_LIGHTING);
      gl.UseProgram(0);
    }
    const auto color = [&](std::uint32_t vertex) {
      return two_sided ? color_at(mesh, vertex) : glm::vec4(lit[range.first_vertex + vertex].color);
    };
    gl.ShadeModel(GL_SMOOTH);  // flat, feedback leaves the colours of cut triangles undefined (measured)
    Matrices<double> whole_range = scene.matrices(i);
    whole_range.win_scale.z = whole_range.win_translate.z = 0.5;
    const ToClip to_clip(whole_range);
    for (std::size_t at = 0; at < wanted.size(); at += kBatch) {
      const auto batch = std::span(wanted).subspan(at, std::min(kBatch, wanted.size() - at));
      const std::vector<FedCorner> corners = fed_corners(mesh, range.first_primitive, batch, color);
      const std::size_t expected = values_of(corner_count(mesh.topology)) * (batch.size() * 5 / 4 + 16);
      const auto fed = [&] {
        const auto run = [&] { draw_corners(gl, corners, mesh.topology, !two_sided || !mesh.colors.empty()); };
        return triangles_of(feedback.run(expected, run));
      };
      std::vector<FedTriangle> triangles = fed();
      if (clip && draw.depth_range != DepthRange{}) {  // a narrow one leaves little of the clip position's z
        gl.DepthRange(0, 1);
        add_polygons(fed(), to_clip, records.polygons);
        gl.DepthRange(draw.depth_range.near, draw.depth_range.far);
      } else if (clip) {
        add_polygons(triangles, to_clip, records.polygons);
      }
      if (window && outlined(mesh, draw)) {
        require_uncut(triangles);
        const SavedState outlines(gl);
        scene.set_fragments(i);
        triangles = fed();
        require_three_each(triangles);
      }
      if (window) add_triangles(triangles, draw, records.triangles);
    }
  }
}

}  // namespace plumbline::osmesa
