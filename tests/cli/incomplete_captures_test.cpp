// Captures that hold a part: each stage is judged whose inputs are there, and what was not judged never passes.
#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <tuple>

#include <nlohmann/json.hpp>

#include "capture/files/capture_folder.h"
#include "renderers/pipeline_renderer.h"
#include "scene/file/scene_file.h"
#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

struct Part {
  const char* name;
  std::function<void(const Capture& whole, Capture& part)> take;
  int code;
  const char* says;
};

const glm::vec4 kBlack(0, 0, 0, 1);

const Part kParts[] = {
    {"nothing", [](const Capture&, Capture&) {}, 2,
     "expected the arrays of a stage that can be judged, found 0 of 13 stages judged"},
    {"color and depth",
     [](const Capture& w, Capture& p) { p.planes.color = w.planes.color, p.planes.depth = w.planes.depth; }, 0,
     "2 of 13 stages judged\n"},
    {"color", [](const Capture& w, Capture& p) { p.planes.color = w.planes.color; }, 0, "1 of 13 stages judged\n"},
    {"depth", [](const Capture& w, Capture& p) { p.planes.depth = w.planes.depth; }, 0, "1 of 13 stages judged\n"},
    {"black", [](const Capture& w, Capture& p) { p.planes.color = Plane<glm::vec4>(w.width, w.height, kBlack); }, 1,
     "first different stage: merge"},
    {"no number",
     [](const Capture& w, Capture& p) { p.planes.color = Plane<glm::vec4>(w.width, w.height, glm::vec4(NAN)); }, 1,
     "first different stage: merge"},
    {"far depth", [](const Capture& w, Capture& p) { p.planes.depth = Plane<double>(w.width, w.height, 1); }, 1,
     "first different stage: depth"},
    {"one step", [](const Capture& w, Capture& p) { p.planes.depth = w.planes.depth, p.planes.depth(64, 64) += 3e-7; },
     1, "first different stage: depth"},
    {"winners", [](const Capture& w, Capture& p) { p.planes.id = w.planes.id; }, 0, "1 of 13 stages judged\n"},
    {"no winner",
     [](const Capture& w, Capture& p) { p.planes.id = Plane<std::int32_t>(w.width, w.height, kBackground); }, 1,
     "first different stage: visibility"},
    {"shaded", [](const Capture& w, Capture& p) { p.planes.shaded = w.planes.shaded; }, 0, "1 of 13 stages judged\n"},
    {"counts", [](const Capture& w, Capture& p) { p.planes.count = w.planes.count; }, 0, "1 of 13 stages judged\n"},
    {"counts and sums",
     [](const Capture& w, Capture& p) { p.planes.count = w.planes.count, p.planes.id_sum = w.planes.id_sum; }, 0,
     "1 of 13 stages judged\n"},
    {"no count", [](const Capture& w, Capture& p) { p.planes.count = Plane<std::uint32_t>(w.width, w.height); }, 1,
     "first different stage: coverage"},
    {"sums", [](const Capture& w, Capture& p) { p.planes.id_sum = w.planes.id_sum; }, 2, "found 0 of 13 stages judged"},
    {"matrices", [](const Capture& w, Capture& p) { p.records.matrices = w.records.matrices; }, 0,
     "1 of 13 stages judged\n"},
    {"vertices", [](const Capture& w, Capture& p) { p.records.vertices = w.records.vertices; }, 2,
     "vertex: matrices: the capture does not hold it"},
    {"matrices and vertices",
     [](const Capture& w, Capture& p) {
       p.records.matrices = w.records.matrices, p.records.vertices = w.records.vertices;
     },
     0, "2 of 13 stages judged\n"},
    {"moved vertices",
     [](const Capture& w, Capture& p) {
       p.records.matrices = w.records.matrices, p.records.vertices = w.records.vertices;
       p.records.vertices[0].p_clip.x += 0.01;
     },
     1, "wrong by itself: vertex"},
    {"lit", [](const Capture& w, Capture& p) { p.records.lit = w.records.lit; }, 2, "light: matrices: the capture"},
    {"polygons", [](const Capture& w, Capture& p) { p.records.polygons = w.records.polygons; }, 2,
     "clip: vertex: the capture"},
    {"window", [](const Capture& w, Capture& p) { p.records.triangles = w.records.triangles; }, 2,
     "window: matrices: the capture"},
    {"fragments without triangles", [](const Capture& w, Capture& p) { p.records.covered = w.records.covered; }, 0,
     "1 of 13 stages judged\n"},
    {"window and fragments",
     [](const Capture& w, Capture& p) {
       p.records.triangles = w.records.triangles, p.records.covered = w.records.covered;
     },
     0, "1 of 13 stages judged\n"},
    {"a fragment less",
     [](const Capture& w, Capture& p) {
       p.records.triangles = w.records.triangles, p.records.covered = w.records.covered;
       p.records.covered.erase(p.records.covered.begin() + 100);
     },
     1, "wrong by itself: coverage"},
    {"depths without fragments", [](const Capture& w, Capture& p) { p.records.depth = w.records.depth; }, 2,
     "depth: it shows no plane of it"},
    {"matrices in double",
     [](const Capture& w, Capture& p) {
       p.records.matrices = w.records.matrices;
       for (Matrices<double>& m : p.records.matrices) m.model_view *= 1 + 1e-9, m.win_scale *= 1 + 1e-9;
     },
     0, "1 of 13 stages judged\n"},
    {"noise, and wrong depths",
     [](const Capture& w, Capture& p) {
       p = w;
       p.records.vertices[0].n_eye.x += 1e-5;  // of an unlit scene: no pixel shows it
       for (double& z : p.records.depth) z += 0.01;
     },
     1, "first different stage: depth (against exact, per stage)\nwrong by itself: vertex, depth, merge\n"},
    {"no triangle of the polygons",
     [](const Capture& w, Capture& p) {
       p = w;
       p.records.triangles.clear(), p.records.covered.clear(), p.records.depth.clear();
       p.records.attributes.clear(), p.records.shaded.clear(), p.records.drawn.clear();
       p.without_records = {"window", "coverage", "depth", "attributes", "shade", "visibility"};
       p.planes = {};
     },
     1, "wrong by itself: window\n"},
    {"no polygon of the triangles",
     [](const Capture& w, Capture& p) {
       p.records.matrices = w.records.matrices, p.records.vertices = w.records.vertices, p.records.lit = w.records.lit;
       p.without_records = {"clip", "clip.polygon"};
     },
     1, "wrong by itself: clip\n"},
    {"no fragment of the triangles",
     [](const Capture& w, Capture& p) { p.records.triangles = w.records.triangles, p.without_records = {"coverage"}; },
     1, "wrong by itself: coverage\n"},
    {"winners that the picture contradicts",
     [](const Capture& w, Capture& p) { p = w, p.planes.id.values().assign(p.planes.id.size(), kBackground); }, 1,
     "visibility: the capture contradicts itself: planes.id: "},
    {"a picture without triangles",
     [](const Capture& w, Capture& p) { p.planes.color = w.planes.color, p.without_records = {"window"}; }, 1,
     "window: the capture contradicts itself: window.*: no triangle, and planes.color shows "},
    {"a winner that the scene does not have", [](const Capture& w, Capture& p) { p = w, p.planes.id(3, 2) = 99; }, 2,
     "planes.id: pixel 3, 2: expected -1 to "},
    {"no vertex",
     [](const Capture& w, Capture& p) { p.records.matrices = w.records.matrices, p.without_records = {"vertex"}; }, 2,
     "vertices, as the scene has, found 0"},
    {"everything", [](const Capture& w, Capture& p) { p = w; }, 0, "11 of 13 stages judged\n"}};

