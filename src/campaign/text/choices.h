// Choices by seed: the same on every machine, for the distributions are integer arithmetic of our own (those of
// <random> differ between libraries) on the numbers of std::mt19937_64, which the C++ standard fixes.
//
// A mutant of a scene has other choices, not another text: each mutant is a valid scene.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <random>
#include <span>
#include <string_view>
#include <vector>

namespace plumbline::campaign {

class Choices {
 public:
  /// Choices by the numbers of the first seed; each further seed replaces one in 24 of the numbers by one of its own.
  explicit Choices(std::span<const std::uint64_t> seeds);

  /// Whole number in [low, high], a range of at most 2^32 numbers, each equally likely, to 2^-32.
  std::int64_t whole(std::int64_t low, std::int64_t high);
  int count(int low, int high) { return static_cast<int>(whole(low, high)); }
  /// True in `percent` of 100 cases.
  bool chance(int percent) { return whole(0, 99) < percent; }
  /// A number in [low, high] as people write them: a multiple of 1, 1/2, 1/10 or 1/100, seldom of 1e-6; of a
  /// finer step in narrow ranges.
  double number(double low, double high);
  /// One of the words; a word written twice is twice as likely.
  std::string_view word(std::initializer_list<std::string_view> words);
  /// One of the numbers.
  double of(std::initializer_list<double> numbers);

 private:
  std::uint64_t bits();

  std::vector<std::mt19937_64> streams_;  ///< of each seed
};

}  // namespace plumbline::campaign
