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
LightSource<To> converted(const LightSource<From>& l) {
  return {Vec4<To>(l.p_eye), Vec3<To>(l.spot_eye)};
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

template <class To, class From>
Vec4<To> converted(const Vec4<From>& four) {
  return Vec4<To>(four);
}
template <class To, class From>
std::array<Vec4<To>, 3> converted(const std::array<Vec4<From>, 3>& fours) {
  return {Vec4<To>(fours[0]), Vec4<To>(fours[1]), Vec4<To>(fours[2])};
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
  if (request.records.has(Stage::matrices)) {
    to.matrices = converted<double>(from.matrices);
    to.lights = converted<double>(from.lights);
  }
  if (request.records.has(Stage::vertex)) to.vertices = converted<double>(from.vertices);
  if (request.records.has(Stage::light)) {
    to.lit = converted<double>(from.lit);
    for (const Varying v : kAllVaryings) to.varyings[v].vertices = converted<double>(from.varyings[v].vertices);
  }
  if (request.records.has(Stage::clip)) {
    for (const ClipPolygon& polygon : from.polygons.polygons) {
      if (!wanted(polygon.primitive)) continue;
      const auto first = static_cast<std::uint32_t>(to.polygons.vertices.size());
      to.polygons.polygons.push_back({polygon.primitive, first, polygon.count});
      for (std::uint32_t i = 0; i < polygon.count; ++i) {
        to.polygons.vertices.push_back(converted<double>(from.polygons.vertices[polygon.first + i]));
        for (const Varying v : kAllVaryings) {
          const auto& clipped = from.varyings[v].clipped;
          if (!clipped.empty()) to.varyings[v].clipped.push_back(Vec4<double>(clipped[polygon.first + i]));
        }
      }
    }
  }
  if (request.records.has(Stage::window)) {
    for (std::size_t i = 0; i < from.triangles.size(); ++i) {
      if (!wanted(from.triangles[i].primitive)) continue;
      to.triangles.push_back(converted<double>(from.triangles[i]));
      for (const Varying v : kAllVaryings) {
        const auto& triangles = from.varyings[v].triangles;
        if (!triangles.empty()) to.varyings[v].triangles.push_back(converted<double>(triangles[i]));
      }
    }
  }
}

std::size_t widened_bytes(const Records<float>& from, const Request& request) {
  const auto bytes = [&](Stage stage, std::size_t n, std::size_t size) {
    return request.records.has(stage) ? n * size : 0;
  };
  std::size_t sum = bytes(Stage::vertex, from.vertices.size(), sizeof(Vertex<double>)) +
                    bytes(Stage::light, from.lit.size(), sizeof(Lit<double>)) +
                    bytes(Stage::clip, from.polygons.vertices.size(), sizeof(ClipVertex<double>)) +
                    bytes(Stage::clip, from.polygons.polygons.size(), sizeof(ClipPolygon)) +
                    bytes(Stage::window, from.triangles.size(), sizeof(WindowTriangle<double>));
  for (const Varying v : kAllVaryings) {
    const VaryingColumns<float>& columns = from.varyings[v];
    sum += bytes(Stage::light, columns.vertices.size(), sizeof(Vec4<double>)) +
           bytes(Stage::clip, columns.clipped.size(), sizeof(Vec4<double>)) +
           bytes(Stage::window, columns.triangles.size(), 3 * sizeof(Vec4<double>));
  }
  return sum;
}

WindowTriangle<float> narrow(const WindowTriangle<double>& from) { return converted<float>(from); }
std::vector<LightSource<float>> narrow(const std::vector<LightSource<double>>& from) { return converted<float>(from); }

Records<float> narrow(const Records<double>& from) {
  Records<float> to;
  to.matrices = converted<float>(from.matrices);
  to.lights = converted<float>(from.lights);
  to.vertices = converted<float>(from.vertices);
  to.lit = converted<float>(from.lit);
  to.polygons = {converted<float>(from.polygons.vertices), from.polygons.polygons};
  to.triangles = converted<float>(from.triangles);
  for (const Varying v : kAllVaryings) {
    to.varyings[v].vertices = converted<float>(from.varyings[v].vertices);
    to.varyings[v].clipped = converted<float>(from.varyings[v].clipped);
    to.varyings[v].triangles = converted<float>(from.varyings[v].triangles);
  }
  return to;
}

}  // namespace plumbline::pipeline
