// Pairs of image files that must compare equal, and pairs that must not: what plumb compare is for. Each is compared
// both ways round.
//
// Where it says so, idiff (OpenImageIO 2.4.7, ImageBufAlgo::compare) finds nothing: it takes any infinity for any other
// and NaN for NaN, does not count the value at which it first meets a number that is not finite, lets NaN's comparisons
// count nothing, and reads channels and pixels that one image lacks as 0.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>

#include <fmt/format.h>

// After fmt: it would include it as headers only (image_file.cpp).
#include <OpenImageIO/imageio.h>

#include "check/compare/compare_stored.h"
#include "tests/check/fixtures.h"
#include "tests/test_folder.h"
#include "tests/text_file.h"

namespace plumbline::check {
namespace {

namespace fs = std::filesystem;
using OIIO::TypeDesc;
using Names = std::vector<std::string>;

constexpr double kCode = 1.0 / 255;

// What a file shall hold: rows from the top, channels beside each other; codes where the type is of integers.
struct Picture {
  TypeDesc type;
  int width, height;
  Names channels;
  std::vector<double> values;
  int x = 0, y = 0;                                           // the data window's corner
  std::optional<std::pair<int, int>> display = std::nullopt;  // the display window's size

  double& at(int px, int py, std::size_t channel) {
    return values[static_cast<std::size_t>(py * width + px) * channels.size() + channel];
  }
};

double code_of(const Picture& p, double value) {
  if (p.type == TypeDesc::UINT8) return std::round(255 * value);
  if (p.type == TypeDesc::UINT16) return std::round(65535 * value);
  return value;
}

// Every value another, in steps that any type holds exactly; in [0, 1).
Picture gradient(TypeDesc type, Names channels = {"R", "G", "B", "A"}, int width = 4, int height = 3) {
  Picture p{type, width, height, std::move(channels), {}};
  p.values.resize(static_cast<std::size_t>(width * height) * p.channels.size());
  for (std::size_t i = 0; i < p.values.size(); ++i) {
    const double steps = static_cast<double>(i * 7 % 64);
    p.values[i] = type == TypeDesc::UINT8 ? 4 * steps : type == TypeDesc::UINT16 ? 4 * 257 * steps : steps / 64;
  }
  return p;
}
Picture filled(TypeDesc type, double value, Names channels = {"R", "G", "B", "A"}, int width = 4, int height = 3) {
  Picture p = gradient(type, std::move(channels), width, height);
  std::fill(p.values.begin(), p.values.end(), code_of(p, value));
  return p;
}
Picture with(Picture p, int x, int y, std::size_t channel, double value) {
  p.at(x, y, channel) = value;
  return p;
}
Picture moved(Picture p, int x, int y) {
  p.x = x, p.y = y;
  return p;
}
Picture framed(Picture p, int width, int height) {
  p.display = {width, height};
  return p;
}
// With every pixel (x, y) from `from(x, y)`.
Picture mapped(const Picture& p, int width, int height, const std::function<std::pair<int, int>(int, int)>& from) {
  Picture out = gradient(p.type, p.channels, width, height), source = p;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto [px, py] = from(x, y);
      for (std::size_t c = 0; c < p.channels.size(); ++c) out.at(x, y, c) = source.at(px, py, c);
    }
  }
  return out;
}

template <class T>
bool write_as(OIIO::ImageOutput& out, TypeDesc type, const std::vector<double>& values) {
  std::vector<T> data;
  for (double v : values) data.push_back(static_cast<T>(v));
  return out.write_image(type, data.data());
}

void save(const fs::path& file, const Picture& p) {
  OIIO::ImageSpec spec(p.width, p.height, static_cast<int>(p.channels.size()), p.type);
  spec.channelnames = p.channels;
  const auto alpha = std::ranges::find(p.channels, "A");
  spec.alpha_channel = alpha == p.channels.end() ? -1 : static_cast<int>(alpha - p.channels.begin());
  spec.x = p.x, spec.y = p.y;
  if (p.display) spec.full_width = p.display->first, spec.full_height = p.display->second;
  spec.attribute("oiio:UnassociatedAlpha", 1);
  const auto out = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(out) << OIIO::geterror();
  ASSERT_TRUE(out->open(file.string(), spec)) << out->geterror();
  const bool written = p.type == TypeDesc::UINT8    ? write_as<std::uint8_t>(*out, TypeDesc::UINT8, p.values)
                       : p.type == TypeDesc::UINT16 ? write_as<std::uint16_t>(*out, TypeDesc::UINT16, p.values)
                                                    : write_as<float>(*out, TypeDesc::FLOAT, p.values);
  ASSERT_TRUE(written && out->close()) << out->geterror();
}

