// Comparators of stages 0 to 2: matrices, vertices, lit colours.
#include <functional>

#include <glm/gtc/matrix_inverse.hpp>

#include "check/compare/compare_records.h"
#include "tests/check/fixtures.h"

namespace plumbline::check {
namespace {

struct MatrixRecords : testing::Test {
  MatrixRecords() {
    records.matrices.resize(2);
    for (std::size_t i = 0; i < 2; ++i) {
      Matrices<double>& m = records.matrices[i];
      for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
          m.model_view[c][r] = 0.25 + c + 4 * r;
          m.projection[c][r] = c == r ? -1.5 : 0;
          if (c < 3 && r < 3) m.normal[c][r] = 0.75;
        }
      }
      m.win_scale = {48, 32, 0.5};
      m.win_translate = {48, 32, 0.5};
    }
  }
  // Every number that OpenGL hands out.
  static std::vector<double*> entries(Matrices<double>& m) {
    std::vector<double*> out;
    for (int c = 0; c < 4; ++c) {
      for (int r = 0; r < 4; ++r) {
        out.push_back(&m.model_view[c][r]);
        out.push_back(&m.projection[c][r]);
      }
    }
    for (int i = 0; i < 3; ++i) {
      out.push_back(&m.win_scale[i]);
      out.push_back(&m.win_translate[i]);
    }
    return out;
  }
  Records<double> records;
};

TEST_F(MatrixRecords, EqualOnesPass) {
  EXPECT_TRUE(passes(compare_rounded_matrices(records, records, 2)));
  EXPECT_EQ(compare_rounded_matrices(records, records, 2).max_difference, 0);
  EXPECT_EQ(compare_rounded_matrices(records, records, 2).items, 2u);
  EXPECT_TRUE(passes(compare_matrices(records, records, 1)));
}

TEST_F(MatrixRecords, OneUlpOfAnyEntryFails) {
  for (std::size_t i = 0; i < entries(records.matrices[1]).size(); ++i) {
    Records<double> other = records;
    double& entry = *entries(other.matrices[1])[i];
    entry = entry == 0 ? 2.1e-10 : float_above(entry);  // more than 2e-12 of any column
    for (const Measurement& m :
         {compare_rounded_matrices(records, other, 2), compare_rounded_matrices(other, records, 2)}) {
      EXPECT_TRUE(fails(m)) << i;
      EXPECT_EQ(m.worst.place.record, 1);
    }
  }
}

// Remainders of entries that cancel, such as 3.2e-10 of coordinates near 1: each side rounds its own double to float.
TEST_F(MatrixRecords, TheRestOfWhatCancelsPassesWithinTwoErrorsOfDouble) {
  for (const double largest : {0.5, 1.0, 100.0}) {
    records.matrices[0].model_view[3] = {largest, 3.16227766e-10, 0, 0};
    Records<double> other = records;
    double& entry = other.matrices[0].model_view[3].y;
    entry += 1.99e-12 * std::max(1.0, largest);
    EXPECT_TRUE(passes(compare_rounded_matrices(records, other, 2))) << largest;
    EXPECT_TRUE(passes(compare_rounded_matrices(other, records, 2))) << largest;
    entry += 0.02e-12 * std::max(1.0, largest);
    EXPECT_TRUE(fails(compare_rounded_matrices(records, other, 2))) << largest;
    EXPECT_TRUE(fails(compare_rounded_matrices(other, records, 2))) << largest;
  }
}

TEST_F(MatrixRecords, TheWorstEntryIsNamed) {
  Records<double> other = records;
  other.matrices[0].projection[1][1] = -1.5 + 3 * 0x1p-23;
  EXPECT_STREQ(compare_rounded_matrices(other, records, 2).worst.place.field, "projection");
  other.matrices[0].model_view[0][3] = 100;
  EXPECT_STREQ(compare_rounded_matrices(other, records, 2).worst.place.field, "model_view");
}

TEST_F(MatrixRecords, WhatIsNoNumberFails) {
  for (double bad : not_numbers()) {
    for (std::size_t i = 0; i < entries(records.matrices[0]).size(); ++i) {
      Records<double> other = records;
      *entries(other.matrices[0])[i] = bad;
      EXPECT_TRUE(fails(compare_rounded_matrices(records, other, 2))) << i;
      EXPECT_TRUE(fails(compare_rounded_matrices(other, records, 2))) << i;
      EXPECT_TRUE(fails(compare_matrices(records, other, 1))) << i;
      EXPECT_TRUE(fails(compare_matrices(other, records, 1))) << i;
      if (std::isnan(bad)) {
        EXPECT_TRUE(fails(compare_matrices(other, other, 1))) << i;
      }
    }
  }
}

