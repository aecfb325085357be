#include "renderers/run_stage.h"

#include "capture/require_fitting.h"
#include "pipeline/coverage.h"
#include "pipeline/matrices.h"
#include "pipeline/merge.h"
#include "pipeline/recorder.h"
#include "pipeline/triangle_setup.h"
#include "pipeline/visibility.h"
#include "renderers/convert.h"
#include "scene/antialias.h"
#include "scene/draw_of.h"

namespace plumbline::pipeline {

namespace {

Vec4<double> widen(const Color<float>& c) { return {c.r, c.g, c.b, c.a}; }

/// Runs one stage; each function is one or two of render.cpp's numbered blocks.
class OneStage {
 public:
  OneStage(const Scene& scene, Stage stage, const Stages& stages, const Capture& in, Capture& out)
      : scene_(scene),
        stage_(stage),
        stages_(stages),
        in_(in),
        records_(in.records),
        out_(out),
        request_{StageSet{stage}, false, {}, {}},
        ranges_(draw_ranges(scene)),
        carried_(carried(scene)) {
    lights_ = narrow(records_.lights);
    if (lights_.empty()) {
      const auto of_scene = light_sources(scene);
      lights_.assign(of_scene.begin(), of_scene.end());
    }
  }

  void run() {
    if (stage_ <= Stage::window) return run_geometry();
    if (stage_ == Stage::coverage) return run_coverage();
    if (stage_ <= Stage::shade) return run_fragments();
    run_planes();
  }

 private:
  DrawInput input(std::size_t draw) const {
    const bool known = draw < records_.matrices.size();
    return draw_input(scene_, scene_.draws[draw], known ? narrow(records_.matrices[draw]) : Matrices<float>());
  }
  std::size_t draw_number(std::uint32_t primitive) const { return draw_of(ranges_, primitive).value(); }
  const Draw& draw_at(std::uint32_t triangle) const {
    return scene_.draws[draw_number(records_.triangles[triangle].primitive)];
  }
  void run_geometry() {
    Capture made;
    Recorder recorder(scene_, request_, 0, made);
    if (stage_ == Stage::matrices) {
      const auto lights = stages_.lights(scene_);
      recorder.lights({lights.begin(), lights.end()});
    }
    for (std::size_t d = 0; d < scene_.draws.size(); ++d) run_geometry(d, recorder);
    if (stage_ == Stage::window) run_window(recorder);
    out_.records = std::move(made.records);  // without a recorder's planes
  }

  void run_geometry(std::size_t d, Recorder& recorder) {
    const Draw& draw = scene_.draws[d];
    const Mesh& mesh = scene_.meshes[draw.mesh];
    const DrawRange& range = ranges_[d];
    std::vector<Vertex<float>> vertices;
    std::vector<Attributes> attributes;
    if (stage_ == Stage::matrices) recorder.draw(draw, stages_.matrices(scene_, draw));
    if (stage_ == Stage::vertex) {
      stages_.vertex(narrow(records_.matrices[d]), draw.normals, mesh, vertices);
      recorder.vertices(vertices);
    }
    if (stage_ != Stage::light && stage_ != Stage::clip) return;
    for (std::size_t i = 0; i < range.vertex_count; ++i) {
      vertices.push_back(narrow(records_.vertices[range.first_vertex + i]));
    }
    if (stage_ == Stage::light) {
      stages_.light(scene_, draw, lights_, vertices, attributes);
      return recorder.attributes(attributes);
    }
    for (std::size_t i = 0; i < range.vertex_count; ++i) {
      attributes.push_back(attributes_at(records_, range.first_vertex + i));
    }
    const DrawInput in = input(d);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      Polygon polygon = stages_.assemble(in, mesh.triangles[i], vertices, attributes);
      polygon.primitive = range.first_primitive + i;
      stages_.clip(in, polygon);
      if (!polygon.corners.empty()) recorder.polygon(polygon);
    }
  }