struct ImagePairs : TestFolder {
  std::vector<StoredComparison> compared(const std::string& ending_a, const Picture& a, const std::string& ending_b,
                                         const Picture& b, double tolerance, bool turned) {
    save(folder / ("a" + ending_a), a);
    save(folder / ("b" + ending_b), b);
    const StoredImage stored_a = read_stored(folder / ("a" + ending_a)),
                      stored_b = read_stored(folder / ("b" + ending_b));
    return turned ? compare_images(stored_b, stored_a, tolerance) : compare_images(stored_a, stored_b, tolerance);
  }
  const fs::path& folder = root_;
};

struct Pair {
  const char* why;
  const char* ending_a;
  Picture a;
  const char* ending_b;
  Picture b;
  double tolerance = 0;
};

TEST_F(ImagePairs, ThatMustPass) {
  const Names rgb{"R", "G", "B"}, grey{"Y"};
  const TypeDesc u8 = TypeDesc::UINT8, u16 = TypeDesc::UINT16, half = TypeDesc::HALF, f32 = TypeDesc::FLOAT;
  Picture codes = filled(u8, 0, grey, 255, 1), codes_above = codes, codes16 = filled(u16, 0, grey, 255, 1);
  for (int i = 0; i < 255; ++i) {
    codes.at(i, 0, 0) = i;
    codes_above.at(i, 0, 0) = i + 1;
    codes16.at(i, 0, 0) = 257 * i;
  }
  const Pair pairs[] = {
      {"a png is itself", ".png", gradient(u8), ".png", gradient(u8)},
      {"png and tga", ".png", gradient(u8), ".tga", gradient(u8)},
      {"png and tif", ".png", gradient(u8), ".tif", gradient(u8)},
      {"png and ppm, no alpha", ".png", gradient(u8, rgb), ".ppm", gradient(u8, rgb)},
      {"png and bmp, no alpha", ".png", gradient(u8, rgb), ".bmp", gradient(u8, rgb)},
      {"one channel", ".png", gradient(u8, grey), ".pgm", gradient(u8, grey)},
      {"16-bit png", ".png", gradient(u16), ".png", gradient(u16)},
      {"16-bit png and tif", ".png", gradient(u16), ".tif", gradient(u16)},
      {"8 and 16 bits of one value", ".png", gradient(u8), ".png", gradient(u16)},
      {"8 and 16 bits, every code", ".png", codes, ".png", codes16},
      {"half exr", ".exr", gradient(half), ".exr", gradient(half)},
      {"half and float", ".exr", gradient(half), ".exr", gradient(f32)},
      {"float exr and tif", ".exr", gradient(f32), ".tif", gradient(f32)},
      {"-0 is 0", ".exr", filled(f32, 0), ".exr", filled(f32, -0.0)},
      {"-0 is 0 in half", ".exr", filled(half, 0), ".exr", filled(half, -0.0)},
      {"an infinity is itself", ".exr", with(filled(f32, kInf), 1, 1, 1, -kInf), ".exr",
       with(filled(half, kInf), 1, 1, 1, -kInf)},
      {"one pixel", ".png", gradient(u8, rgb, 1, 1), ".png", gradient(u8, rgb, 1, 1)},
      {"tall", ".png", gradient(u8, rgb, 1, 300), ".tga", gradient(u8, rgb, 1, 300)},
      {"one step, tolerance 1/255, at every code", ".png", codes, ".png", codes_above, kCode},
      {"257 of 65535 are 1/255", ".png", filled(u16, 0), ".png", with(filled(u16, 0), 0, 0, 0, 257), kCode},
      {"one step across types", ".png", codes_above, ".png", codes16, kCode},
      {"a float near a code", ".png", filled(u8, 0.5), ".exr", filled(f32, 128 / 255.0), 1e-7},
      {"within", ".exr", filled(f32, 0.5), ".exr", with(filled(f32, 0.5), 3, 2, 3, 0.5078125), 0.0078125},
      {"one channel of two names", ".exr", gradient(f32, {"Z"}), ".tif", gradient(f32, grey)},
      {"a window that is moved, both", ".exr", moved(gradient(f32), 5, -7), ".exr", moved(gradient(f32), 5, -7)},
  };
  for (const Pair& pair : pairs) {
    SCOPED_TRACE(pair.why);
    for (bool turned : {false, true}) {
      for (const StoredComparison& c : compared(pair.ending_a, pair.a, pair.ending_b, pair.b, pair.tolerance, turned)) {
        EXPECT_FALSE(is_failure(c.outcome)) << c.what << " " << c.measurement.mismatch;
        EXPECT_TRUE(passes(c.measurement)) << c.what;
        EXPECT_EQ(c.measurement.items, pair.a.values.size() / pair.a.channels.size());
      }
    }
  }
  EXPECT_GE(std::size(pairs), 20u);
}

