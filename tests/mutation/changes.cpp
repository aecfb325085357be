#include "mutation/changes.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

#include <fmt/format.h>

#include "mutation/mutators.h"

namespace plumbline::mutation {

namespace {

// True for statements without effect on a picture: throws, reservations of memory, compile-time evaluation.
bool is_left_alone(const Source& s, std::size_t first, std::size_t last) {
  static const std::set<std::string_view> kWords = {"throw",
                                                    "static_assert",
                                                    "template",
                                                    "reserve",
                                                    "using",
                                                    "concept",
                                                    "fmt",
                                                    "requires",
                                                    "typename",
                                                    "alignas",
                                                    "asm",
                                                    "decltype",
                                                    "sizeof",
                                                    "try",
                                                    "catch",
                                                    "operator",
                                                    "abort",
                                                    "fail",
                                                    "PLUMBLINE_VERSION",
                                                    "global_control"};
  for (std::size_t i = first; i <= last; ++i) {
    if (kWords.contains(s.word(i))) return true;
    if (s.word(i) == "if" && s.word(i + 1) == "constexpr") return true;
  }
  return false;
}

// True for statements that can be changed: outside functions, constexpr definitions; inside, a return, a condition, an
// assignment, a comparison or a call.
bool may_change(const Source& s, std::size_t first, std::size_t last) {
  const auto begin = s.tokens.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = s.tokens.begin() + static_cast<std::ptrdiff_t>(last) + 1;
  const auto holds = [&](std::string_view word) {
    return std::any_of(begin, end, [&](const Token& t) { return t.text == word; });
  };
  if (!s.tokens[first].in_function) return holds("constexpr") && holds("=");
  if (s.word(first) == "return" || s.word(first) == "if" || s.word(first) == "else") return true;
  return std::any_of(begin, end, [](const Token& t) { return t.text.ends_with('=') || t.text == "("; });
}

// Index of the statement's last token before its end.
std::size_t last_of_statement(const Source& s, std::size_t first) {
  std::size_t i = first;
  while (i + 1 < s.tokens.size() && s.tokens[i + 1].statement == first && s.word(i + 1) != ";" &&
         s.word(i + 1) != "{" && s.word(i + 1) != "}")
    ++i;
  return i;
}

std::string trimmed(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool space = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (space && (out.empty() || out.back() == ' ')) continue;
    out += space ? ' ' : c;
  }
  if (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

}  // namespace

std::vector<Change> changes_of(const std::string& file, std::string_view source) {
  const std::vector<Token> tokens = tokens_of(source);
  const Source s{source, tokens};
  std::vector<Change> out;
  const Emit emit = [&](std::string_view kind, std::size_t first, std::size_t last, std::string replacement) {
    const std::string_view before = s.between(first, last);
    if (trimmed(before) == trimmed(replacement)) return;
    const Token& token = tokens[first];
    out.push_back({file, std::string(token.function), token.line, token.at, before.size(), std::move(replacement),
                   std::string(kind)});
  };
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const std::size_t first = tokens[i].statement, last = last_of_statement(s, first);
    if (first >= tokens.size() || is_left_alone(s, first, last) || !may_change(s, first, last)) continue;
    if (i == first && tokens[i].in_function && s.word(last + 1) == ";" && !tokens[i].in_for) {
      drop_statement(s, first, last, emit);
    }
    const bool steps = tokens[i].text == "++" || tokens[i].text == "--";
    if (!steps) mutate_token(s, i, emit);
  }
  return out;
}

std::string changed(std::string_view source, const Change& change) {
  return fmt::format("{}{}{}", source.substr(0, change.at), change.replacement,
                     source.substr(change.at + change.length));
}

ChangedLines lines_of(std::string_view source, const Change& change) {
  const std::size_t from = change.at == 0 ? 0 : source.rfind('\n', change.at - 1) + 1;
  const std::size_t to = std::min(source.find('\n', change.at + change.length), source.size());
  std::string after = fmt::format("{}{}{}", source.substr(from, change.at - from), change.replacement,
                                  source.substr(change.at + change.length, to - change.at - change.length));
  return {trimmed(source.substr(from, to - from)), trimmed(after)};
}

}  // namespace plumbline::mutation
