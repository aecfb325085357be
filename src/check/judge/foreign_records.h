// Records of a foreign candidate (Profile::foreign), in the form that comparators read: the order of corners, and
// normals, which it may normalize at the vertices or at the fragments.
#pragma once

#include <vector>

#include "capture/renderer.h"
#include "capture/stages.h"
#include "check/judge/scene_judgement.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Rotates the corners of the candidate's window triangles, with their varyings, into the reference's order: a renderer
/// may begin a triangle at any corner. Each triangle takes the rotation (by 0, 1 or 2 corners) under which most of its
/// numbers match, to 1e-3, those of one of the reference's triangles of the primitive: a wrong number is outvoted.
/// Ties: the smallest distance, then the rotation that most triangles take, then 0.
void rotate_corners(Records<double>& candidate, const Records<double>& reference);

/// rotate_corners() into the order of the triangles that the referee makes of the candidate's polygons. `shown`: the
/// candidate's info. Rotates nothing where the candidate does not show the records that stage window reads, or the
/// referee refuses them.
void rotate_as_made(const Scene& scene, const RendererInfo& shown, Renderer& referee, Capture& candidate);

/// Draws whose normals with_unit_normals() brings to unit length.
enum class OfDraws { all, lit_at_vertices };
/// The records with n_eye at unit length, where that differs from 1 by more than 2^-16, in draws whose normals are
/// normalized. Zero, infinite and NaN normals stay.
Records<double> with_unit_normals(const Scene& scene, Records<double> records, OfDraws of);

/// The candidate's records for comparisons of stage vertex: its own; for a foreign candidate a copy with unit normals,
/// which is stored in `made`.
const Records<double>& vertex_records(const SceneJudgement& c, Records<double>& made);

/// Scales each interpolated normal whose length is 1, within 2^-16, to the length of the expected normal: a foreign
/// candidate may normalize while interpolating. Other normals stay.
void stretch_unit_normals(std::vector<Attributes<double>>& normals, const std::vector<Attributes<double>>& expected);

}  // namespace plumbline::check
