// plumb campaign of another renderer.
#include <fmt/format.h>

#include "tests/cli/campaign.h"
#include "tests/text_file.h"

namespace plumbline {
namespace {

TEST_F(Campaign, OfAProgramCountsWhatItDoesNotDraw) {
  const Outcome run =
      campaign("c", fmt::format("--seeds 1..4 --program '{} {{input}} {{output}}'", PLUMBLINE_C_RENDERER));
  EXPECT_EQ(run.code, 2) << run.text;
  EXPECT_TRUE(run.says("hold: 0\nnothing could be judged: 8\n      ")) << run.text;
  EXPECT_TRUE(run.says("states: 0 of ")) << "of scenes that were not drawn: " << run.text;
  EXPECT_TRUE(run.says("most scenes ask for more than is drawn; other generators ask for less:\n--generator plain: "))
      << run.text;
  EXPECT_TRUE(run.says("no plane cuts\n--generator flat: triangles of one colour a draw")) << run.text;
}

// The C renderer draws opaque triangles by OpenGL's rules, and no texture, fog or line.
TEST_F(Campaign, OfAProgramThatDrawsTrianglesAloneHasScenesForIt) {
  const std::string program = fmt::format(" --program '{} {{serve}}'", PLUMBLINE_C_RENDERER);
  const Outcome run = campaign("c", "--seeds 1..20 --generator plain --against exact,embree" + program);
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_TRUE(run.says("plain scenes: 20\nhold: 14\nnothing could be judged: 6\n      4  a frame in which nothing is "))
      << run.text;
  EXPECT_FALSE(run.says("--generator plain: ")) << run.text;
  const Outcome flat = campaign("f", "--seeds 1..20 --generator flat --against exact,embree" + program);
  EXPECT_EQ(flat.code, 0) << flat.text;
  EXPECT_TRUE(flat.says("flat scenes: 20\n")) << flat.text;
  const Outcome inside = campaign("i", "--seeds 1..20 --generator inside --against exact,embree" + program);
  EXPECT_EQ(inside.code, 0) << inside.text;
  EXPECT_TRUE(inside.says("inside scenes: 20\n")) << inside.text;
}

TEST_F(Campaign, OfAProgramNamesMistakesAmongItsConventions) {
  test::write_text(folder_ / "c.json", R"({"format": "plumbline conventions", "version": 1, "rows": "from_top"})");
  const std::string program = fmt::format(" --against exact --program '{} {{serve}}'", PLUMBLINE_C_RENDERER);
  const Outcome declared =
      campaign("declared", "--seeds 11..40 --generator ordinary --conventions " + at("c.json") + program);
  EXPECT_EQ(declared.code, 1) << declared.text;
  EXPECT_TRUE(declared.says("rows: from_top, expected from_bottom")) << declared.text;
  const Outcome plain = campaign("plain", "--seeds 11..40 --generator ordinary" + program);
  EXPECT_EQ(plain.code, 0) << plain.text;
  EXPECT_TRUE(plain.says("not judged: which triangle owns a sample on an edge (no tie rule")) << plain.text;
}

// Two that end otherwise are two findings, however long the command line is.
TEST_F(Campaign, OfAProgramTellsFailuresApartAndNotCommands) {
  const std::string word(150, 'x');
  const Outcome run = campaign("c", "--seeds 1..12 --generator hard --against exact --program '" + word +
                                        "= sh -c \"grep -q stencil \\$1 && kill -6 \\$\\$; kill -11 \\$\\$\" "
                                        "sh {scene} {output}'");
  EXPECT_EQ(run.code, 1) << run.text;
  for (const char* how : {"Aborted", "Segmentation fault"}) {
    EXPECT_TRUE(run.says(fmt::format("merge, failed: program: exited with status #: signal # ({})", how))) << run.text;
  }
}

// Words about each scene, and about scenes before, tell no failures apart.
TEST_F(Campaign, OfAProgramTellsFailuresApartByTheLastLineOfItsStderr) {
  test::write_text(folder_ / "mine.sh",
                   "echo \"drawing $(cksum <\"$1/manifest.json\" | tr 0-9 a-j)\" >&2\n"
                   "grep -q stencil \"$1/manifest.json\" && echo 'no stencil' >&2 || echo 'no luck' >&2\nexit 3\n");
  const Outcome run = campaign(
      "c", "--seeds 1..12 --generator hard --against exact --program 'sh " + at("mine.sh") + " {input} {output}'");
  EXPECT_EQ(run.code, 1) << run.text;
  std::size_t findings = 0;
  for (std::size_t at = 0; (at = run.text.find("  repeat: ", at)) != run.text.npos; ++at) ++findings;
  EXPECT_LE(findings, 2u) << run.text;
  EXPECT_TRUE(run.says("merge, failed: program: exited with status #: no ")) << run.text;
  EXPECT_FALSE(run.says("stderr: drawing")) << run.text;
}

TEST_F(Campaign, GivesAProgramTheTimeLimit) {
  const Outcome run =
      campaign("c", "--seeds 1..1 --generator hard --judge-only --time-limit 1 --program 'sleep 100; {serve}'");
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_TRUE(run.says("took longer than #s and was killed")) << run.text;
}

TEST_F(Campaign, OfAProgramWhoseWordsAreNoUtf8IsTold) {
  test::write_text(folder_ / "mine.sh", "printf 'grob \\351\\nund mehr\\n' >&2; exit 3\n");
  const Outcome run =
      campaign("c", "--seeds 1..1 --generator hard --program 'sh " + at("mine.sh") + " {input} {output}'");
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_TRUE(results("c").starts_with("{")) << run.text;
}

// A program that is mended is another one.
TEST_F(Campaign, OfAProgramThatWasChangedIsRefused) {
  test::write_text(folder_ / "mine.sh", "exit 3\n");
  const std::string options = "--seeds 1..1 --generator hard --judge-only --program 'sh " + at("mine.sh") + " {serve}'";
  ASSERT_EQ(campaign("c", options).code, 0);
  test::write_text(folder_ / "mine.sh", "exit 4\n");
  const Outcome run = campaign("c", options);
  EXPECT_EQ(run.code, 2) << run.text;
  EXPECT_TRUE(run.says("expected a journal of this campaign")) << run.text;
  EXPECT_TRUE(run.says("take another folder, or delete this one")) << run.text;
}

// A server that fails from its second scene on: by itself, each scene is drawn.
TEST_F(Campaign, OfAProgramTellsWhatDoesNotRepeat) {
  test::write_text(folder_ / "mine",
                   "#!/bin/sh\n"
                   "while IFS=\"$(printf '\\t')\" read -r in out; do\n"
                   "  if [ -n \"$tired\" ]; then echo failed tired; continue; fi\n"
                   "  tired=yes\n"
                   "  " PLUMBLINE_C_RENDERER
                   " \"$in\" \"$out\" 2>/dev/null && echo ok || echo unsupported\n"
                   "done\n");
  fs::permissions(folder_ / "mine", fs::perms::owner_all);
  const std::string options = "--seeds 11..14 --generator ordinary --jobs 1 --against exact";
  const Outcome run = campaign("c", options + " --program '" + at("mine") + " {serve}'");
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_TRUE(
      run.says("not repeated " + at("c/findings/merge-failed-program-failed-tired-program/scene.json") +
               ": merge, failed: program: failed: tired (against program); judged again, nothing can be judged"))
      << run.text;
  EXPECT_TRUE(test::text_of(at("c/findings/merge-failed-program-failed-tired-program/scene.txt"))
                  .ends_with("\nnot repeated\n"));
}

}  // namespace
}  // namespace plumbline
