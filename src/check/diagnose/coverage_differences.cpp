#include "check/diagnose/coverage_differences.h"

#include <algorithm>

#include <fmt/format.h>

#include "check/compare/compare_records.h"

namespace plumbline::check {

std::vector<CoverageDifference> coverage_differences(const Evidence& e) {
  std::vector<CoverageDifference> out;
  CoverageDifference now;
  const auto end = [&] {
    if (!now.missing.empty() || !now.extra.empty()) out.push_back(std::move(now));
    now = {};
  };
  each_covered(e.candidate.records.covered, e.expected.records.covered, [&](const Covered& c, bool has, bool should) {
    if (c.triangle != now.triangle) end();
    now.triangle = c.triangle;
    (has && should ? now.both : has ? now.extra : now.missing).emplace_back(c.x, c.y);
  });
  end();
  return out;
}

std::optional<CoverageDifference> worst_triangle(const Evidence& e, const Place& worst) {
  std::vector<CoverageDifference> all = coverage_differences(e);
  if (all.empty()) return std::nullopt;
  const glm::ivec2 pixel(worst.x, worst.y);
  const auto is_there = [&](const CoverageDifference& d) {
    return std::ranges::count(d.missing, pixel) + std::ranges::count(d.extra, pixel) > 0;
  };
  if (std::ranges::any_of(all, is_there)) std::erase_if(all, [&](const auto& d) { return !is_there(d); });
  return *std::ranges::max_element(all, {}, [](const auto& d) { return d.missing.size() + d.extra.size(); });
}

std::string coverage_picture(const CoverageDifference& t) {
  constexpr glm::ivec2 kLargest(64, 32);
  glm::ivec2 low(1 << 30), high(0);
  for (const auto* pixels : {&t.both, &t.missing, &t.extra}) {
    for (const glm::ivec2 p : *pixels) low = glm::min(low, p), high = glm::max(high, p);
  }
  // Cut about the first pixel that differs.
  const glm::ivec2 about = t.missing.empty() ? t.extra.front() : t.missing.front();
  const glm::ivec2 from = glm::clamp(about - kLargest / 2, low, glm::max(high - kLargest + 1, low));
  const glm::ivec2 size = glm::min(high - from + 1, kLargest);
  std::vector<std::string> rows(static_cast<std::size_t>(size.y), std::string(static_cast<std::size_t>(size.x), '.'));
  const auto draw = [&](const std::vector<glm::ivec2>& pixels, char mark) {
    for (const glm::ivec2 p : pixels) {
      const glm::ivec2 q = p - from;
      if (q.x < 0 || q.y < 0 || q.x >= size.x || q.y >= size.y) continue;
      rows[static_cast<std::size_t>(q.y)][static_cast<std::size_t>(q.x)] = mark;
    }
  };
  draw(t.both, '#');
  draw(t.missing, '?');
  draw(t.extra, '!');
  std::string out = fmt::format("triangle {}: {} missing (?), {} extra (!); lower left is pixel {},{}\n", t.triangle,
                                t.missing.size(), t.extra.size(), from.x, from.y);
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) out += *row + "\n";
  return out;
}

}  // namespace plumbline::check
