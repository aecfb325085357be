#include "reference/arithmetic/passes.h"

namespace plumbline::math {

namespace {

/// GzRender's filter, AAFilter of CSCI-580's homework 6: the sample's offset in x and y [pixels] (its picture is moved
/// the other way), and its weight.
struct Filter {
  double shift_x, shift_y, weight;
};
constexpr std::array<Filter, 6> kFilter = {{{-0.52, 0.38, 0.128},
                                            {0.41, 0.56, 0.119},
                                            {0.27, 0.08, 0.294},
                                            {-0.17, -0.29, 0.249},
                                            {0.58, -0.55, 0.104},
                                            {-0.31, -0.71, 0.106}}};

}  // namespace

glm::dvec2 sample_offset(const FrameFormat& frame) {
  if (!frame.pass.sample) return glm::dvec2(0);
  return kSamplePositions.at(static_cast<std::size_t>(*frame.pass.sample)) - 0.5;
}

std::vector<Scene> pass_scenes(const Scene& scene) {
  const Antialias& antialias = scene.frame.antialias;
  if (antialias.kind == Antialias::Kind::none) return {scene};
  Scene plain = scene;
  plain.path.clear();
  plain.frame.antialias = {};
  std::vector<Scene> passes;
  if (antialias.kind == Antialias::Kind::supersample) {
    const int n = antialias.factor;
    passes.push_back(plain);
    passes[0].frame.width = n * scene.frame.width;
    passes[0].frame.height = n * scene.frame.height;
    for (Draw& draw : passes[0].draws) {
      if (auto& box = draw.scissor) box = Scissor{n * box->x, n * box->y, n * box->width, n * box->height};
    }
  } else if (antialias.kind == Antialias::Kind::multisample) {
    for (int sample = 0; sample < static_cast<int>(kSamplePositions.size()); ++sample) {
      passes.push_back(plain);
      passes.back().frame.pass.sample = sample;
    }
  } else {
    for (const Filter& filter : kFilter) {  // vertices move against the samples
      passes.push_back(plain);
      passes.back().frame.pass.shift = -glm::dvec2(filter.shift_x, filter.shift_y);
    }
  }
  return passes;
}

std::vector<PixelShare> pixel_shares(const Antialias& antialias, int x, int y) {
  std::vector<PixelShare> shares;
  if (antialias.kind == Antialias::Kind::taps) {
    for (const Filter& filter : kFilter) {
      shares.push_back({shares.size(), {x, y}, static_cast<int>(1000 * filter.weight + 0.5)});
    }
  } else if (antialias.kind == Antialias::Kind::multisample) {
    for (std::size_t sample = 0; sample < kSamplePositions.size(); ++sample) shares.push_back({sample, {x, y}, 1});
  } else {
    const int n = antialias.kind == Antialias::Kind::supersample ? antialias.factor : 1;
    for (int i = 0; i < n * n; ++i) shares.push_back({0, {n * x + i % n, n * y + i / n}, 1});
  }
  return shares;
}

}  // namespace plumbline::math
