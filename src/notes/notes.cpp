#include "notes/notes.h"

#include <string_view>

#include <nlohmann/json.hpp>

namespace plumbline::notes {

/// The text of notes.json (notes_json.cpp.in).
extern const std::string_view kNotesJson;

namespace {

std::vector<Place> places(const nlohmann::json& teaching, const char* key) {
  std::vector<Place> out;
  for (const std::string& text : teaching.value(key, std::vector<std::string>())) out.push_back(place(text));
  return out;
}

Teaching teaching_of(const nlohmann::json& t) {
  return {t.at("section"),       t.at("teaches"),        places(t, "where"),
          places(t, "shown_by"), t.value("mistake", ""), places(t, "mistake_shown_by")};
}

}  // namespace

Place place(const std::string& text) {
  const std::size_t colon = text.find(": ");
  return colon == std::string::npos ? Place{text, ""} : Place{text.substr(0, colon), text.substr(colon + 2)};
}

std::vector<Note> all() {
  std::vector<Note> out;
  for (const nlohmann::json& note : nlohmann::json::parse(kNotesJson)) {
    out.push_back({note.at("number"), note.at("title"), {}});
    for (const nlohmann::json& teaching : note.at("teachings")) out.back().teachings.push_back(teaching_of(teaching));
  }
  return out;
}

}  // namespace plumbline::notes
