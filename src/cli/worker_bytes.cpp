#include "cli/worker_bytes.h"

#include <concepts>
#include <cstring>
#include <type_traits>
#include <utility>

namespace plumbline::cli {

namespace {

template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;

class Writer {
 public:
  template <Plain T>
  void operator()(T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void operator()(std::string& text) {
    std::size_t size = text.size();
    (*this)(size);
    bytes_ += text;
  }
  void word(const char*& text) {
    std::string copy = text;
    (*this)(copy);
  }
  template <class T>
  std::size_t count(T& items) {
    std::size_t size = items.size();
    (*this)(size);
    return size;
  }
  template <class T>
  bool has(std::optional<T>& value) {
    bool there = value.has_value();
    (*this)(there);
    return there;
  }
  std::string done() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Reader {
 public:
  Reader(std::string_view bytes, std::set<std::string>* words) : bytes_(bytes), words_(words) {}
  template <Plain T>
  void operator()(T& value) {
    std::memcpy(&value, take(sizeof value), sizeof value);
  }
  void operator()(std::string& text) {
    std::size_t size = 0;
    (*this)(size);
    text.assign(take(size), size);
  }
  void word(const char*& text) {
    std::string read;
    (*this)(read);
    text = words_->insert(std::move(read)).first->c_str();
  }
  template <class T>
  std::size_t count(T&) {
    std::size_t size = 0;
    (*this)(size);
    return size;
  }
  template <class T>
  bool has(std::optional<T>& value) {
    bool there = false;
    (*this)(there);
    if (there) value.emplace();
    return there;
  }

 private:
  const char* take(std::size_t size) {
    if (size > bytes_.size()) throw std::runtime_error("a worker's answer is cut off");
    const char* out = bytes_.data();
    bytes_.remove_prefix(size);
    return out;
  }

  std::string_view bytes_;
  std::set<std::string>* words_;
};

template <class Archive, class... Fields>
void all(Archive& archive, Fields&... fields) {
  (visit(archive, fields), ...);
}
template <class T>
concept PlainOrText = Plain<T> || std::same_as<T, std::string>;
template <class Archive, PlainOrText T>
void visit(Archive& archive, T& value) {
  archive(value);
}
template <class Archive, class T>
void visit(Archive& archive, std::vector<T>& items) {
  items.resize(archive.count(items));
  for (T& item : items) visit(archive, item);
}
template <class Archive, class K, class V>
void visit(Archive& archive, std::map<K, V>& items) {
  std::vector<std::pair<K, V>> list(items.begin(), items.end());
  list.resize(archive.count(list));
  for (auto& [key, value] : list) all(archive, key, value);
  items = std::map<K, V>(list.begin(), list.end());
}
template <class Archive>
void visit(Archive& archive, check::Worst& w) {
  all(archive, w.place.x, w.place.y, w.place.record, w.place.of_primitive);
  archive.word(w.place.field);
  all(archive, w.candidate, w.reference, w.difference, w.tolerance);
}
template <class Archive>
void visit(Archive& archive, check::Measurement& m) {
  all(archive, m.unit, m.items, m.differing, m.ambiguous, m.disputed, m.max_difference, m.max_ratio, m.worst, m.dispute,
      m.reason, m.mismatch);
  for (std::uint64_t& n : m.histogram) archive(n);
}
template <class Archive>
void visit(Archive& archive, check::Comparison& c) {
  all(archive, c.scene, c.judge.reference, c.judge.kind, c.stage, c.outcome, c.measurement, c.ledger_row, c.note);
}
template <class Archive>
void visit(Archive& archive, report::HtmlReport::Drawing& d) {
  all(archive, d.scene, d.description, d.thumbnail, d.outcome, d.first, d.fails, d.all, d.color_alone);
}

template <class Archive>
void visit_scene(Archive& archive, JudgedScene& s, const CheckRules& rules) {
  check::SceneVerdict& v = s.verdict;
  all(archive, v.scene, v.path, v.comparisons, v.seconds, v.failure, v.repeat, v.cause, s.failure, s.versions);
  s.settled.resize(archive.count(s.settled));
  for (check::Settled& settled : s.settled) {
    std::ptrdiff_t number = settled.expectation == nullptr ? 0 : settled.expectation - rules.expectations.data();
    all(archive, number, settled.fate, settled.line);
    settled.expectation = &rules.expectations.at(static_cast<std::size_t>(number));
  }
  if (archive.has(s.drawing)) visit(archive, *s.drawing);
}

}  // namespace

std::string to_bytes(JudgeRequest request) {
  Writer writer;
  all(writer, request.scene, request.ended, request.not_compared);
  return writer.done();
}

JudgeRequest request_of(std::string_view bytes) {
  Reader reader(bytes, nullptr);
  JudgeRequest out;
  all(reader, out.scene, out.ended, out.not_compared);
  return out;
}

std::string to_bytes(JudgedScene scene, const CheckRules& rules) {
  Writer writer;
  visit_scene(writer, scene, rules);
  return writer.done();
}

JudgedScene judged_scene_of(std::string_view bytes, const CheckRules& rules, std::set<std::string>& words) {
  Reader reader(bytes, &words);
  JudgedScene out;
  visit_scene(reader, out, rules);
  return out;
}

}  // namespace plumbline::cli