class IncompleteCaptures : public Cli {};

#ifdef PLUMBLINE_EMBREE
const std::string kByExactAndEmbree = " --against exact,embree";
#else
const std::string kByExactAndEmbree = " --against exact";
#endif

TEST_F(IncompleteCaptures, AreJudgedAsFarAsTheyGo) {
  const Scene scene = load_scene(kSharedEdges, {});
  const Capture whole = pipeline::make_pipeline()->capture(scene, {.records = StageSet::all()});
  for (const Part& part : kParts) {
    SCOPED_TRACE(part.name);
    Capture capture;
    capture.renderer = "theirs";
    capture.version = "1";
    capture.width = whole.width;
    capture.height = whole.height;
    part.take(whole, capture);
    write_capture(capture, at("capture"));
    const Outcome run = plumb("diagnose " + kSharedEdges + kByExactAndEmbree + " --capture " + at("capture"));
    EXPECT_EQ(run.code, part.code) << run.text;
    EXPECT_TRUE(run.says(part.says)) << run.text;
  }
}

// Winners alone do not tell which of several legal fragments of a line wins, and a plane that is not there is not
// compared.
TEST_F(IncompleteCaptures, HaveNoJudgedWinnersOfLinesWithoutFragments) {
  const std::string lines = kScenes + "lines/star.json";
  const Capture whole = pipeline::make_pipeline()->capture(load_scene(lines, {}), {.records = StageSet::all()});
  Capture capture;
  capture.renderer = "theirs";
  capture.version = "1";
  capture.width = whole.width;
  capture.height = whole.height;
  capture.planes.id = whole.planes.id;
  const auto diagnosed = [&] {
    write_capture(capture, at("capture"));
    return plumb("diagnose " + lines + " --capture " + at("capture"));
  };
  const Outcome alone = diagnosed();
  EXPECT_EQ(alone.code, 2) << alone.text;
  EXPECT_TRUE(alone.says("visibility: of lines and points, it shows no count or id_sum")) << alone.text;
  capture.planes.count = whole.planes.count;
  capture.planes.id_sum = whole.planes.id_sum;
  EXPECT_TRUE(diagnosed().says("visibility: coverage: it shows planes, no records"));
}

