// Triangles in clip space and what exact's clipping leaves of them.
#pragma once

#include <functional>

#include "check/polygons/compare_polygons.h"
#include "tests/check/fixtures.h"

namespace plumbline::check {

struct ClipTriangle {
  glm::dvec4 a, b, c;
};

// One draw of triangles in clip space, and exact's polygons of them. Primitives 0 and 3 lie inside; 1 has a corner
// behind the near plane and 2 one beyond the right plane: each is cut to four vertices.
struct Polygons : testing::Test {
  Polygons() {
    set({{{-0.5, -0.5, 0, 1}, {0.5, -0.25, 0.25, 1}, {0, 0.75, 0.5, 2}},
         {{-1, -1, -1, 2}, {1, -0.5, 0, 2}, {0.25, 0.5, -4, 3}},
         {{0, 0, 0, 1}, {3, 0.25, 0.5, 1}, {0.25, 0.75, 0.25, 1}},
         {{0.25, 0.25, 0, 1}, {0.5, 0.25, 0, 1}, {0.25, 0.5, 0, 1}}});
  }
  void set(const std::vector<ClipTriangle>& triangles) {
    scene = {};
    scene.meshes.resize(1);
    scene.draws.resize(1);
    records = {};
    for (const auto& [a, b, c] : triangles) {
      const auto first = static_cast<std::uint32_t>(records.vertices.size());
      scene.meshes[0].triangles.emplace_back(first, first + 1, first + 2);
      for (int i = 0; i < 3; ++i) {
        scene.meshes[0].positions.emplace_back(0);
        records.vertices.push_back({{}, i == 0 ? a : i == 1 ? b : c, {}});
        records.lit.push_back({glm::dvec4(0.25 * i, 0.5, 0.75 - 0.25 * i, 1)});
      }
    }
    Capture in;
    in.records = records;
    records.polygons = exact::make_exact()->run_stage(scene, Stage::clip, in).records.polygons;
  }
  Measurement compare(const Change& candidate, const Change& reference = kUnchanged, double copies = 0) const {
    Records<double> a = records, b = records;
    candidate(a);
    reference(b);
    return compare_polygons(scene, a, b, kFactor, FlatColors::provoking, copies);
  }
  // Vertex i of a primitive's polygon.
  static ClipVertex<double>& at(Records<double>& r, std::size_t primitive, std::uint32_t i) {
    return r.polygons.vertices[r.polygons.polygons[primitive].first + i];
  }
  // The numbers, within a polygon, of its vertices that a cut made.
  std::vector<std::uint32_t> cuts(std::size_t primitive) {
    std::vector<std::uint32_t> out;
    for (std::uint32_t i = 0; i < records.polygons.polygons[primitive].count; ++i) {
      if (at(records, primitive, i).cut) out.push_back(i);
    }
    return out;
  }
  static void erase_vertex(Records<double>& r, std::size_t primitive, std::uint32_t i) {
    auto& [vertices, polygons] = r.polygons;
    vertices.erase(vertices.begin() + polygons[primitive].first + i);
    --polygons[primitive].count;
    for (std::size_t p = primitive + 1; p < polygons.size(); ++p) --polygons[p].first;
  }
  static void repeat_vertex(Records<double>& r, std::size_t primitive, std::uint32_t i) {
    auto& [vertices, polygons] = r.polygons;
    const auto place = vertices.begin() + polygons[primitive].first + i;
    vertices.insert(place, *place);
    ++polygons[primitive].count;
    for (std::size_t p = primitive + 1; p < polygons.size(); ++p) ++polygons[p].first;
  }
  // Moves a vertex a share of the way to another one, colour and all.
  static void slide(ClipVertex<double>& v, const ClipVertex<double>& to, double share) {
    v.p_clip += share * (to.p_clip - v.p_clip);
    v.color += share * (to.color - v.color);
  }
  static constexpr double kFactor = 8;
  Scene scene;
  Records<double> records;
};

}  // namespace plumbline::check