TEST_F(MatrixRecords, OnlyTheExactReferenceSeesTheNormalMatrix) {
  Records<double> other = records;
  other.matrices[1].normal[2][1] = 0.76;
  EXPECT_TRUE(passes(compare_rounded_matrices(other, records, 2)));
  EXPECT_TRUE(fails(compare_matrices(other, records, 1)));
  EXPECT_STREQ(compare_matrices(other, records, 1).worst.place.field, "normal");
}

// Inverse of a model-view that was rounded to float: many ULP off where entries of the normal matrix nearly cancel.
TEST_F(MatrixRecords, OfAnInversionInFloatMayBeOffByItsRoundings) {
  const glm::dmat3 m(1, 0.2, 0.5, 0.3, 0.9, 0.9, 0.1, 0.7 + 1e-9, 0.7);  // a cofactor is 0.9e-9
  records.matrices[0].model_view = glm::dmat4(m);
  records.matrices[0].normal = glm::inverseTranspose(m);
  Records<double> other = records;
  other.matrices[0].normal = glm::inverseTranspose(glm::dmat3(glm::mat3(m)));
  EXPECT_TRUE(fails(compare_matrices(other, records, 1)));
  EXPECT_TRUE(passes(compare_matrices(other, records, 1, Inversion::in_float)));
  other.matrices[0].normal[0][0] += 0.01;
  EXPECT_TRUE(fails(compare_matrices(other, records, 1, Inversion::in_float)));
  other.matrices[0].normal[0][0] = kNaN;
  EXPECT_TRUE(fails(compare_matrices(other, records, 1, Inversion::in_float)));
}

TEST_F(MatrixRecords, RoundingOnceToFloatPassesTwiceFails) {
  const auto with = [&](double a) {
    Records<double> other = records;
    other.matrices[0].projection[0][0] = a;
    return other;
  };
  const double reference = -1.5 - 0.49 * 0x1p-23;
  EXPECT_TRUE(passes(compare_matrices(with(-1.5), with(reference), 1)));
  EXPECT_TRUE(passes(compare_matrices(with(-1.5 - 0x1p-24), with(-1.5), 1))) << "half an ULP";
  EXPECT_TRUE(fails(compare_matrices(with(-1.5 - 0x1p-23), with(reference), 1))) << "the farther neighbour";
  EXPECT_TRUE(fails(compare_matrices(with(float_above(-1.5)), with(-1.5), 1)));
  // In half ULP, but for the 1e-12.
  EXPECT_NEAR(compare_matrices(with(-1.5 - 0x1p-22), with(-1.5), 1).max_difference, 4, 1e-3);
}

TEST_F(MatrixRecords, EntriesBelowAThresholdMayBeZero) {
  Records<double> other = records;
  other.matrices[0].projection[0][1] = 0.99e-12;
  EXPECT_TRUE(passes(compare_matrices(records, other, 1)));
  other.matrices[0].projection[0][1] = 2e-12;
  EXPECT_TRUE(fails(compare_matrices(records, other, 1)));
}

TEST_F(MatrixRecords, AFarTranslationIsNoExcuseForARotation) {
  Records<double> far = records;
  far.matrices[0].model_view[3][0] = 1e6;
  Records<double> other = far;
  other.matrices[0].model_view[0][0] += 8 * 0x1p-25;  // 8 ULP of 0.25, 2.4e-7
  EXPECT_TRUE(fails(compare_matrices(other, far, 1)));
}

TEST_F(MatrixRecords, MissingExtraAndSwappedRecordsFail) {
  Records<double> fewer = records, none, swapped = records;
  fewer.matrices.pop_back();
  swapped.matrices[0].model_view[0][0] = 5;
  Records<double> original = swapped;
  std::swap(swapped.matrices[0], swapped.matrices[1]);
  for (const auto& compare : std::vector<std::function<Measurement(const Records<double>&, const Records<double>&)>>{
           [](auto&&... both) { return compare_rounded_matrices(both..., 2); },
           [](auto&&... both) { return compare_matrices(both..., 1); }}) {
    EXPECT_TRUE(fails(compare(fewer, records), 2));
    EXPECT_TRUE(fails(compare(records, fewer), 2));
    EXPECT_TRUE(fails(compare(none, records), 2));
    EXPECT_TRUE(fails(compare(records, none), 2));
    EXPECT_TRUE(fails(compare(swapped, original), 2));
  }
  EXPECT_NE(compare_rounded_matrices(fewer, records, 2).mismatch.find("1 matrices, the reference 2"),
            std::string::npos);
}

