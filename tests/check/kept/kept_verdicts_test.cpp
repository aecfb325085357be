// A verdict of an earlier run stands where everything that it follows from is what it was, and nowhere else.
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "base/temporary_path.h"
#include "capture/capture_columns.h"
#include "check/kept/judge_or_recall.h"
#include "check/kept/traced_renderer.h"
#include "check/verdict/verdict_bytes.h"
#include "scene/antialias.h"
#include "tests/check/judge/judge_fixtures.h"
#include "tests/text_file.h"

namespace plumbline::check {
namespace {

namespace fs = std::filesystem;

// Flips the lowest bit of the first value of the k-th array that is not empty.
class FlipArray {
 public:
  explicit FlipArray(int k) : left_(k) {}
  bool flipped() const { return left_ < 0; }
  std::string_view name() const { return name_; }
  template <class Record>
  void group(Handed of, const auto& columns, std::vector<Record>& records) {
    columns.each([&](const auto& column) {
      if (!records.empty() && left_-- == 0) name_ = of.name, flip(&column.at(records.front(), 0));
    });
  }
  template <class T>
  void plane(Handed of, Plane<T>& plane) {
    if (!plane.empty() && left_-- == 0) name_ = of.name, flip(&plane.values().front());
  }

 private:
  static void flip(void* value) { *static_cast<unsigned char*>(value) ^= 1; }
  int left_;
  std::string_view name_;
};

std::string bytes_of(SceneVerdict verdict) {
  verdict.seconds = 0;
  ByteWriter writer;
  visit(writer, verdict);
  return writer.done();
}

class KeptVerdicts : public Judge {
 protected:
  KeptVerdicts() {
    candidate.on_info = [](auto&) {};  // with its painters
    candidate.before_capture = [this](auto&) { ++drawn; };
    referee.before_capture = [this](auto&) { ++asked; };
    scene.name = "group/name";
    std::string name = temporary_files() / "plumbline-kept-XXXXXX";
    root = mkdtemp(name.data());
    folder = root;
  }
  ~KeptVerdicts() override { fs::remove_all(root); }
  // Judges the scene, or recalls its verdict; returns how often the referee was asked for a capture.
  int judged_by_asking(const std::string& judges = "these") {
    check::KeptVerdicts kept{VerdictStore(folder),
                             judges,
                             [this](double) { return tried; },
                             began.value_or(fs::file_time_type::clock::now()),
                             {}};
    const int before = asked;
    const Reference references[] = {{"exact", &referee}};
    verdict = judge_or_recall(scene, candidate, references, kept);
    bytes = bytes_of(verdict);
    return asked - before;
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.is_regular_file()) out.push_back(entry.path());
    }
    return out;
  }

  fs::path root, folder;
  bool tried = false;
  std::optional<fs::file_time_type> began;  ///< unless now
  int drawn = 0, asked = 0;
  std::string bytes;
};

TEST_F(KeptVerdicts, StandsWhereNothingChanged) {
  ASSERT_GT(judged_by_asking(), 0);
  const std::string first = bytes;
  ASSERT_FALSE(verdict.comparisons.empty());
  EXPECT_EQ(bytes, bytes_of(judge(scene, candidate, std::vector<Reference>{{"exact", &referee}})));
  drawn = 0;
  EXPECT_EQ(judged_by_asking(), 0);
  EXPECT_EQ(bytes, first);
  EXPECT_EQ(drawn, 1 + static_cast<int>(candidate.info().painters.size()));
}

TEST_F(KeptVerdicts, FallsByAnyBitOfTheCandidates) {
  judged_by_asking();
  int arrays = 0;
  for (bool flipped = true; flipped; ++arrays) {
    std::string_view name;
    const auto flip = [&](Capture& capture) {
      FlipArray one(arrays);
      visit_capture(one, capture);
      flipped = one.flipped();
      name = one.name();
    };
    TracedRenderer traced(scene, candidate);
    traced.capture(scene, {.records = StageSet::all()});
    candidate.on_capture = flip;
    TracedRenderer now(scene, candidate);
    const bool same = now.answers_as_before(*traced.calls());
    EXPECT_NE(same, flipped) << name;
    candidate.on_capture = [](auto&) {};
  }
  EXPECT_GT(arrays, 30);
  const std::function<void(Capture&)> changes[] = {[](Capture& c) { c.version += "b"; },
                                                   [](Capture& c) { c.renderer += "b"; },
                                                   [](Capture& c) { ++c.width; },
                                                   [](Capture& c) { c.depth_in_float = !c.depth_in_float; },
                                                   [](Capture& c) { c.snapped_by = SnappedBy::conventions; },
                                                   [](Capture& c) { c.derived.insert("front"); },
                                                   [](Capture& c) { c.without_records.insert("window"); },
                                                   [](Capture& c) { c.samples.emplace_back(1, 1); },
                                                   [](Capture& c) { c.records.covered.pop_back(); }};
  for (const auto& change : changes) {
    candidate.on_capture = change;
    TracedRenderer changed(scene, candidate);
    changed.capture(scene, {.records = StageSet::all()});
    candidate.on_capture = [](auto&) {};
    TracedRenderer now(scene, candidate);
    EXPECT_FALSE(now.answers_as_before(*changed.calls()));
  }
}

