#include "pipeline/assemble.h"

#include <algorithm>

#include "scene/antialias.h"

namespace plumbline::pipeline {

namespace {

class Assembler {
 public:
  Assembler(Chunk& chunk, const Painting& painting) : chunk_(chunk), painting_(painting), vertices_(painting.vertices) {
    const auto tiles = static_cast<std::size_t>(painting.columns * painting.rows);
    chunk.first.assign(tiles + 1, 0);
    chunk.draws.clear();
    chunk.count = 0;
    chunk.any_far = false;
    least_ = most_ = painting.samples[0];
    for (const glm::ivec2& sample : painting.samples) {
      least_ = glm::min(least_, sample);
      most_ = glm::max(most_, sample);
    }
  }

  // Three more corners make a triangle.
  void reserve(std::size_t more) {
    triangles_ = chunk_.triangles.of(chunk_.count + more, chunk_.count);
    boxes_ = chunk_.boxes.of(chunk_.count + more, chunk_.count);
  }

  void add_filled(Cull cull, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const glm::ivec2 p = vertices_[a].snapped, q = vertices_[b].snapped, r = vertices_[c].snapped;
    const std::int64_t area =
        static_cast<std::int64_t>(q.x - p.x) * (r.y - p.y) - static_cast<std::int64_t>(q.y - p.y) * (r.x - p.x);
    const bool front = area > 0;
    if (area == 0 || (cull != Cull::none && front == (cull == Cull::front))) return;
    const int reach = 0;
    add({{a, b, c}, front, 3, 1}, std::min({p.x, q.x, r.x}), std::min({p.y, q.y, r.y}), std::max({p.x, q.x, r.x}),
        std::max({p.y, q.y, r.y}), reach);
  }

  void add_other(const WindowTriangle<float>& t, std::uint32_t first_corner) {
    const auto& v = t.v;
    const auto [x0, x1] = std::minmax({v[0].snapped.x, v[1].snapped.x, v[2].snapped.x});
    const auto [y0, y1] = std::minmax({v[0].snapped.y, v[1].snapped.y, v[2].snapped.y});
    add({{first_corner, first_corner + 1, first_corner + 2},
         t.front,
         static_cast<std::uint8_t>(t.corners),
         static_cast<std::uint16_t>(t.width)},
        x0, y0, x1, y1, t.corners < 3 ? static_cast<int>(t.width) : 0);
  }

  void end_draw(std::uint32_t draw) {
    if (chunk_.count > (chunk_.draws.empty() ? 0 : chunk_.draws.back().end))
      chunk_.draws.push_back({draw, chunk_.count});
  }

  // A counting sort: numbers ascend within each tile.
  void fill_bins() {
    std::vector<std::uint32_t>& first = chunk_.first;
    std::uint32_t sum = 0;
    for (std::uint32_t& f : first) sum += std::exchange(f, sum);
    std::uint32_t* numbers = chunk_.numbers.of(sum);
    for (std::uint32_t n = 0; n < chunk_.count; ++n) {
      const TileBox box = boxes_[n];
      for (int y = box.y0; y <= box.y1; ++y) {
        for (int x = box.x0; x <= box.x1; ++x)
          numbers[first[static_cast<std::size_t>(y * painting_.columns + x)]++] = n;
      }
    }
    // Each tile's first number has moved to the next tile's.
    for (std::size_t t = first.size() - 1; t > 0; --t) first[t] = first[t - 1];
    first[0] = 0;
  }

 private:
  void add(const PaintTriangle& triangle, int x_min, int y_min, int x_max, int y_max, int reach) {
    // The pixels whose centres the box holds (coverage.h, pixel_bounds).
    const auto up = [](int snapped) { return (snapped + kSubpixel - 1) >> 8; };
    const auto down = [](int snapped) { return snapped >> 8; };
    const int x0 = std::max(up(x_min - most_.x) - reach, 0), y0 = std::max(up(y_min - most_.y) - reach, 0);
    const int x1 = std::min(down(x_max - least_.x) + reach, painting_.format.width - 1),
              y1 = std::min(down(y_max - least_.y) + reach, painting_.format.height - 1);
    if (x0 > x1 || y0 > y1) return;
    constexpr std::int64_t kLongestEdge = 1 << 22;  // set_up_lanes.h
    chunk_.any_far |= std::int64_t{x_max} - x_min > kLongestEdge || std::int64_t{y_max} - y_min > kLongestEdge;
    const TileBox box{static_cast<std::uint8_t>(x0 / kTile), static_cast<std::uint8_t>(y0 / kTile),
                      static_cast<std::uint8_t>(x1 / kTile), static_cast<std::uint8_t>(y1 / kTile)};
    triangles_[chunk_.count] = triangle;
    boxes_[chunk_.count++] = box;
    for (int y = box.y0; y <= box.y1; ++y) {
      for (int x = box.x0; x <= box.x1; ++x) ++chunk_.first[static_cast<std::size_t>(y * painting_.columns + x)];
    }
  }

  Chunk& chunk_;
  const Painting& painting_;
  const WindowVertex<float>* vertices_;
  PaintTriangle* triangles_ = nullptr;
  TileBox* boxes_ = nullptr;
  glm::ivec2 least_, most_;  // of the samples
};

}  // namespace

void assemble(Chunk& chunk, std::span<const AssemblyWork> draws, std::span<const OtherTriangles> others,
              const Painting& painting) {
  Assembler to(chunk, painting);
  for (std::size_t d = 0; d < draws.size(); ++d) {
    const AssemblyWork& work = draws[d];
    const std::uint32_t begin = std::max(chunk.first_primitive, work.range.first_primitive);
    const std::uint32_t end = std::min(chunk.end_primitive, work.range.first_primitive + work.range.primitive_count);
    if (begin >= end) continue;
    const auto of_primitive = [&](std::uint32_t primitive) {
      return std::partition_point(others[d].triangles.begin(), others[d].triangles.end(),
                                  [&](const WindowTriangle<float>& t) { return t.primitive < primitive; });
    };
    auto other = of_primitive(begin);
    const auto others_end = of_primitive(end);
    to.reserve(end - begin + static_cast<std::size_t>(others_end - other));
    const auto add_others = [&](std::uint32_t up_to) {
      for (; other != others_end && other->primitive <= up_to; ++other) {
        const auto number = static_cast<std::uint32_t>(other - others[d].triangles.begin());
        to.add_other(*other, others[d].first_vertex + 3 * number);
      }
    };
    for (std::uint32_t primitive = begin; work.outside != nullptr && primitive < end; ++primitive) {
      const glm::uvec3& corner = work.mesh->triangles[primitive - work.range.first_primitive];
      const std::uint8_t a = work.outside[corner[0]], b = work.outside[corner[1]], c = work.outside[corner[2]];
      const unsigned any = a | b | c;
      if (any == 0) {
        to.add_filled(work.draw->cull, work.first_vertex + corner[1], work.first_vertex + corner[2],
                      work.first_vertex + corner[0]);
        continue;
      }
      if ((any & kNotFinite) != 0 || (a & b & c & work.planes) != 0) continue;
      if ((any & work.planes) != 0) {
        add_others(primitive);
      } else if ((any & kNotDrawable) == 0) {  // violates planes only that do not cut
        to.add_filled(work.draw->cull, work.first_vertex + corner[1], work.first_vertex + corner[2],
                      work.first_vertex + corner[0]);
      }
    }
    add_others(end);
    to.end_draw(static_cast<std::uint32_t>(d));
  }
  to.fill_bins();
}

}  // namespace plumbline::pipeline
