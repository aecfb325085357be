// The random changes of scripts/mutate_source: the same for a seed, each another text, none where none belongs.
#include "mutation/changes.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string_view>

#include <gtest/gtest.h>

#include "mutation/choose.h"
#include "mutation/fields.h"
#include "mutation/judge.h"
#include "mutation/kept.h"
#include "mutation/run.h"
#include "mutation/score.h"
#include "mutation/tokens.h"

namespace plumbline::mutation {
namespace {

const std::filesystem::path kRoot = PLUMBLINE_SOURCE_DIR;

std::map<std::string, std::string> sources() {
  return sources_of(kRoot, read_file_rules(kRoot / "tests/mutation/files.tsv"));
}

std::vector<Change> drawn(const std::map<std::string, std::string>& from, std::uint64_t seed, std::size_t count) {
  Draw draw(from, read_file_rules(kRoot / "tests/mutation/files.tsv"), seed);
  std::vector<Change> out;
  for (Change change; out.size() < count && draw.next(change);) out.push_back(change);
  return out;
}

// A function's body with all its changes, as "before -> after".
std::set<std::string> changes_in(const std::string& body) {
  const std::string source = "void f(int a, int b) {\n" + body + "\n}\n";
  std::set<std::string> out;
  for (const Change& change : changes_of("f.cpp", source)) {
    const ChangedLines lines = lines_of(source, change);
    EXPECT_EQ(lines.before, body);
    out.insert(lines.after);
  }
  return out;
}

TEST(SourceChanges, ASeedDrawsTheSameChanges) {
  const auto from = sources();
  const std::vector<Change> first = drawn(from, 0xe4d66d8, 300), again = drawn(from, 0xe4d66d8, 300);
  ASSERT_EQ(first.size(), 300u);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].file, again[i].file);
    EXPECT_EQ(first[i].at, again[i].at);
    EXPECT_EQ(first[i].replacement, again[i].replacement);
  }
  const std::vector<Change> other = drawn(from, 0xe4d66d9, 300);
  std::size_t equal = 0;
  for (std::size_t i = 0; i < first.size(); ++i) equal += other[i].file == first[i].file && other[i].at == first[i].at;
  EXPECT_LT(equal, 10u) << "by chance, one or two";
}

TEST(SourceChanges, EachDiffersFromTheSource) {
  std::size_t count = 0;
  for (const auto& [file, text] : sources()) {
    for (const Change& change : changes_of(file, text)) {
      const ChangedLines lines = lines_of(text, change);
      EXPECT_NE(lines.before, lines.after) << file << ":" << change.line;
      EXPECT_EQ(std::ranges::count(text.substr(0, change.at), '\n') + 1, static_cast<std::ptrdiff_t>(change.line));
      ++count;
    }
  }
  EXPECT_GT(count, 5000u);
}

TEST(SourceChanges, AreSlipsThatPeopleMake) {
  EXPECT_EQ(changes_in("if (a < b) g();"),
            (std::set<std::string>{"if (a <= b) g();", "if (a > b) g();", "if (!(a < b)) g();", "if (a < b) ;"}));
  EXPECT_EQ(changes_in("const int c = a - b;"),
            (std::set<std::string>{"const int c = a + b;", "const int c = b - a;"}));
  EXPECT_EQ(changes_in("c = v.x;"), (std::set<std::string>{"c = v.y;", ";"}));
  EXPECT_EQ(changes_in("return g(a, b);"), (std::set<std::string>{"return g(b, a);"}));
  EXPECT_EQ(changes_in("return a ? b : 2;"),
            (std::set<std::string>{"return a ? 2 : b;", "return a ? b : 1;", "return a ? b : 3;"}));
  EXPECT_EQ(changes_in("return -0.5f;"), (std::set<std::string>{"return 0.5f;", "return -1.0f;", "return -0.0f;"}));
}

TEST(SourceChanges, LeaveAloneWhatDrawsNothing) {
  EXPECT_EQ(changes_in("int c;"), std::set<std::string>{});
  EXPECT_EQ(changes_in("static_assert(1 + 1 == 2);"), std::set<std::string>{});
  EXPECT_EQ(changes_in("if (a < 0) throw 1;"), std::set<std::string>{});
  EXPECT_EQ(changes_in("list.reserve(a + 1);"), std::set<std::string>{});
  EXPECT_EQ(changes_in("const std::vector<int> c(b);  // a < b"), std::set<std::string>{});
  EXPECT_EQ(changes_in("g(\"a < b\");"), std::set<std::string>{";"});
  EXPECT_TRUE(changes_of("f.h", "#define A 1 + 1\nstruct S {\n  int a = 1;\n};\nenum E { one = 1 };\n").empty());
  EXPECT_EQ(changes_of("f.h", "constexpr int kTwo = 2;\n").size(), 2u);
  EXPECT_EQ(changes_of("f.h", "struct S {\n  int f(int a) { return [] { return 7; }(); }\n};\n")[0].function, "f");
}

