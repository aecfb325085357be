// Tie rule: which triangle of two owns a sample on their edge.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "learn/probe_scene.h"
#include "learn/prober.h"

namespace plumbline::learn {

namespace {

using C = Conventions;

// Coverage of one triangle.
Plane<glm::vec4> alone(Prober& prober, const std::string& name, int size, const std::array<ProbeCorner, 3>& triangle) {
  Scene scene = probe_frame(name, size, size);
  add_triangles(scene, std::span(&triangle, 1));
  return prober.draw(scene).color;
}

// Number of samples on the inner edges of a fan that no triangle, one, or several cover.
struct Shared {
  std::size_t none = 0, one = 0, more = 0;
};
Shared shared_edges(Prober& prober, glm::dvec2 sample) {
  constexpr int kFan = 16, kSpokes = 16;
  constexpr std::array<glm::ivec2, kSpokes> around = {{{6, 0},
                                                       {6, 3},
                                                       {6, 6},
                                                       {3, 6},
                                                       {0, 6},
                                                       {-3, 6},
                                                       {-6, 6},
                                                       {-6, 3},
                                                       {-6, 0},
                                                       {-6, -3},
                                                       {-6, -6},
                                                       {-3, -6},
                                                       {0, -6},
                                                       {3, -6},
                                                       {6, -6},
                                                       {6, -3}}};
  const glm::dvec2 middle = glm::dvec2(8) + sample;
  Plane<int> count(kFan, kFan);
  for (std::size_t i = 0; i < kSpokes; ++i) {
    const auto at = [&](glm::dvec2 p) { return ProbeCorner{{p, 0.5}, glm::vec4(1), {}}; };
    const Plane<glm::vec4> color =
        alone(prober, "fan", kFan,
              {at(middle), at(middle + glm::dvec2(around[i])), at(middle + glm::dvec2(around[(i + 1) % kSpokes]))});
    for (std::size_t k = 0; k < count.size(); ++k) count.values()[k] += is_white(color.values()[k]) ? 1 : 0;
  }
  Shared out;
  for (int y = -5; y <= 5; ++y) {
    for (int x = -5; x <= 5; ++x) {
      const auto on_spoke = [&](const glm::ivec2& end) { return x * end.y == y * end.x; };
      if (std::ranges::none_of(around, on_spoke)) continue;
      const int triangles = count(8 + x, 8 + y);
      ++(triangles == 0 ? out.none : triangles == 1 ? out.one : out.more);
    }
  }
  return out;
}

// True: the rule gives samples on an edge to the triangle that lies to its `inward` side.
bool owns(C::TieRule rule, glm::ivec2 inward) {
  const bool left = rule == C::TieRule::left_bottom || rule == C::TieRule::left_top,
             bottom = rule == C::TieRule::left_bottom || rule == C::TieRule::right_bottom;
  return inward.x != 0 ? (inward.x > 0) == left : (inward.y > 0) == bottom;
}

// Samples on a fan's edges of 1/5 to 4/5 pixel a row or column, over 30 of these: numbers that float rounds, so that
// edges that are stepped lie on either side of their samples.
struct Slanted {
  std::size_t all = 0, one = 0, by_rule = 0;
};
Slanted slanted_edges(Prober& prober, glm::dvec2 sample, C::TieRule rule) {
  constexpr int kFan = 64, kCentre = 32, kRadius = 30, kStep = 6;
  std::vector<glm::ivec2> around;
  for (int k = -kRadius; k < kRadius; k += kStep) around.emplace_back(kRadius, k);
  for (std::size_t i = 0; around.size() < 40; ++i) around.emplace_back(-around[i].y, around[i].x);  // a quarter turn on
  const auto at = [&](glm::ivec2 p) {
    return ProbeCorner{{glm::dvec2(kCentre + p.x, kCentre + p.y) + sample, 0.5}, glm::vec4(1), {}};
  };
  std::array<Plane<glm::vec4>, 2> color;  // of the triangles of even and of odd numbers, which share no edge
  for (std::size_t odd = 0; odd < 2; ++odd) {
    std::vector<std::array<ProbeCorner, 3>> triangles;
    for (std::size_t i = odd; i < around.size(); i += 2)
      triangles.push_back({at({0, 0}), at(around[i]), at(around[(i + 1) % around.size()])});
    Scene scene = probe_frame("slanted", kFan, kFan);
    add_triangles(scene, triangles);
    color[odd] = prober.draw(scene).color;
  }
  Slanted out;
  for (std::size_t i = 0; i < around.size(); ++i) {  // between triangles i - 1 and i
    const glm::ivec2 to = around[i];
    if (to.x == 0 || to.y == 0 || std::abs(to.x) == std::abs(to.y)) continue;  // of the other fan
    for (int k = 1; k < kRadius / 5; ++k) {
      const glm::ivec2 pixel = kCentre + to * k / (kRadius / 5);
      const bool mine = is_white(color[i % 2](pixel.x, pixel.y)), before = is_white(color[1 - i % 2](pixel.x, pixel.y));
      ++out.all;
      out.one += mine != before;
      out.by_rule += mine != before && mine == owns(rule, {-to.y, to.x});
    }
  }
  return out;
}

}  // namespace

void learn_ties(Prober& prober) {
  const ConventionWords words = words_of("tie_rule");
  C& c = prober.learned.conventions;
  if (prober.is_open(kSampleWords.name)) return prober.open(words, "the sample's place is open");
  const double steps = c.subpixel_bits == C::kFloat ? 1024 : std::ldexp(1.0, c.subpixel_bits);
  if (c.sample * steps != glm::round(c.sample * steps)) {
    return prober.open(words, "no edge can be laid through a sample: its place is not on the grid");
  }
  Scene scene = probe_frame("edges", 16, 16);
  add_triangles(scene, rectangle(glm::dvec2(3) + c.sample, glm::dvec2(9) + c.sample, 0.5, glm::vec4(1)));
  const Plane<glm::vec4> color = prober.draw(scene).color;
  const bool left = is_white(color(3, 6)), right = is_white(color(9, 6)), bottom = is_white(color(6, 3)),
             top = is_white(color(6, 9));
  const Shared shared = shared_edges(prober, c.sample);
  const std::size_t all = shared.none + shared.one + shared.more;
  const std::string evidence = fmt::format("{} of {} samples on a fan's edges are in one triangle", shared.one, all);
  using enum C::TieRule;
  if (shared.one == all) {
    const bool by_sides = left != right && bottom != top;
    const C::TieRule rule = left ? (bottom ? left_bottom : left_top) : (bottom ? right_bottom : right_top);
    const Slanted slanted = slanted_edges(prober, c.sample, rule);
    if (slanted.one < slanted.all) {
      return prober.fits_none(words, fmt::format("{} of {} samples on a fan's slanted edges are in one triangle, the "
                                                 "others in none or in both",
                                                 slanted.one, slanted.all));
    }
    c.tie_rule = by_sides && slanted.by_rule == slanted.all ? rule : any;
    const std::string of_slanted =
        by_sides ? fmt::format("; {} of {} on slanted ones go by {}", slanted.by_rule, slanted.all, name_of(rule)) : "";
    return prober.found(words, name_of(c.tie_rule), evidence + of_slanted);
  } else if (left && right && bottom && top && shared.none == 0) {
    c.tie_rule = inclusive;
  } else if (!left && !right && !bottom && !top && shared.more == 0) {
    c.tie_rule = exclusive;
  } else {
    return prober.fits_none(
        words, fmt::format("of {} samples on a fan's edges, {} are in no triangle (cracks), {} in several", all,
                           shared.none, shared.more));
  }
  prober.found(words, name_of(c.tie_rule), evidence);
}

}  // namespace plumbline::learn
