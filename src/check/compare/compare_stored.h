// Comparison of two stored images, or captures, number against number: without scene, rules or ledger.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "capture/capture.h"
#include "capture/files/image_file.h"
#include "check/verdict/verdict.h"

namespace plumbline::check {

/// Comparison of one channel of two images, or of one array of two captures. Numbers are compared by value: -0 equals
/// 0, an infinity equals only itself, NaN equals nothing, because two pictures with NaN in one place are not proven
/// equal.
struct StoredComparison {
  std::string what;  ///< channel, array (capture_columns.h), or property that differs
  Outcome outcome = Outcome::equal;
  Measurement measurement;
  double codes = 0;  ///< largest code (2^n - 1) if both sides hold n-bit codes; 0: floats, or different formats
  std::string note;
};

/// Rows of two images. If sizes or windows differ: that row alone. Else: a row `channels` if an image lacks a channel
/// of the other, a row `pixels` if there are several pairs of channels, and a row for each pair. Channels pair by name;
/// two images of one channel each pair whatever the names. `tolerance`: finite, at least 0 [value; codes count as
/// values in [0,1]].
std::vector<StoredComparison> compare_images(const StoredImage& a, const StoredImage& b, double tolerance);

/// Rows of two captures: `frame` where the sizes differ, then one for each array that either holds, in the order of
/// visit_capture() (capture_columns.h). Records are compared in stored order, floats with `tolerance` (colours are
/// floats: one code may be slightly more than 1/255), integers exactly. An array that one side lacks is `missing`.
std::vector<StoredComparison> compare_captures(const Capture& a, const Capture& b, double tolerance);

/// |a - b| times `amplify` (none: such that the largest finite one is 1), at most 1. Of three pairs of channels or
/// more, the first three are red, green and blue, and every other one, such as alpha, is seen in all three; of one or
/// two pairs, each is seen in all three. A difference that is not finite is 1 in its channel. Empty where windows
/// differ or no channels pair.
Plane<glm::vec4> amplified_difference(const StoredImage& a, const StoredImage& b, std::optional<double> amplify);

}  // namespace plumbline::check
