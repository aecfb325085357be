// Constants that references and judges share with the renderer, against their sources: another value does not compile.
#include "capture/capture.h"
#include "capture/stages.h"
#include "reference/arithmetic/passes.h"
#include "scene/antialias.h"
#include "scene/scene.h"

namespace plumbline::math {

// Formats: n-bit codes up to 2^n - 1 (OpenGL 4.5, section 2.3.5.1), float formats without.
static_assert(color_scale(ColorFormat::rgba8) == 0xff && color_scale(ColorFormat::rgba12) == 0xfff);
static_assert(color_scale(ColorFormat::rgba16) == 0xffff && color_scale(ColorFormat::rgba32f) == 0);
static_assert(depth_scale(DepthFormat::z8) == 0xff && depth_scale(DepthFormat::z16) == 0xffff);
static_assert(depth_scale(DepthFormat::z24) == 0xffffff && depth_scale(DepthFormat::z32f) == 0);

// Window coordinates snap to 1/256 pixel (GL_SUBPIXEL_BITS is 8).
static_assert(kSubpixel == 1 << 8);

// Primitives: a triangle's three corners, a line's two, a point's one.
static_assert(corner_count(Topology::triangles) == 3 && corner_count(Topology::lines) == 2);
static_assert(corner_count(Topology::points) == 1);

// GzRender alone counts rows from the top (CSCI-580, note 000).
static_assert(rows_from_top(Dialect::gzrender) && !rows_from_top(Dialect::gl));
static_assert(!rows_from_top(Dialect::games101) && !rows_from_top(Dialect::tinyrenderer));

// Minification filters with mipmaps (OpenGL 4.5, table 8.10).
static_assert(!mipmaps(MinFilter::nearest) && !mipmaps(MinFilter::linear));
static_assert(mipmaps(MinFilter::nearest_mipmap_nearest) && mipmaps(MinFilter::nearest_mipmap_linear));
static_assert(mipmaps(MinFilter::linear_mipmap_nearest) && mipmaps(MinFilter::linear_mipmap_linear));

// Varyings that light makes, those of back faces, and those of the specular term.
static_assert(is_lit(Varying::secondary) && is_lit(Varying::back_color) && is_lit(Varying::back_secondary));
static_assert(!is_lit(Varying::texture) && !is_lit(Varying::normal) && !is_lit(Varying::position));
static_assert(is_back(Varying::back_color) && is_back(Varying::back_secondary) && !is_back(Varying::secondary));
static_assert(!is_back(Varying::texture) && !is_back(Varying::normal) && !is_back(Varying::position));
static_assert(is_secondary(Varying::secondary) && is_secondary(Varying::back_secondary));
static_assert(!is_secondary(Varying::back_color) && !is_secondary(Varying::texture));
static_assert(!is_secondary(Varying::normal) && !is_secondary(Varying::position));

}  // namespace plumbline::math
