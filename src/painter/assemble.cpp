#include "painter/assemble.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "scene/antialias.h"

namespace plumbline::pipeline {

namespace {

class Assembler {
 public:
  Assembler(Chunk& chunk, const Painting& painting) : chunk_(chunk), painting_(painting), snapped_(painting.snapped) {
    chunk.draws.clear();
    chunk.count = 0;
    chunk.any_long_edge = false;
    std::tie(least_, most_) = painting.sample_bounds();
  }

  void reserve(std::size_t more) {
    triangles_ = room_for(chunk_.count + more, chunk_.triangles);
    boxes_ = room_for(chunk_.count + more, chunk_.boxes);
  }

  // A triangle (filled, or its edges or corners), line or point; `v`: indices of snapped_.
  void add_primitive(const Draw& draw, Topology topology, const std::uint32_t (&v)[3]) {
    if (topology == Topology::points) return add_point(draw, v[0], true);
    if (topology == Topology::lines) return add_line(draw, v[0], v[1], true);
    const auto snapped = [&](std::size_t i) { return glm::i64vec2(snapped_[v[i]]); };
    const glm::i64vec2 q = snapped(1) - snapped(0), r = snapped(2) - snapped(0);
    const auto add_filled = [&](std::size_t, bool front) { add({{v[1], v[2], v[0]}, front, 3, 1}, 0); };
    visit_polygon(
        draw, 3, [&](std::size_t) { return q.x * r.y - q.y * r.x; }, add_filled,
        [&](std::size_t a, std::size_t b, bool front) { add_line(draw, v[a], v[b], front); },
        [&](std::size_t p, bool front) { add_point(draw, v[p], front); });
  }

  void add_kept(const AssemblyWork& of, const glm::uvec3& v, const KeptTriangle& kept) {
    const std::uint32_t first = of.range.first_vertex;
    triangles_[chunk_.count] = {{first + v[1], first + v[2], first + v[0]}, kept.kept == Kept::front, 3, 1};
    boxes_[chunk_.count] = kept.box;
    chunk_.count += kept.kept != Kept::none;  // without a branch
  }

  void add_other(const ShadedTriangle& t, std::uint32_t first_corner) {
    add({{first_corner, first_corner + 1, first_corner + 2},
         t.front,
         static_cast<std::uint8_t>(t.corners),
         static_cast<std::uint16_t>(t.width)},
        t.corners < 3 ? static_cast<int>(t.width) : 0);
  }

  // Counting sort of triangles by tile: numbers ascend within each tile.
  void fill_bins() {
    std::vector<std::uint32_t>& first = chunk_.first;
    first.assign(static_cast<std::size_t>(painting_.columns * painting_.rows) + 1, 0);
    const auto each_tile = [&](TileBox box, auto visit) {
      for (int y = box.y0; y <= box.y1; ++y) {
        for (int x = box.x0; x <= box.x1; ++x) visit(first[static_cast<std::size_t>(y * painting_.columns + x)]);
      }
    };
    for (std::uint32_t n = 0; n < chunk_.count; ++n) each_tile(boxes_[n], [](std::uint32_t& count) { ++count; });
    std::uint64_t sum = 0;
    for (std::uint32_t& f : first) sum += std::exchange(f, static_cast<std::uint32_t>(sum));
    if (sum > std::numeric_limits<std::uint32_t>::max()) {
      throw std::length_error("triangles that touch more tiles together than 2^32");
    }
    std::uint32_t* numbers = room_for(sum, chunk_.numbers);
    for (std::uint32_t n = 0; n < chunk_.count; ++n) {
      each_tile(boxes_[n], [&](std::uint32_t& next) { numbers[next++] = n; });
    }
    // Filling has advanced each tile's `first` to the next tile's: shift the array back by one entry.
    for (std::size_t t = first.size() - 1; t > 0; --t) first[t] = first[t - 1];
    first[0] = 0;
  }

 private:
  void add_line(const Draw& draw, std::uint32_t a, std::uint32_t b, bool front) {
    add({{a, b, b}, front, 2, static_cast<std::uint16_t>(draw.line_width)}, draw.line_width);
  }
  void add_point(const Draw& draw, std::uint32_t p, bool front) {
    add({{p, p, p}, front, 1, static_cast<std::uint16_t>(draw.point_size)}, draw.point_size);
  }

