#include "faults/notes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "faults/pixel_barycentrics.h"
#include "faults/pixels_in_order.h"
#include "faults/variants.h"
#include "pipeline/geometry.h"
#include "transforms/projection.h"

namespace plumbline::faults {

namespace {

constexpr double kRadians = 3.14159265358979323846 / 180.0;

// Stage 0 of another camera. Lights (Stages::lights) still go by the scene's own camera.
Matrices<float> seen_by(const Camera& camera, const Scene& scene, const Draw& draw) {
  Scene moved;  // all that stage 0 reads
  moved.name = scene.name;
  moved.dialect = scene.dialect;
  moved.frame = scene.frame;
  moved.projection = scene.projection;
  moved.camera = camera;
  return pipeline::matrices(moved, draw);
}

// v = w x v with v = t before: -|t x w| u. The matrix is singular; normals stay right.
Matrices<float> v_is_w_cross_v(const Scene& scene, const Draw& draw) {
  Matrices<float> m = pipeline::matrices(scene, draw);
  if (scene.dialect != Dialect::gzrender) return m;
  const auto& [c, l, t] = scene.camera;
  const auto length = static_cast<float>(glm::length(glm::cross(t, glm::normalize(l - c))));
  for (int column = 0; column < 4; ++column) m.model_view[column][1] = -length * m.model_view[column][0];
  return m;
}

// The origin at `center`, under a projection whose eye is at the origin.
Matrices<float> lookat_without_its_projection(const Scene& scene, const Draw& draw) {
  if (scene.dialect != Dialect::gl && scene.dialect != Dialect::games101) return pipeline::matrices(scene, draw);
  const auto& [eye, center, up] = scene.camera;
  return seen_by({center, center + (center - eye), up}, scene, draw);
}

// X_pi's eye is d behind c: c and l are moved d forward, and the eye is where c was.
Matrices<float> eye_at_c(const Scene& scene, const Draw& draw) {
  const auto* view_plane = std::get_if<ViewPlane>(&scene.projection);
  if (view_plane == nullptr) return pipeline::matrices(scene, draw);
  const auto& [c, l, up] = scene.camera;
  const glm::dvec3 forward = transforms::gzrender::d_of_fov(view_plane->fov_degrees * kRadians) * glm::normalize(l - c);
  return seen_by({c + forward, l + forward, up}, scene, draw);
}

// NDC x = -1 is the first column's sample and y = 1 the top row's, not these pixels' outer sides: the picture moves
// half a pixel to the right and down, 1/width and 1/height in NDC.
Matrices<float> whole_centres(const Scene& scene, const Draw& draw) {
  Matrices<float> m = pipeline::matrices(scene, draw);
  if (scene.dialect != Dialect::gl && scene.dialect != Dialect::games101) return m;
  for (int column = 0; column < 4; ++column) {
    Vec4<float>& to_clip = m.projection[column];
    to_clip.x += to_clip.w / static_cast<float>(scene.frame.width);
    to_clip.y -= to_clip.w / static_cast<float>(scene.frame.height);
  }
  return m;
}

// N.L below 0 takes light away, as does an opposite light of negative colour. (Directional lights alone, as GzRender's
// are; 8 lights at most.)
void no_clamp_of_n_l(const pipeline::LightInput& in, std::vector<pipeline::Attributes>& out) {
  Scene wrong = in.scene;
  std::vector<LightSource<float>> opposite(in.lights.begin(), in.lights.end());
  for (std::size_t i = 0; i < in.scene.lights.size(); ++i) {
    const Light& l = in.scene.lights[i];
    if (l.kind == Light::Kind::directional && wrong.lights.size() < 8) {
      wrong.lights.push_back({l.kind, -l.vector, glm::vec3(0), -l.diffuse, glm::vec3(0)});
      opposite.push_back({-in.lights[i].p_eye, {}});
    }
  }
  pipeline::light({wrong, in.draw, in.mesh, opposite, in.vertices}, out);
}

// GzRender turns N where N.L and N.E are both below 0, and skips the light where only one is. The mistake turns N
// wherever N.E < 0.
void flipped_normals(const pipeline::LightInput& in, std::vector<pipeline::Attributes>& out) {
  std::vector<Vertex<float>> facing(in.vertices.begin(), in.vertices.end());
  for (Vertex<float>& v : facing) {
    if (v.n_eye.z < 0) v.n_eye = -v.n_eye;
  }
  pipeline::light({in.scene, in.draw, in.mesh, in.lights, facing}, out);
}

// A triangle with a corner before the near plane (Z < 0) is deleted. Where depths are clamped there is no near
// plane.
void delete_behind_view_plane(const pipeline::DrawInput& input, pipeline::Polygon& polygon) {
  const auto is_before = [](const pipeline::ClipVertex& v) { return v.p_clip.z < -v.p_clip.w; };
  if (!input.depth_clamp && std::any_of(polygon.corners.begin(), polygon.corners.end(), is_before)) {
    return polygon.corners.clear();
  }
  pipeline::clip(input, polygon);
}

constexpr bool is_small_side(std::int64_t step_x, std::int64_t step_y) {
  return step_x > 0 || (step_x == 0 && step_y > 0);
}

bool no_edge_in(std::int64_t, std::int64_t) { return false; }
bool left_edges_in(std::int64_t step_x, std::int64_t) { return step_x > 0; }
bool left_and_right_edges_in(std::int64_t step_x, std::int64_t) { return step_x != 0; }
// "Consistent sign" holds for either sign: only the ownership of edges changes sides.
bool left_taken_for_right(std::int64_t step_x, std::int64_t step_y) { return !is_small_side(step_x, step_y); }

// x_i is the first corner's x, in pixels whose centres are whole numbers.
PixelList box_of_one_vertex(const Triangle& triangle, const PixelBounds& box) {
  if (triangle.corners != 3) return pipeline::covered_pixels(triangle, box);
  const glm::ivec2 p = triangle.v[2].snapped;  // the fan's hub
  const auto floor = [](int snapped) { return snapped >> 8; };
  const auto ceiling = [](int snapped) { return (snapped + kSubpixel - 1) >> 8; };
  const PixelBounds of_vertex{floor(p.x), floor(p.y), ceiling(p.x) + 1, ceiling(p.y) + 1};
  return pipeline::covered_pixels(pipeline::edges_of(triangle), of_vertex, box);
}

// y = y + k in float for each x, from the first exited pixel on; ROUND(y).
PixelList incremental_line(const Triangle& t, const PixelBounds& box) {
  if (t.corners != 2) return pipeline::covered_pixels(t, box);
  const glm::ivec2 from = t.v[0].snapped, d = t.v[1].snapped - from;
  const int x = std::abs(d.x) >= std::abs(d.y) ? 0 : 1, y = 1 - x;  // the major axis and the other
  const float k = static_cast<float>(d[y]) / static_cast<float>(std::abs(d[x]));
  const PixelList line = pixels_in_order(t, {0, 0, 16384, 16384});  // all of any frame
  PixelList out;
  float at = 0;
  for (glm::ivec2 p : line) {
    const int steps = std::abs(p[x] * kSubpixel - from[x]);
    at = p == line.front() ? (static_cast<float>(from[y]) + k * static_cast<float>(steps)) / kSubpixel : at + k;
    p[y] = static_cast<int>(std::floor(at + 0.5f));
    if (p.x >= box.x0 && p.y >= box.y0 && p.x < box.x1 && p.y < box.y1) out.push_back(p);
  }
  return out;
}

// (sum b z) / (sum b w), z and w before the division, b on the screen. Since z = A w + B, that is A + B / (sum b w):
// the depth of the point whose distance is interpolated on the screen. So 002's z/w and the Z that 004 warns of are one
// mistake.
float depth_of_linear_z(const Setup& setup, const Pixels<float>& p) {
  const Barycentric b = pipeline::barycentric(setup.planes, p);
  const pipeline::DepthSetup& s = setup.depth;
  const auto& inv_w = setup.perspective.inv_w;
  const double b0 = b.l0 / pipeline::to_wide(inv_w[0]), b1 = b.l1 / pipeline::to_wide(inv_w[1]),
               b2 = b.l2 / pipeline::to_wide(inv_w[2]);
  const double z = b0 * s.z0 + b1 * (s.z0 + s.dz1) + b2 * (s.z0 + s.dz2), w = b0 + b1 + b2;
  return stored_depth(s, z / w + z_of_sample(setup));
}

float eight_bit_depth(const Setup& setup, const Pixels<float>& p) {
  return stored_depth(setup.depth, pipeline::depth_code(window_z(setup, p), 255.0) / 255.0);
}

constexpr std::array kNotes = {
    Fault{"notes.000.v_is_w_cross_v", "World Space -> Camera Space: v = w x v, v being up before, for w x u",
          Stage::matrices, put<&Stages::matrices, v_is_w_cross_v>},
    Fault{"notes.000.no_clamp_of_n_l", "Shading: where N.L is below 0, directional lights take light away",
          Stage::light, put<&Stages::light, no_clamp_of_n_l>},
    Fault{"notes.000.flipped_normals", "Shading, GzRender's way: normals that face away from the eye are turned over",
          Stage::light, put<&Stages::light, flipped_normals>},
    Fault{"notes.000.strict_edges", "Rasterization: alpha, beta, gamma > 0: no triangle has the pixels on its edges",
          Stage::coverage, put<&Stages::coverage, tied<no_edge_in>>},
    Fault{"notes.000.box", "Rasterization: the bounding box is that of one vertex", Stage::coverage,
          put<&Stages::coverage, box_of_one_vertex>},
    Fault{"notes.000.affine_color", "Rasterization: c = alpha c0 + beta c1 + gamma c2, without perspective",
          Stage::attributes, put<&Stages::attributes, affine_attributes>},
    Fault{"notes.002.lookat", "LookAt Method: the center is the origin, under a projection with its eye there",
          Stage::matrices, put<&Stages::matrices, lookat_without_its_projection>},
    Fault{"notes.002.sum_z_over_sum_w", "Z-Buffer: depth is (sum b z) / (sum b w), b on the screen", Stage::depth,
          put<&Stages::depth, depth_of_linear_z>},
    Fault{"notes.002.eight_bit_depth", "Z-Buffer: depth has 256 codes, whatever the format", Stage::depth,
          put<&Stages::depth, eight_bit_depth>},
    Fault{"notes.002.affine_color", "Fragment Shader: varying_intensity * bar, without perspective", Stage::attributes,
          put<&Stages::attributes, affine_attributes>},
    Fault{"notes.004.eye_at_c", "3.3: the eye is at c, not d behind it", Stage::matrices,
          put<&Stages::matrices, eye_at_c>},
    Fault{"notes.004.whole_centres", "2.1, 3.2 X_sp: pixel centres are whole numbers: half a pixel off",
          Stage::matrices, put<&Stages::matrices, whole_centres>},
    Fault{"notes.004.delete_behind_view_plane", "3.2: triangles with a corner of Z < 0 are deleted, not cut",
          Stage::clip, put<&Stages::clip, delete_behind_view_plane>},
    Fault{"notes.004.incremental_line", "2.2: lines by y = y + k in float, whose error builds up", Stage::coverage,
          put<&Stages::coverage, incremental_line>},
    Fault{"notes.004.lee_sign", "2.5: E > 0 is taken for left, so that right edges' pixels are in for left ones'",
          Stage::coverage, put<&Stages::coverage, tied<left_taken_for_right>>},
    Fault{"notes.004.left_edges", "2.5: pixels on left edges are in, on horizontal ones nobody's", Stage::coverage,
          put<&Stages::coverage, tied<left_edges_in>>},
    Fault{"notes.004.left_right_edges", "2.5: pixels on left and right edges are in, on horizontal ones nobody's",
          Stage::coverage, put<&Stages::coverage, tied<left_and_right_edges_in>>},
    Fault{"notes.004.all_edges_in", "2.5: pixels on all edges are in", Stage::coverage,
          put<&Stages::coverage, tied<all_edges_in>>},
    Fault{"notes.004.z_in_camera_space", "3.2: Z is interpolated in camera space, not in the perspective plane",
          Stage::depth, put<&Stages::depth, depth_of_linear_z>},
};

}  // namespace

std::span<const Fault> of_notes() { return kNotes; }

}  // namespace plumbline::faults