struct BadPair : Pair {
  Names different;           // the rows that must differ, beside "pixels"
  std::uint64_t pixels = 1;  // how many
};

TEST_F(ImagePairs, ThatMustFail) {
  const Names rgb{"R", "G", "B"}, grey{"Y"}, all{"R", "G", "B", "A"};
  const TypeDesc u8 = TypeDesc::UINT8, u16 = TypeDesc::UINT16, half = TypeDesc::HALF, f32 = TypeDesc::FLOAT;
  const Picture g8 = gradient(u8), g16 = gradient(u16), gh = gradient(half), gf = gradient(f32),
                flat = filled(f32, 0.5);
  const Picture faint = with(with(g8, 1, 1, 3, 1), 1, 1, 0, 200), fainter = with(faint, 1, 1, 0, 201);
  const Picture clear = with(g8, 2, 0, 3, 0);
  const double largest = std::numeric_limits<float>::max(), smallest = std::numeric_limits<float>::denorm_min();
  const BadPair pairs[] = {
      {{"one pixel", ".png", g8, ".png", with(g8, 1, 2, 1, 0)}, {"G"}},
      {{"the last value of all", ".png", g8, ".png", with(g8, 3, 2, 3, 1)}, {"A"}},
      {{"one step, png", ".png", filled(u8, 0.5), ".png", with(filled(u8, 0.5), 0, 0, 2, 129)}, {"B"}},
      {{"one step, ppm", ".ppm", filled(u8, 0.5, rgb), ".ppm", with(filled(u8, 0.5, rgb), 0, 0, 2, 129)}, {"B"}},
      {{"one step under faint alpha, png", ".png", faint, ".png", fainter}, {"R"}},
      {{"one step under faint alpha, tga", ".tga", faint, ".tga", fainter}, {"R"}},
      {{"one step under faint alpha, tif", ".tif", faint, ".tif", fainter}, {"R"}},
      {{"colour under no alpha, png", ".png", clear, ".png", with(clear, 2, 0, 1, 250)}, {"G"}},
      {{"colour under no alpha, tga", ".tga", clear, ".tga", with(clear, 2, 0, 1, 250)}, {"G"}},
      {{"alpha only, png", ".png", g8, ".png", with(g8, 0, 1, 3, 255)}, {"A"}},
      {{"alpha only, tga", ".png", g8, ".tga", with(g8, 0, 1, 3, 255)}, {"A"}},
      {{"alpha only, exr", ".exr", gf, ".exr", with(gf, 0, 1, 3, 1)}, {"A"}},
      {{"one step of 16 bits, png", ".png", filled(u16, 0.5), ".png", with(filled(u16, 0.5), 1, 1, 0, 32769)}, {"R"}},
      {{"one step of 16 bits, tif", ".tif", g16, ".tif", with(g16, 0, 0, 0, 1)}, {"R"}},
      {{"8 bits against 16, one step off", ".png", filled(u8, 1), ".png", with(filled(u16, 1), 0, 0, 0, 65534)}, {"R"}},
      {{"one step of half", ".exr", filled(half, 0.5), ".exr", with(filled(half, 0.5), 2, 2, 1, 0.50048828125)}, {"G"}},
      {{"half cannot hold it", ".exr", filled(half, 0.1), ".exr", filled(f32, 0.1)}, all, 12},
      {{"one step of float", ".exr", flat, ".exr", with(flat, 2, 2, 1, float_above(0.5))}, {"G"}},
      {{"the smallest number is not 0", ".exr", filled(f32, 0), ".exr", with(filled(f32, 0), 0, 0, 0, smallest)},
       {"R"}},
      {{"depth, one step", ".exr", filled(f32, 0.5, {"Z"}), ".exr",
        with(filled(f32, 0.5, {"Z"}), 3, 0, 0, float_above(0.5))},
       {"Z"}},
      {{"one NaN (idiff passes)", ".exr", flat, ".exr", with(flat, 1, 1, 0, kNaN)}, {"R"}},
      {{"NaN everywhere (idiff passes)", ".exr", flat, ".exr", filled(f32, kNaN)}, all, 12},
      {{"NaN and NaN (idiff passes)", ".exr", filled(f32, kNaN), ".exr", filled(f32, kNaN)}, all, 12},
      {{"NaN in half", ".exr", gh, ".exr", with(gh, 0, 0, 3, kNaN)}, {"A"}},
      {{"NaN and an infinity", ".exr", with(flat, 1, 1, 0, kInf), ".exr", with(flat, 1, 1, 0, kNaN)}, {"R"}},
      {{"no tolerance reaches NaN", ".exr", flat, ".exr", with(flat, 1, 1, 0, kNaN), 1e300}, {"R"}},
      {{"infinities of two signs (idiff passes)", ".exr", filled(f32, kInf), ".exr", filled(f32, -kInf)}, all, 12},
      {{"one infinity (idiff passes)", ".exr", flat, ".exr", with(flat, 0, 2, 2, kInf)}, {"B"}},
      {{"an infinity and the largest number", ".exr", with(flat, 0, 0, 0, kInf), ".exr", with(flat, 0, 0, 0, largest),
        1e300},
       {"R"}},
      {{"infinity in half", ".exr", with(gh, 0, 0, 0, kInf), ".exr", with(gh, 0, 0, 0, 65504)}, {"R"}},
      {{"a column less, all black (idiff passes)", ".png", filled(u8, 0), ".png", filled(u8, 0, all, 3, 3)},
       {"size"},
       0},
      {{"transposed", ".png", g8, ".png", mapped(g8, 3, 4, [](int x, int y) { return std::pair(y, x); })}, {"size"}, 0},
      {{"as many pixels, of another shape", ".png", filled(u8, 0), ".png", filled(u8, 0, all, 6, 2)}, {"size"}, 0},
      {{"a pixel and two", ".png", filled(u8, 1, grey, 1, 1), ".png", filled(u8, 1, grey, 2, 1)}, {"size"}, 0},
      {{"no alpha and alpha 0 (idiff passes)", ".png", filled(u8, 0, rgb), ".png", filled(u8, 0)}, {"channels"}, 0},
      {{"no alpha and alpha 1", ".exr", filled(f32, 1, rgb), ".exr", filled(f32, 1)}, {"channels"}, 0},
      {{"grey and colour", ".png", filled(u8, 1, grey), ".png", filled(u8, 1, rgb)}, {"channels"}, 0},
      {{"channels of other names", ".exr", filled(f32, 1, {"U", "V"}), ".exr", filled(f32, 1, {"S", "T"})},
       {"channels"},
       0},
      {{"upside down", ".png", g8, ".png", mapped(g8, 4, 3, [](int x, int y) { return std::pair(x, 2 - y); })}, all, 8},
      {{"mirrored", ".png", g8, ".png", mapped(g8, 4, 3, [](int x, int y) { return std::pair(3 - x, y); })}, all, 12},
      {{"red and blue swapped", ".png", with(filled(u8, 0), 0, 0, 0, 9), ".png", with(filled(u8, 0), 0, 0, 2, 9)},
       {"R", "B"}},
      {{"a window that is moved", ".exr", gf, ".exr", moved(gf, 1, 0)}, {"data window"}, 0},
      {{"another frame about it", ".exr", framed(gf, 4, 3), ".exr", framed(gf, 8, 8)}, {"display window"}, 0},
      {{"two steps, tolerance 1/255", ".png", filled(u8, 0.5), ".png", with(filled(u8, 0.5), 0, 0, 0, 130), kCode},
       {"R"}},
      {{"one step, tolerance a little less", ".png", filled(u8, 0.5), ".png", with(filled(u8, 0.5), 0, 0, 0, 129),
        std::nextafter(kCode, 0)},
       {"R"}},
  };
  for (const BadPair& pair : pairs) {
    SCOPED_TRACE(pair.why);
    for (bool turned : {false, true}) {
      Names different;
      for (const StoredComparison& c : compared(pair.ending_a, pair.a, pair.ending_b, pair.b, pair.tolerance, turned)) {
        if (c.outcome != Outcome::different) {
          EXPECT_FALSE(is_failure(c.outcome));
          continue;
        }
        if (c.what == "pixels") {
          EXPECT_TRUE(fails(c.measurement, pair.pixels));
          continue;
        }
        EXPECT_TRUE(pair.pixels == 0 || fails(c.measurement, pair.pixels)) << c.what;
        EXPECT_EQ(pair.pixels == 0, !c.measurement.mismatch.empty());
        different.push_back(c.what);
      }
      EXPECT_EQ(different, pair.different);
    }
  }
  EXPECT_GE(std::size(pairs), 40u);
}

