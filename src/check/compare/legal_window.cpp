#include "check/compare/legal_window.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "check/bounds/matched_by_primitive.h"
#include "check/bounds/units.h"
#include "check/verdict/ledger.h"

namespace plumbline::check {

// A polygon's corner in the window. `error`: of p_win, per coordinate.
struct WindowCorner {
  WindowVertex<double> vertex;
  Vec4<double> back_color;
  Vec3<double> error;
};

namespace {

// Box in which a corner may lie: its centre and half its size.
struct Spot {
  Vec2<double> middle, reach;
};

// Grid positions [the grid's steps] of p_win within its error (rounded down or up: plus kOfFixedPoint).
Spot snapped_spot(const WindowCorner& c, const Conventions& grid) {
  const bool is_to_nearest = grid.subpixel_rounding == Conventions::Rounding::nearest;
  Spot out{};
  for (int k = 0; k < 2; ++k) {
    const double at = c.vertex.p_win[k], error = c.error[k] + (is_to_nearest ? 0 : kOfFixedPoint),
                 least = on_grid(grid, k, at - error), most = on_grid(grid, k, at + error);
    out.middle[k] = (least + most) / 2;
    out.reach[k] = (most - least) / 2;
  }
  return out;
}

// Interval of twice the signed area.
struct Area {
  double least, most;
};

// Area of the polygon through the spots: sum of m_i x m_(i+1), from the first corner on. Where corner i moves by h_i,
// it changes by at most sum |h_i| |m_(i+1) - m_(i-1)| + |h_i| |h_(i+1)|, taken per coordinate. `rounding`: relative
// error of the products' sum in the arithmetic of whoever decides.
Area area_of(std::span<const Spot> spots, double rounding) {
  double area = 0, terms = 0, moved = 0;
  const std::size_t n = spots.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Spot &before = spots[(i + n - 1) % n], &at = spots[i], &next = spots[(i + 1) % n];
    const Vec2<double> p = at.middle - spots[0].middle, q = next.middle - spots[0].middle;
    area += p.x * q.y - p.y * q.x;
    terms += std::abs(p.x * q.y) + std::abs(p.y * q.x);
    const Vec2<double> across = glm::abs(next.middle - before.middle);
    moved += at.reach.x * across.y + at.reach.y * across.x + at.reach.x * next.reach.y + at.reach.y * next.reach.x;
  }
  moved += rounding * terms;
  return {area - moved, area + moved};
}

// In float: two differences, a product and a sum round, 4 u of the terms.
Area unsnapped_area(std::span<const WindowCorner> corners) {
  std::vector<Spot> spots;
  for (const WindowCorner& c : corners) spots.push_back({Vec2<double>(c.vertex.p_win), Vec2<double>(c.error)});
  return area_of(spots, 4 * u);
}

// Products of snapped coordinates are integers: sums below 2^52 are exact in double.
Area snapped_area(std::span<const WindowCorner> corners, const Conventions& grid) {
  if (grid.subpixel_bits == Conventions::kFloat) return unsnapped_area(corners);
  std::vector<Spot> spots;
  for (const WindowCorner& c : corners) spots.push_back(snapped_spot(c, grid));
  const Area exact = area_of(spots, 0);
  return std::max(std::abs(exact.least), std::abs(exact.most)) < 0x1p48 ? exact : area_of(spots, 0x1p-48);
}

// Area by equation 3.6 as it stands, in float: 2 n products of window positions, and their sum, round by 2 n u of the
// products (largest seen: 3.3 u of one product).
Area area_by_equation(std::span<const WindowCorner> corners) {
  const Area exact = unsnapped_area(corners);
  double products = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3<double>&p = corners[i].vertex.p_win, &q = corners[(i + 1) % corners.size()].vertex.p_win;
    products += std::abs(p.x * q.y) + std::abs(p.y * q.x);
  }
  const double off = 2 * static_cast<double>(corners.size()) * u * products;
  return {exact.least - off, exact.most + off};
}

// Areas that decide a facing by FacingArea::either.
Area either_area(std::span<const WindowCorner> corners, const Conventions& grid) {
  const Area snapped = snapped_area(corners, grid), plain = area_by_equation(corners);
  return {std::min(snapped.least, plain.least), std::max(snapped.most, plain.most)};
}

bool is_culled(Cull cull, bool front) { return cull == (front ? Cull::front : Cull::back); }

WindowAnswer answer_of(std::uint32_t primitive, std::uint32_t corners, int width, const WindowCorner& a,
                       const WindowCorner& b, const WindowCorner& c) {
  WindowAnswer out;
  out.record.v = {a.vertex, b.vertex, c.vertex};
  out.record.primitive = primitive;
  out.record.corners = corners;
  out.record.width = static_cast<std::uint32_t>(width);
  out.back_color = {a.back_color, b.back_color, c.back_color};
  return out;
}