// Exact records of two draws whose vertices are of very different size.
struct VertexRecords : testing::Test {
  static void keep(Records<double>&) {}
  Measurement vertices(const Change& candidate, const Change& reference = keep) const {
    Records<double> a = records, b = records;
    candidate(a);
    reference(b);
    return compare_vertices(scene, a, b, kFactor, kNormals);
  }
  Measurement lit(const Change& candidate, const Change& reference = keep) const {
    Records<double> a = records, b = records;
    candidate(a);
    reference(b);
    return compare_lit(scene, a, b, kFactor);
  }
  static constexpr double kFactor = 8, kNormals = 6;
  Scene scene = two_draws();
  Records<double> records = exact_capture(scene).records;
};

TEST_F(VertexRecords, EqualOnesPass) {
  EXPECT_TRUE(passes(vertices(kUnchanged)));
  EXPECT_EQ(vertices(kUnchanged).max_difference, 0);
  EXPECT_EQ(vertices(kUnchanged).items, 10u);
  EXPECT_TRUE(passes(lit(kUnchanged)));
  EXPECT_EQ(lit(kUnchanged).items, 10u);
}

// The sum of the absolute values of the terms of row `r` of m p.
double terms(const glm::dmat4& m, const glm::dvec4& p, int r) {
  double sum = 0;
  for (int c = 0; c < 4; ++c) sum += std::abs(m[c][r] * p[c]);
  return sum;
}

TEST_F(VertexRecords, ErrorsAreHeldToTheSizeOfTheirTerms) {
  const auto ranges = draw_ranges(scene);
  for (std::size_t i : {0u, 5u, 6u, 9u}) {  // the first and last of each draw
    const std::size_t d = i < 6 ? 0 : 1;
    const Matrices<double>& m = records.matrices[d];
    const glm::dvec4 p(scene.meshes[d].positions[i - ranges[d].first_vertex], 1);
    glm::dvec4 eye;
    for (int r = 0; r < 4; ++r) eye[r] = terms(m.model_view, p, r);
    for (int r = 0; r < 4; ++r) {
      const double clip = terms(m.projection, eye, r);
      for (double share : {-1.01, -0.99, 0.99, 1.01}) {
        const double at = share * kFactor * kU;
        const bool holds = std::abs(share) < 1;
        const auto eye_moved = [&](auto& a) { a.vertices[i].p_eye[r] += at * eye[r]; };
        const auto clip_moved = [&](auto& a) { a.vertices[i].p_clip[r] += at * clip; };
        EXPECT_EQ(passes(vertices(eye_moved)), holds || eye[r] == 0) << i << " " << r;
        EXPECT_EQ(passes(vertices(kUnchanged, eye_moved)), holds || eye[r] == 0) << i << " " << r;
        EXPECT_EQ(passes(vertices(clip_moved)), holds || clip == 0) << i << " " << r;
        if (!holds && eye[r] != 0) {
          EXPECT_TRUE(fails(vertices(eye_moved)));
          EXPECT_EQ(vertices(eye_moved).worst.place.record, static_cast<std::int64_t>(i));
          EXPECT_STREQ(vertices(eye_moved).worst.place.field, "p_eye");
          EXPECT_NEAR(vertices(eye_moved).max_ratio, 1.01, 0.001);
          EXPECT_STREQ(vertices(clip_moved).worst.place.field, "p_clip");
        }
      }
    }
  }
}

TEST_F(VertexRecords, NormalsAreHeldToTheirs) {
  // Turned and scaled: |N||n| / |N n| is below 3 for any rotation.
  for (int c = 0; c < 3; ++c) {
    for (std::size_t i : {2u, 8u}) {
      EXPECT_TRUE(passes(vertices([&](auto& a) { a.vertices[i].n_eye[c] += 0.99 * kNormals * kU; })));
      EXPECT_TRUE(fails(vertices([&](auto& a) { a.vertices[i].n_eye[c] -= 3.01 * kNormals * kU; })));
    }
  }
}