  void run_window(Recorder& recorder) {
    std::vector<ShadedTriangle> triangles;
    for (std::size_t i = 0; i < records_.polygons.polygons.size(); ++i) {
      const Polygon polygon = polygon_at(records_, i);
      triangles.clear();
      stages_.window(input(draw_number(polygon.primitive)), polygon, triangles);
      for (const ShadedTriangle& t : triangles) recorder.triangle(t, t.attributes);
    }
  }

  void run_coverage() {
    const FrameFormat& frame = scene_.frame;
    const glm::ivec2 sample = stages_.sample_offsets(sample_place(frame)).coverage;
    out_.planes.count = Plane<std::uint32_t>(frame.width, frame.height);
    out_.planes.id_sum = Plane<std::uint64_t>(frame.width, frame.height);
    for (std::uint32_t i = 0; i < records_.triangles.size(); ++i) {
      const ShadedTriangle triangle = triangle_at(records_, i);
      const Draw& draw = draw_at(i);
      const PixelBounds box = draw.scissor ? stages_.scissor(*draw.scissor, bounds_of(frame)) : bounds_of(frame);
      for (const glm::ivec2 p : stages_.coverage(as_seen_from(triangle, sample), box)) {
        out_.records.covered.push_back({i, static_cast<std::uint16_t>(p.x), static_cast<std::uint16_t>(p.y)});
        ++out_.planes.count(p.x, p.y);
        out_.planes.id_sum(p.x, p.y) += id_weight(triangle.primitive);
      }
    }
  }

  void run_fragments() {
    const SampleOffsets offsets = stages_.sample_offsets(sample_place(scene_.frame));
    std::vector<Surface> surfaces;
    for (const Draw& draw : scene_.draws) surfaces.push_back(surface_of(scene_, draw, lights_));
    TriangleSetup setup;
    std::uint32_t triangle = ~0u;
    glm::ivec2 anchor(-1);
    for (std::size_t i = 0; i < records_.covered.size(); ++i) {
      const Covered& c = records_.covered[i];
      const glm::ivec2 pixel(c.x, c.y);
      const Surface& surface = surfaces[draw_number(records_.triangles[c.triangle].primitive)];
      if (stage_ == Stage::shade) {
        run_shade(i, surface, records_.triangles[c.triangle].front);
        continue;
      }
      if (triangle != c.triangle || anchor != anchor_of(pixel)) {
        triangle = c.triangle, anchor = anchor_of(pixel);
        const DepthState depth = depth_state(*surface.draw, scene_.frame.depth, scene_.depth_clamp);
        setup = set_up(stages_, triangle_at(records_, triangle), surface, depth, offsets, anchor);
      }
      run_fragment(i, surface, setup, pixel_at(pixel));
    }
  }

  // Depth, attributes or texture.
  void run_fragment(std::size_t i, const Surface& surface, const TriangleSetup& setup, const Pixels<float>& p) {
    Records<double>& out = out_.records;
    if (stage_ == Stage::depth) {
      const double z = stages_.depth(setup, p), scale = depth_scale(scene_.frame.depth);
      out.depth.push_back(scale == 0.0 ? z : z / scale);
    } else if (stage_ == Stage::attributes) {
      const SurfaceAttributes<float> attributes = interpolated(stages_, surface, setup, p);
      out.attributes.push_back({widen(attributes.color)});
      for (const Varying v : carried_) {
        if (!is_back(v)) out.varyings[v].fragments.push_back(widen(attributes[v]));
      }
    } else if (textured(scene_)) {
      Texel<double>& to = out.texels.emplace_back();
      if (!surface.texture) return;
      const Vec4<double>& texcoords = records_.varyings[Varying::texture].fragments[i];
      const FilteredTexel<float> texel = filtered(stages_, *surface.texture, setup, narrow(texcoords), p);
      to = {widen(texel.color), texel.lod};
    }
  }

  void run_shade(std::size_t i, const Surface& surface, bool front) {
    SurfaceAttributes<float> attributes{narrow(records_.attributes[i].color), {}, {}};
    for (const Varying v : surface.carried) attributes[v] = narrow(records_.varyings[v].fragments[i]);
    if (surface.texture) {
      const Texel<double>& texel = records_.texels[i];
      attributes.texel = {narrow(texel.color), static_cast<float>(texel.lod)};
    }
    out_.records.shaded.push_back({widen(stages_.shade(surface, front, attributes).color)});
  }