// Fan of triangles, each faced and culled by itself; by FacingArea::either also as the whole polygon. One without area
// covers nothing, drawn or not, whatever its facing.
std::vector<WindowAnswer> fan(const Draw& draw, std::uint32_t primitive, std::span<const WindowCorner> corners,
                              const Conventions& grid, FacingArea of) {
  std::vector<WindowAnswer> out;
  const Area whole = of == FacingArea::either ? either_area(corners, grid) : Area{kInfinite, -kInfinite};
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const std::array<WindowCorner, 3> three = {corners[i - 1], corners[i], corners[0]};
    const Area area = snapped_area(three, grid), plain = of == FacingArea::either ? either_area(three, grid) : area;
    const double least = std::min(plain.least, whole.least), most = std::max(plain.most, whole.most);
    WindowAnswer answer = answer_of(primitive, 3, 1, three[0], three[1], three[2]);
    const bool front = most > 0, back = least < 0;
    answer.has_no_area = area.least == 0 && area.most == 0;
    const bool may_have_none = of == FacingArea::either ? area.least <= 0 && area.most >= 0 : answer.has_no_area;
    answer.front = may_have_none || (front && !is_culled(draw.cull, true));
    answer.back = may_have_none || (back && !is_culled(draw.cull, false));
    answer.absent = (least <= 0 && most >= 0) || answer.front != front || answer.back != back;
    out.push_back(answer);
  }
  return out;
}

// Edges or corners of a polygon of one facing.
std::vector<WindowAnswer> outline(const Draw& draw, std::uint32_t primitive, bool front,
                                  std::span<const WindowCorner> corners) {
  std::vector<WindowAnswer> out;
  const bool lines = (front ? draw.front_mode : draw.back_mode) == PolygonMode::line;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const WindowCorner &before = corners[(i + corners.size() - 1) % corners.size()], &at = corners[i];
    WindowAnswer answer = lines ? answer_of(primitive, 2, draw.line_width, before, at, at)
                                : answer_of(primitive, 1, draw.point_size, at, at, at);
    answer.front = answer.record.front = front;
    answer.back = !front;
    out.push_back(answer);
  }
  return out;
}

}  // namespace

LegalWindow::LegalWindow(const Scene& scene, const Records<double>& records, double factor, FacingArea area,
                         const Conventions& conventions)
    : scene_(scene), records_(records), factor_(factor), area_(area), conventions_(conventions), draws_(scene) {}

Vec3<double> LegalWindow::error(std::uint32_t primitive, const Vec3<double>& p_win) const {
  const Vec3<double>& t = records_.matrices[draws_.of_primitive(primitive).value()].win_translate;
  return factor_ * u * (glm::abs(p_win - t) + glm::abs(t));
}

std::vector<std::vector<WindowAnswer>> LegalWindow::of(std::uint32_t primitive) const {
  const std::span<const ClipPolygon> polygons =
      std::ranges::equal_range(records_.polygons.polygons, primitive, {}, &ClipPolygon::primitive);
  const auto number = draws_.of_primitive(primitive);
  if (polygons.empty() || !number || *number >= records_.matrices.size()) return {};
  const Draw& draw = scene_.draws[*number];
  if (is_filled(draw)) {
    std::vector<WindowAnswer> out;
    for (const ClipPolygon& polygon : polygons) {
      const auto corners = corners_of(polygon, *number);
      if (corners.empty()) return {};
      std::ranges::copy(fan(draw, primitive, corners, conventions_, area_), std::back_inserter(out));
    }
    return {out};
  }
  if (polygons.size() > 1) return {};
  const std::vector<WindowCorner> corners = corners_of(polygons.front(), *number);
  if (corners.empty()) return {};
  const Area area =
      area_ == FacingArea::either ? either_area(corners, conventions_) : snapped_area(corners, conventions_);
  std::vector<std::vector<WindowAnswer>> out;
  for (const bool front : {true, false}) {
    const bool legal = front ? area.most > 0 : area.least <= 0;
    if (!legal) continue;
    const PolygonMode mode = front ? draw.front_mode : draw.back_mode;
    if (is_culled(draw.cull, front)) {
      out.emplace_back();
    } else {
      out.push_back(mode == PolygonMode::fill ? fan(draw, primitive, corners, conventions_, area_)
                                              : outline(draw, primitive, front, corners));
    }
  }
  return out;
}

std::vector<WindowCorner> LegalWindow::corners_of(const ClipPolygon& polygon, std::size_t draw) const {
  const std::vector<ClipVertex<double>>& vertices = records_.polygons.vertices;
  if (polygon.count < 3 || std::size_t{polygon.first} + polygon.count > vertices.size()) return {};
  const Matrices<double>& m = records_.matrices[draw];
  const std::vector<Vec4<double>>& back = records_.varyings[Varying::back_color].clipped;
  const bool two_sided = carries(scene_, scene_.draws[draw], Varying::back_color) && back.size() == vertices.size();
  const Vec3<double> translate = m.win_translate + Vec3<double>(0.5 - conventions_.sample, 0);
  std::vector<WindowCorner> out;
  for (std::uint32_t i = polygon.first; i < polygon.first + polygon.count; ++i) {
    const ClipVertex<double>& v = vertices[i];
    WindowCorner& c = out.emplace_back();
    c.vertex = {Vec3<double>(v.p_clip) / v.p_clip.w * m.win_scale + translate, 1 / v.p_clip.w, {}, v.color};
    c.back_color = two_sided ? back[i] : v.color;
    c.error = error(polygon.primitive, c.vertex.p_win);
    const Vec3<double>& p = c.vertex.p_win;
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return {};
  }
  return out;
}

