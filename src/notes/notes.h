// The map of the course notes: what each section of the four teaches, the function that does it here, and the test or
// scene that shows it. The notes themselves are their authors'; here are their titles, their sections' titles, and what
// they teach in other words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace plumbline::notes {

/// A name in a file of the project: a function or type, a test (Suite.case), a fault. A scene has no name but its file.
struct Place {
  std::string file;  ///< from the project's folder
  std::string name;  ///< may be qualified, as gzrender::x_pi; empty of a scene
};

/// One heading, algorithm, matrix, formula or claim of a note.
struct Teaching {
  std::string_view section;  ///< as it is titled there
  std::string_view teaches;
  std::vector<Place> where = {};             ///< functions that do it
  std::vector<Place> shown_by = {};          ///< scenes and tests
  std::string_view mistake = {};             ///< what the note has wrong or leaves open; empty: nothing
  std::vector<Place> mistake_shown_by = {};  ///< tests and faults; one at least, if there is a mistake
};

struct Note {
  std::string_view number;          ///< by which the project's comments name it: 000, 001, 002, 004
  std::string_view title;           ///< and author
  std::vector<Teaching> teachings;  ///< in the note's order
};

Note gzrender();                             ///< 000
Note games101();                             ///< 001
Note tinyrenderer();                         ///< 002
Note class_notes();                          ///< 004
std::vector<Teaching> class_notes_raster();  ///< of its sections 1 and 2

/// The four.
std::vector<Note> all();

// Words of the tables.
inline Place function(std::string_view file, std::string_view name) {
  return {"src/" + std::string(file), std::string(name)};
}
inline Place test(std::string_view file, std::string_view name) {
  return {"tests/" + std::string(file) + "_test.cpp", std::string(name)};
}
inline Place scene(std::string_view name) { return {"tests/scenes/" + std::string(name) + ".json", ""}; }
inline Place fault(std::string_view file, std::string_view name) {
  return {"tests/faults/" + std::string(file) + ".cpp", std::string(name)};
}

}  // namespace plumbline::notes