TEST_F(KeptVerdicts, FallsByAPicture) {
  judged_by_asking();
  candidate.on_picture = [](Capture& c) {
    c.planes.color(0, 0).r = static_cast<float>(float_above(c.planes.color(0, 0).r));
  };
  EXPECT_GT(judged_by_asking(), 0);
}

TEST_F(KeptVerdicts, FallsByWhatTheCandidateSaysOfItself) {
  judged_by_asking();
  candidate.on_info = [](RendererInfo& info) { info[Stage::light].reason = "other"; };
  EXPECT_GT(judged_by_asking(), 0);
}

TEST_F(KeptVerdicts, FallsByJudgesSceneAndReferences) {
  judged_by_asking();
  EXPECT_GT(judged_by_asking("others"), 0);
  EXPECT_EQ(judged_by_asking("others"), 0);
  scene.draws[0].material.shininess += 1;
  EXPECT_GT(judged_by_asking(), 0);
  scene.name = "group/other";
  EXPECT_GT(judged_by_asking(), 0);
  referee.on_info = [](RendererInfo& info) { info.legal = false, info.version = "next"; };
  EXPECT_GT(judged_by_asking(), 0);
}

TEST_F(KeptVerdicts, FallsByAFileOfTheScene) {
  const fs::path file = root / "scene.json";
  test::write_text(file, "{}");
  scene.files = {file.string()};
  folder = root / "kept";
  judged_by_asking();
  EXPECT_EQ(judged_by_asking(), 0);
  test::write_text(file, "{ }");
  EXPECT_GT(judged_by_asking(), 0);
  EXPECT_EQ(judged_by_asking(), 0);
  began = fs::last_write_time(file);  // written since the scene was read, perhaps
  EXPECT_GT(judged_by_asking(), 0);
  fs::remove(file);
  EXPECT_GT(judged_by_asking(), 0);
}

TEST_F(KeptVerdicts, OfAFailureIsNone) {
  candidate.on_capture = [](Capture& c) { c.planes.color(3, 3).r = 0.625f; };
  for (int i = 0; i < 2; ++i) {
    EXPECT_GT(judged_by_asking(), 0);
    EXPECT_NE(first_different(verdict), nullptr);
  }
  EXPECT_TRUE(files().empty());
}

TEST_F(KeptVerdicts, OfACandidateThatFailsIsNone) {
  candidate.before_capture = [](const Request& r) {
    if (r.planes == WantedPlanes::picture) throw RendererFailed("it crashed");
  };
  EXPECT_GT(judged_by_asking(), 0);
  EXPECT_TRUE(files().empty());
}

// The kept calls are repeated outside of judge(), which makes a failure a row.
TEST_F(KeptVerdicts, FallsByACandidateThatFailsNow) {
  judged_by_asking();
  drawn = 0;
  candidate.before_capture = [this](const Request& r) {
    ++drawn;
    if (r.planes == WantedPlanes::all) throw RendererFailed("it crashed");
  };
  EXPECT_GT(judged_by_asking(), 0);
  EXPECT_TRUE(std::ranges::any_of(verdict.comparisons, [](const Comparison& c) {
    return c.outcome == Outcome::failed && c.note.find("it crashed") != std::string::npos;
  }));
  EXPECT_EQ(drawn, 1) << "it is waited for twice";
}

TEST_F(KeptVerdicts, OfPassesAndOfWhatIsOverBudget) {
  scene.frame.antialias = {Antialias::Kind::multisample, 1};
  judged_by_asking();
  EXPECT_EQ(judged_by_asking(), 0);
  scene.frame.antialias = {};
  candidate.before_capture = [](const Request& r) {
    if (r.records.has(Stage::coverage)) throw OverBudget("too many fragments");
  };
  judged_by_asking();
  EXPECT_EQ(judged_by_asking(), 0);
  candidate.before_capture = [](auto&) {};
  EXPECT_GT(judged_by_asking(), 0);
}

