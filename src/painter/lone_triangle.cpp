#include "painter/lone_triangle.h"

#include <optional>

#include "kernels/coverage.h"
#include "painter/fragments.h"

namespace plumbline::pipeline {

namespace {

void paint_pixels(const Painting& painting, const PaintDraw& draw, const PaintTriangle& triangle, auto& tile) {
  const WindowTriangle t = window_triangle_of(painting, triangle), seen = as_seen_from(t, painting.formats.sample);
  const BarycentricPlanes planes = planes_of(t, tile.x0, tile.y0);
  const DepthPlane depth = at_offset(depth_plane(depth_setup(t, draw.depth), planes), painting.formats.sample);
  const auto color = [&](int k) { return painting.vertices[triangle.corner[draw.flat() ? 1 : k]].color; };
  const FragmentSetup s{t.front, planes, depth, perspective_setup(t, planes, draw.surface == nullptr),
                        attribute_setup({color(0), color(1), color(2)})};
  GradientSetup gradients{};
  if (draw.surface != nullptr && draw.surface->texture)
    gradients = gradient_setup(t, varying_of(painting, draw, triangle, Varying::texture), planes);
  const std::optional<SurfaceSetup> surface = surface_setup(painting, draw, triangle, gradients);
  const auto paint = [&](glm::ivec2 p) {
    const int place = pixel_offset(p.x - tile.x0, p.y - tile.y0);
    paint_fragments<float>(*draw.draw, s, surface, pixel_at(p), true, place, painting.formats.color_scale, tile);
  };
  const PixelBounds of_tile{tile.x0, tile.y0, tile.x0 + kTile, tile.y0 + kTile};
  if (t.corners < 3) return visit_line_or_point(t, {tile.x0, tile.y0}, glm::ivec2(kTile), paint);
  visit_inside(edges_of(seen), intersection(pixel_bounds(seen), of_tile), paint);
}

}  // namespace

void paint_alone(const Painting& painting, const PaintDraw& draw, const PaintTriangle& triangle, Tile& tile) {
  paint_pixels(painting, draw, triangle, tile);
}

void paint_alone(const Painting& painting, const PaintDraw& draw, const PaintTriangle& triangle, PackedTile& tile) {
  paint_pixels(painting, draw, triangle, tile);
}

}  // namespace plumbline::pipeline