  void add(const PaintTriangle& triangle, int reach) {
    const auto& [a, b, c] = triangle.corner;
    const glm::ivec2 p = snapped_[a], q = snapped_[b], r = snapped_[c];
    const auto [x_min, x_max] = std::minmax({p.x, q.x, r.x});
    const auto [y_min, y_max] = std::minmax({p.y, q.y, r.y});
    // The pixels whose centres the box holds (coverage.h, pixel_bounds).
    const auto up = [](int snapped) { return (snapped + kSubpixel - 1) >> 8; };
    const auto down = [](int snapped) { return snapped >> 8; };
    const int x0 = std::max(up(x_min - most_.x) - reach, 0), y0 = std::max(up(y_min - most_.y) - reach, 0);
    const int x1 = std::min(down(x_max - least_.x) + reach, painting_.format.width - 1),
              y1 = std::min(down(y_max - least_.y) + reach, painting_.format.height - 1);
    if (x0 > x1 || y0 > y1) return;
    chunk_.any_long_edge |= std::int64_t{x_max} - x_min > kLongestEdge || std::int64_t{y_max} - y_min > kLongestEdge;
    const TileBox box{static_cast<std::uint8_t>(x0 / kTile), static_cast<std::uint8_t>(y0 / kTile),
                      static_cast<std::uint8_t>(x1 / kTile), static_cast<std::uint8_t>(y1 / kTile)};
    triangles_[chunk_.count] = triangle;
    boxes_[chunk_.count++] = box;
  }

  Chunk& chunk_;
  const Painting& painting_;
  const glm::ivec2* snapped_;
  PaintTriangle* triangles_ = nullptr;
  TileBox* boxes_ = nullptr;
  glm::ivec2 least_, most_;  // of the samples
};

}  // namespace

void assemble(Chunk& chunk, std::span<const AssemblyWork> draws, const OtherTriangles& others, const Painting& painting,
              CullTriangles cull) {
  Assembler to(chunk, painting);
  for (std::size_t d = 0; d < draws.size(); ++d) {
    const AssemblyWork& work = draws[d];
    const std::uint32_t begin = std::max(chunk.first_primitive, work.range.first_primitive);
    const std::uint32_t end = std::min(chunk.end_primitive, work.range.first_primitive + work.range.primitive_count);
    if (begin >= end) continue;
    const auto of_primitive = [&](std::uint32_t primitive) {
      return std::ranges::lower_bound(others.triangles, primitive, {}, &ShadedTriangle::primitive);
    };
    auto other = of_primitive(begin);
    const auto others_end = of_primitive(end);
    const bool filled = is_filled(*work.draw);
    to.reserve((filled ? 1 : 3) * std::size_t{end - begin} + static_cast<std::size_t>(others_end - other));
    const auto add_others = [&](std::uint32_t up_to) {
      for (; other != others_end && other->primitive <= up_to; ++other) {
        const auto number = static_cast<std::uint32_t>(other - others.triangles.begin());
        to.add_other(*other, others.first_vertex + 3 * number);
      }
    };
    const std::span<const glm::uvec3> corners =
        std::span(work.mesh->triangles).subspan(begin - work.range.first_primitive, end - begin);
    const bool all_inside = (work.any_outside & (work.planes | kNotFinite | kNotDrawable)) == 0;
    // Calls add(i) for primitives wholly in the view volume, and add_others() in a clipped one's place.
    const auto each_inside = [&](std::size_t from, std::size_t to_end, auto add) {
      for (std::size_t i = from; i < to_end && all_inside; ++i) add(i);
      for (std::size_t i = from; i < to_end && !all_inside; ++i) {
        const glm::uvec3& corner = corners[i];
        const unsigned a = work.outside[corner[0]], b = work.outside[corner[1]], c = work.outside[corner[2]];
        const unsigned any = a | b | c;
        if ((any & kNotFinite) != 0 || (a & b & c & work.planes) != 0) continue;
        if ((any & work.planes) != 0) {
          add_others(begin + static_cast<std::uint32_t>(i));
        } else if ((any & kNotDrawable) == 0) {
          add(i);
        }
      }
    };
    if (work.outside != nullptr && filled && work.mesh->topology == Topology::triangles) {
      constexpr std::size_t kMost = 256;
      KeptTriangle kept[kMost];
      for (std::size_t from = 0; from < corners.size(); from += kMost) {
        const auto some = corners.subspan(from, std::min(kMost, corners.size() - from));
        cull(painting, work, some, kept);
        each_inside(from, from + some.size(), [&](std::size_t i) { to.add_kept(work, corners[i], kept[i - from]); });
      }
    } else if (work.outside != nullptr) {
      const std::uint32_t first = work.range.first_vertex;
      each_inside(0, corners.size(), [&](std::size_t i) {
        const glm::uvec3 v = first + corners[i];
        to.add_primitive(*work.draw, work.mesh->topology, {v[0], v[1], v[2]});
      });
    }
    add_others(end);
    if (chunk.count > (chunk.draws.empty() ? 0 : chunk.draws.back().end))
      chunk.draws.push_back({static_cast<std::uint32_t>(d), chunk.count});
  }
  to.fill_bins();
}

}  // namespace plumbline::pipeline
