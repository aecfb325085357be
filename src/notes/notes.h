// The map of the course notes (notes.json): what each section of the four teaches, the function that implements it, and
// the test or scene that shows it. Titles and section titles are the notes' own; what they teach is in other words.
#pragma once

#include <string>
#include <vector>

namespace plumbline::notes {

/// A name in a file of the project: a function or type, a test (Suite.case), a fault. A scene has no name but its file.
struct Place {
  std::string file;  ///< from the project's folder
  std::string name;  ///< may be qualified, as gzrender::x_pi; empty of a scene
};
/// Of "file: name", or of "file".
Place place(const std::string& text);

/// One heading, algorithm, matrix, formula or claim of a note.
struct Teaching {
  std::string section;  ///< as it is titled there
  std::string teaches;
  std::vector<Place> where;             ///< functions that implement it
  std::vector<Place> shown_by;          ///< scenes and tests
  std::string mistake;                  ///< what the note has wrong or leaves open; empty: nothing
  std::vector<Place> mistake_shown_by;  ///< tests and faults; at least one where there is a mistake
};

struct Note {
  std::string number;               ///< by which the project's comments name it: 000, 001, 002, 004
  std::string title;                ///< and author
  std::vector<Teaching> teachings;  ///< in the note's order
};

/// The four.
std::vector<Note> all();

}  // namespace plumbline::notes
