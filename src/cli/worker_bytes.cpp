#include "cli/worker_bytes.h"

#include <string>

#include "check/verdict/verdict_bytes.h"

namespace plumbline::cli {

namespace {

template <class Archive>
void visit(Archive& archive, report::HtmlReport::Drawing& d) {
  visit_all(archive, d.scene, d.description, d.thumbnail, d.outcome, d.first, d.fails, d.all, d.color_alone);
}

template <class Archive>
void visit_scene(Archive& archive, JudgedScene& s, const CheckRules& rules) {
  visit_all(archive, s.verdict, s.failure, s.versions);
  s.settled.resize(archive.count(s.settled));
  for (check::Settled& settled : s.settled) {
    std::ptrdiff_t number = settled.expectation == nullptr ? 0 : settled.expectation - rules.expectations.data();
    visit_all(archive, number, settled.fate, settled.line);
    settled.expectation = &rules.expectations.at(static_cast<std::size_t>(number));
  }
  if (archive.has(s.drawing)) visit(archive, *s.drawing);
}

}  // namespace

std::string to_bytes(JudgeRequest request) {
  ByteWriter writer;
  visit_all(writer, request.scene, request.ended, request.not_compared);
  return writer.done();
}

JudgeRequest request_of(std::string_view bytes) {
  ByteReader reader(bytes, nullptr);
  JudgeRequest out;
  visit_all(reader, out.scene, out.ended, out.not_compared);
  return out;
}

std::string to_bytes(DiagnosisAnswer answer) {
  ByteWriter writer;
  visit_all(writer, answer.code, answer.text);
  return writer.done();
}

DiagnosisAnswer diagnosis_of(std::string_view bytes) {
  ByteReader reader(bytes, nullptr);
  DiagnosisAnswer out;
  visit_all(reader, out.code, out.text);
  return out;
}

std::string to_bytes(JudgedScene scene, const CheckRules& rules) {
  ByteWriter writer;
  visit_scene(writer, scene, rules);
  return writer.done();
}

JudgedScene judged_scene_of(std::string_view bytes, const CheckRules& rules, std::set<std::string>& words) {
  ByteReader reader(bytes, &words);
  JudgedScene out;
  visit_scene(reader, out, rules);
  return out;
}

}  // namespace plumbline::cli
