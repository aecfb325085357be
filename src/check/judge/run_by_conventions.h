// Stages as a referee makes them of a renderer's own records, by the renderer's conventions.
#pragma once

#include "capture/conventions.h"
#include "capture/renderer.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Whether the declared view volume differs from OpenGL's (clip_depth): exact's clipping and window depths then do not
/// apply.
bool has_other_volume(const Conventions& conventions);

/// Whether a draw's fog is not that of the fragment's |z_eye|, which the references compute: factors of vertices, which
/// no record of fragments holds, or distances |p_eye|.
bool fogs_otherwise(const Scene& scene, const Conventions& conventions);

/// Whether the stage's result differs from OpenGL's by these conventions.
bool differs_from_opengl(const Scene& scene, const Conventions& conventions, Stage stage);

/// Whether run_by_conventions() knows which triangle owns a sample on an edge: the rule is settled (conventions.h,
/// settles_ties), by left or right and bottom or top, on a grid that window.snapped holds (at most 8 bits); edges are
/// not added up in fixed point; pixels are sampled at their centres.
bool knows_ties(const Scene& scene, const Conventions& conventions);

/// referee.run_stage(scene, stage, in), but for what the conventions say otherwise than OpenGL:
/// - window: positions are moved as to_dialect() moves them; a triangle's area and facing are those on the declared
///   grid. Corners that are not snapped count on a grid of 16 bits, or of fewer where positions reach 2^30 steps;
/// - coverage: where knows_ties(), triangles own samples on their edges by the declared rule;
/// - depth, attributes, texture: where no corner is snapped, triangles face as their unsnapped corners do, between
///   which the renderer interpolates; where depth_corners (depth) or attribute_corners are snapped, the renderer
///   interpolates between snapped corners; attributes and texture: by 1/w = 1 where interpolation is affine;
/// - depth: polygon offsets by offset_unit; texture: levels and weights by texture_bits, level_of_detail, magnified and
///   half_way_level;
/// - visibility: where alpha tests are in float, alphas are not rounded to codes;
/// - merge: colours that are blended or combined with stored codes meet codes rounded, and blended, as declared.
/// Throws as run_stage() does.
Capture run_by_conventions(Renderer& referee, const Scene& scene, Stage stage, const Capture& in,
                           const Conventions& conventions);

/// Stage merge, by run_by_conventions(), of a renderer that blends in float: legal.color_lo and color_hi hold the range
/// of its codes, which are rounded as declared and read again. For frames of floats, and where no code is read again:
/// what referee.run_stage() returns.
Capture merge_as_declared(Renderer& referee, const Scene& scene, const Capture& in, const Conventions& conventions);

}  // namespace plumbline::check
