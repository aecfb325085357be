// The gathering of measurements: what every comparator rests on.
#include <climits>

#include "tests/check/fixtures.h"

namespace plumbline::check {
namespace {

TEST(Difference, OfNumbers) {
  EXPECT_EQ(difference(1, 1), 0);
  EXPECT_EQ(difference(3, 1), 2);
  EXPECT_EQ(difference(1, 3), 2);
  EXPECT_EQ(difference(-0.0, 0.0), 0) << "negative zero is zero";
  EXPECT_EQ(difference(1, above(1)), std::numeric_limits<double>::epsilon());
  EXPECT_GT(difference(0, std::numeric_limits<double>::denorm_min()), 0);
  EXPECT_EQ(difference(std::numeric_limits<double>::max(), -std::numeric_limits<double>::max()), kInf);
}

TEST(Difference, OfWhatIsNoNumberIsInfinite) {
  for (double a : not_numbers()) {
    EXPECT_EQ(difference(a, 1), kInf) << a;
    EXPECT_EQ(difference(1, a), kInf) << a;
    for (double b : not_numbers()) {
      const bool same_infinity = std::isinf(a) && a == b;
      EXPECT_EQ(difference(a, b), same_infinity ? 0 : kInf) << a << " against " << b;
    }
  }
}

// One item of one value.
Measurement one(double diff, double tolerance) {
  Meter meter("u");
  meter.value(diff, tolerance, {1, 2, -1, "f"}, diff, 0);
  meter.item();
  return meter.done();
}

TEST(Meter, AToleranceExactlyMetPassesAndTheNextDoubleFails) {
  for (double tolerance : {0.501, 1.0, 8.0, 1e-300, 1e300}) {
    EXPECT_TRUE(passes(one(tolerance, tolerance))) << tolerance;
    EXPECT_EQ(one(tolerance, tolerance).max_ratio, 1) << tolerance;
    EXPECT_TRUE(fails(one(above(tolerance), tolerance))) << tolerance;
  }
  EXPECT_TRUE(passes(one(0, 0)));
  EXPECT_EQ(one(0, 0).max_ratio, 0);
  EXPECT_TRUE(fails(one(std::numeric_limits<double>::denorm_min(), 0)));
}

TEST(Meter, WhatIsNoNumberFails) {
  EXPECT_TRUE(fails(one(kNaN, 1)));
  EXPECT_TRUE(fails(one(kInf, 1)));
  EXPECT_TRUE(fails(one(-1, 1))) << "a difference cannot be negative";
  EXPECT_EQ(one(kNaN, 1).max_difference, kInf);
  EXPECT_EQ(one(kNaN, 1).worst.difference, kInf);
}

TEST(Meter, ABoundThatIsNoNumberAllowsNothing) {
  for (double tolerance : {kNaN, -1.0, -kInf}) {
    EXPECT_TRUE(passes(one(0, tolerance)));
    EXPECT_TRUE(fails(one(1e-9, tolerance))) << tolerance;
    EXPECT_EQ(one(1e-9, tolerance).worst.tolerance, 0);
  }
}

TEST(Meter, NorDoesAnInfiniteBound) {
  EXPECT_TRUE(fails(one(1e-9, kInf))) << "a bound that could not be computed";
  EXPECT_TRUE(fails(one(kInf, kInf)));
}

TEST(Meter, TheWorstHasTheLargestRatioNotTheLargestDifference) {
  Meter meter("u");
  const auto item = [&](double diff, double tolerance, std::int64_t record) {
    meter.value(diff, tolerance, {-1, -1, record, "f"}, diff + 10, 10);
    meter.item();
  };
  item(4, 8, 0);
  item(1, 1.25, 1);
  item(3, 4, 2);
  const Measurement m = meter.done();
  EXPECT_EQ(m.worst.place.record, 1);
  EXPECT_EQ(m.worst.candidate, 11);
  EXPECT_EQ(m.worst.reference, 10);
  EXPECT_EQ(m.worst.difference, 1);
  EXPECT_EQ(m.worst.tolerance, 1.25);
  EXPECT_EQ(m.max_ratio, 0.8);
  EXPECT_EQ(m.max_difference, 4);
  EXPECT_EQ(m.differing, 0u);
  EXPECT_EQ(m.items, 3u);
}

TEST(Meter, AmongEqualRatiosTheLargerDifferenceThenTheFirst) {
  Meter meter("u");
  const auto item = [&](double diff, double tolerance, std::int64_t record) {
    meter.value(diff, tolerance, {-1, -1, record, ""}, 0, 0);
    meter.item();
  };
  item(100, 1, 0);
  item(1e-3, 0, 1);  // beyond a tolerance of zero: an infinite ratio
  item(2, 0, 2);
  item(2, 0, 3);
  item(1, 0, 4);
  EXPECT_EQ(Meter(meter).done().worst.place.record, 2);
  item(kNaN, 5, 5);
  item(kInf, 0, 6);
  const Measurement m = meter.done();
  EXPECT_EQ(m.worst.place.record, 5);
  EXPECT_EQ(m.max_ratio, kInf);
  EXPECT_EQ(m.differing, 7u);
}

TEST(Meter, AnItemCountsOnceHoweverManyOfItsValuesDiffer) {
  Meter meter("u");
  meter.value(1, 0, {}, 0, 0);
  meter.value(5, 0, {}, 0, 0);
  meter.value(0, 0, {}, 0, 0);
  meter.item();
  meter.value(0, 0, {}, 0, 0);
  meter.item();
  meter.item();  // of no values
  const Measurement m = meter.done();
  EXPECT_EQ(m.items, 3u);
  EXPECT_EQ(m.differing, 1u);
  EXPECT_EQ(m.max_difference, 5);
  EXPECT_EQ(m.histogram[0], 2u);
  EXPECT_EQ(m.histogram[15], 1u) << "an item stands where its largest difference is";
  EXPECT_EQ(m.unit, "u");
}

TEST(Meter, HistogramBucketsArePowersOfTwo) {
  const auto bucket = [](double diff) {
    const Measurement m = one(diff, kInf);
    return std::find(m.histogram.begin(), m.histogram.end(), 1u) - m.histogram.begin();
  };
  EXPECT_EQ(bucket(0), 0);
  EXPECT_EQ(bucket(std::numeric_limits<double>::denorm_min()), 1);
  EXPECT_EQ(bucket(0x1p-13), 1);
  EXPECT_EQ(bucket(0x1p-12), 1);
  EXPECT_EQ(bucket(std::nextafter(0x1p-11, 0)), 1);
  EXPECT_EQ(bucket(0x1p-11), 2);
  EXPECT_EQ(bucket(std::nextafter(1.0, 0)), 12);
  EXPECT_EQ(bucket(1), 13);
  EXPECT_EQ(bucket(2), 14);
  EXPECT_EQ(bucket(std::nextafter(32.0, 0)), 17);
  EXPECT_EQ(bucket(32), 18);
  EXPECT_EQ(bucket(1e300), 18);
  EXPECT_EQ(bucket(kInf), 19);
  EXPECT_EQ(bucket(kNaN), 19);
}

TEST(Meter, HistogramSumsToTheItems) {
  Meter meter("u");
  for (int i = 0; i < 1000; ++i) {
    meter.value(i % 7 == 0 ? 0 : i % 11 == 0 ? kNaN : std::exp2(i % 40 - 20), 1, {}, 0, 0);
    if (i % 3 != 0) meter.item();
  }
  meter.missing(5, {});
  const Measurement m = meter.done();
  EXPECT_EQ(m.items, 671u);
  EXPECT_EQ(histogram_sum(m), m.items);
}

TEST(Meter, WhatIsInfinitelyApartIsToldByItsNumbers) {
  Meter meter("u");
  meter.missing(1, {-1, -1, 7, "triangles", true}, 0, 2);
  EXPECT_EQ(to_string(meter.done().worst, "expected", "u"), "primitive 7 triangles: 0, expected 2");
  Meter other("u");
  other.value(4, 1, {3, 2, -1, "z"}, 0.5, 0.25);
  other.item();
  EXPECT_EQ(to_string(other.done().worst, "expected", "u"), "pixel 3,2 z: 0.5, expected 0.25, 4 u apart, tolerance 1");
}

TEST(Meter, MissingItemsAllDiffer) {
  Meter meter("u");
  meter.missing(0, {});
  EXPECT_TRUE(passes(Meter(meter).done()));
  meter.missing(3, {-1, -1, 7, "gone"});
  meter.value(0, 0, {}, 0, 0);
  meter.item();
  const Measurement m = meter.done();
  EXPECT_TRUE(fails(m, 3));
  EXPECT_EQ(m.items, 4u);
  EXPECT_EQ(m.max_difference, kInf);
  EXPECT_EQ(to_string(m.worst.place), "record 7 gone");
}

TEST(Meter, CountsWhatIsAmbiguousAndDisputed) {
  Meter meter("u");
  const auto item = [&](int x, double diff, const char* why) {
    meter.suspect(why);
    meter.value(diff, 2, {x, 5, -1, "z"}, 10, 10 + diff);
    meter.value(diff / 2, 2, {x, 5, -1, "w"}, 10, 10 + diff / 2);
    meter.item();
  };
  meter.ambiguous();
  meter.ambiguous();
  meter.item();
  item(1, 1, "within");
  item(2, 3, "late");
  item(3, 7, "early");
  item(4, 6, "late");
  Measurement m = Meter(meter).done();
  EXPECT_EQ(m.ambiguous, 1u) << "of items";
  EXPECT_EQ(m.disputed, 3u) << "the first is within its tolerance";
  EXPECT_EQ(m.differing, 0u);
  EXPECT_EQ(m.max_difference, 1.5) << "of what is not disputed";
  EXPECT_EQ(m.max_ratio, 0.75);
  EXPECT_EQ(to_string(m.dispute.place), "pixel 3,5 z");
  EXPECT_EQ(m.dispute.candidate, 10);
  EXPECT_EQ(m.dispute.reference, 17);
  EXPECT_EQ(m.dispute.difference, 7);
  EXPECT_EQ(m.dispute.tolerance, 2);
  EXPECT_EQ(m.reason, "early");
  EXPECT_EQ(m.disputed_at, (std::vector<glm::ivec2>{{2, 5}, {3, 5}, {4, 5}}));
  // No reason excuses the next item, nor what is no number.
  meter.value(3, 2, {}, 0, 3);
  meter.item();
  item(5, kNaN, "late");
  m = meter.done();
  EXPECT_EQ(m.disputed, 3u);
  EXPECT_EQ(m.differing, 2u);
  EXPECT_EQ(m.differing_at, (std::vector<glm::ivec2>{{5, 5}})) << "once an item, and not the one that has no pixel";
}

TEST(Meter, KeepsTheFirstPlacesAlone) {
  Meter meter("u");
  for (int i = 0; i < 70000; ++i) {
    meter.value(1, 0, {i, 1, -1, ""}, 0, 1);
    meter.item();
  }
  const Measurement m = meter.done();
  EXPECT_EQ(m.differing, 70000u);
  EXPECT_EQ(m.differing_at.size(), 65536u);
  EXPECT_EQ(m.differing_at.back(), glm::ivec2(65535, 1));
}

TEST(Place, InWords) {
  EXPECT_EQ(to_string(Place{}), "");
  EXPECT_EQ(to_string({3, 0, -1, ""}), "pixel 3,0");
  EXPECT_EQ(to_string({0, 4, 0, "z"}), "pixel 0,4 record 0 z");
  EXPECT_EQ(to_string({-1, -1, 12, "p_clip"}), "record 12 p_clip");
  EXPECT_EQ(to_string({0, 4, 3, "z", true}), "pixel 0,4 primitive 3 z");
  EXPECT_EQ(to_string({-1, -1, -1, "p_clip"}), "p_clip");
}

TEST(Mismatch, EveryItemDiffers) {
  const Measurement m = mismatch("u", "why", 12);
  EXPECT_TRUE(fails(m, 12));
  EXPECT_EQ(m.items, 12u);
  EXPECT_EQ(m.max_difference, kInf);
  EXPECT_EQ(m.max_ratio, kInf);
  EXPECT_EQ(histogram_sum(m), 12u);
  EXPECT_EQ(m.mismatch, "why");
  EXPECT_TRUE(fails(mismatch("u", "why", 0), 1)) << "empty against full is not nothing";
}

TEST(CompareEqual, SizesNotNumbersOfPixels) {
  const Measurement turned = compare_equal(Plane<int>(96, 64), Plane<int>(64, 96), "pixels");
  EXPECT_TRUE(fails(turned, 96 * 64));
  EXPECT_EQ(turned.mismatch, "96 x 64 against 64 x 96");
  EXPECT_TRUE(fails(compare_equal(Plane<int>(96, 64), Plane<int>(96, 65), "pixels"), 96 * 64));
  EXPECT_TRUE(fails(compare_equal(Plane<int>(96, 64), Plane<int>(97, 64), "pixels"), 96 * 64));
  EXPECT_TRUE(fails(compare_equal(Plane<int>(96, 64), Plane<int>(), "pixels"), 96 * 64));
  EXPECT_TRUE(fails(compare_equal(Plane<int>(), Plane<int>(96, 64), "pixels")));
  EXPECT_TRUE(passes(compare_equal(Plane<int>(96, 64), Plane<int>(96, 64), "pixels")));
}

TEST(CompareEqual, EachPixelCountsInItsPlace) {
  // Width and height differ, so that a stride of the other would be seen.
  const Plane<std::uint32_t> plane(5, 3, 7);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) {
      Plane<std::uint32_t> other = plane;
      other(x, y) += 2;
      const Measurement m = compare_equal(plane, other, "pixels");
      EXPECT_TRUE(fails(m));
      EXPECT_EQ(m.items, 15u);
      EXPECT_EQ(m.worst.place.x, x);
      EXPECT_EQ(m.worst.place.y, y);
      EXPECT_EQ(m.worst.candidate, 7);
      EXPECT_EQ(m.worst.reference, 9);
      EXPECT_EQ(m.worst.difference, 2);
      EXPECT_TRUE(fails(compare_equal(other, plane, "pixels")));
    }
  }
}

template <class T>
double apart(T a, T b) {
  return compare_equal(Plane<T>(1, 1, a), Plane<T>(1, 1, b), "pixels").max_difference;
}

TEST(CompareEqual, DoesNotOverflow) {
  const std::uint64_t big = std::uint64_t{1} << 53;
  EXPECT_EQ(apart(big, big + 1), 1) << "equal as doubles";
  EXPECT_EQ(apart(big + 1, big), 1);
  EXPECT_EQ(apart(UINT64_MAX, UINT64_MAX - 1), 1);
  EXPECT_EQ(apart<std::uint64_t>(0, std::uint64_t{1} << 32), 4294967296.0);
  EXPECT_EQ(apart(UINT32_MAX, 0u), 4294967295.0);
  EXPECT_EQ(apart(0u, UINT32_MAX), 4294967295.0);
  EXPECT_EQ(apart(INT32_MAX, -1), 2147483648.0);
  EXPECT_EQ(apart(INT32_MIN, INT32_MAX), 4294967295.0);
}

}  // namespace
}  // namespace plumbline::check