  // Stages 10 and 11: the recorded fragments, in draw order, through the tests into the planes.
  void run_planes() {
    const Formats formats = formats_of(scene_.frame);
    FrameBuffer frame(scene_.frame);
    Plane<std::int32_t> id(scene_.frame.width, scene_.frame.height, kBackground);
    for (std::size_t i = 0; i < records_.covered.size(); ++i) {
      const Covered& c = records_.covered[i];
      const plumbline::WindowTriangle<double>& triangle = records_.triangles[c.triangle];
      const Draw& draw = draw_at(c.triangle);
      const double z = records_.depth[i];
      const auto incoming = static_cast<float>(formats.depth_scale == 0.0 ? z : depth_code(z, formats.depth_scale));
      const Shaded shaded{records_.shaded.empty() ? Color<float>{} : narrow(records_.shaded[i].color)};
      const FramePixel to = frame.at({c.x, c.y});
      const bool drawn = is_drawn(i, draw, triangle, incoming, shaded, to, id(c.x, c.y));
      if (stage_ == Stage::visibility) out_.records.drawn.push_back({drawn});
      if (!drawn) continue;
      id(c.x, c.y) = static_cast<std::int32_t>(triangle.primitive);
      write_fragment(stages_, stages_.merge_state(draw.merge), incoming, shaded.color, formats.color_scale, to);
    }
    if (stage_ == Stage::visibility) {
      out_.planes.id = std::move(id);
      out_.planes.stencil = std::move(frame.stencil);
      return;
    }
    out_.planes.depth = Plane<double>(scene_.frame.width, scene_.frame.height);
    for (std::size_t i = 0; i < frame.depth.size(); ++i) {
      const double z = frame.depth.values()[i];
      out_.planes.depth.values()[i] = formats.depth_scale == 0.0 ? z : z / formats.depth_scale;
      if (formats.color_scale != 0.0f) frame.color.values()[i] /= formats.color_scale;
    }
    out_.planes.color = std::move(frame.color);
  }

  // Merge takes the recorded answers, or the winners; visibility, and a capture without either, tests.
  bool is_drawn(std::size_t i, const Draw& draw, const plumbline::WindowTriangle<double>& triangle, float z,
                const Shaded& shaded, const FramePixel& at, std::int32_t winner_so_far) const {
    const float color_scale = formats_of(scene_.frame).color_scale;
    const auto passes = [&](const Draw& by) {
      const bool nearer = stages_.depth_passes(by.depth_func, z, *at.depth);
      return passes_tests(stages_, by, triangle.front, nearer, shaded, color_scale, at.stencil);
    };
    if (stage_ == Stage::visibility) return passes(draw);
    if (!records_.drawn.empty()) return records_.drawn[i].drawn;
    if (in_.planes.id.empty()) return passes(draw);
    // The winner itself passes; a cut primitive may have two triangles at a pixel.
    const Covered& c = records_.covered[i];
    if (in_.planes.id(c.x, c.y) != static_cast<std::int32_t>(triangle.primitive)) return false;
    Draw known = draw;
    known.stencil.reset();  // what was held is not known
    if (winner_so_far == kBackground) known.depth_func = DepthFunc::always;
    return passes(known);
  }

  const Scene& scene_;
  const Stage stage_;
  const Stages& stages_;
  const Capture& in_;
  const Records<double>& records_;
  Capture& out_;
  const Request request_;
  const std::vector<DrawRange> ranges_;
  const std::vector<Varying> carried_;
  std::vector<LightSource<float>> lights_;
};

}  // namespace

void run_stage(const Scene& scene, Stage stage, const Stages& stages, const Capture& in, Capture& out) {
  require_fitting(scene, stage, in);
  OneStage(scene, stage, stages, in, out).run();
}

}  // namespace plumbline::pipeline
