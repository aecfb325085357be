#include "reference/arithmetic/resolve.h"

#include <cmath>

#include "reference/arithmetic/passes.h"

namespace plumbline::math {

namespace {

using Color = glm::dvec4;

// Weighted mean of a pixel's samples: in codes where the frame has codes, whose sums with integer weights are exact, so
// that the nearer code is chosen exactly; else in the samples' own numbers.
Color mean_codes(const FrameFormat& frame, const std::vector<Plane<glm::vec4>>& samples, int x, int y) {
  const double scale = color_scale(frame.color);
  Color sum(0);
  double weights = 0;
  for (const PixelShare& s : pixel_shares(frame.antialias, x, y)) {
    const Color value(samples[s.pass](s.pixel.x, s.pixel.y));
    sum += static_cast<double>(s.weight) * (scale == 0 ? value : glm::round(value * scale));
    weights += s.weight;
  }
  return sum / weights;
}

template <class Finish>
Plane<glm::vec4> each_pixel(const FrameFormat& frame, const std::vector<Plane<glm::vec4>>& samples, Finish finish) {
  Plane<glm::vec4> out(frame.width, frame.height);
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) out(x, y) = glm::vec4(finish(mean_codes(frame, samples, x, y)));
  }
  return out;
}

}  // namespace

Plane<glm::vec4> mean_colors(const FrameFormat& frame, const std::vector<Plane<glm::vec4>>& samples) {
  const double scale = color_scale(frame.color);
  return each_pixel(frame, samples, [&](const Color& mean) { return scale == 0 ? mean : mean / scale; });
}

Plane<glm::vec4> resolved_colors(const FrameFormat& frame, const std::vector<Plane<glm::vec4>>& samples) {
  const double scale = color_scale(frame.color);
  return each_pixel(frame, samples,
                    [&](const Color& mean) { return scale == 0 ? mean : glm::floor(mean + 0.5) / scale; });
}

Capture capture_resolved(Renderer& renderer, const Scene& scene, const Request& request) {
  require_budget(scene, plane_bytes(scene), request.memory_budget);
  const Request planes{.memory_budget = request.memory_budget, .conventions = request.conventions};
  Capture out;
  for (const Scene& pass : pass_scenes(scene)) {
    Capture drawn = renderer.capture(pass, planes);
    if (out.samples.empty()) {
      out.renderer = drawn.renderer;
      out.version = drawn.version;
      const int n = scene.frame.antialias.factor;
      out.planes.depth = Plane<double>(scene.frame.width, scene.frame.height);
      for (int y = 0; y < scene.frame.height; ++y) {
        for (int x = 0; x < scene.frame.width; ++x) out.planes.depth(x, y) = drawn.planes.depth(n * x, n * y);
      }
    }
    out.samples.push_back(std::move(drawn.planes.color));
  }
  out.width = scene.frame.width;
  out.height = scene.frame.height;
  out.planes.color = resolved_colors(scene.frame, out.samples);
  return out;
}

}  // namespace plumbline::math
