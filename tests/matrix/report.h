// What the fault matrix says: as text, and as JSON.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "matrix/matrix.h"

namespace plumbline::matrix {

/// A subject and what came of it.
struct Row {
  Subject subject;
  std::size_t affected = 0;  ///< scenes; of a pair: those that each affects alone
  std::vector<Answer> answers;

  std::size_t seen() const;   ///< scenes on which something is seen
  std::size_t right() const;  ///< on which is_right()
};

struct Matrix {
  std::vector<std::string> scenes;  ///< names, by number
  std::vector<Row> faults, pairs, legal;
  double seconds = 0;
};

/// What must hold: shares of the answers, but for `caught`, the share of the faults that are seen on a scene at least.
struct Shares {
  double caught, faults, pairs, legal;
};
inline constexpr Shares kRequired = {1, 0.97, 0.85, 1};
/// 1 of nothing.
Shares shares(const Matrix& matrix);
bool holds(const Shares& shares);

std::string text_of(const Matrix& matrix);
/// Throws OutputError (atomic_path.h).
void write_json(const Matrix& matrix, const std::filesystem::path& file);

}  // namespace plumbline::matrix