TEST(SourceChanges, ATextWithoutAnEndEndsWithTheFile) {
  for (const char* source : {"int f() { return 'a", "int f() { return \"a\\", "int f() { return 1; } '"}) {
    EXPECT_EQ(tokens_of(source).back().at + tokens_of(source).back().text.size(), std::string_view(source).size());
  }
}

TEST(SourceChanges, EachFileOfTheSourcesHasARule) {
  const auto rules = read_file_rules(kRoot / "tests/mutation/files.tsv");
  EXPECT_EQ(rule_of(rules, "src/pipeline/light.cpp", "light")->names, std::vector<std::string>{"light"});
  EXPECT_EQ(rule_of(rules, "src/painter/painter.cpp", "")->names, std::vector<std::string>{"picture"});
  EXPECT_EQ(rule_of(rules, "reference/exact/clip.cpp", ""), nullptr);
  std::set<const FileRule*> used;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / "src")) {
    if (!entry.is_regular_file()) continue;
    const std::string path = entry.path().lexically_relative(kRoot).generic_string();
    used.insert(rule_of(rules, path, ""));
    const std::string extension = entry.path().extension().string();
    if (extension != ".cpp" && extension != ".h") continue;
    for (const Change& change : changes_of(path, text_of(entry.path()))) {
      used.insert(rule_of(rules, path, change.function));
    }
  }
  for (const FileRule& rule : rules) {
    EXPECT_TRUE(used.contains(&rule)) << rule.prefix << " is the beginning of no file or function";
  }
  for (const Equivalent& e : read_equivalents(kRoot / "tests/mutation/equivalent.tsv")) {
    const std::string text = text_of(kRoot / e.file);
    EXPECT_TRUE(std::ranges::any_of(changes_of(e.file, text),
                                    [&](const Change& change) {
                                      const ChangedLines lines = lines_of(text, change);
                                      return lines.before == e.before && lines.after == e.after;
                                    }))
        << e.file << ": no change makes this of it: " << e.after;
    EXPECT_TRUE(std::ranges::any_of(rules, [&](const FileRule& rule) {  // of the file, or of a function of it
      const std::string& shorter = rule.prefix.size() < e.file.size() ? rule.prefix : e.file;
      return rule.names[0] != "-" && rule.prefix.starts_with(shorter) && e.file.starts_with(shorter);
    })) << e.file;
  }
}

TEST(SourceChanges, WhatWasFoundIsTakenOverFromALogOfTheSameSources) {
  const auto rules = read_file_rules(kRoot / "tests/mutation/files.tsv");
  Judged found, survivor, equivalent;
  found.seed = survivor.seed = equivalent.seed = "ab";
  found.number = 1;
  survivor.number = 2;
  equivalent.number = 3;
  equivalent.verdict.outcome = Outcome::equivalent;
  equivalent.verdict.note = "the same";
  found.rule = survivor.rule = equivalent.rule = rule_of(rules, "src/pipeline/light.cpp", "light");
  found.change.file = survivor.change.file = "src/pipeline/light.cpp";
  found.lines = {"a = b;", ";"};
  survivor.lines = {"a = 1;", "a = 2;"};
  found.verdict = {Outcome::references, 3, "light/a", {"light", "shade"}, {"light", "osmesa, light"},
                   {"shade", ""},       ""};
  survivor.verdict.note = "why";
  const std::filesystem::path log = std::filesystem::path(testing::TempDir()) / "plumbline_changes.tsv";
  std::ofstream(log) << log_head("1234") << log_of({found, survivor, equivalent});
  const auto kept = read_found(log, "1234");
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_EQ(kept.at(key_of(equivalent)).note, "the same");
  const Verdict& v = kept.at(key_of(found));
  EXPECT_EQ(v.outcome, Outcome::references);
  EXPECT_EQ(v.expected, found.verdict.expected);
  EXPECT_TRUE(v.named_by_check() && v.named_by_diagnose());
  EXPECT_THROW(read_found(log, "1235"), std::runtime_error) << "of other sources";
  std::ofstream(log, std::ios::app) << "a line of less\n";
  EXPECT_THROW(read_found(log, "1234"), std::runtime_error);
  std::string no_number = log_of({found});
  no_number.replace(no_number.find("\t3\t"), 3, "\tx\t");
  std::ofstream(log) << log_head("1234") << no_number;
  EXPECT_THROW(read_found(log, "1234"), std::runtime_error);
  std::filesystem::remove(log);
  EXPECT_EQ(sources_hash(kRoot), sources_hash(kRoot));
}

TEST(SourceChanges, NumbersAreWhole) {
  EXPECT_EQ(number_of("1f", 16, "p"), 31u);
  for (const char* bad : {"", "1g", "-1", "123456789012345678901"}) {
    EXPECT_THROW(number_of(bad, 16, "p"), std::runtime_error) << bad;
  }
}