bool LegalWindow::fits(const WindowTriangle<double>& t, const WindowAnswer& answer) const {
  const WindowTriangle<double>& r = answer.record;
  if (t.corners != r.corners || t.width != r.width || !(t.front ? answer.front : answer.back)) return false;
  const auto near = [&](const WindowVertex<double>& a, const WindowVertex<double>& b) {
    const Vec3<double> error = this->error(r.primitive, b.p_win);
    for (int c = 0; c < 3; ++c) {
      if (!(std::abs(a.p_win[c] - b.p_win[c]) <= error[c])) return false;
    }
    return std::abs(a.inv_w - b.inv_w) <= factor_ * u * std::abs(b.inv_w);
  };
  const auto turned = [&](std::size_t turn) {
    return near(t.v[0], r.v[turn]) && near(t.v[1], r.v[(1 + turn) % 3]) && near(t.v[2], r.v[(2 + turn) % 3]);
  };
  return turned(0) || (t.corners == 3 && (turned(1) || turned(2)));
}

std::optional<std::vector<std::size_t>> LegalWindow::match(std::span<const WindowTriangle<double>> run,
                                                           const std::vector<WindowAnswer>& answers) const {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (out.size() < run.size() && fits(run[out.size()], answers[i])) {
      out.push_back(i);
    } else if (!answers[i].absent) {
      return std::nullopt;
    }
  }
  if (out.size() != run.size()) return std::nullopt;
  return out;
}

namespace {

std::vector<double> depths_of(std::span<const WindowTriangle<double>> run) {
  std::vector<double> out;
  for (const WindowTriangle<double>& t : run) {
    for (const WindowVertex<double>& v : t.v) out.push_back(v.p_win.z);
  }
  return out;
}

}  // namespace

std::vector<std::uint32_t> turned_outlines(const Scene& scene, const Records<double>& candidate,
                                           const Records<double>& reference) {
  std::vector<std::uint32_t> out;
  const auto outlines = [&](const Draw& draw) {
    return scene.meshes[draw.mesh].topology == Topology::triangles && !is_filled(draw);
  };
  if (std::ranges::none_of(scene.draws, outlines) || candidate.matrices.size() != scene.draws.size()) return out;
  const LegalWindow legal(scene, candidate, tolerance(Profile::exact, Stage::window).factor, FacingArea::either);
  const std::span a(candidate.triangles), b(reference.triangles);
  matched_by_primitive(a, b, [&](auto mine, auto theirs) {
    const std::uint32_t primitive = (mine.empty() ? theirs : mine).front().primitive;
    const Draw* draw = legal.draws().draw(primitive);
    if (draw == nullptr || !outlines(*draw)) return;
    const bool same =
        std::ranges::equal(mine, theirs, {}, &WindowTriangle<double>::corners, &WindowTriangle<double>::corners);
    const bool face_shows = carries(scene, *draw, Varying::back_color) || draw->stencil;
    // Mesa finds the slope of a polygon offset for faces that are not filled, too: of one without area, 0/0.
    const bool slope_shows = draw->polygon_offset != PolygonOffset{} && depths_of(mine) != depths_of(theirs);
    if (same && !face_shows && !slope_shows) return;
    const auto answers = legal.of(primitive);
    if (answers.size() < 2) return;
    const auto is_legal = [&](std::span<const WindowTriangle<double>> run) {
      return std::ranges::any_of(answers, [&](const auto& list) { return legal.match(run, list).has_value(); });
    };
    // The reference hands out no facing of edges and corners, and may decide it for each triangle of the fan: where
    // rounding decides, it may draw parts of both faces.
    const auto may_be_drawn = [&](const WindowTriangle<double>& t) {
      return std::ranges::any_of(answers, [&](const std::vector<WindowAnswer>& list) {
        return std::ranges::any_of(list, [&](const WindowAnswer& answer) {
          WindowTriangle<double> faced = t;
          if (t.corners < 3) faced.front = answer.front;
          for (std::size_t k = 0; slope_shows && k < 3; ++k) faced.v[k].p_win.z = answer.record.v[k].p_win.z;
          return legal.match({&faced, 1}, {answer}).has_value();
        });
      });
    };
    if (is_legal(mine) && std::ranges::all_of(theirs, may_be_drawn)) out.push_back(primitive);
  });
  return out;
}

}  // namespace plumbline::check
