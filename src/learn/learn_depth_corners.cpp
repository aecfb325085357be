// Window positions between which depths are interpolated: the corners' own, or snapped ones.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "learn/probe_scene.h"
#include "learn/prober.h"
#include "learn/ramps.h"

namespace plumbline::learn {

namespace {

using C = Conventions;

constexpr int kRamps = 16, kPeriod = 4;       // ramps are two pixels wide, one begins every kPeriod pixels
constexpr double kFirst = 0.2, kRise = 0.25;  // depth at a ramp's beginning; its rise in a pixel

Scene ramps(const C& c, double off) {
  Scene scene = probe_frame("depth_corners", kPeriod * kRamps, 4);
  std::vector<std::array<ProbeCorner, 3>> triangles;
  for (int i = 0; i < kRamps; ++i) {
    const double from = kPeriod * i + 1 + off;
    const auto at = [&](double x, double y, double z) {
      return ProbeCorner{{x, y, in_volume(c, z)}, glm::vec4(1), {}};
    };
    const double last = kFirst + 2 * kRise;
    for (const auto& t : quad({at(from, 0, kFirst), at(from + 2, 0, last), at(from + 2, 4, last), at(from, 4, kFirst)}))
      triangles.push_back(t);
  }
  add_triangles(scene, triangles);
  return scene;
}

}  // namespace

// A sample in a ramp has one depth by the corners as they are, and another by the corners on the grid.
void learn_depth_corners(Prober& prober) {
  const ConventionWords words = words_of("depth_corners");
  C& c = prober.learned.conventions;
  if (c.subpixel_bits == C::kFloat) {
    c.depth_corners = C::DepthCorners::as_they_are;
    return prober.found(words, name_of(c.depth_corners), "positions are not snapped");
  }
  if (prober.open_if_any_open(words, {"sample", "subpixel_bits", "subpixel_rounding", "depth_range"})) return;
  const double off = off_grid(c), apart = kRise * off;
  const RampPixel pixel = pixel_of_ramp(c);
  const double as_it_is = kFirst + kRise * (pixel.from_start - off), snapped = as_it_is + apart;
  Scene scene = ramps(c, off);
  scene.frame.depth = DepthFormat::z24;
  const Plane<double> left = prober.draw_depths(scene);
  std::size_t by_corners = 0, by_grid = 0;
  for (int i = 0; i < kRamps; ++i) {
    const double z = left(kPeriod * i + 1 + pixel.column, pixel.row);
    by_corners += std::abs(z - as_it_is) < std::abs(apart) / 3 ? 1 : 0;
    by_grid += std::abs(z - snapped) < std::abs(apart) / 3 ? 1 : 0;
  }
  const std::string evidence = fmt::format("{} of {} ramps", std::max(by_corners, by_grid), kRamps);
  if (std::max(by_corners, by_grid) < kRamps) return prober.open(words, evidence + " at most go by one of the two");
  c.depth_corners = by_grid > by_corners ? C::DepthCorners::snapped : C::DepthCorners::as_they_are;
  prober.found(words, name_of(c.depth_corners), evidence);
}

}  // namespace plumbline::learn
