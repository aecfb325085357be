#include "mutation/tokens.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace plumbline::mutation {

namespace {

bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

class Scanner {
 public:
  explicit Scanner(std::string_view source) : source_(source) {}

  std::vector<Token> scan() {
    while (skip_space()) {
      const std::size_t from = at_;
      const TokenKind kind = take();
      at_ = std::min(at_, source_.size());  // a text without an end ends with the file
      Token token{kind, source_.substr(from, at_ - from), from, line_};
      token.space_before = from == 0 || std::isspace(static_cast<unsigned char>(source_[from - 1])) != 0;
      token.space_after = at_ == source_.size() || std::isspace(static_cast<unsigned char>(source_[at_])) != 0;
      tokens_.push_back(token);
      for (const char c : token.text) line_ += c == '\n';
    }
    return std::move(tokens_);
  }

 private:
  bool starts(std::string_view text) const { return source_.substr(at_).starts_with(text); }
  void skip_to(std::string_view end) {
    const std::size_t found = source_.find(end, at_);
    const std::size_t to = found == source_.npos ? source_.size() : found;
    for (; at_ < to; ++at_) line_ += source_[at_] == '\n';
  }
  void skip_preprocessor_line() {
    do {
      skip_to("\n");
      if (at_ == source_.size() || source_[at_ - 1] != '\\') return;
      ++at_, ++line_;
    } while (true);
  }

  // True: a token follows.
  bool skip_space() {
    while (at_ < source_.size()) {
      const char c = source_[at_];
      if (c == '\n') ++line_, new_line_ = true;
      if (std::isspace(static_cast<unsigned char>(c)) != 0) {
        ++at_;
      } else if (starts("//")) {
        skip_to("\n");
      } else if (starts("/*")) {
        skip_to("*/");
        at_ += 2;
      } else if (c == '#' && new_line_) {
        skip_preprocessor_line();
      } else {
        new_line_ = false;
        return true;
      }
    }
    return false;
  }

  TokenKind take() {
    const char c = source_[at_];
    if (starts("R\"")) {
      const std::size_t open = source_.find('(', at_);
      const std::string end = ")" + std::string(source_.substr(at_ + 2, open - at_ - 2)) + "\"";
      at_ = source_.find(end, open) + end.size();
      return TokenKind::text;
    }
    if (c == '"' || c == '\'') {
      for (++at_; at_ < source_.size() && source_[at_] != c; ++at_) at_ += source_[at_] == '\\';
      ++at_;
      return TokenKind::text;
    }
    if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
      const auto is_sign = [&] {
        const char before = source_[at_ - 1];
        return (source_[at_] == '+' || source_[at_] == '-') && (before == 'e' || before == 'p');
      };
      for (++at_;
           at_ < source_.size() && (in_word(source_[at_]) || source_[at_] == '.' || source_[at_] == '\'' || is_sign());)
        ++at_;
      return TokenKind::number;
    }
    if (in_word(c)) {
      while (at_ < source_.size() && in_word(source_[at_])) ++at_;
      return TokenKind::word;
    }
    static constexpr std::array<std::string_view, 25> kLong = {
        "<=>", "<<=", ">>=", "...", "->*", "::", "->", "++", "--", "<<", "<=", ">=", "==",
        "!=",  "&&",  "||",  "+=",  "-=",  "*=", "/=", "%=", "&=", "|=", "^=", ".*"};
    for (const std::string_view symbol : kLong) {
      if (!starts(symbol)) continue;
      at_ += symbol.size();
      return TokenKind::symbol;
    }
    ++at_;
    return TokenKind::symbol;
  }

  std::string_view source_;
  std::size_t at_ = 0, line_ = 1;
  bool new_line_ = true;
  std::vector<Token> tokens_;
};

bool is_open(std::string_view t) { return t == "(" || t == "[" || t == "{"; }
bool is_close(std::string_view t) { return t == ")" || t == "]" || t == "}"; }

// The name of the function whose body the brace at `brace` opens: none of namespaces, types and values.
std::string_view opened_function(const std::vector<Token>& tokens, std::size_t brace) {
  std::string_view name;
  for (std::size_t i = tokens[brace].statement; i < brace; ++i) {
    const std::string_view t = tokens[i].text;
    if (t == "namespace" || t == "enum") return "";
    if ((t == "struct" || t == "class" || t == "union") && name.empty() &&
        (i == 0 || (tokens[i - 1].text != "<" && tokens[i - 1].text != ",")))
      return "";
    if (t == "(" && name.empty() && i > 0) name = tokens[i - 1].text;
  }
  return name;
}

void find_surroundings(std::vector<Token>& tokens) {
  std::vector<std::size_t> open;
  std::size_t statement = 0, for_end = 0;
  std::vector<std::string_view> functions = {""};
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    Token& token = tokens[i];
    token.partner = i;
    token.statement = statement;
    token.function = functions.back();
    token.in_function = !token.function.empty();
    if (is_open(token.text)) open.push_back(i);
    if (is_close(token.text) && !open.empty()) {
      token.partner = open.back();
      tokens[open.back()].partner = i;
      open.pop_back();
    }
    if (token.text == "{") functions.push_back(token.in_function ? token.function : opened_function(tokens, i));
    if (token.text == "}" && functions.size() > 1) functions.pop_back();
    if (token.text == ";" || token.text == "{" || token.text == "}") statement = i + 1;
  }
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].text == "for" && i + 1 < tokens.size()) for_end = std::max(for_end, tokens[i + 1].partner);
    tokens[i].in_for = i < for_end;
  }
}

}  // namespace

std::vector<Token> tokens_of(std::string_view source) {
  std::vector<Token> tokens = Scanner(source).scan();
  find_surroundings(tokens);
  return tokens;
}

}  // namespace plumbline::mutation
