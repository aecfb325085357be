// plumb notes, as a user meets it. (That what it says is so, notes/map_test.cpp asks.)
#include "notes/notes.h"

#include <fmt/format.h>

#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

using notes::Note;
using notes::Teaching;

TEST_F(Cli, NotesPrintsEveryRowOfOneNoteOrOfAll) {
  const Outcome all = plumb("notes");
  EXPECT_EQ(all.code, 0);
  for (const Note& note : notes::all()) {
    const Outcome one = plumb("notes " + std::string(note.number));
    EXPECT_EQ(one.code, 0);
    EXPECT_TRUE(all.says(one.text)) << note.number;
    EXPECT_TRUE(one.text.starts_with(std::string(note.number) + " " + std::string(note.title))) << one.text;
    for (const Teaching& t : note.teachings) {
      EXPECT_TRUE(one.says(fmt::format("  {} | {}\n", t.section, t.teaches))) << one.text;
      EXPECT_TRUE(t.mistake.empty() || one.says(fmt::format("    mistake:  {}\n", t.mistake)));
      for (const auto& places : {t.where, t.shown_by, t.mistake_shown_by}) {
        for (const auto& [file, name] : places) {
          EXPECT_TRUE(one.says(name.empty() ? file + "\n" : file + ": " + name + "\n")) << file << name;
        }
      }
    }
  }
  EXPECT_FALSE(plumb("notes 001").says("GzRender"));
}

TEST_F(Cli, NotesOfAnUnknownNumberEnds2AndNamesThoseThereAre) {
  const Outcome run = plumb("notes 003");
  EXPECT_EQ(run.code, 2);
  EXPECT_TRUE(run.says("003") && run.says("000") && run.says("004")) << run.text;
}

}  // namespace
}  // namespace plumbline
