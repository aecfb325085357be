// The error of coverage: four samples, N x N and the six taps against the exact area of a triangle in each pixel.
//
// The sides of a convex figure pass through at most 2 N - 1 of a pixel's N x N cells each; of a triangle, at most
// 3 (2 N - 1). All other cells are in or out as their centres are, and one that is not is off by its own area at most:
// the error is at most 3 (2 N - 1) / N^2, which falls as 6 / N. The places of a side in its cells being as good as
// random, the errors of the some N cells on it add up as their root: RMS falls as N^(-3/2).
#include <cmath>
#include <filesystem>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "notes/raster/triangle_area.h"
#include "pipeline/render.h"
#include "tests/extent.h"
#include "tests/pipeline/window_scene.h"
#include "tests/text_file.h"

namespace plumbline {
namespace {

constexpr int kFrameSize = 24, kTriangles = 250;
using Kind = Antialias::Kind;

struct Row {
  std::string name;
  double samples;  ///< of a pixel
  double sum_of_squares = 0, largest = 0;
  int pixels = 0;
  double rms() const { return std::sqrt(sum_of_squares / pixels); }
};

// Adds the errors of partly covered pixels.
void measure(const raster::Corners& corners, const Antialias& antialias, Row& row) {
  const auto p_win = [&](std::size_t i) { return glm::vec3(glm::vec2(corners[i]) / 256.0f + 0.5f, 0.5f); };
  Scene scene = test::window_scene(kFrameSize, kFrameSize, {{p_win(0), p_win(1), p_win(2)}});
  scene.frame.color = ColorFormat::rgba32f;
  scene.frame.antialias = antialias;
  const pipeline::Frame frame = pipeline::render(scene);
  for (int y = 0; y < kFrameSize; ++y) {
    for (int x = 0; x < kFrameSize; ++x) {
      const double area = raster::area_in_pixel(corners, x, y);
      if (area < 1e-9 || area > 1 - 1e-9) continue;
      const double error = std::abs(static_cast<double>(frame.color_rgba32f(x, y).r) - area);
      row.sum_of_squares += error * error;
      row.largest = std::max(row.largest, error);
      ++row.pixels;
    }
  }
}

// RMS against samples a pixel, both in powers of two, and the line that falls as 1/N = samples^(-1/2).
void plot(const std::vector<Row>& rows, const std::filesystem::path& file) {
  const auto x = [](double samples) { return 60 + 70 * std::log2(samples); };
  const auto y = [](double rms) { return 20 - 45 * std::log2(rms / 0.5); };
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"540\" height=\"340\" font-family=\"sans-serif\" "
      "font-size=\"12\"><rect width=\"540\" height=\"340\" fill=\"white\"/>\n";
  for (int i = 0; i <= 6; ++i) {
    svg += fmt::format(
        "<path d=\"M{0} 20V290\" stroke=\"#ddd\"/><text x=\"{0}\" y=\"306\" text-anchor=\"middle\">{1}</text>\n",
        x(1 << i), 1 << i);
    svg += fmt::format(
        "<path d=\"M60 {0}H480\" stroke=\"#ddd\"/><text x=\"54\" y=\"{1}\" text-anchor=\"end\">1/{2}</text>\n",
        y(std::exp2(-1 - i)), y(std::exp2(-1 - i)) + 4, 2 << i);
  }
  svg += fmt::format("<path d=\"M{} {}L{} {}\" stroke=\"#999\" stroke-dasharray=\"4\"/>\n", x(1), y(rows[0].rms()),
                     x(64), y(rows[0].rms() / 8));
  for (const Row& row : rows) {
    const bool grid = row.name.find(" x ") != std::string::npos;
    svg += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/><text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
        x(row.samples), y(row.rms()), grid ? "#26c" : "#c42", x(row.samples) + 7, y(row.rms()) + (grid ? -5 : 14),
        row.name);
  }
  svg +=
      "<text x=\"270\" y=\"330\" text-anchor=\"middle\">samples a pixel; dashed: falling as 1/N</text>"
      "<text x=\"70\" y=\"14\">RMS error of coverage against the exact area</text></svg>\n";
  test::write_text(file, svg);
}

TEST(AntialiasError, FallsWithTheNumberOfSamples) {
  std::mt19937 random(5);
  std::vector<Row> rows;
  std::vector<Antialias> kinds;
  for (int n = 1; n <= 8; ++n) {
    rows.push_back({fmt::format("{0} x {0}", n), static_cast<double>(n * n)});
    kinds.push_back({Kind::supersample, n});
  }
  rows.push_back({"four samples", 4});
  kinds.push_back({Kind::multisample, 1});
  rows.push_back({"six taps", 6});
  kinds.push_back({Kind::taps, 1});
  for (int t = 0; t < kTriangles / static_cast<int>(one_of(2)); ++t) {
    raster::Corners corners;
    for (glm::ivec2& c : corners) {
      c.x = static_cast<int>(random() % (256 * (kFrameSize - 1)));
      c.y = static_cast<int>(random() % (256 * (kFrameSize - 1)));
    }
    for (std::size_t k = 0; k < kinds.size(); ++k) measure(corners, kinds[k], rows[k]);
  }
  fmt::print("{:<14} {:>8} {:>10} {:>10} {:>10}\n", "", "samples", "RMS", "largest", "bound");
  const double one = rows[0].rms();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Row& row = rows[k];
    const double n = kinds[k].factor, bound = std::min(1.0, 3 * (2 * n - 1) / (n * n));
    const bool grid = kinds[k].kind == Kind::supersample;
    fmt::print("{:<14} {:>8} {:>10.5f} {:>10.5f} {:>10}\n", row.name, row.samples, row.rms(), row.largest,
               grid ? fmt::format("{:.5f}", bound) : "");
    EXPECT_GT(row.pixels, 1000);
    if (!grid) continue;
    EXPECT_LE(row.largest, bound) << row.name;
    EXPECT_LE(row.rms(), one / n) << row.name << ": falls at least as 1/N";
    EXPECT_LE(row.rms() * std::pow(n, 1.5), 1.25 * one) << row.name << ": and as N^(-3/2)";
  }
  EXPECT_LE(rows[8].rms(), one / 2) << "as 2 x 2: along slanting sides the two are as good";
  // The taps reach .71 of a pixel far: that is another filter, smoother than the pixel's box, and not nearer to it for
  // having more samples.
  EXPECT_LT(rows[9].rms(), one / 2);
  plot(rows, std::filesystem::path(PLUMBLINE_PLUMB).parent_path() / "antialias_error.svg");
}

