#include <algorithm>
#include <array>
#include <cmath>

#include "faults/lists.h"
#include "faults/variants.h"
#include "pipeline/geometry.h"
#include "transforms/normal.h"

namespace plumbline::faults {

namespace {

// Stage matrices of the draw that `change` altered.
template <auto change>
Matrices<float> matrices_of_other(const Scene& scene, const Draw& draw) {
  Draw wrong = draw;
  change(wrong);
  return pipeline::matrices(scene, wrong);
}

constexpr auto kTransformsReversed = [](Draw& draw) { std::reverse(draw.transforms.begin(), draw.transforms.end()); };

void turn(Draw& draw, double factor) {
  for (Transform& t : draw.transforms) {
    if (auto* rotate = std::get_if<Rotate>(&t)) rotate->degrees *= factor;
  }
}
constexpr auto kClockwise = [](Draw& draw) { turn(draw, -1); };
constexpr auto kDegreesForRadians = [](Draw& draw) { turn(draw, 180 / 3.14159265358979323846); };

// The camera's up points down: the scene, its lights included, is turned about the view's axis.
Scene with_wrong_view(const Scene& scene) {
  Scene wrong = scene;
  wrong.camera.up = -scene.camera.up;
  return wrong;
}
Matrices<float> matrices_of_wrong_view(const Scene& scene, const Draw& draw) {
  return pipeline::matrices(with_wrong_view(scene), draw);
}
FixedVector<LightSource<float>, 8> lights_of_wrong_view(const Scene& scene) {
  return pipeline::light_sources(with_wrong_view(scene));
}
void wrong_view(Stages& stages) {
  put<&Stages::matrices, matrices_of_wrong_view>(stages);
  put<&Stages::lights, lights_of_wrong_view>(stages);
}

// Stage matrices, its result then changed.
template <auto change>
Matrices<float> matrices_changed(const Scene& scene, const Draw& draw) {
  Matrices<float> m = pipeline::matrices(scene, draw);
  change(scene, m);
  return m;
}

constexpr auto kFovHorizontal = [](const Scene& scene, Matrices<float>& m) {
  if (!std::holds_alternative<Perspective>(scene.projection)) return;
  const float aspect = static_cast<float>(scene.frame.width) / static_cast<float>(scene.frame.height);
  m.projection[0][0] *= aspect;
  m.projection[1][1] *= aspect;
};

// tan(fov / 2 * near) for tan(fov / 2) * near.
constexpr auto kFovTimesNear = [](const Scene& scene, Matrices<float>& m) {
  const auto* perspective = std::get_if<Perspective>(&scene.projection);
  if (perspective == nullptr) return;
  const double half = glm::radians(double{perspective->fov_y_degrees}) / 2, near = std::abs(double{perspective->near});
  const auto factor = static_cast<float>(std::tan(half) / std::tan(half * near));
  m.projection[0][0] *= factor;
  m.projection[1][1] *= factor;
};

constexpr auto kAspectInverted = [](const Scene& scene, Matrices<float>& m) {
  const float aspect = static_cast<float>(scene.frame.width) / static_cast<float>(scene.frame.height);
  if (std::holds_alternative<Perspective>(scene.projection)) m.projection[0][0] = aspect * m.projection[1][1];
};

constexpr auto kAspectOfOne = [](const Scene& scene, Matrices<float>& m) {
  if (std::holds_alternative<Perspective>(scene.projection)) m.projection[0][0] = m.projection[1][1];
};

constexpr auto kAspectOf4To3 = [](const Scene& scene, Matrices<float>& m) {
  if (std::holds_alternative<Perspective>(scene.projection)) m.projection[0][0] = 0.75f * m.projection[1][1];
};

// near and far exchanged in (n + f) / (n - f) and 2 n f / (n - f), and in an orthographic projection's terms: a sign.
constexpr auto kNearFarSwapped = [](const Scene&, Matrices<float>& m) {
  for (int column = 0; column < 4; ++column) m.projection[column].z = -m.projection[column].z;
};

// z_clip of another library, from 0 to w: half the sum of z and w.
constexpr auto kClipFromZero = [](const Scene&, Matrices<float>& m) {
  for (int column = 0; column < 4; ++column)
    m.projection[column].z = 0.5f * (m.projection[column].z + m.projection[column].w);
};

constexpr auto kDepthRangeNotMapped = [](const Scene&, Matrices<float>& m) {
  m.win_scale.z = m.win_translate.z = 0.5f;
};

// Model times view, for view times model.
Matrices<float> view_last(const Scene& scene, const Draw& draw) {
  Draw unmoved = draw;
  unmoved.transforms.clear();
  const glm::dmat4 view(pipeline::matrices(scene, unmoved).model_view);
  Matrices<float> m = pipeline::matrices(scene, draw);
  const glm::dmat4 model_view = glm::inverse(view) * glm::dmat4(m.model_view) * view;
  m.model_view = glm::mat4(model_view);
  m.normal = glm::mat3(transforms::normal_matrix(model_view));
  return m;
}

constexpr auto kNormalsByInverse = [](const Scene&, Matrices<float>& m) { m.normal = glm::transpose(m.normal); };

constexpr auto kViewportOneShort = [](const Scene&, Matrices<float>& m) {
  m.win_scale.x -= 0.5f;
  m.win_scale.y -= 0.5f;
};

constexpr auto kViewportByWidthLessOne = [](const Scene&, Matrices<float>& m) {
  m.win_scale.x -= 0.5f, m.win_translate.x -= 0.5f;
  m.win_scale.y -= 0.5f, m.win_translate.y -= 0.5f;
};

constexpr auto kViewportWidthLessOne = [](const Scene&, Matrices<float>& m) {
  m.win_scale.x -= 0.5f, m.win_translate.x -= 0.5f;
};

constexpr auto kViewportHeightLessOne = [](const Scene&, Matrices<float>& m) {
  m.win_scale.y -= 0.5f, m.win_translate.y -= 0.5f;
};

constexpr auto kViewportLessOneFromTop = [](const Scene&, Matrices<float>& m) {
  m.win_scale.x -= 0.5f, m.win_translate.x -= 0.5f;
  m.win_scale.y -= 0.5f, m.win_translate.y += 0.5f;
};

// Stage vertex under another normal matrix.
template <auto change>
void normals_by_other(const Matrices<float>& matrices, Normals normals, const Mesh& mesh,
                      std::vector<Vertex<float>>& out) {
  Matrices<float> wrong = matrices;
  change(wrong);
  pipeline::transform(wrong, normals, mesh, out);
}

constexpr auto kModelView = [](Matrices<float>& m) { m.normal = Mat3<float>(m.model_view); };
constexpr auto kNotTurned = [](Matrices<float>& m) { m.normal = Mat3<float>(1); };

void normals_not_renormalised(const Matrices<float>& matrices, Normals, const Mesh& mesh,
                              std::vector<Vertex<float>>& out) {
  pipeline::transform(matrices, Normals::as_they_are, mesh, out);
}

// Stage vertex, each of its vertices then changed.
template <auto change>
void vertices_changed(const Matrices<float>& matrices, Normals normals, const Mesh& mesh,
                      std::vector<Vertex<float>>& out) {
  const std::size_t first = out.size();
  pipeline::transform(matrices, normals, mesh, out);
  for (std::size_t i = first; i < out.size(); ++i) change(matrices, mesh.positions[i - first], out[i]);
}

// The model-view matrix' translation is added to normals, as to positions.
constexpr auto kNormalsTranslated = [](const Matrices<float>& m, const glm::vec3&, Vertex<float>& v) {
  const Vec3<float> n = v.n_eye + Vec3<float>(m.model_view[3]);
  if (glm::length(n) > 0) v.n_eye = glm::normalize(n);
};

constexpr auto kEyePositionOfModel = [](const Matrices<float>&, const glm::vec3& p_model, Vertex<float>& v) {
  v.p_eye = Vec4<float>(p_model, 1);
};

constexpr auto kWIsOne = [](const Matrices<float>&, const glm::vec3&, Vertex<float>& v) { v.p_clip.w = 1; };

constexpr auto kProjectionFirst = [](const Matrices<float>& m, const glm::vec3& p_model, Vertex<float>& v) {
  v.p_clip = m.model_view * (m.projection * Vec4<float>(p_model, 1));
};

constexpr std::array kVertices = {
    stage_fault("matrices.fov_horizontal", "the vertical field of view is taken for the horizontal one",
                put<&Stages::matrices, matrices_changed<kFovHorizontal>>),
    stage_fault("matrices.fov_times_near",
                "half the field of view is multiplied by near within the tangent, not beside it",
                put<&Stages::matrices, matrices_changed<kFovTimesNear>>),
    stage_fault("matrices.aspect_inverted", "the aspect ratio is taken for height over width",
                put<&Stages::matrices, matrices_changed<kAspectInverted>>),
    stage_fault("matrices.aspect_of_one", "every picture is taken to be square",
                put<&Stages::matrices, matrices_changed<kAspectOfOne>>),
    stage_fault("matrices.aspect_of_4_to_3", "every picture is taken to be 4 to 3",
                put<&Stages::matrices, matrices_changed<kAspectOf4To3>>, "avaraline/Avara#69"),
    stage_fault("matrices.near_far_swapped", "the near plane is taken for the far one",
                put<&Stages::matrices, matrices_changed<kNearFarSwapped>>),
    stage_fault("matrices.clip_z_from_zero", "the projection is that of a library whose view volume is 0 <= z <= w",
                put<&Stages::matrices, matrices_changed<kClipFromZero>>),
    stage_fault("matrices.depth_range_not_mapped", "every draw's depths fill [0,1], whatever its depth range",
                put<&Stages::matrices, matrices_changed<kDepthRangeNotMapped>>),
    stage_fault("matrices.viewport_one_short",
                "the viewport is a pixel too narrow and too low: its sides are taken for centres",
                put<&Stages::matrices, matrices_changed<kViewportOneShort>>),
    stage_fault("matrices.viewport_by_width_less_one",
                "the viewport is a pixel less wide and high: its left lower corner is right",
                put<&Stages::matrices, matrices_changed<kViewportByWidthLessOne>>),
    stage_fault("matrices.viewport_width_less_one", "the viewport is a pixel less wide: its left side is right",
                put<&Stages::matrices, matrices_changed<kViewportWidthLessOne>>),
    stage_fault("matrices.viewport_height_less_one", "the viewport is a pixel less high: its lower side is right",
                put<&Stages::matrices, matrices_changed<kViewportHeightLessOne>>),
    stage_fault("matrices.viewport_less_one_from_top",
                "the viewport is a pixel less wide and high: its left upper corner is right",
                put<&Stages::matrices, matrices_changed<kViewportLessOneFromTop>>),
    stage_fault("matrices.normals_by_inverse", "the normals' matrix is the inverse, not transposed",
                put<&Stages::matrices, matrices_changed<kNormalsByInverse>>),
    stage_fault("matrices.transforms_reversed", "a draw's transforms are multiplied in the other order",
                put<&Stages::matrices, matrices_of_other<kTransformsReversed>>, "glob3mobile/g3m#197"),
    stage_fault("matrices.view_last", "the view and a draw's transforms are multiplied in the other order",
                put<&Stages::matrices, view_last>),
    stage_fault("matrices.rotation_sign", "rotations turn clockwise",
                put<&Stages::matrices, matrices_of_other<kClockwise>>),
    stage_fault("matrices.degrees_for_radians", "a rotation's degrees are taken for radians",
                put<&Stages::matrices, matrices_of_other<kDegreesForRadians>>),
    stage_fault("matrices.view_upside_down", "the camera's up is taken for down, and lights go by that view too",
                wrong_view),
    stage_fault("vertex.normals_by_model_view", "normals go by the model-view matrix, not its inverse transpose",
                put<&Stages::vertex, normals_by_other<kModelView>>),
    stage_fault("vertex.normals_not_turned", "normals are not turned with the model",
                put<&Stages::vertex, normals_by_other<kNotTurned>>, "thunder-engine/thunder#61"),
    stage_fault("vertex.not_renormalised", "normals are not brought to unit length after the model's scale",
                put<&Stages::vertex, normals_not_renormalised>),
    stage_fault("vertex.normals_translated", "normals are moved with the model",
                put<&Stages::vertex, vertices_changed<kNormalsTranslated>>, "KhronosGroup/glTF-Sample-Viewer#41"),
    stage_fault("vertex.eye_position_of_model", "the place that is lit is that in model space",
                put<&Stages::vertex, vertices_changed<kEyePositionOfModel>>),
    stage_fault("vertex.w_is_one", "w of the clip position is left at 1",
                put<&Stages::vertex, vertices_changed<kWIsOne>>),
    stage_fault("vertex.projection_first", "the projection and the model-view matrix are multiplied in the other order",
                put<&Stages::vertex, vertices_changed<kProjectionFirst>>),
};

}  // namespace

std::span<const Fault> of_vertices() { return kVertices; }

}  // namespace plumbline::faults
