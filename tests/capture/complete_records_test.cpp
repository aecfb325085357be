// Records in any order, and without what follows from others.
#include "capture/complete_records.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <random>

#include <fmt/format.h>

#include "capture/files/capture_columns.h"
#include "renderers/pipeline_renderer.h"
#include "scene/file/scene_file.h"

namespace plumbline {
namespace {

const std::string kScenes = PLUMBLINE_SOURCE_DIR "/tests/scenes/";

Capture whole_capture(const Scene& scene) {
  return pipeline::make_pipeline()->capture(scene, {StageSet::all(), false, {}, {}});
}

// The arrays that differ.
struct Differing {
  std::vector<std::string> names;
  template <class Record>
  void group(Handed group, const auto& columns, const std::vector<Record>& a, const std::vector<Record>& b) {
    columns.each([&](const auto& column) {
      if (packed(a, column) != packed(b, column)) names.push_back(fmt::format("{}.{}", group.name, column.name));
    });
  }
  void plane(Handed, const auto&, const auto&) const {}
};
std::vector<std::string> differing(const Capture& a, const Capture& b) {
  Differing out;
  visit_capture(out, a, b);
  return out.names;
}

template <class T>
void permute(std::vector<T>& column, const std::vector<std::size_t>& order) {
  if (column.size() != order.size()) return;
  const std::vector<T> was = column;
  for (std::size_t i = 0; i < order.size(); ++i) column[i] = was[order[i]];
}

void shuffle_all(Records<double>& r, std::mt19937& random) {
  std::ranges::shuffle(r.polygons.polygons, random);
  std::vector<std::size_t> order(r.triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});  // a polygon's triangles stay in their order
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return r.triangles[i].primitive * 2654435761u; });
  std::vector<std::uint32_t> now(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) now[order[i]] = static_cast<std::uint32_t>(i);
  permute(r.triangles, order);
  for (const Varying v : kAllVaryings) permute(r.varyings[v].triangles, order);
  for (Covered& c : r.covered) c.triangle = now[c.triangle];
  std::vector<std::size_t> fragments(r.covered.size());
  std::iota(fragments.begin(), fragments.end(), std::size_t{0});
  std::ranges::shuffle(fragments, random);
  permute(r.covered, fragments), permute(r.depth, fragments), permute(r.attributes, fragments);
  permute(r.texels, fragments), permute(r.shaded, fragments), permute(r.drawn, fragments);
  for (const Varying v : kAllVaryings) permute(r.varyings[v].fragments, fragments);
}

void turn_all(Records<double>& r) {
  for (std::size_t i = 0; i < r.triangles.size(); ++i) {
    if (r.triangles[i].corners != 3) continue;
    const auto turn = static_cast<std::ptrdiff_t>(i % 3);
    std::ranges::rotate(r.triangles[i].v, r.triangles[i].v.begin() + turn);
    for (const Varying v : kAllVaryings) {
      auto& column = r.varyings[v].triangles;
      if (!column.empty()) std::ranges::rotate(column[i], column[i].begin() + turn);
    }
  }
}

TEST(CompleteRecords, leave_a_capture_in_order_as_it_is) {
  std::size_t scenes = 0;
  for (const auto& file : find_scenes({{kScenes}})) {
    const Scene scene = load_scene(file, {});
    if (scene.frame.antialias.kind != Antialias::Kind::none || scene.frame.width * scene.frame.height > 100'000)
      continue;
    Capture capture;
    try {
      capture = whole_capture(scene);
    } catch (const OverBudget&) {
      continue;
    }
    if (capture.records.covered.size() > 300'000) continue;
    const Capture was = capture;
    complete_records(scene, capture);
    EXPECT_EQ(differing(was, capture), std::vector<std::string>()) << file;
    ++scenes;
  }
  EXPECT_GT(scenes, 200u);
}

TEST(CompleteRecords, put_shuffled_records_in_order) {
  std::mt19937 random(7);
  for (const char* name :
       {"coverage/shared_edges", "texture/floor_modulated", "light/all_at_once", "clip/six_planes"}) {
    const Scene scene = load_scene(kScenes + name + ".json", {});
    const Capture was = whole_capture(scene);
    Capture capture = was;
    shuffle_all(capture.records, random);
    turn_all(capture.records);
    EXPECT_GT(differing(was, capture).size(), 4u) << name;
    complete_records(scene, capture);
    EXPECT_EQ(differing(was, capture), std::vector<std::string>()) << name;
  }
}

TEST(CompleteRecords, fill_what_follows_from_others) {
  for (const char* name :
       {"coverage/shared_edges", "light/all_at_once", "clip/six_planes", "lines/wide_star", "points/sizes"}) {
    const Scene scene = load_scene(kScenes + name + ".json", {});
    const Capture was = whole_capture(scene);
    Capture capture = was;
    for (Vertex<double>& v : capture.records.vertices) v.n_eye = {};
    for (ClipVertex<double>& v : capture.records.polygons.vertices) v.cut = false;
    for (WindowTriangle<double>& t : capture.records.triangles) {
      t.front = false, t.corners = 3, t.width = 1;
      for (WindowVertex<double>& v : t.v) v.snapped = {};
    }
    capture.derived = {"vertex.n_eye", "clip.cut", "window.front", "window.corners", "window.width", "window.snapped"};
    complete_records(scene, capture);
    for (std::size_t i = 0; i < was.records.vertices.size(); ++i)
      EXPECT_LT(glm::distance(capture.records.vertices[i].n_eye, was.records.vertices[i].n_eye), 1e-6) << name;
    for (std::size_t i = 0; i < was.records.vertices.size(); ++i)
      capture.records.vertices[i].n_eye = was.records.vertices[i].n_eye;
    EXPECT_EQ(differing(was, capture), std::vector<std::string>()) << name;
  }
}

TEST(CompleteRecords, refuse_to_guess_the_facing_of_outlines) {
  const Scene scene = load_scene(kScenes + "polygon_mode/wireframe.json", {});
  for (const char* column : {"window.front", "window.corners"}) {
    Capture capture = whole_capture(scene);
    capture.derived = {column};
    try {
      complete_records(scene, capture);
      FAIL() << column;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(std::string(error.what()), std::string(column) + ": left out, and a draw's polygons are not filled");
    }
  }
}

}  // namespace
}  // namespace plumbline