// No two of the four samples share a row or a column: of an upright or level side they tell four places apart, as a
// grid of 4 x 4 does with sixteen; a grid of N x N is off by half a column, 1/(2 N).
TEST(AntialiasError, OfUprightAndLevelSides) {
  for (const bool upright : {true, false}) {
    std::vector<Row> rows(4);
    const Antialias kinds[] = {{}, {Kind::supersample, 2}, {Kind::supersample, 4}, {Kind::multisample, 1}};
    for (int k = 0; k < 256; k += 8) {
      constexpr int kFar = 256 * 1000;
      const int at = 11 * 256 + k;
      raster::Corners corners{{{at, -kFar}, {at + kFar, 0}, {at, kFar}}};
      if (!upright) {
        for (glm::ivec2& c : corners) std::swap(c.x, c.y);
      }
      for (std::size_t i = 0; i < rows.size(); ++i) measure(corners, kinds[i], rows[i]);
    }
    EXPECT_NEAR(rows[0].largest, 1.0 / 2, 1e-9);
    EXPECT_NEAR(rows[1].largest, 1.0 / 4, 1e-9);
    EXPECT_NEAR(rows[2].largest, 1.0 / 8, 1e-9);
    EXPECT_NEAR(rows[3].largest, 1.0 / 8, 1e-9);
  }
}

}  // namespace
}  // namespace plumbline
