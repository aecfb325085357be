#include "mutation/mutators.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <vector>

#include <fmt/format.h>

namespace plumbline::mutation {

namespace {

using Words = std::vector<std::string_view>;

bool is_binary(const Token& token) { return token.space_before && token.space_after; }

void replace_operator(const Source& s, std::size_t i, const Emit& emit) {
  static const std::map<std::string_view, Words> kComparisons = {
      {"<", {"<=", ">"}}, {"<=", {"<", ">"}}, {">", {">=", "<"}}, {">=", {">", "<"}}, {"==", {"!="}}, {"!=", {"=="}},
  };
  static const std::map<std::string_view, Words> kOperators = {
      {"+", {"-"}},   {"-", {"+"}},   {"*", {"/"}},   {"/", {"*"}},   {"%", {"/"}},   {"&&", {"||"}}, {"||", {"&&"}},
      {"&", {"|"}},   {"|", {"&"}},   {"^", {"|"}},   {"<<", {">>"}}, {">>", {"<<"}}, {"+=", {"-="}}, {"-=", {"+="}},
      {"*=", {"/="}}, {"/=", {"*="}}, {"|=", {"&="}}, {"&=", {"|="}}, {"^=", {"|="}},
  };
  if (!is_binary(s.tokens[i])) return;
  for (const auto& [kind, table] : {std::pair("comparison", &kComparisons), std::pair("operator", &kOperators)}) {
    const auto found = table->find(s.word(i));
    if (found == table->end()) continue;
    for (const std::string_view other : found->second) emit(kind, i, i, std::string(other));
  }
}

// An integer plus 1, and less 1 if it is above 0. Twice a decimal fraction, and 0; for 0.0 it is 1 and -1. Numbers with
// digit separators or a binary exponent stay.
void replace_number(const Source& s, std::size_t i, const Emit& emit) {
  const std::string_view text = s.word(i);
  const bool hexadecimal = text.starts_with("0x");
  if (text.find('\'') != text.npos || (hexadecimal && text.find('.') != text.npos)) return;
  const std::size_t end = hexadecimal ? text.find_first_not_of("0123456789abcdefABCDEFx")
                                      : text.find_first_of(text.find('.') == text.npos ? "uUlLfFp" : "fF");
  const std::string_view digits = text.substr(0, end), suffix = end == text.npos ? "" : text.substr(end);
  if (suffix.starts_with('p')) return;  // a power of two of another exponent is no likely slip
  if (!hexadecimal && digits.find_first_of(".e") != digits.npos) {
    double value = 0;
    if (std::from_chars(digits.data(), digits.data() + digits.size(), value).ec != std::errc()) return;
    const auto written = [&](double v) {
      std::string out = fmt::format("{}", v);
      if (out.find_first_of(".e") == out.npos) out += ".0";
      return out + std::string(suffix);
    };
    emit("constant", i, i, written(value == 0 ? 1 : 2 * value));
    emit("constant", i, i, written(value == 0 ? -1 : 0));
    return;
  }
  std::uint64_t value = 0;
  const char* from = digits.data() + (hexadecimal ? 2 : 0);
  if (std::from_chars(from, digits.data() + digits.size(), value, hexadecimal ? 16 : 10).ec != std::errc()) return;
  emit("constant", i, i, fmt::format("{}{}", value + 1, suffix));
  if (value > 0) emit("constant", i, i, fmt::format("{}{}", value - 1, suffix));
}

// The other boolean, another component, the opposite function, or a nearby variable whose name ends in another digit
// (0 to 3).
void replace_word(const Source& s, std::size_t i, const Emit& emit) {
  static const std::map<std::string_view, std::string_view> kComponents = {
      {"x", "y"}, {"y", "x"}, {"z", "y"}, {"w", "z"}, {"r", "g"},
      {"g", "b"}, {"b", "r"}, {"a", "b"}, {"s", "t"}, {"t", "s"}};
  static const std::map<std::string_view, std::string_view> kFunctions = {{"min", "max"},
                                                                          {"max", "min"},
                                                                          {"floor", "ceil"},
                                                                          {"ceil", "floor"},
                                                                          {"greater_of", "lesser_of"},
                                                                          {"lesser_of", "greater_of"},
                                                                          {"any", "all"},
                                                                          {"all", "any"},
                                                                          {"sin", "cos"},
                                                                          {"cos", "sin"},
                                                                          {"any_of", "all_of"},
                                                                          {"all_of", "any_of"}};
  const std::string_view word = s.word(i), next = s.word(i + 1), before = i == 0 ? "" : s.word(i - 1);
  if (word == "true" || word == "false") return emit("constant", i, i, word == "true" ? "false" : "true");
  if (const auto c = kComponents.find(word);
      c != kComponents.end() && (before == "." || before == "->") && next != "(") {
    return emit("index", i, i, std::string(c->second));
  }
  if (const auto f = kFunctions.find(word); f != kFunctions.end() && (next == "(" || next == "<")) {
    return emit("function", i, i, std::string(f->second));
  }
  if (word.size() < 2 || word.back() < '0' || word.back() > '3' || next == "(" || next == "<" || next == "::") return;
  for (char digit = '0'; digit <= '3'; ++digit) {
    const std::string other = std::string(word.substr(0, word.size() - 1)) + digit;
    const std::size_t first = i < 200 ? 0 : i - 200;  // where the other one is known, it stands near
    const auto near = s.tokens.subspan(first, i - first);
    if (other != word && std::ranges::count(near, other, &Token::text) > 0) return emit("index", i, i, other);
  }
}

void negate_condition(const Source& s, std::size_t i, const Emit& emit) {
  if ((s.word(i) != "if" && s.word(i) != "while") || s.word(i + 1) != "(") return;
  const std::size_t open = i + 1, close = s.tokens[open].partner;
  for (std::size_t k = open; k < close; ++k) {
    if (s.word(k) == ";" || s.word(k) == "=") return;  // it declares
  }
  if (close > open + 1) {
    emit("negated condition", open + 1, close - 1, fmt::format("!({})", s.between(open + 1, close - 1)));
  }
}

// The last token of the expression in a list that begins at `i`: before a comma or the list's end.
std::size_t end_of_item(const Source& s, std::size_t i, std::size_t close) {
  while (i < close && s.word(i) != ",") i = std::max(s.tokens[i].partner, i) + 1;
  return i - 1;
}

// True: both have tokens of the same kinds. Arguments of other shapes are seldom of one type.
bool alike(const Source& s, std::size_t a, std::size_t a_last, std::size_t b, std::size_t b_last) {
  if (a_last - a != b_last - b) return false;
  for (; a <= a_last; ++a, ++b) {
    const bool symbols = s.tokens[a].kind == TokenKind::symbol;
    if (s.tokens[a].kind != s.tokens[b].kind || (symbols && s.word(a) != s.word(b))) return false;
  }
  return true;
}

void swap_arguments(const Source& s, std::size_t i, const Emit& emit) {
  static const std::set<std::string_view> kSymmetric = {"min",   "max",  "greater_of", "lesser_of", "dot", "any",
                                                        "fused", "Add",  "Mul",        "And",       "Or",  "for",
                                                        "if",    "pair", "switch",     "while"};
  const bool call = s.word(i) == "(", list = s.word(i) == "{";
  if ((!call && !list) || i == 0) return;
  const Token& before = s.tokens[i - 1];
  if (call && before.kind != TokenKind::word && before.text != ">" && before.text != "]") return;
  if (list && (before.text == ")" || before.text == "else" || before.text == "do")) return;  // a block
  if (before.text == "]" && s.word(before.partner == 0 ? 0 : s.tokens[i - 1].partner - 1) != "]" &&
      s.tokens[s.tokens[i - 1].partner].space_before)
    return;  // a lambda's parameters
  if (kSymmetric.contains(before.text)) return;
  const std::size_t close = s.tokens[i].partner;
  for (std::size_t k = i; k < close; ++k) {
    if (s.word(k) == ";") return;
  }
  for (std::size_t first = i + 1; first < close;) {
    const std::size_t last = end_of_item(s, first, close), other = last + 2;
    if (other >= close) return;
    const std::size_t other_last = end_of_item(s, other, close);
    const std::string_view a = s.between(first, last), b = s.between(other, other_last);
    if (a != b && alike(s, first, last, other, other_last))
      emit("swapped arguments", first, other_last, fmt::format("{}, {}", b, a));
    first = other;
  }
}

bool is_operand(const Token& t) { return t.kind == TokenKind::word || t.kind == TokenKind::number; }

// The tokens of a name, a call, an index, a member: from its last one back, from its first one on.
std::size_t operand_before(const Source& s, std::size_t last) {
  std::size_t i = last;
  while (true) {
    if (s.word(i) == ")" || s.word(i) == "]") {
      i = s.tokens[i].partner;
      if (i > 0 && (s.tokens[i - 1].kind == TokenKind::word || s.word(i - 1) == "]") && !s.tokens[i].space_before) {
        --i;
        continue;
      }
      return i;
    }
    if (i < 2 || (s.word(i - 1) != "." && s.word(i - 1) != "->" && s.word(i - 1) != "::")) return i;
    i -= 2;
  }
}
std::size_t operand_after(const Source& s, std::size_t first) {
  std::size_t i = s.word(first) == "(" ? s.tokens[first].partner : first;
  while (true) {
    const std::string_view next = s.word(i + 1);
    if ((next == "(" || next == "[") && !s.tokens[i + 1].space_before) {
      i = s.tokens[i + 1].partner;
    } else if (next == "." || next == "->" || next == "::") {
      i += 2;
    } else {
      return i;
    }
  }
}

void swap_operands(const Source& s, std::size_t i, const Emit& emit) {
  static const std::set<std::string_view> kTight = {"*", "/", "%", ".", "->", "::", "!", "-", "&"};
  const std::string_view word = s.word(i);
  if ((word != "-" && word != "/") || !is_binary(s.tokens[i]) || i == 0 || i + 1 >= s.tokens.size()) return;
  const Token &left = s.tokens[i - 1], &right = s.tokens[i + 1];
  if (!(is_operand(left) || left.text == ")" || left.text == "]") || !(is_operand(right) || right.text == "(")) return;
  const std::size_t first = operand_before(s, i - 1), last = operand_after(s, i + 1);
  if (first == 0 || s.word(first) == "[" || kTight.contains(s.word(first - 1)) || kTight.contains(s.word(last + 1)))
    return;
  const std::string_view a = s.between(first, i - 1), b = s.between(i + 1, last);
  if (a != b) emit("swapped operands", first, last, fmt::format("{} {} {}", b, word, a));
}

void drop_sign(const Source& s, std::size_t i, const Emit& emit) {
  const std::string_view word = s.word(i);
  if ((word != "-" && word != "!") || s.tokens[i].space_after || i + 1 >= s.tokens.size()) return;
  emit("dropped sign", i, i + 1, std::string(s.word(i + 1)));
}

// a ? b : c becomes a ? c : b.
void swap_branches(const Source& s, std::size_t i, const Emit& emit) {
  if (s.word(i) != "?") return;
  std::size_t colon = 0, k = i + 1;
  for (int depth = 0; k < s.tokens.size(); k = std::max(k, s.tokens[k].partner) + 1) {
    const std::string_view t = s.word(k);
    if (t == "?") ++depth;
    if (t == ":" && depth-- == 0) colon = colon == 0 ? k : colon;
    if (t == "," || t == ";" || t == ")" || t == "]" || t == "}") break;
  }
  if (colon <= i + 1 || k <= colon + 1) return;
  const std::string_view a = s.between(i + 1, colon - 1), b = s.between(colon + 1, k - 1);
  if (a != b && b.find('?') == b.npos) emit("swapped branches", i + 1, k - 1, fmt::format("{} : {}", b, a));
}

}  // namespace

void mutate_token(const Source& source, std::size_t i, const Emit& emit) {
  const Token& token = source.tokens[i];
  if (token.kind == TokenKind::number) return replace_number(source, i, emit);
  if (token.kind == TokenKind::word) {
    replace_word(source, i, emit);
    return negate_condition(source, i, emit);
  }
  if (token.kind == TokenKind::text) return;
  replace_operator(source, i, emit);
  swap_arguments(source, i, emit);
  swap_operands(source, i, emit);
  drop_sign(source, i, emit);
  swap_branches(source, i, emit);
}

void drop_statement(const Source& s, std::size_t first, std::size_t last, const Emit& emit) {
  static const std::set<std::string_view> kKeywords = {"return", "break",    "case",   "default", "const",  "constexpr",
                                                       "auto",   "using",    "struct", "goto",    "do",     "static",
                                                       "switch", "continue", "public", "private", "delete", "alignas"};
  while (s.word(first) == "if" || s.word(first) == "for" || s.word(first) == "while" || s.word(first) == "else") {
    const bool bare = s.word(first) == "else";
    first = bare ? first + 1 : s.tokens[first + 1].partner + 1;
    if (first > last) return;
  }
  const std::string_view word = s.word(first);
  if (kKeywords.contains(word) ||
      (s.tokens[first].kind != TokenKind::word && word != "++" && word != "--" && word != "*"))
    return;
  std::size_t i = first;
  if (s.tokens[first].kind == TokenKind::word) {
    i = operand_after(s, first);
    const std::string_view next = s.word(i + 1);
    const bool writes = next.ends_with("=") && next != "==" && next != "<=" && next != ">=" && next != "!=";
    const bool calls = i >= last && s.word(last) == ")";
    if (!writes && !calls && next != "++" && next != "--") return;  // it declares
  }
  emit("dropped statement", first, last, "");
}

}  // namespace plumbline::mutation