TEST_F(VertexRecords, WhatIsNoNumberFails) {
  for (double bad : not_numbers()) {
    for (int c = 0; c < 4; ++c) {
      const std::vector<Change> changes = {[&](auto& a) { a.vertices[7].p_eye[c] = bad; },
                                           [&](auto& a) { a.vertices[7].p_clip[c] = bad; },
                                           [&](auto& a) { a.vertices[7].n_eye[c % 3] = bad; }};
      for (const Change& change : changes) {
        EXPECT_TRUE(fails(vertices(change)));
        EXPECT_TRUE(fails(vertices(kUnchanged, change)));
        if (std::isnan(bad)) {
          EXPECT_TRUE(fails(vertices(change, change)));
        }
      }
      for (std::size_t i : {1u, 7u}) {
        const Change change = [&](auto& a) { a.lit[i].color[c] = bad; };
        EXPECT_TRUE(fails(lit(change)));
        EXPECT_TRUE(fails(lit(kUnchanged, change)));
      }
    }
  }
}

TEST_F(VertexRecords, MissingExtraAndSwappedRecordsFail) {
  const Change fewer = [](auto& a) { a.vertices.pop_back(), a.lit.pop_back(); };
  const Change none = [](auto& a) { a.vertices.clear(), a.lit.clear(); };
  const Change swapped = [](auto& a) { std::swap(a.vertices[0], a.vertices[1]), std::swap(a.lit[6], a.lit[9]); };
  for (const auto& compare : {&VertexRecords::vertices, &VertexRecords::lit}) {
    const auto run = [&](const Change& a, const Change& b) { return (this->*compare)(a, b); };
    EXPECT_TRUE(fails(run(fewer, kUnchanged), 10));
    EXPECT_TRUE(fails(run(kUnchanged, fewer), 10));
    EXPECT_TRUE(fails(run(none, kUnchanged), 10));
    EXPECT_TRUE(fails(run(kUnchanged, none), 10));
    EXPECT_TRUE(fails(run(swapped, kUnchanged), 2));
  }
}

TEST_F(VertexRecords, WithoutWhatTheyAreMadeOfThereIsNothingToHoldThemTo) {
  EXPECT_TRUE(fails(vertices([](auto& a) { a.matrices.clear(); }), 10));
  EXPECT_TRUE(fails(vertices([](auto& a) { a.matrices.pop_back(); }), 10));
  EXPECT_TRUE(fails(lit([](auto& a) { a.vertices.clear(); }), 10));
}

TEST_F(VertexRecords, MoreVerticesThanTheSceneHasFail) {
  const Change more = [](auto& a) { a.vertices.push_back(a.vertices.back()), a.lit.push_back(a.lit.back()); };
  EXPECT_FALSE(passes(vertices(more, more)));
  EXPECT_FALSE(passes(lit(more, more)));
}

TEST_F(VertexRecords, UnlitColoursAreEqual) {
  const Change ulp = [](auto& a) { a.lit[6].color.g = float_above(a.lit[6].color.g); };
  EXPECT_TRUE(fails(lit(ulp)));
  EXPECT_TRUE(fails(lit(kUnchanged, ulp)));
  EXPECT_EQ(lit(ulp).worst.place.record, 6);
  EXPECT_LE(lit(ulp).max_difference, 1) << "in u";
}

TEST_F(VertexRecords, LitColoursAreHeldToTheLights) {
  // One light: 0.2 * 0.1 of the scene's, 0 of its own, 0.8 diffuse, no highlight: below the least magnitude, 1.
  const auto moved = [&](int c, double by) { return lit([=](auto& a) { a.lit[5].color[c] += by * kFactor * kU; }); };
  for (int c = 0; c < 4; ++c) {
    EXPECT_TRUE(passes(moved(c, 0.99)));
    EXPECT_TRUE(fails(moved(c, -1.01)));
  }
  // Three lights: 3 * 0.8 + 0.02.
  scene.lights.resize(3, scene.lights[0]);
  for (int c = 0; c < 3; ++c) {
    EXPECT_TRUE(passes(moved(c, 0.99 * 2.42)));
    EXPECT_TRUE(fails(moved(c, 1.01 * 2.42)));
  }
  const Change other_normal = [](auto& r) { r.vertices[5].n_eye.x += 0.01; };
  EXPECT_TRUE(passes(lit([](auto& a) { a.lit[5].color.r += 0.005; }, other_normal)));
  EXPECT_TRUE(fails(lit([](auto& a) { a.lit[5].color.a += 0.005; }, other_normal))) << "alpha is the material's";
}

