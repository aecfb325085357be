// A renderer that ends its worker process: the scene is judged once more without that step.
#include <csignal>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "capture/renderers/watched_renderer.h"
#include "tests/check/judge/judge_fixtures.h"

namespace plumbline::check {
namespace {

// judge() in worker processes. rows() returns one line per row; `ends` gets how workers ended, by the step they were
// in.
struct JudgeWatched : Judge {
  JudgeWatched() {
    candidate.on_info = [](RendererInfo&) {};  // it paints
  }
  std::string rows(const std::function<void(Changed& candidate, Changed& witness, Changed& referee)>& harm,
                   std::map<std::uint32_t, std::string>& ends) {
    std::string out;
    const auto make = [&](Progress& progress) -> Workers::Answer {
      return [&](const std::string&) {
        const EndedSteps ended = ends;
        const Watch watch{&progress, &ended, std::chrono::seconds(60)};
        const auto changed = [](std::unique_ptr<Renderer> inner, const Changed& like) {
          auto made = std::make_unique<Changed>(std::move(inner));
          made->on_info = like.on_info;
          return made;
        };
        auto ours = changed(pipeline::make_pipeline(), candidate), other = changed(pipeline::make_pipeline(), witness),
             judge_of_stages = changed(exact::make_exact(), referee);
        harm(*ours, *other, *judge_of_stages);
        const auto make_other = [&]() -> std::unique_ptr<Renderer> {
          before_made();
          return std::move(other);
        };
        const auto a = make_watched(std::move(ours), 0, watch), b = make_watched("witness", make_other, 1, watch),
                   c = make_watched(std::move(judge_of_stages), 2, watch);
        const Reference references[] = {{"witness", b.get()}, {"exact", c.get()}};
        std::string text;
        for (const Comparison& row : judge(scene, *a, references).comparisons) {
          text += fmt::format("{} {} {} {}\n", title_of(row.judge), name_of(row.stage), name_of(row.outcome), row.note);
        }
        return text;
      };
    };
    const std::size_t only[] = {0};
    Workers(1, {}, make)
        .run({only, [](std::size_t) { return std::string(); },
              [&](std::size_t, const std::string& answer) { out = answer; },
              [&](std::size_t, const WorkerEnd& end) {
                ends[end.step] = end.how;
                return std::string();
              }});
    return out;
  }
  std::function<void()> before_made = [] {};  // runs before the witness is made

  std::string rows(const std::function<void(Changed&, Changed&, Changed&)>& harm) {
    std::map<std::uint32_t, std::string> ends;
    return rows(harm, ends);
  }
};

bool has(const std::string& rows, const std::string& row) { return ("\n" + rows).find("\n" + row) != rows.npos; }

TEST_F(JudgeWatched, NothingEndsAWorkerWhereNothingCrashes) {
  std::map<std::uint32_t, std::string> ends;
  const std::string all = rows([](Changed&, Changed&, Changed&) {}, ends);
  EXPECT_TRUE(ends.empty());
  EXPECT_EQ(all.find("failed"), all.npos) << all;
}

TEST_F(JudgeWatched, AReferenceThatCrashesIsARowAndTheOthersAreJudged) {
  const std::string all =
      rows([](Changed&, Changed& theirs, Changed&) { theirs.before_capture = [](const Request&) { raise(SIGFPE); }; });
  EXPECT_TRUE(has(all, "witness merge failed was killed by signal 8 (Floating point exception)")) << all;
  EXPECT_TRUE(has(all, "exact, per stage merge ")) << all;
  EXPECT_TRUE(has(all, "picture merge equal")) << all;
}

TEST_F(JudgeWatched, AReferenceThatCannotBeMadeIsARowAndTheOthersAreJudged) {
  const std::pair<std::function<void()>, const char*> endings[] = {
      {[] { raise(SIGSEGV); }, "was killed by signal 11 (Segmentation fault)"},
      {[] { throw std::bad_alloc(); }, "took more memory than a worker may have"},
      {[] { throw RendererFailed("no device"); }, "no device"},
      {[] { throw Unsupported("no such processor"); }, "no such processor"}};
  for (const auto& [end, how] : endings) {
    before_made = end;
    const std::string all = rows([](Changed&, Changed&, Changed&) {});
    EXPECT_TRUE(has(all, fmt::format("witness merge failed {}: while it was made\n", how))) << all;
    EXPECT_TRUE(has(all, "exact, per stage merge ")) << all;
    EXPECT_TRUE(has(all, "picture merge equal")) << all;
  }
}

TEST_F(JudgeWatched, AStageOfExactsThatCrashesIsThatStagesRow) {
  const std::string all = rows([](Changed&, Changed&, Changed& exact) {
    exact.before_run = [](Stage stage) {
      if (stage == Stage::window) raise(SIGSEGV);
    };
  });
  EXPECT_TRUE(has(all, "exact, per stage window failed was killed by signal 11 (Segmentation fault)")) << all;
  EXPECT_TRUE(has(all, "exact, per stage clip ")) << all;
  EXPECT_TRUE(has(all, "exact, per stage coverage equal")) << all;
  EXPECT_TRUE(has(all, "witness window equal")) << all;
}

TEST_F(JudgeWatched, APainterThatCrashesIsThePicturesRow) {
  const std::string all = rows([](Changed& ours, Changed&, Changed&) {
    ours.before_capture = [](const Request& r) {
      if (r.planes == WantedPlanes::picture) raise(SIGSEGV);
    };
  });
  EXPECT_TRUE(has(all, "picture merge failed was killed by signal 11")) << all;
  EXPECT_TRUE(has(all, "witness merge equal")) << all;
}

TEST_F(JudgeWatched, ACandidateThatCrashesIsNamedAtItsStage) {
  const std::string all = rows([](Changed& ours, Changed&, Changed&) {
    ours.before_capture = [](const Request&) { raise(SIGSEGV); };
    ours.before_run = [](Stage stage) {
      if (stage == Stage::depth) raise(SIGSEGV);
    };
  });
  EXPECT_TRUE(has(all, "ours depth failed was killed by signal 11")) << all;
  EXPECT_TRUE(has(all, "exact, per stage window ")) << all;
  EXPECT_TRUE(has(all, "witness light equal")) << all;
  EXPECT_TRUE(has(all, "exact, per stage depth unsupported")) << all;
  EXPECT_FALSE(has(all, "picture")) << all;
}

}  // namespace
}  // namespace plumbline::check