TEST_F(KeptVerdicts, DrawsNothingTwiceOfWhatChanged) {
  judged_by_asking();
  candidate.on_capture = [](Capture& c) { c.version = "next"; };
  drawn = 0;
  EXPECT_GT(judged_by_asking(), 0);
  const int painters = static_cast<int>(candidate.info().painters.size());
  EXPECT_EQ(drawn, 1 + painters);
  candidate.on_picture = [](Capture& c) { c.version = "last"; };  // of the first painter on
  drawn = 0;
  EXPECT_GT(judged_by_asking(), 0);
  EXPECT_EQ(drawn, 2 + painters) << "the records, which are as they were, are drawn again: their hash alone was kept";
}

TEST_F(KeptVerdicts, IsTriedByJudgingAgain) {
  judged_by_asking();
  const std::string first = bytes;
  tried = true;
  EXPECT_GT(judged_by_asking(), 0);
  EXPECT_EQ(bytes, first);
  referee.before_run = [](Stage stage) {
    if (stage == Stage::window) throw Unsupported("it runs the stage no longer");
  };
  EXPECT_GT(judged_by_asking(), 0);
  const Comparison& last = verdict.comparisons.back();
  EXPECT_EQ(last.outcome, Outcome::failed);
  EXPECT_NE(last.note.find("--no-cache"), std::string::npos);
  EXPECT_TRUE(files().empty());
}

TEST_F(KeptVerdicts, IsNoneWhereItsFileIsDamaged) {
  judged_by_asking();
  const std::string first = bytes;
  ASSERT_EQ(files().size(), 1u);
  const std::string whole = test::text_of(files()[0]);
  const auto holds_with = [&](const std::string& damaged) {
    test::write_text(files()[0], damaged);
    EXPECT_GT(judged_by_asking(), 0);
    EXPECT_EQ(bytes, first);
  };
  for (const std::size_t size : {std::size_t{0}, std::size_t{5}, std::size_t{32}, whole.size() / 2, whole.size() - 1})
    holds_with(whole.substr(0, size));
  for (const std::size_t at : {std::size_t{0}, std::size_t{31}, std::size_t{32}, whole.size() - 1}) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 1);
    holds_with(flipped);
  }
  holds_with(whole + "x");
  EXPECT_EQ(judged_by_asking(), 0);
}

TEST_F(KeptVerdicts, AreTrimmedFromTheLongestUnused) {
  const VerdictStore store(folder);
  const Hash keys[] = {{1, 1}, {2, 2}, {3, 3}};
  for (const Hash& key : keys) store.keep(key, std::string(1000, 'x'));
  const auto now = fs::file_time_type::clock::now();
  for (const fs::path& file : files()) fs::last_write_time(file, now - std::chrono::hours(2));
  EXPECT_TRUE(store.find(keys[1]));  // used again
  store.trim(5000);
  EXPECT_EQ(files().size(), 3u);
  store.trim(1500);
  EXPECT_TRUE(store.find(keys[1]));
  EXPECT_FALSE(store.find(keys[0]) || store.find(keys[2]));
  store.forget(keys[1]);
  EXPECT_FALSE(store.find(keys[1]));
}

TEST_F(KeptVerdicts, AreTrimmedAmongFilesOfOthers) {
  const VerdictStore store(folder);
  const Hash key{1, 1};
  store.keep(key, std::string(1000, 'x'));
  const fs::path kept = files()[0];
  const fs::path others[] = {folder / "notes.txt", folder / "photos" / "one.verdict", kept.parent_path() / "aa.verdict",
                             folder / kept.filename()};
  fs::create_directories(folder / "photos");
  for (const fs::path& other : others) test::write_text(other, std::string(5000, 'o'));
  store.trim(2000);
  EXPECT_TRUE(store.find(key)) << "files of others take no room";
  store.trim(0);
  EXPECT_FALSE(store.find(key));
  for (const fs::path& other : others) EXPECT_TRUE(fs::exists(other)) << other;
}

TEST_F(KeptVerdicts, NeedNoFolder) {
  const fs::path file = root / "file";
  test::write_text(file, "no folder");
  folder = file / "kept";
  EXPECT_GT(judged_by_asking(), 0);
  EXPECT_GT(judged_by_asking(), 0);
  VerdictStore(folder).trim(0);
}

}  // namespace
}  // namespace plumbline::check
