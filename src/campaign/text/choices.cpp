#include "campaign/text/choices.h"

#include <cmath>

namespace plumbline::campaign {

Choices::Choices(std::span<const std::uint64_t> seeds) {
  for (const std::uint64_t seed : seeds) streams_.emplace_back(seed);
}

std::uint64_t Choices::bits() {
  std::uint64_t out = streams_.front()();
  for (std::size_t i = 1; i < streams_.size(); ++i) {
    const std::uint64_t its_own = streams_[i]();
    if (its_own % 24 == 0) out = its_own;  // by its lower bits: whole() uses the upper 32
  }
  return out;
}

std::int64_t Choices::whole(std::int64_t low, std::int64_t high) {
  const std::uint64_t range = static_cast<std::uint64_t>(high - low) + 1;  // at most 2^32
  return low + static_cast<std::int64_t>(((bits() >> 32) * range) >> 32);
}

double Choices::number(double low, double high) {
  double parts = of({1, 2, 2, 10, 10, 10, 10, 100, 100, 1000000});
  while (std::ceil(low * parts) > std::floor(high * parts)) parts *= 10;  // none that coarse in the range
  const double k = static_cast<double>(
      whole(static_cast<std::int64_t>(std::ceil(low * parts)), static_cast<std::int64_t>(std::floor(high * parts))));
  return k / parts;
}

std::string_view Choices::word(std::initializer_list<std::string_view> words) {
  return words.begin()[whole(0, static_cast<std::int64_t>(words.size()) - 1)];
}

double Choices::of(std::initializer_list<double> numbers) {
  return numbers.begin()[whole(0, static_cast<std::int64_t>(numbers.size()) - 1)];
}

}  // namespace plumbline::campaign