TEST(SourceChanges, AScenesFirstStageIsNamed) {
  const auto named = named_by_check(R"({"comparisons": [
    {"scene": "a", "reference": "osmesa", "stage": "merge", "outcome": "different"},
    {"scene": "a", "reference": "embree", "stage": "depth", "outcome": "different"},
    {"scene": "a", "reference": "exact, from scene", "stage": "clip", "outcome": "within"},
    {"scene": "a", "reference": "picture", "stage": "merge", "outcome": "different"},
    {"scene": "b", "reference": "picture", "stage": "merge", "outcome": "failed", "note": "SIGSEGV"},
    {"scene": "c", "reference": "osmesa", "stage": "merge", "outcome": "dispute"},
    {"scene": "d", "reference": "osmesa", "stage": "depth", "outcome": "different"}],
    "scenes": [{"scene": "b", "failure": "failed b: picture, merge: SIGSEGV"},
    {"scene": "d", "failure": "different d: first different stage: merge (against exact, per stage): 1 of 2"}]})");
  ASSERT_EQ(named.size(), 3u);
  EXPECT_EQ(named.at("d").first, "merge") << "as it says";
  EXPECT_EQ(named.at("d").by, "exact, per stage, merge");
  EXPECT_EQ(named.at("a").first, "depth");
  EXPECT_EQ(named.at("a").by, "embree, depth");
  EXPECT_EQ(named.at("b").first, "picture");
  EXPECT_EQ(named.at("b").by, "picture, merge (failed: SIGSEGV)");
}

TEST(SourceChanges, ScenesAreAffectedByAnyBit) {
  SceneHashes was, is;
  was.of = {{"a", {9, {"1", "2"}}}, {"b", {1, {"1", "2"}}}, {"c", {2, {"1", "2"}}}, {"d", {0, {"1", "2"}}}};
  is.of = {{"a", {9, {"0", "2"}}}, {"b", {1, {"1", "0"}}}, {"c", {2, {"failed", "why"}}}, {"d", {0, {"1", "2"}}}};
  const std::vector<Affected> scenes = affected(was, is);
  ASSERT_EQ(scenes.size(), 3u);
  EXPECT_EQ(scenes[0].scene, "c");
  EXPECT_TRUE(scenes[0].failed);
  EXPECT_EQ(scenes[1].scene, "a");
  EXPECT_FALSE(scenes[1].picture_alone);
  EXPECT_EQ(scenes[2].scene, "b");
  EXPECT_TRUE(scenes[2].picture_alone);
}

// Adds `count` changes in files of the rule, of that outcome and name.
void add(std::vector<Judged>& to, const FileRule& rule, std::size_t count, Outcome outcome, const std::string& name) {
  for (std::size_t i = 0; i < count; ++i) {
    Judged j;
    j.rule = &rule;
    j.verdict.outcome = outcome;
    j.verdict.expected = (rule.names[0] == "any" || rule.names[0] == "data") ? std::vector<std::string>{} : rule.names;
    j.verdict.check.first = j.verdict.diagnose.first = name;
    to.push_back(j);
  }
}

TEST(SourceChanges, TheScoreHoldsJustWhereItMay) {
  const FileRule clip{"c", {"clip"}, ""}, painter{"p", {"picture"}, ""}, scene{"s", {"any"}, ""},
      data{"d", {"data"}, ""};
  std::vector<Judged> judged;
  add(judged, clip, 93, Outcome::references, "clip");
  add(judged, clip, 4, Outcome::references, "window");
  add(judged, clip, 3, Outcome::survived, "none");
  add(judged, painter, 50, Outcome::picture, "picture");
  add(judged, scene, 50, Outcome::references, "depth");
  add(judged, clip, 27, Outcome::equivalent, "none");
  EXPECT_TRUE(holds(score_of(judged)));
  const auto fails_with = [&](const FileRule& rule, Outcome outcome, const std::string& name) {
    std::vector<Judged> more = judged;
    add(more, rule, 4, outcome, name);
    return !holds(score_of(more));
  };
  EXPECT_TRUE(fails_with(clip, Outcome::references, "window"));
  EXPECT_TRUE(fails_with(scene, Outcome::goldens, "none"));
  EXPECT_TRUE(fails_with(scene, Outcome::equivalent, "none"));
  EXPECT_TRUE(fails_with(painter, Outcome::references, "merge"));
  EXPECT_FALSE(fails_with(scene, Outcome::references, "light"));
  EXPECT_FALSE(fails_with(data, Outcome::tables, "none"));
  EXPECT_TRUE(fails_with(data, Outcome::goldens, "none"));
  EXPECT_FALSE(holds(score_of({})));
}

}  // namespace
}  // namespace plumbline::mutation
