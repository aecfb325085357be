// Choices by seed: the same on every machine, for the distributions are integer arithmetic of our own (those of
// <random> differ between libraries) on the numbers of std::mt19937_64, which the C++ standard fixes.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <random>
#include <string_view>

namespace plumbline::ordinary {

class Choices {
 public:
  explicit Choices(std::uint64_t seed) : bits_(seed) {}

  /// In [low, high]; each equally likely, to 2^-32 of the range.
  std::int64_t whole(std::int64_t low, std::int64_t high);
  int count(int low, int high) { return static_cast<int>(whole(low, high)); }
  /// True in `percent` of 100 cases.
  bool chance(int percent) { return whole(0, 99) < percent; }
  /// A number in [low, high] as people write them: a multiple of 1, 1/2, 1/10 or 1/100, seldom of 1e-6.
  double number(double low, double high);
  /// One of the words; a word written twice is twice as likely.
  std::string_view word(std::initializer_list<std::string_view> words);
  /// One of the numbers.
  double of(std::initializer_list<double> numbers);

 private:
  std::mt19937_64 bits_;
};

}  // namespace plumbline::ordinary
