// judge() among made-up renderers.
#pragma once

#include <functional>
#include <map>
#include <stdexcept>

#include "check/judge/judge.h"
#include "renderers/pipeline_renderer.h"
#include "tests/check/fixtures.h"

namespace plumbline::check {

// A renderer, with hooks that change its answers.
class Changed : public Renderer {
 public:
  explicit Changed(std::unique_ptr<Renderer> inner) : inner_(std::move(inner)) {}
  RendererInfo info() const override {
    RendererInfo out = inner_->info();
    on_info(out);
    return out;
  }
  Capture capture(const Scene& scene, const Request& request) override {
    before_capture(request);
    Capture out = inner_->capture(scene, request);
    (request.planes == WantedPlanes::picture ? on_picture : on_capture)(out);
    return out;
  }
  Capture run_stage(const Scene& scene, Stage stage, const Capture& in, const Conventions& conventions) override {
    before_run(stage);
    return inner_->run_stage(scene, stage, in, conventions);
  }
  std::function<void(RendererInfo&)> on_info = [](auto&) {};
  std::function<void(const Request&)> before_capture = [](auto&) {};
  std::function<void(Capture&)> on_capture = [](auto&) {};
  std::function<void(Capture&)> on_picture = [](auto&) {};  // of the picture alone
  std::function<void(Stage)> before_run = [](auto) {};

 private:
  std::unique_ptr<Renderer> inner_;
};

// Ours as a foreign renderer; `alter` changes its captures.
struct OursAsAnothers : Changed {
  explicit OursAsAnothers(std::function<void(Capture&)> alter) : Changed(pipeline::make_pipeline()) {
    on_info = [](RendererInfo& info) {
      info.profile = Profile::foreign;
      info.painters.clear();
    };
    on_picture = on_capture = std::move(alter);
  }
};

// A pipeline as candidate, and three references: `witness`, a pipeline with OpenGL's profile whose stages cannot be
// run; `oracle`, which shows planes and legal answers alone; `referee`, exact without legal answers.
struct Judge : testing::Test {
  Judge() {
    candidate.on_info = [](RendererInfo& info) { info.painters.clear(); };  // picture_test.cpp's
    witness.on_info = [](RendererInfo& info) {
      info.painters.clear();
      info.name = "witness";
      info.profile = Profile::opengl;
      for (Ability& a : info.stages) a.runs = false;
      info.legal = false;
    };
    oracle.on_info = [](RendererInfo& info) {
      info.name = "oracle";
      for (Ability& a : info.stages) a = {false, false, "an oracle sees planes alone"};
    };
    referee.on_info = [](RendererInfo& info) { info.legal = false; };
    scene.frame.depth = DepthFormat::z32f;
  }
  using Results = std::map<std::pair<std::string, Stage>, Comparison>;
  Results run(const std::vector<Reference>& references, BothCaptures* drawn = nullptr) {
    verdict = judge(scene, candidate, references, drawn);
    Results out;
    for (const Comparison& c : verdict.comparisons) {
      EXPECT_EQ(c.scene, scene.name);
      EXPECT_TRUE(out.emplace(std::pair(title_of(c.judge), c.stage), c).second)
          << title_of(c.judge) << " judged " << name_of(c.stage) << " twice";
    }
    return out;
  }
  Results run() { return run({{"witness", &witness}, {"oracle", &oracle}, {"exact", &referee}}); }
  static std::size_t count(const Results& results, Outcome outcome) {
    return static_cast<std::size_t>(
        std::count_if(results.begin(), results.end(), [&](const auto& r) { return r.second.outcome == outcome; }));
  }
  // The first pixel, x and y from 1 on, that exactly one fragment covers; (-1, -1): there is none.
  static glm::ivec2 covered_pixel(const Planes& planes) {
    for (int y = 1; y < planes.id.height(); ++y) {
      for (int x = 0; x < planes.id.width(); ++x) {
        if (planes.id(x, y) != kBackground && planes.count(x, y) == 1) return {x, y};
      }
    }
    return {-1, -1};
  }

  Scene scene = two_draws();
  Changed candidate{pipeline::make_pipeline()}, witness{pipeline::make_pipeline()}, oracle{exact::make_exact()},
      referee{exact::make_exact()};
  SceneVerdict verdict;
};

}  // namespace plumbline::check