TEST_F(ImagePairs, TellTheWorstPixelFromTheLowerLeftAndItsValues) {
  const Picture a = filled(TypeDesc::UINT8, 0);
  const auto rows = compared(".png", a, ".png", with(with(a, 1, 2, 0, 51), 3, 0, 1, 102), 0, false);
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(rows[0].what, "pixels");
  EXPECT_EQ(rows[0].measurement.differing, 2u);
  EXPECT_EQ(to_string(rows[0].measurement.worst.place), "pixel 3,2");
  EXPECT_EQ(to_string(rows[1].measurement.worst.place), "pixel 1,0");
  EXPECT_EQ(rows[1].measurement.worst.candidate, 0);
  EXPECT_EQ(rows[1].measurement.worst.reference, 0.2);
  EXPECT_EQ(rows[2].measurement.max_difference, 0.4);
  EXPECT_EQ(rows[2].codes, 255);
  const auto nans = compared(".exr", filled(TypeDesc::FLOAT, kNaN), ".exr", filled(TypeDesc::FLOAT, kNaN), 0, false);
  EXPECT_NE(nans.back().note.find("12 NaN in both"), std::string::npos) << nans.back().note;
}

TEST_F(ImagePairs, AreOfOneImageAFile) {
  const auto refused = [&](const fs::path& file, const std::string& why) {
    try {
      read_stored(file);
      ADD_FAILURE() << file;
    } catch (const ImageError& e) {
      EXPECT_NE(std::string(e.what()).find(file.string()), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what();
    }
  };
  refused(folder / "none.png", "found none");
  refused(folder, "found none");
  test::write_text(folder / "text.png", "text");
  refused(folder / "text.png", "cannot be read");
  save(folder / "cut.exr", gradient(TypeDesc::FLOAT, {"R", "G", "B"}, 64, 64));
  fs::resize_file(folder / "cut.exr", fs::file_size(folder / "cut.exr") / 2);
  refused(folder / "cut.exr", "cannot be read");
  const OIIO::ImageSpec spec(2, 2, 1, TypeDesc::UINT8);
  const std::uint8_t pixels[4] = {1, 2, 3, 4};
  const auto out = OIIO::ImageOutput::create("two.tif");
  ASSERT_TRUE(out && out->open((folder / "two.tif").string(), spec) && out->write_image(TypeDesc::UINT8, pixels));
  ASSERT_TRUE(out->open((folder / "two.tif").string(), spec, OIIO::ImageOutput::AppendSubimage) &&
              out->write_image(TypeDesc::UINT8, pixels) && out->close());
  refused(folder / "two.tif", "found several");
}

}  // namespace
}  // namespace plumbline::check
