// Two images, or two captures, as they are stored: no scene, no rules, no ledger; number against number.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "capture/capture.h"
#include "capture/files/image_file.h"
#include "check/verdict/verdict.h"

namespace plumbline::check {

/// A channel of two images, or an array of two captures. Numbers are compared as numbers: -0 is 0, an infinity equals
/// itself alone, NaN equals nothing: not even NaN, for two pictures that are broken in one place are not proven equal.
struct StoredComparison {
  std::string what;  ///< the channel's name, the array's (capture_columns.h), or what else is apart
  Outcome outcome = Outcome::equal;
  Measurement measurement;
  double codes = 0;  ///< both are codes, of that many steps (2^n - 1); 0: floats, or unlike
  std::string note;
};

/// One row per channel, paired by name (one-channel images: whatever the names), after one of whole pixels; and one for
/// each thing that is apart otherwise: windows (then nothing else), channels that one image lacks. `tolerance`: in
/// values, finite and not negative, of the channels' [0,1] for codes.
std::vector<StoredComparison> compare_images(const StoredImage& a, const StoredImage& b, double tolerance);

/// One row per array that either holds, in the order of the stages, records in the order in which they are stored;
/// `tolerance` is for floats (a capture's colours are: one code apart may be a rounding above 1/255), integers are
/// exact. What one alone holds is `missing`.
std::vector<StoredComparison> compare_captures(const Capture& a, const Capture& b, double tolerance);

/// |a - b| times `amplify` (none: such that the largest is white), red, green and blue by the first three channels; any
/// other, such as alpha, is seen in all three. White where a difference is not finite. Empty where windows differ or no
/// channels pair.
Plane<glm::vec4> amplified_difference(const StoredImage& a, const StoredImage& b, std::optional<double> amplify);

}  // namespace plumbline::check
