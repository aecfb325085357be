#include "renderers/run_stage.h"

namespace plumbline::pipeline {

namespace {

// Attributes from a colour and value_at(column), which is null where the column is missing: then 0.
template <class Value>
Attributes gathered(const Vec4<double>& color, const Varyings<double>& columns, Value value_at) {
  Attributes out{};
  out.color() = Vec4<float>(color);
  for (const Varying v : kAllVaryings) {
    if (const Vec4<double>* value = value_at(columns[v])) out[v] = Vec4<float>(*value);
  }
  return out;
}

const Vec4<double>* value_at(const std::vector<Vec4<double>>& column, std::size_t i) {
  return i < column.size() ? &column[i] : nullptr;
}

}  // namespace

Matrices<float> narrow(const Matrices<double>& m) {
  return {Mat4<float>(m.model_view), Mat4<float>(m.projection), Mat3<float>(m.normal), Vec3<float>(m.win_scale),
          Vec3<float>(m.win_translate)};
}

Vertex<float> narrow(const Vertex<double>& v) {
  return {Vec4<float>(v.p_eye), Vec4<float>(v.p_clip), Vec3<float>(v.n_eye)};
}

void copy_planes(const Frame& frame, const FrameFormat& format, Planes& to) {
  const Formats formats = formats_of(format);
  const auto as_color = [&](const auto& codes) {
    Plane<glm::vec4> color(codes.width(), codes.height());
    for (std::size_t i = 0; i < codes.size(); ++i) {
      color.values()[i] = glm::vec4(codes.values()[i]) / formats.color_scale;
    }
    return color;
  };
  to.color = !frame.color_rgba8.empty()    ? as_color(frame.color_rgba8)
             : !frame.color_rgba16.empty() ? as_color(frame.color_rgba16)
                                           : frame.color_rgba32f;
  to.depth = Plane<double>(to.color.width(), to.color.height());
  for (std::size_t i = 0; i < to.depth.size(); ++i) {
    to.depth.values()[i] = frame.depth_z32f.empty() ? frame.depth_code.values()[i] / formats.depth_scale
                                                    : static_cast<double>(frame.depth_z32f.values()[i]);
  }
  to.stencil = frame.stencil;
}

Attributes attributes_at(const Records<double>& r, std::size_t i) {
  return gathered(r.lit[i].color, r.varyings, [&](const auto& columns) { return value_at(columns.vertices, i); });
}

Polygon polygon_at(const Records<double>& r, std::size_t i) {
  const ClipPolygon& from = r.polygons.polygons[i];
  Polygon out{from.primitive, {}};
  for (std::size_t k = from.first; k < from.first + from.count; ++k) {
    const plumbline::ClipVertex<double>& v = r.polygons.vertices[k];
    const auto value = [&](const auto& columns) { return value_at(columns.clipped, k); };
    out.corners.push_back({Vec4<float>(v.p_clip), gathered(v.color, r.varyings, value), v.cut});
  }
  return out;
}

ShadedTriangle triangle_at(const Records<double>& r, std::size_t i) {
  const plumbline::WindowTriangle<double>& from = r.triangles.at(i);
  ShadedTriangle out{{{}, from.primitive, from.front, from.corners, from.width}, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    const plumbline::WindowVertex<double>& v = from.v[k];
    out.v[k] = {Vec3<float>(v.p_win), static_cast<float>(v.inv_w), v.snapped};
    out.attributes[k] = gathered(v.color, r.varyings, [&](const VaryingColumns<double>& columns) {
      return i < columns.triangles.size() ? &columns.triangles[i][k] : nullptr;
    });
  }
  return out;
}

}  // namespace plumbline::pipeline
