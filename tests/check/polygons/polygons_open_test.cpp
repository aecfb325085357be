// Polygons whose cuts rounding decides about: the corners say what is open, never the polygon that is judged.
#include "tests/check/polygons/polygons.h"

namespace plumbline::check {
namespace {

struct OpenPolygons : Polygons {
  void set_line(const glm::dvec4& a, const glm::dvec4& b) {
    set({{a, b, b}});
    scene.meshes[0].topology = Topology::lines;
    records.lit[2] = records.lit[1];
    Capture in;
    in.records = records;
    in.records.polygons = {};
    records.polygons = exact::make_exact()->run_stage(scene, Stage::clip, in).records.polygons;
  }
  // The vertex of the line at share t of the way from its first end.
  ClipVertex<double> on_line(double t, bool cut) const {
    return {glm::mix(records.vertices[0].p_clip, records.vertices[1].p_clip, t),
            glm::mix(records.lit[0].color, records.lit[1].color, t), cut};
  }
  Measurement ending_in(const ClipVertex<double>& end) const {
    return compare([&](auto& r) { at(r, 0, 1) = end; });
  }
};

// Corners on a line, and two equal ones; both are cut by the right plane.
TEST_F(OpenPolygons, AForeignTriangleWithoutAreaMayHaveAnyPolygonAlongItself) {
  for (const glm::dvec4 last : {glm::dvec4(2, 0, 0, 1), glm::dvec4(3, 0.5, 0.25, 1)}) {
    set({{{0, -1, -0.5, 1}, {3, 0.5, 0.25, 1}, last}});
    const auto drop = [](auto& r) { r.polygons = {}; };
    const auto drop_vertex = [](auto& r) { erase_vertex(r, 0, r.polygons.polygons[0].count - 1); };
    EXPECT_TRUE(passes(compare(drop, kUnchanged, 1)));
    EXPECT_TRUE(passes(compare(drop_vertex, kUnchanged, 1)));
    EXPECT_TRUE(fails(compare(drop))) << "ours";
    EXPECT_TRUE(fails(compare(
        [&](auto& r) {
          drop_vertex(r);
          at(r, 0, 0).p_clip.y += 1e-4;
        },
        kUnchanged, 1)))
        << "beside it";
    set({{{0, -1, -0.5, 1}, {3, 0.5, 0.25, 1}, last + glm::dvec4(0, 1e-4, 0, 0)}});
    EXPECT_TRUE(fails(compare(drop, kUnchanged, 1))) << "it has an area";
  }
}

// Triangle of clip/along_the_far_plane, cut in float near, then far: the far cut slides along the triangle by 2.9.
TEST_F(OpenPolygons, AForeignTriangleWithoutAreaMayBeCutAnywhereAlongAPlane) {
  set({{{0.000419555872, 0.000891741831, 4.8107028, 4.81038427},
        {-0.00045310898, 0.000629942399, 6.30261087, 6.30219269},
        {0.877657175, 0.118457153, -4688.51025, -4688.19775}}});
  records.lit[0] = records.lit[1] = records.lit[2];
  const auto cut_far_at = [&](double w) {
    return [&, w](Records<double>& r) {
      const glm::dvec4 color = r.lit[2].color;
      r.polygons.vertices = {
          {{0.000725595048, 0.000788109144, 0.000788109086, 0.000788109086}, color, true},
          {{0.00131856732, 0.0010122275, 0.000523952243, 0.0010122275}, color, true},
          {{0.00077448471, 0.000939309481, w, w}, color, true},
      };
      r.polygons.polygons = {{0, 0, 3}};
    };
  };
  EXPECT_TRUE(passes(compare(cut_far_at(2.91164875), kUnchanged, 1)));
  EXPECT_TRUE(fails(compare(cut_far_at(8), kUnchanged, 1))) << "beyond both corners";
}

TEST_F(OpenPolygons, AVertexInTheEyeOpensNoPlane) {
  ASSERT_EQ(records.polygons.polygons[2].count, 4u);
  EXPECT_TRUE(fails(compare([&](auto& r) {
    erase_vertex(r, 2, cuts(2)[1]);
    at(r, 2, cuts(2)[0]).p_clip = glm::dvec4(0);
  })));
}

TEST_F(OpenPolygons, ACornerFartherThanRoundingFromAPlaneLeavesNothingOpen) {
  const double off = (kFactor + 2) * kU;
  set({{{-0.5, 0, 0, 1}, {0.5, 0, 0, 1}, {0, 0.5, -1 - off, 1}}});
  ASSERT_EQ(records.polygons.polygons[0].count, 4u);
  for (const std::uint32_t i : cuts(0)) EXPECT_TRUE(fails(compare([&](auto& r) { erase_vertex(r, 0, i); }))) << i;
  set({{{-0.5, 0, 0, 1}, {0.5, 0, 0, 1}, {0, 0.5, -1 + off, 1}}});
  ASSERT_EQ(records.polygons.polygons[0].count, 3u);
  EXPECT_TRUE(fails(compare([](auto& r) { repeat_vertex(r, 0, 2); })));
}

TEST_F(OpenPolygons, ACornerThatIsOpenCannotBeLost) {
  set({{{-0.5, 0, 0, 1}, {0.5, 0, 0, 1}, {0, 0.5, -1, 1}}});  // the last corner lies on the near plane
  ASSERT_EQ(records.polygons.polygons[0].count, 3u);
  EXPECT_TRUE(fails(compare([&](auto& r) { erase_vertex(r, 0, 2); }))) << "an edge is left";
  EXPECT_TRUE(passes(compare([&](auto& r) {
    repeat_vertex(r, 0, 2);
    at(r, 0, 2).cut = at(r, 0, 3).cut = true;
  })));
  for (const glm::dvec4 off : {glm::dvec4(1e-5, 0, 0, 0), {0, 0, -1e-5, 0}}) {
    EXPECT_TRUE(fails(compare([&](auto& r) {
      repeat_vertex(r, 0, 2);
      at(r, 0, 2).cut = at(r, 0, 3).cut = true;
      at(r, 0, 2).p_clip += off;
    }))) << "off its triangle, or outside";
  }
}

// The view reaches an edge beside the eye alone: what is left of the triangle is one place, with four colours.
TEST_F(OpenPolygons, CutsThatCoincideButForTheirColoursAreEachHeldToTheirOwnEdge) {
  set({{{1.8406438827514648, 2.145226001739502, -1.8975000381469727, 1.6325000524520874},
        {-4.917383193969727e-07, -8.940696716308594e-07, 3.0000009536743164, -3.5762786865234375e-07},
        {0.00038364529609680176, 0.0003886371850967407, 2.999000072479248, 0.0003333091735839844}}});
  scene.depth_clamp = true;
  records.lit[0].color = {0.125, 0.75, 0, 1};
  records.lit[1].color = {0.875, 0.875, 0, 1};
  records.lit[2].color = {0.5, 0.25, 0, 1};
  Capture in;
  in.records = records;
  in.records.polygons = {};
  records.polygons = exact::make_exact()->run_stage(scene, Stage::clip, in).records.polygons;
  ASSERT_EQ(records.polygons.polygons.at(0).count, 4u);
  for (std::ptrdiff_t turn = 0; turn < 4; ++turn) {
    const Change turned = [&](auto& r) { std::rotate(&at(r, 0, 0), &at(r, 0, 0) + turn, &at(r, 0, 0) + 4); };
    EXPECT_TRUE(passes(compare(turned))) << turn;
    EXPECT_TRUE(fails(compare([&](auto& r) { turned(r), at(r, 0, 0).color.r += 1e-4; }))) << turn;
  }
}

// A triangle over the corner of the view, which its long side passes in a distance of `outside`.
TEST_F(OpenPolygons, AnExtraPolygonIsThereByItsCornersAlone) {
  const auto with_extra = [&](double outside, const glm::dvec4& place) {
    set({{{2 + outside, 0, 0, 1}, {0, 2 + outside, 0, 1}, {3, 3, 0, 1}}});
    EXPECT_TRUE(records.polygons.polygons.empty());
    const glm::dvec4 color = glm::mix(records.lit[0].color, records.lit[1].color, 0.5);
    return compare([&](auto& r) {
      r.polygons.vertices.assign(3, {place, color, true});
      r.polygons.polygons = {{0, 0, 3}};
    });
  };
  const Measurement m = with_extra(0x1p-23, {1 + 0x1p-24, 1 + 0x1p-24, 0, 1});
  EXPECT_TRUE(passes(m));
  EXPECT_EQ(m.ambiguous, 1u);
  EXPECT_TRUE(fails(with_extra(0x1p-23, {1, 0.5, 0, 1}))) << "on a plane, but not of the triangle";
  EXPECT_TRUE(fails(with_extra(0x1p-23, {1.5, 0.5, 0, 1}))) << "of the triangle, but outside";
  EXPECT_TRUE(fails(with_extra(0.125, {1, 1, 0, 1}))) << "on two planes, which the triangle does not meet";
}

// A triangle that reaches far into the view, of which the reference has nothing: that the candidate has no more than a
// point of it, on a plane, opens nothing.
TEST_F(OpenPolygons, AnExtraPolygonOnAPlaneDoesNotExcuseItself) {
  set({{{-0.5, 0, 0, 1}, {1.5, 0, 0, 1}, {0, 0.5, 0, 1}}});
  const glm::dvec4 color = glm::mix(records.lit[0].color, records.lit[1].color, 0.75);
  const auto point = [&](auto& r) {
    r.polygons.vertices.assign(3, {glm::dvec4(1, 0, 0, 1), color, true});
    r.polygons.polygons = {{0, 0, 3}};
  };
  EXPECT_TRUE(fails(compare(point, [](auto& r) { r.polygons = {}; })));
}

TEST_F(OpenPolygons, ALineEndsOnAPlaneByItsCornerAlone) {
  set_line({0, 0, 0, 1}, {0.5, 0.25, 0, 1});
  ASSERT_FALSE(at(records, 0, 1).cut);
  EXPECT_TRUE(passes(compare(kUnchanged)));
  EXPECT_TRUE(fails(ending_in(on_line(2, true)))) << "on the right plane, which its corner is far from";
  for (const double off : {0.0, -0x1p-23, 0x1p-23}) {
    set_line({0, 0, 0, 1}, {1 + off, 0.25, 0, 1});
    const bool is_cut = at(records, 0, 1).cut;
    EXPECT_EQ(is_cut, off > 0);
    const Measurement m = ending_in(on_line(1, !is_cut));
    EXPECT_TRUE(passes(m)) << off;
    EXPECT_EQ(m.ambiguous, 1u) << off;
    EXPECT_TRUE(fails(ending_in(on_line(0.5, !is_cut)))) << "away from the plane";
    EXPECT_TRUE(fails(ending_in(on_line(0, !is_cut)))) << "in the other end";
    ClipVertex<double> end = on_line(1, !is_cut);
    end.p_clip.y += 1e-5;
    EXPECT_TRUE(fails(ending_in(end))) << "off the line";
    end = on_line(1, !is_cut);
    end.color.g += 1e-5;
    EXPECT_TRUE(fails(ending_in(end))) << "of another colour";
  }
}

}  // namespace
}  // namespace plumbline::check