// A rasterizer need not invent what follows from its other arrays, nor keep its records in an order.
TEST_F(IncompleteCaptures, MayLeaveOutWhatFollowsFromOthers) {
  using Names = std::set<std::string>;
  const Names of_window = {"window.snapped", "window.corners", "window.width", "window.front"};
  for (const auto& [path, left_out, says] :
       {std::tuple(kSharedEdges, of_window, "11 of 13 stages judged"),
        std::tuple(kScenes + "texture/board_nearest.json", Names{"texture.lod"}, "12 of 13 stages judged"),
        std::tuple(kScenes + "texture/board_linear.json", Names{"texture.lod"}, "12 of 13 stages judged")}) {
    SCOPED_TRACE(path);
    const std::string folder = path.substr(path.rfind('/') + 1);
    Capture capture = pipeline::make_pipeline()->capture(load_scene(path, {}), {.records = StageSet::all()});
    capture.renderer = "theirs";
    std::ranges::reverse(capture.records.polygons.polygons);
    write_capture(capture, at(folder));
    auto manifest = nlohmann::json::parse(test::text_of(at(folder + "/manifest.json")));
    nlohmann::json kept = nlohmann::json::array();
    for (const auto& array : manifest["arrays"]) {
      if (!left_out.contains(array["name"].get<std::string>())) kept.push_back(array);
    }
    EXPECT_EQ(manifest["arrays"].size() - kept.size(), left_out.size());
    manifest["arrays"] = kept;
    test::write_text(at(folder + "/manifest.json"), manifest.dump());
    const Outcome run = plumb("diagnose " + path + kByExactAndEmbree + " --capture " + at(folder));
    EXPECT_EQ(run.code, 0) << run.text;
    EXPECT_TRUE(run.says(says)) << run.text;
  }
}

}  // namespace
}  // namespace plumbline
