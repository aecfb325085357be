#include "pipeline/render.h"

#include "kernels/coverage.h"
#include "pipeline/fragment.h"
#include "scene/antialias.h"

namespace plumbline::pipeline {

Frame render(const Scene& scene, const Stages& stages, Recorder records) {
  // 12. Resolve: an antialiased scene is drawn in passes, each a scene of its own.
  if (antialiased(scene)) {
    return resolve(stages.resolve, scene.frame, render_passes(scene, stages));
  }
  FrameBuffer frame(scene.frame);
  const auto lights = stages.lights(scene);
  records.lights({lights.begin(), lights.end()});
  const std::vector<DrawRange> ranges = draw_ranges(scene);
  for (std::size_t number = 0; number < scene.draws.size(); ++number) {
    const Draw& draw = scene.draws[number];
    const Mesh& mesh = scene.meshes[draw.mesh];
    const Lights in_eye_space(lights.begin(), lights.end());

    // 0. Matrices: a draw's transforms, camera, projection and viewport.
    const Matrices<float> matrices = stages.matrices(scene, draw);
    records.draw(draw, matrices);

    // 1. Vertex: each vertex of the mesh, from model space to eye and clip space.
    std::vector<Vertex<float>> vertices;
    stages.vertex(matrices, draw.normals, mesh, vertices);
    records.vertices(vertices);

    // 2. Light: each vertex' colour, and the attributes beside it.
    std::vector<Attributes> attributes;
    stages.light({scene, draw, mesh, in_eye_space, vertices}, attributes);
    records.attributes(attributes);

    draw_primitives({draw_input(scene, draw, matrices), mesh.triangles, vertices, attributes,
                     ranges[number].first_primitive, surface_of(scene, draw, in_eye_space)},
                    scene.frame, stages, frame, records);
  }
  return finished(scene.frame, frame);
}

void draw_primitives(const PreparedDraw& d, const FrameFormat& format, const Stages& stages, FrameBuffer& frame,
                     Recorder& records) {
  const Draw& draw = *d.input.draw;
  const Formats formats = formats_of(format);
  const SampleOffsets offsets = stages.sample_offsets(formats.sample);
  const DepthState depth_of_draw = depth_state(draw, format.depth, d.input.depth_clamp);
  const Merge merge_state = stages.merge_state(draw.merge);
  const PixelBounds box = draw.scissor ? stages.scissor(*draw.scissor, bounds_of(format)) : bounds_of(format);
  std::vector<ShadedTriangle> triangles;
  for (std::size_t i = 0; i < d.primitives.size(); ++i) {
    // 3. Clip: the primitive is assembled and cut at the view volume.
    Polygon polygon = stages.assemble(d.input, d.primitives[i], d.vertices, d.attributes);
    polygon.primitive = d.first_primitive + static_cast<std::uint32_t>(i);
    stages.clip(d.input, polygon);
    if (polygon.corners.empty()) continue;
    records.polygon(polygon);

    // 4. Window: division by w, viewport, facing, culling; the polygon becomes triangles.
    triangles.clear();
    stages.window(d.input, polygon, triangles);
    for (const ShadedTriangle& triangle : triangles) {
      records.triangle(triangle, triangle.attributes);
      TriangleSetup setup;
      glm::ivec2 anchor(-1);

      // 5. Coverage: the pixels whose centres (or samples) lie inside.
      for (const glm::ivec2 pixel : stages.coverage(as_seen_from(triangle, offsets.coverage), box)) {
        if (anchor != anchor_of(pixel)) {
          anchor = anchor_of(pixel);
          setup = set_up(stages, triangle, d.surface, depth_of_draw, offsets, anchor);
        }
        const Pixels<float> centre = pixel_at(pixel);
        const FramePixel to = frame.at(pixel);

        // 6. Depth: the plane of window z.
        const float z = stages.depth(setup, centre);
        const bool passes_depth = stages.depth_passes(draw.depth_func, z, *to.depth);
        if (!passes_depth && !draw.stencil && !records.keeps_fragments() && !stages.writes_depth(false, false))
          continue;  // changes neither frame nor records

        // 7. Attributes: perspective-correct.
        SurfaceAttributes<float> attributes = interpolated(stages, d.surface, setup, centre);

        // 8. Texture: the filtered texel.
        if (d.surface.texture) {
          attributes.texel = filtered(stages, *d.surface.texture, setup, attributes[Varying::texture], centre);
        }

        // 9. Shade: light per fragment, texture environment, sum of colours, fog.
        const Shaded shaded = stages.shade(d.surface, triangle.front, attributes);

        // 10. Visibility: alpha, stencil and depth test.
        const bool drawn =
            passes_tests(stages, draw, {triangle.front, passes_depth, shaded, to.stencil}, formats.color_scale);
        records.fragment({pixel, z, &attributes, shaded.color, drawn});

        // 11. Merge: depth, blending, logic op, masks.
        if (merge_state.depth_mask && stages.writes_depth(passes_depth, drawn)) *to.depth = z;
        if (drawn) write_color(stages, merge_state, shaded.color, formats.color_scale, to);
      }
    }
  }
}

std::vector<Frame> render_passes(const Scene& scene, const Stages& stages) {
  std::vector<Frame> frames;
  for (const Scene& pass : passes_of(scene)) frames.push_back(render(pass, stages));
  return frames;
}

}  // namespace plumbline::pipeline
