#include "pipeline/recorder.h"

#include <algorithm>

namespace plumbline::pipeline {

Recorder::Recorder(const Scene& scene, const Request& request, std::size_t bytes, Capture& out)
    : scene_(&scene),
      request_(&request),
      out_(&out),
      bytes_(bytes),
      depth_scale_(depth_scale(scene.frame.depth)),
      carried_(carried(scene)) {
  fragment_bytes_ = fragment_bytes(scene, request.records);
  const int w = scene.frame.width, h = scene.frame.height;
  if (!request.pixels.empty()) wanted_pixels_ = Plane<std::uint8_t>(w, h);
  for (const glm::ivec2 p : request.pixels) {
    if (p.x >= 0 && p.y >= 0 && p.x < w && p.y < h) wanted_pixels_(p.x, p.y) = 1;
  }
  out.planes.count = Plane<std::uint32_t>(w, h);
  out.planes.id_sum = Plane<std::uint64_t>(w, h);
  out.planes.id = Plane<std::int32_t>(w, h, kBackground);
  out.planes.shaded = Plane<glm::vec4>(w, h, scene.frame.clear_color);
  if (textured(scene)) out.planes.texel = Plane<glm::vec4>(w, h, glm::vec4(0));
}

bool Recorder::wanted(std::uint32_t primitive) const {
  const auto& primitives = request_->primitives;
  return primitives.empty() || std::binary_search(primitives.begin(), primitives.end(), primitive);
}

void Recorder::count(std::size_t bytes) {
  bytes_ += bytes;
  require_budget(*scene_, bytes_, request_->memory_budget);
}

void Recorder::lights(std::span<const LightSource<float>> lights) {
  if (!keeps(Stage::matrices) || scene_->draws.empty()) return;
  for (const LightSource<float>& light : lights) {
    out_->records.lights.push_back({Vec4<double>(light.p_eye), Vec3<double>(light.spot_eye)});
  }
}

void Recorder::draw(const Draw& draw, const Matrices<float>& m) {
  draw_ = &draw;
  if (!keeps(Stage::matrices)) return;
  out_->records.matrices.push_back({Mat4<double>(m.model_view), Mat4<double>(m.projection), Mat3<double>(m.normal),
                                    Vec3<double>(m.win_scale), Vec3<double>(m.win_translate)});
}

void Recorder::vertices(std::span<const Vertex<float>> vertices) {
  if (!keeps(Stage::vertex)) return;
  count(vertices.size() * sizeof(plumbline::Vertex<double>));
  for (const Vertex<float>& v : vertices) {
    out_->records.vertices.push_back({Vec4<double>(v.p_eye), Vec4<double>(v.p_clip), Vec3<double>(v.n_eye)});
  }
}

void Recorder::attributes(std::span<const Attributes> attributes) {
  if (!keeps(Stage::light)) return;
  count(attributes.size() * (1 + carried_.size()) * sizeof(Vec4<double>));
  for (const Attributes& a : attributes) {
    out_->records.lit.push_back({Vec4<double>(a.color())});
    for (const Varying v : carried_) out_->records.varyings[v].vertices.push_back(Vec4<double>(a[v]));
  }
}

void Recorder::polygon(const Polygon& polygon) {
  if (!keeps(Stage::clip) || !wanted(polygon.primitive)) return;
  ClipPolygons<double>& to = out_->records.polygons;
  const auto corners = static_cast<std::uint32_t>(polygon.corners.size());
  count(sizeof(ClipPolygon) +
        corners * (sizeof(plumbline::ClipVertex<double>) + carried_.size() * sizeof(Vec4<double>)));
  to.polygons.push_back({polygon.primitive, static_cast<std::uint32_t>(to.vertices.size()), corners});
  for (const ClipVertex& c : polygon.corners) {
    to.vertices.push_back({Vec4<double>(c.p_clip), Vec4<double>(c.attributes.color()), c.cut});
    for (const Varying v : carried_) out_->records.varyings[v].clipped.push_back(Vec4<double>(c.attributes[v]));
  }
}

void Recorder::triangle(const WindowTriangle& t, const std::array<Attributes, 3>& attributes) {
  if (out_ == nullptr) return;
  primitive_ = t.primitive;
  if (!wanted(t.primitive)) return;
  ++triangles_;
  if (!keeps(Stage::window)) return;
  count(sizeof(plumbline::WindowTriangle<double>) + 3 * carried_.size() * sizeof(Vec4<double>));
  plumbline::WindowTriangle<double> to{{}, t.primitive, t.front, t.corners, t.width};
  for (std::size_t k = 0; k < 3; ++k) {
    const WindowVertex& v = t.v[k];
    to.v[k] = {Vec3<double>(v.p_win), v.inv_w, v.snapped, Vec4<double>(attributes[k].color())};
  }
  out_->records.triangles.push_back(to);
  for (const Varying v : carried_) {
    if (is_back(v)) continue;
    out_->records.varyings[v].triangles.push_back(
        {Vec4<double>(attributes[0][v]), Vec4<double>(attributes[1][v]), Vec4<double>(attributes[2][v])});
  }
}

void Recorder::fragment(const Fragment& f) {
  if (out_ == nullptr) return;
  const int x = f.pixel.x, y = f.pixel.y;
  const Texel<double> texel = draw_->texture
                                  ? Texel<double>{Vec4<double>(f.attributes->texel.color), f.attributes->texel.lod}
                                  : Texel<double>{};
  Planes& planes = out_->planes;
  ++planes.count(x, y);
  planes.id_sum(x, y) += id_weight(primitive_);
  if (f.drawn) {
    planes.id(x, y) = static_cast<std::int32_t>(primitive_);
    planes.shaded(x, y) = f.shaded;
    if (!planes.texel.empty()) planes.texel(x, y) = glm::vec4(texel.color);
  }
  if (fragment_bytes_ == 0 || (!wanted_pixels_.empty() && wanted_pixels_(x, y) == 0) || !wanted(primitive_)) return;
  Records<double>& r = out_->records;
  if (keeps(Stage::coverage)) {
    r.covered.push_back({triangles_ - 1, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
  }
  if (keeps(Stage::depth)) r.depth.push_back(depth_scale_ == 0.0 ? f.z : f.z / depth_scale_);
  if (keeps(Stage::attributes)) {
    r.attributes.push_back({Vec4<double>(f.attributes->color)});
    for (const Varying v : carried_) {
      if (!is_back(v)) r.varyings[v].fragments.push_back(Vec4<double>((*f.attributes)[v]));
    }
  }
  if (keeps(Stage::texture) && !planes.texel.empty()) r.texels.push_back(texel);
  if (keeps(Stage::shade)) r.shaded.push_back({Vec4<double>(f.shaded)});
  if (keeps(Stage::visibility)) r.drawn.push_back({f.drawn});
  count(fragment_bytes_);
}

}  // namespace plumbline::pipeline
