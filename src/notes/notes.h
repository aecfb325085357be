// Map of the four course notes (notes.json): the teachings of each section, the functions that implement them, and the
// tests and scenes that show them. Titles are the notes' own; `teaches` is in plumbline's words.
#pragma once

#include <string>
#include <vector>

namespace plumbline::notes {

/// A reference to the project: a function, type, test (Suite.case) or fault in a file, or a scene file.
struct Place {
  std::string file;  ///< relative to the project's folder
  std::string name;  ///< may be qualified, as gzrender::x_pi; empty for a scene
};
/// Parses "file: name" or "file".
Place place(const std::string& text);

/// One heading, algorithm, matrix, formula or claim of a note.
struct Teaching {
  std::string section;  ///< the note's title of the section
  std::string teaches;
  std::vector<Place> where;             ///< functions that implement it
  std::vector<Place> shown_by;          ///< scenes and tests
  std::string mistake;                  ///< error or gap of the note; empty: none
  std::vector<Place> mistake_shown_by;  ///< tests and faults; at least one if `mistake` is not empty
};

struct Note {
  std::string number;               ///< the number in the project's comments: 000, 001, 002 or 004
  std::string title;                ///< and author
  std::vector<Teaching> teachings;  ///< in the note's order
};

/// The four notes, by number.
std::vector<Note> all();

}  // namespace plumbline::notes
