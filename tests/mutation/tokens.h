// C++ source as tokens, with what surrounds each.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace plumbline::mutation {

enum class TokenKind { word, number, text, symbol };

struct Token {
  TokenKind kind = TokenKind::symbol;
  std::string_view text;
  std::size_t at = 0;  ///< byte offset
  std::size_t line = 1;
  bool space_before = false, space_after = false;
  bool in_function = false;     ///< within a function's braces
  std::string_view function{};  ///< the name of that function; of a function in it, the outer one's
  bool in_for = false;          ///< within the parentheses of a for statement
  std::size_t partner = 0;      ///< of ( [ { ) ] }: index of the other one; its own index where there is none
  std::size_t statement = 0;    ///< index of the first token of its statement, which ; { } bound
};

/// Comments and preprocessor lines are left out.
std::vector<Token> tokens_of(std::string_view source);

}  // namespace plumbline::mutation
