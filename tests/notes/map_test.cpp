// The map of the course notes leads where it says: every file is there, and every name in it.
#include "notes/notes.h"
#include "tests/text_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <regex>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace plumbline {
namespace {

using notes::Note;
using notes::Place;
using notes::Teaching;

namespace fs = std::filesystem;

std::string without_comments(const std::string& source) {
  return std::regex_replace(source, std::regex("//[^\n]*"), "");
}

/// The part of a source that is in `namespace name`.
std::string within(const std::string& source, const std::string& name) {
  const std::size_t from = source.find("namespace " + name + " {");
  const std::size_t to = source.find("}  // namespace " + name + "\n");
  return from == std::string::npos || to == std::string::npos ? "" : source.substr(from, to - from);
}

bool has_word(const std::string& source, const std::string& word) {
  return std::regex_search(without_comments(source), std::regex("\\b" + word + "\\b"));
}

/// A name of a source: as it stands, or the last part of it within the namespace before it.
bool has_name(const std::string& source, const std::string& name) {
  const std::size_t colons = name.find("::");
  if (has_word(source, name)) return true;
  return colons != std::string::npos && has_word(within(source, name.substr(0, colons)), name.substr(colons + 2));
}

bool has_test(const std::string& source, const std::string& name) {
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos) return false;
  const std::string suite = name.substr(0, dot), test = name.substr(dot + 1);
  return std::regex_search(without_comments(source), std::regex("(TEST|TEST_F|TEST_P|RC_GTEST_PROP)\\(\\s*" + suite +
                                                                ",\\s*" + test + "\\s*[,)]"));
}

/// What is wrong with a place; empty: nothing.
std::string wrong(const Place& place) {
  const fs::path file = fs::path(PLUMBLINE_SOURCE_DIR) / place.file;
  const auto is_in = [&](const char* folder) { return place.file.starts_with(folder); };
  if (!fs::is_regular_file(file)) return place.file + ": there is no such file";
  if (is_in("tests/scenes/")) {
    const bool scene = place.file.ends_with(".json") && !place.file.ends_with(".part.json") && place.name.empty();
    return scene ? "" : place.file + ": it is no scene";
  }
  const std::string source = test::text_of(file);
  const bool found = is_in("src/faults/") ? source.find("\"" + place.name + "\"") != std::string::npos
                     : is_in("src/")      ? has_name(source, place.name)
                                          : has_test(source, place.name);
  return found && !place.name.empty() ? "" : fmt::format("{}: there is no {} in it", place.file, place.name);
}

bool is_fault(const Place& place) { return place.file.starts_with("src/faults/"); }

/// What is wrong with a row; empty: nothing.
std::string wrong(const Teaching& t) {
  std::string out;
  const auto say = [&](const std::string& what) {
    if (!what.empty()) out += fmt::format("{} | {}: {}\n", t.section, t.teaches, what);
  };
  if (t.section.empty() || t.teaches.empty()) say("it says nothing");
  if (t.where.empty()) say("it names no function");
  if (t.where.empty() != t.shown_by.empty()) say("there is a function without a test or scene, or one without it");
  if (t.mistake.empty() != t.mistake_shown_by.empty()) say("there is a mistake without a test, or one without it");
  for (const Place& place : t.where) {
    if (!place.file.starts_with("src/") || is_fault(place)) say(place.file + ": expected a file of src, and no fault");
    say(wrong(place));
  }
  for (const auto& places : {t.shown_by, t.mistake_shown_by}) {
    for (const Place& place : places) {
      if (!place.file.starts_with("tests/") && !is_fault(place))
        say(place.file + ": expected a file of tests, or a fault");
      say(wrong(place));
    }
  }
  return out;
}

TEST(NotesMap, EveryRowLeadsToWhatItNames) {
  for (const Note& note : notes::all()) {
    EXPECT_FALSE(note.title.empty());
    EXPECT_GE(note.teachings.size(), 10u) << note.number;
    for (const Teaching& t : note.teachings) EXPECT_EQ(wrong(t), "") << note.number;
  }
}

/// All that `expression` matches in a source: its groups, joined by dots.
std::vector<std::string> found(const fs::path& file, const char* expression) {
  const std::string source = without_comments(test::text_of(file));
  std::vector<std::string> out;
  const std::regex regex(expression);
  for (std::sregex_iterator at(source.begin(), source.end(), regex), end; at != end; ++at) {
    out.push_back((*at)[1].str() + ((*at).size() > 2 ? "." + (*at)[2].str() : ""));
  }
  return out;
}