TEST_F(VertexRecords, AHighlightMayComeOrGoWhereTheLightGrazes) {
  const glm::dvec3 n = records.vertices[5].n_eye;
  scene.camera = {{0, 0, 1}, {0, 0, 0}, {0, 1, 0}};  // directions are the world's
  records.lights.clear();                            // the scene's are others from here on
  scene.lights = {{Light::Kind::directional, glm::cross(n, glm::dvec3(0.3, 0.5, -0.7)), {}, {}, glm::vec3(0.5)}};
  scene.draws[0].material.specular = glm::vec4(1);  // shininess 0: the whole 0.5, or nothing
  records.lit[5].color = glm::dvec4(0.25);
  const auto moved = [&](double by) { return lit([=](auto& a) { a.lit[5].color.g += by; }); };
  EXPECT_TRUE(passes(moved(0.5)));
  EXPECT_GE(moved(0.5).ambiguous, 1u);
  EXPECT_TRUE(passes(moved(-0.5)));
  EXPECT_TRUE(fails(moved(0.5001)));
  scene.lights[0].vector = glm::cross(n, glm::dvec3(0.3, 0.5, -0.7)) + 1e-4 * n;
  EXPECT_TRUE(fails(moved(0.5))) << "it does not graze";
}

TEST_F(VertexRecords, ALightAtTheVertexGivesAnyColour) {
  scene.camera = {{0, 0, 1}, {0, 0, 0}, {0, 1, 0}};
  records.lights.clear();
  scene.lights = {{Light::Kind::point, glm::dvec3(records.vertices[5].p_eye) + glm::dvec3(0, 0, 1), {}, {}, {}}};
  const auto becomes = [&](double value) { return lit([=](auto& a) { a.lit[5].color.g = value; }); };
  EXPECT_TRUE(passes(becomes(0)));
  EXPECT_TRUE(passes(becomes(1)));
  EXPECT_EQ(becomes(1).ambiguous, 1u);
  EXPECT_TRUE(fails(becomes(1.001)));
  EXPECT_TRUE(fails(becomes(-0.001)));
  EXPECT_TRUE(fails(becomes(std::nan(""))));
}

TEST_F(VertexRecords, ALightAtAVertexExcusesOnlyThatVertex) {
  scene.lights[0].kind = Light::Kind::point;
  scene.lights[0].vector = scene.meshes[0].positions[2];
  EXPECT_TRUE(fails(lit([](auto& a) { a.lit[0].color.r += 1e-3; })));
  EXPECT_TRUE(fails(lit([](auto& a) { a.lit[2].color.r += 1.5; }))) << "colours lie in [0,1] wherever the light is";
}

TEST_F(VertexRecords, UnlitColoursMayBeFlushedByAReferenceThatDoes) {
  records.lit[7].color.g = 0x1p-127;
  Records<double> flushed = records;
  flushed.lit[7].color.g = 0;
  EXPECT_TRUE(fails(compare_lit(scene, records, flushed, kFactor)));
  EXPECT_TRUE(passes(compare_lit(scene, records, flushed, kFactor, {}, {kFlushedUnderflow})));
  records.lit[7].color.g = 0x1p-120;
  EXPECT_TRUE(fails(compare_lit(scene, records, flushed, kFactor, {}, {kFlushedUnderflow}))) << "a normal number";
}

TEST_F(VertexRecords, ATermOfZeroIsDisputedWhereThePowerOverflows) {
  scene.camera = {{0, 0, 1}, {0, 0, 0}, {0, 1, 0}};
  scene.lights = {{Light::Kind::directional, {0, 0, 1}, {}, {}, glm::vec3(1)}};
  scene.draws[0].material.shininess = 128;
  scene.draws[0].material.specular = {0.5, 0, 0, 1};
  records.vertices[5].n_eye = {0, 0, 1000};
  const auto one = [](auto& a) { a.lit[5].color.g = 1; };
  Records<double> reference = records;
  records.lit[5].color.g = 0;
  one(reference);
  const Measurement m = compare_lit(scene, records, reference, kFactor, {}, {0, "overflow"});
  EXPECT_EQ(m.disputed, 1u);
  EXPECT_EQ(m.reason, "overflow");
  EXPECT_TRUE(passes(m));
  EXPECT_TRUE(fails(compare_lit(scene, records, reference, kFactor))) << "nobody says whose fault it is";
  scene.draws[0].material.specular.g = 0.5;
  scene.draws[0].material.specular.b = 0;
  records.lit[5].color.b = reference.lit[5].color.b;
  EXPECT_EQ(compare_lit(scene, records, reference, kFactor, {}, {0, "overflow"}).disputed, 0u)
      << "another channel's term";
  scene.draws[0].material.specular.g = 0;
  records.vertices[5].n_eye = reference.vertices[5].n_eye = {0, 0, 1};
  EXPECT_TRUE(fails(compare_lit(scene, records, reference, kFactor, {}, {0, "overflow"}))) << "nothing overflows";
}

}  // namespace
}  // namespace plumbline::check
