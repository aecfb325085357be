// The mutators: what may stand in a token's place, or in the place of what begins there.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "mutation/tokens.h"

namespace plumbline::mutation {

/// A source and its tokens.
struct Source {
  std::string_view text;
  std::span<const Token> tokens;

  std::string_view word(std::size_t i) const { return i < tokens.size() ? tokens[i].text : std::string_view(); }
  /// The text from token `first` to token `last`, both within.
  std::string_view between(std::size_t first, std::size_t last) const {
    const std::size_t from = tokens[first].at;
    return text.substr(from, tokens[last].at + tokens[last].text.size() - from);
  }
};

/// Tokens `first` to `last` become `replacement`.
using Emit = std::function<void(std::string_view kind, std::size_t first, std::size_t last, std::string replacement)>;

/// The changes that begin at token i, or have it as their operator.
void mutate_token(const Source& source, std::size_t i, const Emit& emit);

/// The statement without which the function goes on: `last` is the token before its semicolon.
void drop_statement(const Source& source, std::size_t first, std::size_t last, const Emit& emit);

}  // namespace plumbline::mutation
