#include "pipeline/fragment.h"

namespace plumbline::pipeline {

TriangleSetup set_up(const Stages& stages, const ShadedTriangle& triangle, const Surface& surface,
                     const DepthState& depth, const SampleOffsets& offsets, glm::ivec2 anchor) {
  TriangleSetup out{};
  const BarycentricPlanes planes = planes_of(triangle, anchor.x, anchor.y);
  out.depth = stages.depth_setup(triangle, depth);
  out.planes = at_offset(planes, offsets.color);
  out.depth_plane = at_offset(depth_plane(out.depth, planes), offsets.depth - offsets.color);
  out.perspective = perspective_setup(triangle, planes, surface.carried.empty());
  const auto corners = [&](std::size_t i) {
    const auto& a = triangle.attributes;
    return std::array<Vec4<float>, 3>{a[0][i], a[1][i], a[2][i]};
  };
  out.attributes[0] = attribute_setup(corners(0));
  for (const Varying v : surface.carried) {
    const std::size_t i = 1 + index_of(v);
    out.attributes[i] = attribute_setup(corners(i));
  }
  if (surface.texture) {
    out.gradients = gradient_setup(triangle, corners(1 + index_of(Varying::texture)), planes);
  }
  return out;
}

SurfaceAttributes<float> interpolated(const Stages& stages, const Surface& surface, const TriangleSetup& setup,
                                      const Pixels<float>& pixel) {
  SurfaceAttributes<float> out{};
  out.color = stages.attributes(setup, setup.attributes[0], pixel);
  for (const Varying v : surface.carried) {
    out[v] = stages.attributes(setup, setup.attributes[1 + index_of(v)], pixel);
  }
  return out;
}

FilteredTexel<float> filtered(const Stages& stages, const TextureSetup& texture, const TriangleSetup& setup,
                              const Color<float>& texcoords, const Pixels<float>& pixel) {
  const Offset<float> at = from_anchor<float>(setup.planes, pixel);
  const double q = value_at<float>(setup.perspective.sum, at);
  return stages.texture(texture, {texcoords.r, texcoords.g}, gradients<float>(setup.gradients, at, q));
}

bool passes_tests(const Stages& stages, const Draw& draw, const TestedFragment& fragment, float color_scale) {
  const auto& [front, passes_depth, shaded, stencil] = fragment;
  bool alive = !shaded.discarded && (passes_depth || draw.stencil);
  if (draw.alpha_test) alive = alive && stages.alpha_passes(*draw.alpha_test, shaded.color.a, color_scale);
  if (!draw.stencil) return alive;
  const StencilFace& face = front ? draw.stencil->front : draw.stencil->back;
  return stages.stencil_test(face, alive, passes_depth, stencil) && passes_depth;
}

void write_color(const Stages& stages, const Merge& state, const Color<float>& color, float color_scale,
                 const FramePixel& to) {
  const Color<float> made = state.logic_op ? stages.logic(*state.logic_op, color, *to.color, color_scale)
                            : state.blend  ? stages.blend(*state.blend, color, *to.color, color_scale)
                                           : stages.merge(color, color_scale);
  for (int c = 0; c < 4; ++c) {
    if (state.color_mask[c]) (*to.color)[c] = made[c];
  }
}

}  // namespace plumbline::pipeline
