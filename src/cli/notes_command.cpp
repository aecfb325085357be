// plumb notes: from the course notes to the project.
#include "notes/notes.h"

#include <fmt/format.h>

#include "cli/commands.h"

namespace plumbline::cli {

namespace {

void print_places(std::string_view word, const std::vector<notes::Place>& places) {
  for (const auto& [file, name] : places) {
    fmt::print("    {:<9} {}{}{}\n", word, file, name.empty() ? "" : ": ", name);
    word = "";
  }
}

void print(const notes::Note& note) {
  fmt::print("{} {}\n", note.number, note.title);
  for (const notes::Teaching& t : note.teachings) {
    fmt::print("\n  {} | {}\n", t.section, t.teaches);
    print_places("where:", t.where);
    print_places("shown by:", t.shown_by);
    if (!t.mistake.empty()) fmt::print("    mistake:  {}\n", t.mistake);
    print_places("seen in:", t.mistake_shown_by);
  }
  fmt::print("\n");
}

}  // namespace

int notes(const NotesOptions& o) {
  for (const notes::Note& note : notes::all()) {
    if (o.number.empty() || o.number == note.number) print(note);
  }
  return kHolds;
}

}  // namespace plumbline::cli
