#include "pipeline/window.h"

#include <cmath>

namespace plumbline::pipeline {

namespace {

WindowVertex window_vertex(const Matrices<float>& m, const ClipVertex& in) {
  WindowVertex out{};
  out.inv_w = 1.0f / in.p_clip.w;
  for (int i = 0; i < 3; ++i) {
    const float p_ndc = in.p_clip[i] * out.inv_w;
    out.p_win[i] =
        in.cut ? p_ndc * m.win_scale[i] + m.win_translate[i] : std::fma(p_ndc, m.win_scale[i], m.win_translate[i]);
  }
  return out;
}

// Finite, and near enough to be snapped to an int; after clipping all are, unless w is 0.
bool drawable(const WindowVertex& v) {
  constexpr float kFarthest = 1 << 20;
  return std::abs(v.p_win.x) <= kFarthest && std::abs(v.p_win.y) <= kFarthest && std::isfinite(v.p_win.z) &&
         std::isfinite(v.inv_w);
}

// A polygon in the window, which becomes triangles.
class Fan {
 public:
  Fan(const DrawInput& input, const Polygon& polygon, std::vector<ShadedTriangle>& out)
      : input_(input), draw_(*input.draw), polygon_(polygon), out_(out) {
    for (const ClipVertex& corner : polygon.corners) {
      WindowVertex v = window_vertex(input.matrices, corner);
      drawable_ &= drawable(v);
      if (drawable_) v.snapped = {snap(v.p_win.x), snap(v.p_win.y)};
      v_.push_back(v);
    }
  }

  void add_triangles() {
    if (!drawable_ || v_.empty()) return;
    if (v_.size() == 1) return add_point(0, true);
    if (v_.size() == 2) return add_line(0, 1, true);
    visit_polygon(
        draw_, v_.size(),
        [&](std::size_t i) {
          return snapped_area({{v_[i - 1], v_[i], v_[0]}});
        },
        [&](std::size_t i, bool front) { add(triangle(i - 1, i, 0, front), 3, 1); },
        [&](std::size_t a, std::size_t b, bool front) { add_line(a, b, front); },
        [&](std::size_t p, bool front) { add_point(p, front); });
  }

 private:
  ShadedTriangle triangle(std::size_t a, std::size_t b, std::size_t c, bool front) const {
    ShadedTriangle out{{{v_[a], v_[b], v_[c]}, polygon_.primitive, front}, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      Attributes& to = out.attributes[k];
      to = polygon_.corners[k == 0 ? a : k == 1 ? b : c].attributes;
      if (front || !input_.two_sided) continue;
      to.color() = to[Varying::back_color];
      to[Varying::secondary] = to[Varying::back_secondary];
    }
    return out;
  }
  void add(ShadedTriangle triangle, std::uint32_t corners, int width) {
    triangle.corners = corners;
    triangle.width = static_cast<std::uint32_t>(width);
    out_.push_back(triangle);
  }
  void add_line(std::size_t a, std::size_t b, bool front) { add(triangle(a, b, b, front), 2, draw_.line_width); }
  void add_point(std::size_t p, bool front) { add(triangle(p, p, p, front), 1, draw_.point_size); }

  const DrawInput& input_;
  const Draw& draw_;
  const Polygon& polygon_;
  bool drawable_ = true;
  FixedVector<WindowVertex, Polygon::kMostCorners> v_;
  std::vector<ShadedTriangle>& out_;
};

}  // namespace

void to_window(const DrawInput& input, const Polygon& polygon, std::vector<ShadedTriangle>& out) {
  Fan(input, polygon, out).add_triangles();
}

}  // namespace plumbline::pipeline
