#include "pipeline/convert.h"

#include <algorithm>

namespace plumbline::pipeline {

namespace {

template <class To, class From>
Matrices<To> converted(const Matrices<From>& m) {
  return {Mat4<To>(m.model_view), Mat4<To>(m.projection), Mat3<To>(m.normal), Vec3<To>(m.win_scale),
          Vec3<To>(m.win_translate)};
}
template <class To, class From>
Vertex<To> converted(const Vertex<From>& v) {
  return {Vec4<To>(v.p_eye), Vec4<To>(v.p_clip), Vec3<To>(v.n_eye)};
}
template <class To, class From>
Lit<To> converted(const Lit<From>& l) {
  return {Vec4<To>(l.color)};
}
template <class To, class From>
ClipVertex<To> converted(const ClipVertex<From>& v) {
  return {Vec4<To>(v.p_clip), Vec4<To>(v.color), v.cut};
}
template <class To, class From>
WindowTriangle<To> converted(const WindowTriangle<From>& t) {
  WindowTriangle<To> out{{}, t.primitive, t.front, t.corners, t.width};
  for (std::size_t i = 0; i < 3; ++i) {
    out.v[i] = {Vec3<To>(t.v[i].p_win), static_cast<To>(t.v[i].inv_w), t.v[i].snapped, Vec4<To>(t.v[i].color)};
  }
  return out;
}

template <class To, class Record>
auto converted(const std::vector<Record>& from) {
  std::vector<decltype(converted<To>(from.front()))> out;
  out.reserve(from.size());
  for (const Record& record : from) out.push_back(converted<To>(record));
  return out;
}

}  // namespace

void widen_geometry(const Records<float>& from, const Request& request, Records<double>& to) {
  const auto wanted = [&](std::uint32_t primitive) {
    return request.primitives.empty() ||
           std::binary_search(request.primitives.begin(), request.primitives.end(), primitive);
  };
  if (request.records.has(Stage::matrices)) to.matrices = converted<double>(from.matrices);
  if (request.records.has(Stage::vertex)) to.vertices = converted<double>(from.vertices);
  if (request.records.has(Stage::light)) to.lit = converted<double>(from.lit);
  if (request.records.has(Stage::clip)) {
    for (const ClipPolygon& polygon : from.polygons.polygons) {
      if (!wanted(polygon.primitive)) continue;
      const auto first = static_cast<std::uint32_t>(to.polygons.vertices.size());
      to.polygons.polygons.push_back({polygon.primitive, first, polygon.count});
      for (std::uint32_t i = 0; i < polygon.count; ++i) {
        to.polygons.vertices.push_back(converted<double>(from.polygons.vertices[polygon.first + i]));
      }
    }
  }
  if (request.records.has(Stage::window)) {
    for (const WindowTriangle<float>& triangle : from.triangles) {
      if (wanted(triangle.primitive)) to.triangles.push_back(converted<double>(triangle));
    }
  }
}

std::size_t widened_bytes(const Records<float>& from, const Request& request) {
  const auto bytes = [&](Stage stage, std::size_t n, std::size_t size) {
    return request.records.has(stage) ? n * size : 0;
  };
  return bytes(Stage::vertex, from.vertices.size(), sizeof(Vertex<double>)) +
         bytes(Stage::light, from.lit.size(), sizeof(Lit<double>)) +
         bytes(Stage::clip, from.polygons.vertices.size(), sizeof(ClipVertex<double>)) +
         bytes(Stage::clip, from.polygons.polygons.size(), sizeof(ClipPolygon)) +
         bytes(Stage::window, from.triangles.size(), sizeof(WindowTriangle<double>));
}

WindowTriangle<float> narrow(const WindowTriangle<double>& from) { return converted<float>(from); }

Records<float> narrow(const Records<double>& from) {
  Records<float> to;
  to.matrices = converted<float>(from.matrices);
  to.vertices = converted<float>(from.vertices);
  to.lit = converted<float>(from.lit);
  to.polygons = {converted<float>(from.polygons.vertices), from.polygons.polygons};
  to.triangles = converted<float>(from.triangles);
  return to;
}

}  // namespace plumbline::pipeline
