// A scene's triangles in homogeneous window coordinates, in double, with error bounds for float arithmetic.
//
// Vertex: v = (X, Y, W) = (x_clip width/2, y_clip height/2, w_clip). Window point (x, y) [pixels from the window's
// *middle*]: the ray d = (x, y, 1) from the origin. The triangle v0 v1 v2 is at that point where d w = b0 v0 + b1 v1 +
// b2 v2 with b_i >= 0, sum b_i = 1 (Olano and Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates",
// 1997). Nothing is divided by w, so that triangles across the eye's plane need no cutting:
//   n_i = v_j x v_k (i, j, k cyclic)   e_i = n_i . d   det = v0 . n0   b_i = e_i / sum e   1/w = sum e / det
//   z_ndc = sum z_i e_i / det, affine in (x, y);  det > 0 iff counter-clockwise in the window, y up.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "capture/conventions.h"
#include "capture/stages.h"
#include "reference/arithmetic/bounded.h"
#include "scene/scene.h"

namespace plumbline::math {

/// A vertex of a draw.
struct Corner {
  glm::dvec3 v;        ///< (X, Y, W)
  double z;            ///< z_clip
  glm::dvec4 size;     ///< of (X, Y, z_clip, W): sums of their terms' absolute values
  glm::dvec4 color;    ///< lit, clamped to [0,1]
  double color_error;  ///< bound on the error of `color` in float
  glm::dvec4 back_color{0}, secondary{0}, back_secondary{0};  ///< where the light model has them
  double back_color_error = 0, secondary_error = 0, back_secondary_error = 0;
  glm::dvec2 texcoord;      ///< 0 where the mesh has none
  double z_eye;             ///< eye-space z, for fog
  double z_eye_error;       ///< bound on the error of z_eye in float
  glm::dvec3 p_eye, n_eye;  ///< position and normal in eye space, for light per fragment
  double p_eye_error, n_eye_error;
  std::uint32_t point;    ///< equal for vertices of one draw whose positions are bit-equal
  bool is_exact = false;  ///< floats hold its window position, and all on the way there; of settles_ties_of_floats()
};

/// Interval of a polygon offset: [middle - half, middle + half] [window z].
struct OffsetBounds {
  double middle = 0, half = 0;
};

/// One of the scene's triangles, with its planes and bounds where some legal renderer may draw it.
struct Triangle {
  std::array<std::uint32_t, 3> corner;  ///< indices into Projected::corners
  std::uint32_t draw = 0;
  std::optional<std::uint32_t> on_grid;  ///< index into Projected::on_grid; none: the triangle has no copy on the grid
  double step = 0, snap = 0;             ///< Projected::step, snap; of a copy on the grid 0
  bool drawn = false;                    ///< false: no legal renderer draws any of it; members below may not be set
  bool facing_kept = false;              ///< the draw does not cull its facing in double
  bool thin = false;                     ///< snapping may reverse its facing or make its area 0
  bool flat = false;                     ///< no area in double, and so no plane
  bool cut = false;                      ///< some renderer may cut it at the view volume
  int cuts = 0;                          ///< number of the view volume's planes that may cut it
  bool ahead = false;                    ///< w > 0 at all corners
  bool loose = false;                    ///< float arithmetic may move it anywhere in the window; `flat` is set, too
  double sign = 0;                       ///< of det
  std::array<glm::dvec3, 3> n;
  std::array<double, 3> per_pixel;  ///< 1 / |(n_i.x, n_i.y)|: e_i times it is the distance to the edge's line
  glm::dvec3 z_plane;               ///< z_view = 1/2 + z_plane . d: 0 on the near plane, 1 on the far one
  glm::dvec3 w_plane;               ///< 1/w = w_plane . d
  glm::dvec4 size;                  ///< the corners' largest
  double roundings = 0;             ///< k: a clip coordinate in float is within k u size of the one in double
  double w_min = 0, w_max = 0;      ///< over its visible part
  DepthRange range;                 ///< z_win = near + (far - near) z_view + offset
  OffsetBounds offset;              ///< the polygon offset
  double z_min = 0, z_max = 0;      ///< z_view over its corners, where `ahead`
  double altitude = 0;              ///< [pixels] least altitude of all pieces for which a renderer may set up a plane
  /// Corners of a cut triangle's visible part, any three of which may be a piece's [pixels from the window's middle].
  std::vector<glm::dvec2> outline;
  /// Pieces cut at the near and far planes alone, where these may cut; corners may lie far outside the window.
  struct Guarded {
    double altitude = 0;              ///< as above
    std::vector<glm::dvec2> outline;  ///< as above
    glm::dvec2 extent{0};             ///< [pixels] twice their corners' largest |x|, |y| from its middle
    double w_min = 0;                 ///< of their corners
  } guarded;
  glm::dvec2 stepped{0};  ///< [pixels] displacement of its edges in x and y by steps, in float or fixed point
  /// Corners so near to a plane that float may cut them off, where positions are not snapped. Then a piece may be a
  /// sliver along an edge or a diagonal from there, no wider than `reach` [pixels]. `at`: [pixels from the window's
  /// middle].
  struct MayBeCutOff {
    glm::dvec2 at;
    double reach;
  };
  std::vector<MayBeCutOff> may_be_cut_off;
  double reach = 0;   ///< [pixels] largest displacement of a vertex over its visible part
  double growth = 1;  ///< factor: displacement at the point nearest to a pixel -> bound for all points near it
};

/// z_win of a triangle at z_view; the polygon offset is included.
inline double to_window(const Triangle& t, double z_view) {
  const double near = t.range.near, far = t.range.far;
  return near + (far - near) * z_view + t.offset.middle;
}
/// |d z_win / d z_view|.
inline double range_scale(const Triangle& t) { return std::abs(double{t.range.far} - double{t.range.near}); }

/// A scene's corners and triangles, numbered as its vertices and primitives are (scene.h, DrawRange). After these
/// corners come their copies on the grid.
struct Projected {
  int width = 0, height = 0;
  std::vector<LightSource<double>> lights;
  std::vector<double> light_errors;  ///< one per light (color_error.h)
  bool perspective = true;
  double distance_per_w = 0;  ///< distance before the eye, by clip w [eye units]; 0: orthographic, w is 1 everywhere
  /// z_view_of_zero() (matrices.h), for a renderer that interpolates 1/w for depths.
  std::optional<double> z_view_of_zero;
  bool depth_clamp = false;  ///< no near and far plane
  Conventions conventions;   ///< of the renderer whose legal answers are wanted
  double step = 0;           ///< h: largest displacement of a vertex by snapping, per axis [pixels]
  double snap = 0;           ///< length of that displacement, sqrt(2) h [pixels]
  DepthFormat depth = DepthFormat::z24;
  /// Sample offset from the pixel's centre [pixels] (scene/antialias.h). The window is moved by -sample, so that a
  /// pixel's centre stands for its sample. Colours are evaluated at the true centre (to_centre()).
  glm::dvec2 sample{0};
  /// Offset from a window point to its place in the frame of the view volume's sides [pixels]: `sample`, less the
  /// shift of the picture by the declared sample (SceneByConventions), which does not move a renderer's own frame.
  glm::dvec2 to_frame{0};
  std::vector<Corner> corners;
  std::vector<Triangle> triangles;
  /// Copies of triangles between their corners' places on the declared grid, for renderers that interpolate between
  /// these places. A copy decides coverage and attributes of its triangle and, where depth_corners is snapped, depth.
  std::vector<Triangle> on_grid;

  /// Place of the renderer's own window that rays are counted from [pixels from the frame's lower left corner].
  glm::dvec2 middle() const { return to_frame + 0.5 * glm::dvec2(width, height); }
  /// The corner's place [pixels from the frame's lower left corner].
  glm::dvec2 place(const Corner& corner) const { return glm::dvec2(corner.v) / corner.v.z + middle(); }
  /// The ray d of a pixel's sample (its centre where there are no samples).
  glm::dvec3 ray(int px, int py) const { return {px + 0.5 - 0.5 * width, py + 0.5 - 0.5 * height, 1}; }
  /// The triangle that coverage and attributes of a primitive go by.
  const Triangle& covering(std::uint32_t primitive) const {
    const Triangle& t = triangles[primitive];
    return t.on_grid ? on_grid[*t.on_grid] : t;
  }
  /// The ray of a pixel's true centre, from that of its sample.
  glm::dvec3 to_centre(glm::dvec3 d) const { return d - glm::dvec3(sample, 0); }
};

}  // namespace plumbline::math
