// Which pixels are covered, as a picture in text: expected ones are typed into a test, and a failure shows both in one.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace plumbline::testing_words {

/// Rows from the top of the frame down, `#` covered, anything else not.
using Picture = std::vector<std::string>;

/// `covers(x, y)` over width x height pixels; y counts up from the bottom row.
template <class Covers>
Picture picture_of(int width, int height, Covers covers) {
  Picture picture;
  for (int y = height - 1; y >= 0; --y) {
    std::string row;
    for (int x = 0; x < width; ++x) row += covers(x, y) ? '#' : '.';
    picture.push_back(row);
  }
  return picture;
}

/// A failure's picture has `#` where both cover, `?` where `is` misses one, `!` where it has one too many.
inline ::testing::AssertionResult same_picture(const Picture& is, const Picture& expected) {
  if (is.size() != expected.size()) {
    return ::testing::AssertionFailure() << is.size() << " rows, expected " << expected.size();
  }
  int missing = 0, extra = 0;
  std::string both;
  for (std::size_t row = 0; row < is.size(); ++row) {
    if (is[row].size() != expected[row].size()) {
      return ::testing::AssertionFailure()
             << "row " << row << " is " << is[row].size() << " wide, expected " << expected[row].size();
    }
    for (std::size_t x = 0; x < is[row].size(); ++x) {
      const bool has = is[row][x] == '#', should = expected[row][x] == '#';
      missing += should && !has;
      extra += has && !should;
      both += has && should ? '#' : should ? '?' : has ? '!' : '.';
    }
    both += '\n';
  }
  if (missing + extra == 0) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << missing << " missing (?), " << extra << " extra (!)\n" << both;
}

}  // namespace plumbline::testing_words
