// Runs by the JSON that they left: read back, merged, compared; and what CI systems read.
#include <limits>
#include <stdexcept>

#include "report/runs/junit.h"
#include "report/runs/run_diff.h"
#include "report/runs/run_merge.h"
#include "report/text/markdown.h"
#include "scene/json/json_tree.h"
#include "tests/test_folder.h"
#include "tests/text_file.h"

namespace plumbline::report {
namespace {

using check::Comparison;
using check::Outcome;
using check::SceneVerdict;

Comparison scene_row(const std::string& scene, Stage stage, Outcome outcome, double largest = 0) {
  Comparison c;
  c.scene = scene, c.judge = "osmesa", c.stage = stage, c.outcome = outcome;
  check::Measurement& m = c.measurement;
  m.unit = "steps", m.items = 100, m.differing = outcome == Outcome::different ? 7 : 0;
  m.max_difference = m.max_ratio = m.worst.difference = largest;
  m.worst.place = {3, 4, 5, "depth"};
  m.worst.candidate = 0.1, m.worst.reference = 1.0 / 3, m.worst.tolerance = 1e-300;
  m.histogram[19] = 2;
  c.ledger_row = "opengl.depth", c.note = "a \"note\" & <more>";
  return c;
}

SceneVerdict scene(const std::string& name, std::vector<Comparison> rows) {
  return {name, "scenes/" + name + ".json", std::move(rows), 0.5};
}

SceneVerdict failing(const std::string& name) {
  SceneVerdict v = scene(
      name, {scene_row(name, Stage::depth, Outcome::different, 9), scene_row(name, Stage::merge, Outcome::equal)});
  v.failure = "different " + name + ": first different stage: depth\n  repeat: plumb check x\n";
  v.repeat = "plumb check x";
  v.causes = {"window (fault window.y_flipped)", "camera (fault not.written)"};
  return v;
}

struct RunFiles : TestFolder {
  std::string at(const std::string& name) const { return (root_ / name).string(); }
  CheckRun run(const std::vector<SceneVerdict>& verdicts, const Shard& shard = {},
               const std::string& version = "1") const {
    write_json(at("run.json"), verdicts, {{{"osmesa", version}}, "", {"osmesa"}, false, shard, {}});
    return read_run(at("run.json"));
  }
  void refused(const std::string& from, const std::string& to, const std::string& says) const {
    write_json(at("run.json"), std::vector{failing("light/a")}, {{{"osmesa", "1"}}, "", {"osmesa"}, false, {}, {}});
    std::string text = test::text_of(at("run.json"));
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
    test::write_text(at("run.json"), text);
    try {
      read_run(at("run.json"));
      ADD_FAILURE() << "taken: " << to;
    } catch (const JsonError& e) {
      EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
    }
  }
};

TEST_F(RunFiles, AreReadBackWhole) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Comparison disputed = scene_row("light/b", Stage::depth, Outcome::dispute, kInfinity);
  disputed.measurement.disputed = 3;
  disputed.measurement.dispute = disputed.measurement.worst;
  disputed.measurement.dispute.place = {-1, -1, 12, "p_clip.x"};
  disputed.measurement.reason = "theirs";
  const std::vector<SceneVerdict> verdicts = {
      failing("light/a"),
      scene("light/b", {disputed, check::not_judged("light/b", "embree", Stage::light, Outcome::unsupported, "why")})};
  std::vector<SceneVerdict> open = verdicts;
  open[1].knows_no_color = open[0].empty_holds = true;
  EXPECT_TRUE(run(open, {}).verdicts[1].knows_no_color && run(open, {}).verdicts[0].empty_holds);
  const CheckRun back = run(verdicts, {2, 3, 5});
  EXPECT_EQ(back.head.shard, (Shard{2, 3, 5}));
  EXPECT_EQ(back.head.versions.at("osmesa"), "1");
  EXPECT_EQ(back.tolerances.size(), check::ledger().size());
  write_json(at("again.json"), back.verdicts, back.head);
  EXPECT_EQ(test::text_of(at("again.json")), test::text_of(at("run.json")));
  EXPECT_NE(test::text_of(at("again.json")).find("\"cause\": \"window (fault window.y_flipped)\""), std::string::npos);
  EXPECT_NE(test::text_of(at("again.json")).find("pixel 3,4 record 5 depth"), std::string::npos);
  EXPECT_FALSE(all_hold(back.verdicts));
  EXPECT_EQ(seconds(back.verdicts), 1.0);
}

TEST_F(RunFiles, OfOthersAreRefusedWithTheirPlace) {
  refused("\"shard\"", "\"shart\"", "at \"/shart\"");
  refused("\"different\"", "\"differs\"", "at \"/comparisons/0/outcome\": expected an outcome (equal to expected)");
  refused("\"pixels\": 100", "\"pixels\": -1", "at \"/comparisons/0/pixels\"");
  refused("\"of\": 1", "\"of\": 0", "at \"/shard/of\"");
  refused("\"place\": \"pixel 3,4", "\"place\": \"pixel 3,5", "to begin with the pixel");
  refused("\"scene\": \"light/a\",\n   \"reference\"", "\"scene\": \"light/c\",\n   \"reference\"",
          "at \"/comparisons/0/scene\": expected one of \"scenes\"");
  EXPECT_THROW(read_run(at("none.json")), JsonError);
}

TEST_F(RunFiles, OfShardsAreOneRun) {
  const std::vector<SceneVerdict> a = {failing("light/a")},
                                  b = {scene("light/b", {scene_row("light/b", Stage::clip, Outcome::within, 1)})};
  std::vector<SceneVerdict> both = a;
  both.push_back(b[0]);
  run(both);
  const std::string whole = test::text_of(at("run.json"));
  const auto merged = [&](std::vector<CheckRun> runs) {
    const Merged m = merge(std::move(runs));
    write_json(at("merged.json"), m.run.verdicts, m.run.head);
    return m.missing;
  };
  const auto runs = [](auto... each) {
    std::vector<CheckRun> out;
    (out.push_back(std::move(each)), ...);
    return out;
  };
  EXPECT_TRUE(merged(runs(run(b, {2, 2, 2}), run(a, {1, 2, 2}), run(a, {1, 2, 2}))).empty());
  EXPECT_EQ(test::text_of(at("merged.json")), whole) << "in the order of the scenes, each once";
  EXPECT_TRUE(merged(runs(run(a), run(b))).empty()) << "runs that state no share";
  EXPECT_EQ(merged(runs(run(b, {2, 3, 4}))),
            (std::vector<std::string>{"missing: shard 1, 3 of 3", "missing: 3 of 4 scenes"}));
  const std::vector<std::string> still = merged(runs(read_run(at("merged.json"))));
  EXPECT_EQ(still, std::vector<std::string>{"missing: 3 of 4 scenes"}) << "merged once more, it is not whole either";
  const std::string xml = junit(b, still);
  EXPECT_NE(xml.find("tests=\"2\" failures=\"1\""), std::string::npos) << xml;
  EXPECT_NE(xml.find("missing: 3 of 4 scenes"), std::string::npos) << xml;

  const auto refuses = [&](std::vector<CheckRun> of, const std::string& says) {
    try {
      merge(std::move(of));
      ADD_FAILURE() << "merged: " << says;
    } catch (const std::runtime_error& e) {
      EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
    }
  };
  refuses(runs(run(a), run(b, {}, "2")), "their versions differ");
  refuses(runs(run(a, {1, 2, 2}), run(b, {2, 3, 2})), "shards of 2 and of 3");
  refuses(runs(run(a, {1, 2, 2}), run(b, {2, 2, 3})), "of 2 scenes and of 3");
  refuses(runs(run(a), run({scene("light/a", {scene_row("light/a", Stage::depth, Outcome::equal)})})),
          "twice, with results that differ");
  CheckRun spoiled = run(b);
  spoiled.head.fault = "light.no_clamp";
  refuses(runs(run(a), spoiled), "with the fault '' and 'light.no_clamp'");
  CheckRun asked = run(b);
  asked.head.against = {"exact"};
  refuses(runs(run(a), asked), "other references");
  CheckRun golden = run(b);
  golden.head.golden = true;
  refuses(runs(run(a), golden), "other references");
  CheckRun other = run(a);
  other.tolerances.begin()->second += 1;
  refuses(runs(other), "are not this program's");
  refuses(runs(run(b), other), "their tolerances differ");
}

TEST_F(RunFiles, ADiffNamesWhatBrokeAndWhatIsLost) {
  const auto rows = [&](Outcome depth, Outcome clip, double largest = 1) {
    SceneVerdict verdict = scene(
        "light/a", {scene_row("light/a", Stage::clip, clip, 1), scene_row("light/a", Stage::depth, depth, largest)});
    if (depth == Outcome::different) verdict.failure = "depth differs\n";
    return run({verdict});
  };
  const CheckRun before = rows(Outcome::within, Outcome::equal);
  EXPECT_EQ(diff_text(diff(before, before)), "nothing has changed\n");
  EXPECT_TRUE(holds(diff(before, before)));

  const RunDiff broken = diff(before, rows(Outcome::different, Outcome::equal));
  EXPECT_FALSE(holds(broken));
  EXPECT_EQ(diff_text(broken),
            "newly broken: 1\n  light/a, osmesa, depth: within -> different: 7 of 100, largest 1 steps\n");
  const RunDiff fixed = diff(rows(Outcome::different, Outcome::equal), before);
  EXPECT_TRUE(holds(fixed));
  EXPECT_EQ(fixed.fixed.size(), 1u);
  const RunDiff unjudged = diff(rows(Outcome::missing, Outcome::equal), rows(Outcome::unsupported, Outcome::equal));
  EXPECT_EQ(unjudged.fixed.size(), 0u) << "judged by nobody";
  EXPECT_EQ(unjudged.moved.size(), 1u);

  for (const Outcome outcome : {Outcome::unsupported, Outcome::missing}) {
    EXPECT_FALSE(holds(diff(before, rows(outcome, Outcome::equal)))) << name_of(outcome);
  }
  const RunDiff gone = diff(before, run({scene("light/a", {scene_row("light/a", Stage::clip, Outcome::equal, 1)})}));
  EXPECT_FALSE(holds(gone));
  EXPECT_EQ(gone.lost.at(0).now, "not there");
  const RunDiff added = diff(run({}), before);
  EXPECT_TRUE(holds(added));
  EXPECT_EQ(added.added.size(), 2u);
  EXPECT_FALSE(holds(diff(run({}), run({failing("light/a")})))) << "new, and broken";
  SceneVerdict by_no_row = scene("light/b", {scene_row("light/b", Stage::clip, Outcome::equal, 1)});
  by_no_row.failure = "unjudged: depth\n";
  EXPECT_EQ(diff(run({}), run({by_no_row})).broken.at(0).was, "not there");
  EXPECT_TRUE(holds(diff(before, rows(Outcome::dispute, Outcome::equal)))) << "listed, no failure";
  EXPECT_EQ(diff(before, rows(Outcome::dispute, Outcome::equal)).moved.size(), 1u);

  const RunDiff excused = diff(before, rows(Outcome::expected, Outcome::equal));
  EXPECT_TRUE(holds(excused));
  EXPECT_TRUE(diff_text(excused).starts_with("newly expected to differ: 1\n")) << diff_text(excused);
  EXPECT_EQ(diff(rows(Outcome::different, Outcome::equal), rows(Outcome::expected, Outcome::equal)).fixed.size(), 0u);
  EXPECT_EQ(diff(rows(Outcome::expected, Outcome::equal), before).fixed.size(), 1u);
  EXPECT_FALSE(holds(diff(rows(Outcome::expected, Outcome::equal), rows(Outcome::different, Outcome::equal))));

  SceneVerdict nobody = scene("light/a", {scene_row("light/a", Stage::clip, Outcome::equal, 1),
                                          scene_row("light/a", Stage::depth, Outcome::within, 1)});
  nobody.failure = "unjudged light/a: no reference judged merge\n";
  EXPECT_EQ(diff(before, run({nobody})).broken.at(0).now, "unjudged light/a: no reference judged merge");
}

TEST_F(RunFiles, ARowThatFailsInASceneThatHoldsIsRefused) {
  const SceneVerdict holds = scene("light/a", {scene_row("light/a", Stage::clip, Outcome::different, 1)});
  write_json(at("said.json"), {&holds, 1}, run({}).head);
  try {
    read_run(at("said.json"));
    FAIL() << "it is read";
  } catch (const std::exception& e) {
    EXPECT_NE(std::string(e.what()).find("/comparisons/0/outcome"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("one that holds, as its scene does"), std::string::npos) << e.what();
  }
}

TEST_F(RunFiles, WhatIsWrongWithTheRunItselfIsKept) {
  CheckRun lost = run({scene("light/a", {})});
  lost.head.failures = {"expectation light/z, osmesa, depth: there is no such scene"};
  write_json(at("lost.json"), lost.verdicts, lost.head);
  const CheckRun back = read_run(at("lost.json"));
  EXPECT_EQ(back.head.failures, lost.head.failures);
  std::vector<CheckRun> both(2, back);
  EXPECT_EQ(merge(both).run.head.failures, lost.head.failures) << "once";
  EXPECT_NE(junit(back.verdicts, back.head.failures).find("failures=\"1\""), std::string::npos);
  const RunDiff d = diff(run({scene("light/a", {})}), back);
  EXPECT_FALSE(holds(d));
  EXPECT_EQ(d.broken.at(0).now, lost.head.failures[0]);
  EXPECT_TRUE(holds(diff(back, back)));
}

TEST_F(RunFiles, ADiffNamesWhatMovedBeyondItsLimits) {
  const auto with = [&](double largest, double seconds) {
    SceneVerdict v = scene("light/a", {scene_row("light/a", Stage::depth, Outcome::within, largest)});
    v.seconds = seconds;
    return run({v});
  };
  const CheckRun before = with(4, 1);
  EXPECT_TRUE(diff(before, with(5, 1)).differences.empty()) << "a quarter more is not told";
  EXPECT_EQ(diff(before, with(5.1, 1)).differences.at(0).now, "0 differ, 0 ambiguous, largest 5.1 steps");
  CheckRun more = before;
  more.verdicts[0].comparisons[0].measurement.differing = 9;
  EXPECT_EQ(diff(before, more).differences.at(0).now, "9 differ, 0 ambiguous, largest 4 steps");
  more = before;
  more.verdicts[0].comparisons[0].measurement.ambiguous = 1;
  EXPECT_EQ(diff(before, more).differences.size(), 1u);
  EXPECT_EQ(diff(before, with(3.1, 1)).differences.size(), 1u);
  EXPECT_TRUE(diff(before, with(5.1, 1), {2, 1.5, 0.25}).differences.empty());
  EXPECT_TRUE(diff(before, with(4, 1.5)).times.empty());
  EXPECT_EQ(diff(before, with(4, 1.6)).times.at(0).now, "1.60 s");
  EXPECT_EQ(diff(before, with(4, 0.6)).times.size(), 1u);
  EXPECT_TRUE(diff(with(4, 0.01), with(4, 0.1)).times.empty()) << "less than a quarter of a second";
  CheckRun moved = with(4, 1);
  const std::string name = moved.tolerances.begin()->first;
  moved.tolerances[name] *= 2;
  moved.head.versions["osmesa"] = "2";
  const RunDiff d = diff(before, moved);
  EXPECT_EQ(d.tolerances.at(0).what, name);
  EXPECT_EQ(d.versions.at(0).was, "1");
  EXPECT_TRUE(holds(d));
  EXPECT_NE(diff_json(d).find("\"tolerances that moved\": [\n  {"), std::string::npos) << diff_json(d);
  EXPECT_NE(diff_markdown(d).find("### tolerances that moved: 1"), std::string::npos) << diff_markdown(d);
}

TEST_F(RunFiles, AsJUnit) {
  const std::string text =
      junit(std::vector{failing("light/a"), scene("light/b", {scene_row("light/b", Stage::clip, Outcome::equal)}),
                        scene("light/c", {scene_row("light/c", Stage::clip, Outcome::unsupported)})});
  SceneVerdict open = scene("light/d", {scene_row("light/d", Stage::depth, Outcome::ambiguous_only)});
  open.empty_holds = true;
  EXPECT_NE(junit(std::vector{open}).find("<skipped message=\"nothing was judged\"/>"), std::string::npos)
      << "the cleared frame holds";
  EXPECT_NE(
      text.find(
          "<testsuite name=\"plumb check\" tests=\"3\" failures=\"1\" errors=\"0\" skipped=\"1\" time=\"1.500\">"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("<testcase classname=\"light\" name=\"b\" file=\"scenes/light/b.json\" time=\"0.500\"/>"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("<testcase classname=\"light\" name=\"c\" file=\"scenes/light/c.json\" time=\"0.500\">"
                      "<skipped message=\"nothing was judged\"/></testcase>"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("<failure message=\"different light/a: first different stage: depth\">"), std::string::npos);
  EXPECT_NE(text.find("a &quot;note&quot; &amp; &lt;more&gt;"), std::string::npos) << "the rows";
  SceneVerdict odd = failing("light/a");
  odd.failure =
      "a\x01"
      "b\xff";
  EXPECT_NE(junit(std::vector{odd}).find("a?b\xef\xbf\xbd"), std::string::npos) << "XML holds neither";
  odd.failure = "a\xef\xbf\xbe\xef\xbf\xbf\xef\xbf\xbd";
  EXPECT_NE(junit(std::vector{odd}).find("a??\xef\xbf\xbd"), std::string::npos) << "nor U+FFFE and U+FFFF";
}

TEST_F(RunFiles, AsMarkdown) {
  std::vector<SceneVerdict> verdicts = {failing("light/a"),
                                        scene("light/b", {scene_row("light/b", Stage::depth, Outcome::expected),
                                                          scene_row("light/b", Stage::clip, Outcome::unsupported)})};
  const std::string text = markdown(verdicts, "FAILED: 2 scenes");
  for (const char* part : {"FAILED: 2 scenes", "| different | 1 |", "Not run: 1 unsupported, 0 missing, 0 failed.",
                           "| light/a | depth | osmesa | 7 of 100 pixel 3,4", "| plumb check x |", "1 expected"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  }
  EXPECT_EQ(cell("a|b\n<c> `d`"), "a\\|b &lt;c&gt; \\`d\\`");
  EXPECT_EQ(cell("a\xff|"), "a\xef\xbf\xbd\\|") << "a page is UTF-8";
  verdicts.assign(250, failing("light/a"));
  EXPECT_NE(markdown(verdicts, "").find("and 50 more"), std::string::npos);
  EXPECT_EQ(markdown(std::vector{scene("light/b", {})}, "").find("### Failures"), std::string::npos);
}

}  // namespace
}  // namespace plumbline::report
