// Normals of a foreign candidate (Profile::foreign), which may normalize at the vertices or at the fragments.
#pragma once

#include "check/judge/scene_judgement.h"

namespace plumbline::check {

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
