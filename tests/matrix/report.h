// The fault matrix' report: text and JSON.
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

/// Shares [0, 1]: of the faults that are seen on one scene at least (`caught`), and of the right answers on faults,
/// pairs and legal variants.
struct Shares {
  double caught, faults, pairs, legal;
};
inline constexpr Shares kRequired = {1, 0.97, 0.85, 1};
/// The shares of a matrix; a share of nothing is 1.
Shares shares(const Matrix& matrix);
/// True: no share is below kRequired's.
bool holds(const Shares& shares);

std::string text_of(const Matrix& matrix);
/// Throws OutputError (atomic_path.h).
void write_json(const Matrix& matrix, const std::filesystem::path& file);

}  // namespace plumbline::matrix