// The other way round: what is there to show a mistake of the notes, the map names.
TEST(NotesMap, NamesAllTestsAndFaultsOfTheNotes) {
  std::set<std::string> named;
  for (const Note& note : notes::all()) {
    for (const Teaching& t : note.teachings) {
      for (const auto& places : {t.shown_by, t.mistake_shown_by}) {
        for (const Place& place : places) named.insert(place.name);
      }
    }
  }
  int seen = 0;
  for (const auto& file : fs::directory_iterator(PLUMBLINE_SOURCE_DIR "/tests/notes")) {
    const std::string name = file.path().filename().string();
    if (!name.ends_with("_test.cpp") || name == "map_test.cpp") continue;
    for (const std::string& test : found(file, "\nTEST\\((\\w+),\\s*(\\w+)\\)")) {
      ++seen;
      EXPECT_TRUE(named.contains(test)) << name << ": " << test;
    }
  }
  for (const std::string& fault : found(PLUMBLINE_SOURCE_DIR "/src/faults/notes.cpp", "\"(notes\\.[^\"]+)\"")) {
    ++seen;
    EXPECT_TRUE(named.contains(fault)) << fault;
  }
  EXPECT_GE(seen, 45);
}

TEST(NotesMap, AWrongNameIsSeen) {
  const auto fault_of = [](const char* text) { return wrong(notes::place(text)); };
  EXPECT_EQ(fault_of("src/transforms/projection.cpp: gzrender::x_pi"), "");
  EXPECT_NE(fault_of("src/transforms/projection.cpp: games101::x_pi"), "") << "of another namespace";
  EXPECT_NE(fault_of("src/transforms/projection.cpp: x_p"), "") << "a part of a name";
  EXPECT_NE(fault_of("src/transforms/projection.cpp"), "");
  EXPECT_NE(fault_of("src/transforms/projections.cpp: x_pi"), "") << "no such file";
  EXPECT_NE(fault_of("src/notes/raster/triangle_lee.cpp: Edges"), "") << "named in a comment alone";
  EXPECT_EQ(fault_of("tests/notes/map_test.cpp: NotesMap.AWrongNameIsSeen"), "");
  EXPECT_EQ(fault_of("tests/property/transforms_test.cpp: Transforms.XPiIsWhatTheNotesClaim"), "");
  EXPECT_NE(fault_of("tests/notes/map_test.cpp: NotesMap.AWrongNameIs"), "");
  EXPECT_NE(fault_of("tests/notes/map_test.cpp: AWrongNameIsSeen"), "");
  EXPECT_NE(fault_of("tests/notes/maps_test.cpp: NotesMap.AWrongNameIsSeen"), "");
  EXPECT_EQ(fault_of("tests/scenes/notes/gl_solids.json"), "");
  EXPECT_NE(fault_of("tests/scenes/notes/gl_solid.json"), "");
  EXPECT_NE(fault_of("tests/scenes/notes/solids.part.json"), "") << "a part of scenes";
  EXPECT_EQ(fault_of("src/faults/raster.cpp: attributes.affine"), "");
  EXPECT_NE(fault_of("src/faults/raster.cpp: attributes.affin"), "");
}

TEST(NotesMap, ARowWithNothingInItIsSeen) {
  const Place function = notes::place("src/transforms/projection.cpp: near_plane"),
              scene = notes::place("tests/scenes/camera/wide.json");
  const auto row = [&] { return Teaching{"s", "t", {function}, {scene}, "", {}}; };
  EXPECT_EQ(wrong(row()), "");
  const auto with = [&](auto change) {
    Teaching t = row();
    change(t);
    return wrong(t);
  };
  EXPECT_NE(with([](Teaching& t) { t.section = ""; }), "");
  EXPECT_NE(with([](Teaching& t) { t.teaches = ""; }), "");
  EXPECT_NE(with([](Teaching& t) { t.where.clear(); }), "");
  EXPECT_NE(with([](Teaching& t) { t.shown_by.clear(); }), "");
  EXPECT_NE(with([](Teaching& t) { t.where.clear(), t.shown_by.clear(); }), "");
  EXPECT_NE(with([](Teaching& t) { t.mistake = "m"; }), "") << "where is it seen?";
  EXPECT_NE(with([&](Teaching& t) { t.mistake_shown_by = {scene}; }), "") << "which?";
  EXPECT_NE(with([&](Teaching& t) { t.where = {scene}; }), "");
  EXPECT_NE(with([&](Teaching& t) { t.shown_by = {function}; }), "");
}

}  // namespace
}  // namespace plumbline
