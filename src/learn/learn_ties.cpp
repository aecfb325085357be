// Tie rule: which triangle of two owns a sample on their edge.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "learn/probe_scene.h"
#include "learn/prober.h"

namespace plumbline::learn {

namespace {

using C = Conventions;

constexpr std::array kRules = {C::TieRule::left_bottom, C::TieRule::left_top, C::TieRule::right_bottom,
                               C::TieRule::right_top};

// True: the rule gives samples on an edge to a triangle into which the vector `inward` points from that edge.
bool owns(C::TieRule rule, glm::ivec2 inward) {
  const bool left = rule == C::TieRule::left_bottom || rule == C::TieRule::left_top,
             bottom = rule == C::TieRule::left_bottom || rule == C::TieRule::right_bottom;
  return inward.x != 0 ? (inward.x > 0) == left : (inward.y > 0) == bottom;
}

// Samples on edges between two triangles, by how many of the two cover them.
struct Samples {
  std::size_t none = 0, one = 0, both = 0;
  std::size_t all() const { return none + one + both; }
};
struct FanEdges {
  Samples samples, straight;             // all; of them, those on horizontal and vertical edges
  std::array<std::size_t, 4> by_rule{};  // of samples.one, how many each of kRules gives to their triangle
  void add(const FanEdges& other) {
    const auto sum = [](Samples& to, const Samples& of) { to.none += of.none, to.one += of.one, to.both += of.both; };
    sum(samples, other.samples), sum(straight, other.straight);
    for (std::size_t r = 0; r < by_rule.size(); ++r) by_rule[r] += other.by_rule[r];
  }
};

// A fan about a hub, out to a square of side 2 radius, whose edges pass through samples.
struct Fan {
  glm::dvec2 hub;  ///< from the lower left corner of the pixel in the middle [pixels]
  int radius;      ///< [pixels]
  double first;    ///< place of an edge's first sample, of equal parts from the hub to the square
};
// Hub at a sample: edges are straight, diagonal, and of 1/5 to 4/5 pixel a row or column. Float rounds these slopes, so
// that edges that are stepped lie on either side of their samples.
Fan through_samples(glm::dvec2 sample) { return {sample, 30, 1}; }
// Whole pixels, and samples at centres: edges to corners that are an odd number of pixels away in x and in y pass
// through centres half way. No level or upright edge does.
constexpr Fan kThroughCentres{glm::dvec2(0), 27, 0.5};

enum class Turn { counter_clockwise, clockwise };

// Samples on the edges of a fan, of 40 triangles or 36.
FanEdges fan_edges(Prober& prober, const Fan& fan, Turn turn) {
  constexpr int kFan = 64, kCentre = 32, kStep = 6;
  std::vector<glm::ivec2> around;
  for (int k = -fan.radius; k < fan.radius; k += kStep) around.emplace_back(fan.radius, k);
  const std::size_t all = 4 * around.size();
  for (std::size_t i = 0; around.size() < all; ++i)
    around.emplace_back(-around[i].y, around[i].x);  // a quarter turn on
  const auto at = [&](glm::ivec2 p) {
    return ProbeCorner{{glm::dvec2(kCentre + p.x, kCentre + p.y) + fan.hub, kFlatDepth}, glm::vec4(1), {}};
  };
  std::array<Plane<glm::vec4>, 2> color;  // of the triangles of even and of odd numbers, which share no edge
  for (std::size_t odd = 0; odd < 2; ++odd) {
    std::vector<std::array<ProbeCorner, 3>> triangles;
    for (std::size_t i = odd; i < around.size(); i += 2) {
      std::array<ProbeCorner, 3> t = {at({0, 0}), at(around[i]), at(around[(i + 1) % around.size()])};
      if (turn == Turn::clockwise) std::swap(t[1], t[2]);
      std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(i / 2 % 3),
                  t.end());  // rules may go by corners' order
      triangles.push_back(t);
    }
    Scene scene = probe_frame("fan", kFan, kFan);
    add_triangles(scene, triangles);
    color[odd] = prober.draw(scene).color;
  }
  FanEdges out{};
  for (std::size_t i = 0; i < around.size(); ++i) {  // between triangles i - 1 and i
    const glm::ivec2 to = around[i];
    const int parts = std::gcd(to.x, to.y);
    for (double k = fan.first; k < parts; ++k) {
      const glm::ivec2 pixel = glm::floor(static_cast<double>(kCentre) + k * glm::dvec2(to / parts));
      const bool mine = is_white(color[i % 2](pixel.x, pixel.y)), before = is_white(color[1 - i % 2](pixel.x, pixel.y));
      const auto count = [&](Samples& s) { ++(mine != before ? s.one : mine ? s.both : s.none); };
      count(out.samples);
      if (to.x == 0 || to.y == 0) count(out.straight);
      for (std::size_t r = 0; r < kRules.size(); ++r)
        out.by_rule[r] += mine != before && mine == owns(kRules[r], {-to.y, to.x});
    }
  }
  return out;
}

}  // namespace

void learn_ties(Prober& prober) {
  const ConventionWords words = words_of("tie_rule");
  C& c = prober.learned.conventions;
  if (prober.open_if_any_open(words, {kSampleWords.name})) return;
  const double steps = c.subpixel_bits == C::kFloat ? 1024 : std::ldexp(1.0, c.subpixel_bits);
  const bool is_between = c.subpixel_bits == 0 && c.sample == glm::dvec2(0.5);
  if (!is_between && c.sample * steps != glm::round(c.sample * steps)) {
    return prober.open(words, "no edge can be laid through a sample: its place is not on the grid");
  }
  const Fan fan = is_between ? kThroughCentres : through_samples(c.sample);
  FanEdges found = fan_edges(prober, fan, Turn::counter_clockwise);
  // Rules may go by edges' directions. A renderer that drops back faces shows none of them.
  const FanEdges clockwise = fan_edges(prober, fan, Turn::clockwise);
  if (clockwise.samples.none < clockwise.samples.all()) found.add(clockwise);
  const auto& [samples, straight, by_rule] = found;
  const std::size_t best = static_cast<std::size_t>(std::ranges::max_element(by_rule) - by_rule.begin());
  std::string evidence =
      fmt::format("{} of {} samples on a fan's edges are in one triangle", samples.one, samples.all());
  if (samples.one == samples.all()) {
    c.tie_rule = by_rule[best] == samples.one ? kRules[best] : C::TieRule::any;
    evidence += fmt::format(", {} by {}", by_rule[best], name_of(kRules[best]));
    if (is_between) evidence += "; no level edge passes through a sample";
    if (c.tie_rule == C::TieRule::any)
      evidence += ": no rule: edges stepped in float, or a rule by corners' order or edges' directions";
  } else if (straight.both == straight.all() && samples.none == 0) {
    c.tie_rule = C::TieRule::inclusive;
  } else if (straight.none == straight.all() && samples.both == 0) {
    c.tie_rule = C::TieRule::exclusive;
  } else {
    return prober.fits_none(
        words, fmt::format("of {} samples on a fan's edges, {} are in no triangle (cracks), {} in both", samples.all(),
                           samples.none, samples.both));
  }
  prober.found(words, name_of(c.tie_rule), evidence);
}

}  // namespace plumbline::learn
