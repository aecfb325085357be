#include "renderers/run_stage.h"

#include <limits>

#include "capture/require_fitting.h"
#include "kernels/coverage.h"
#include "pipeline/fragment.h"
#include "pipeline/geometry.h"
#include "pipeline/recorder.h"
#include "scene/antialias.h"
#include "scene/draw_index.h"

namespace plumbline::pipeline {

namespace {

/// Runs one stage, as render.cpp's block of its number does: run_geometry() stages 0 to 4, run_coverage() 5,
/// run_fragments() 6 to 11. Records go through the same Recorder.
class OneStage {
 public:
  OneStage(const Scene& scene, Stage stage, const Stages& stages, const Capture& in)
      : scene_(scene),
        stage_(stage),
        stages_(stages),
        in_(in),
        records_(in.records),
        request_{StageSet{stage}, false, {}, {}, std::numeric_limits<std::size_t>::max()},
        recorder_(scene, request_, 0, made_),
        draws_(scene) {
    for (const auto& l : records_.lights) lights_.push_back({Vec4<float>(l.p_eye), Vec3<float>(l.spot_eye)});
    const auto of_scene = light_sources(scene);
    if (records_.lights.empty()) lights_.assign(of_scene.begin(), of_scene.end());
  }

  void run(Capture& out) {
    if (kGeometryStages.has(stage_)) {
      run_geometry();
    } else if (stage_ == Stage::coverage) {
      run_coverage();
    } else {
      run_fragments();
    }
    out.records = std::move(made_.records);
    Planes &to = out.planes, &from = made_.planes;  // the recorder fills planes of other stages, too
    if (stage_ == Stage::coverage) to.count = std::move(from.count), to.id_sum = std::move(from.id_sum);
    if (stage_ == Stage::visibility) to.id = std::move(from.id), to.stencil = std::move(from.stencil);
    if (stage_ == Stage::merge) to.depth = std::move(from.depth), to.color = std::move(from.color);
  }

 private:
  std::size_t draw_number(std::uint32_t primitive) const { return draws_.of_primitive(primitive).value(); }
  DrawInput input(std::size_t draw) const {
    const bool known = draw < records_.matrices.size();
    return draw_input(scene_, scene_.draws[draw], known ? narrow(records_.matrices[draw]) : Matrices<float>());
  }

  void run_geometry() {
    if (stage_ == Stage::matrices) {
      const auto lights = stages_.lights(scene_);
      recorder_.lights({lights.begin(), lights.end()});
    }
    for (std::size_t d = 0; d < scene_.draws.size(); ++d) run_geometry(d);
    std::vector<ShadedTriangle> triangles;
    for (std::size_t i = 0; stage_ == Stage::window && i < records_.polygons.polygons.size(); ++i) {
      const Polygon polygon = polygon_at(records_, i);
      triangles.clear();
      stages_.window(input(draw_number(polygon.primitive)), polygon, triangles);
      for (const ShadedTriangle& t : triangles) recorder_.triangle(t, t.attributes);
    }
  }

  void run_geometry(std::size_t d) {
    const Draw& draw = scene_.draws[d];
    const Mesh& mesh = scene_.meshes[draw.mesh];
    const DrawRange& range = draws_.ranges()[d];
    std::vector<Vertex<float>> vertices;
    std::vector<Attributes> attributes;
    if (stage_ == Stage::matrices) recorder_.draw(draw, stages_.matrices(scene_, draw));
    if (stage_ == Stage::vertex) {
      stages_.vertex(narrow(records_.matrices[d]), draw.normals, mesh, vertices);
      recorder_.vertices(vertices);
    }
    if (stage_ != Stage::light && stage_ != Stage::clip) return;
    for (std::size_t i = 0; i < range.vertex_count; ++i) {
      vertices.push_back(narrow(records_.vertices[range.first_vertex + i]));
    }
    if (stage_ == Stage::light) {
      stages_.light({scene_, draw, mesh, lights_, vertices}, attributes);
      return recorder_.attributes(attributes);
    }
    for (std::size_t i = 0; i < range.vertex_count; ++i) {
      attributes.push_back(attributes_at(records_, range.first_vertex + i));
    }
    const DrawInput in = input(d);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      Polygon polygon = stages_.assemble(in, mesh.triangles[i], vertices, attributes);
      polygon.primitive = range.first_primitive + i;
      stages_.clip(in, polygon);
      if (!polygon.corners.empty()) recorder_.polygon(polygon);
    }
  }

  void begin(const ShadedTriangle& triangle) {
    recorder_.draw(scene_.draws[draw_number(triangle.primitive)], {});
    recorder_.triangle(triangle, triangle.attributes);
  }

  void run_coverage() {
    const FrameFormat& frame = scene_.frame;
    const glm::ivec2 sample = stages_.sample_offsets(sample_offset(frame)).coverage;
    const SurfaceAttributes<float> nothing{};
    for (std::uint32_t i = 0; i < records_.triangles.size(); ++i) {
      const ShadedTriangle triangle = triangle_at(records_, i);
      begin(triangle);
      const auto& scissor = scene_.draws[draw_number(triangle.primitive)].scissor;
      const PixelBounds box = scissor ? stages_.scissor(*scissor, bounds_of(frame)) : bounds_of(frame);
      for (const glm::ivec2 p : stages_.coverage(as_seen_from(triangle, sample), box)) {
        recorder_.fragment({p, 0, &nothing, {}, false});
      }
    }
  }

  // Stages 6 to 11 of the recorded fragments, in draw order.
  void run_fragments() {
    const Formats formats = formats_of(scene_.frame);
    const SampleOffsets offsets = stages_.sample_offsets(formats.sample);
    std::vector<Surface> surfaces;
    for (const Draw& draw : scene_.draws) {  // of depth, what fails in a surface is not seen
      surfaces.push_back(stage_ == Stage::depth ? Surface{&scene_, &draw, {}, {}, {}}
                                                : surface_of(scene_, draw, lights_));
    }
    FrameBuffer frame(scene_.frame);
    ShadedTriangle triangle;
    const Surface* surface = nullptr;
    TriangleSetup setup;
    glm::ivec2 anchor(-1);
    for (std::size_t i = 0; i < records_.covered.size(); ++i) {
      const Covered& c = records_.covered[i];
      const glm::ivec2 pixel(c.x, c.y);
      if (i == 0 || c.triangle != records_.covered[i - 1].triangle) {
        triangle = triangle_at(records_, c.triangle);
        begin(triangle);
        surface = &surfaces[draw_number(triangle.primitive)];
        anchor = glm::ivec2(-1);
      }
      if (stage_ <= Stage::texture && anchor != anchor_of(pixel)) {
        anchor = anchor_of(pixel);
        const DepthState depth = depth_state(*surface->draw, scene_.frame.depth, scene_.depth_clamp);
        setup = set_up(stages_, triangle, *surface, depth, offsets, anchor);
      }
      SurfaceAttributes<float> attributes{};
      Fragment made{pixel, 0, &attributes, {}, false};
      if (stage_ == Stage::depth) made.z = stages_.depth(setup, pixel_at(pixel));
      if (stage_ == Stage::attributes) attributes = interpolated(stages_, *surface, setup, pixel_at(pixel));
      if (stage_ == Stage::texture && surface->texture) {
        const Color<float> texcoords(records_.varyings[Varying::texture].fragments[i]);
        attributes.texel = filtered(stages_, *surface->texture, setup, texcoords, pixel_at(pixel));
      }
      if (stage_ == Stage::shade)
        made.shaded = stages_.shade(*surface, triangle.front, recorded_attributes(i, *surface)).color;
      if (stage_ >= Stage::visibility) {
        const double z = records_.depth[i];
        made.z = static_cast<float>(formats.depth_scale == 0.0 ? z : depth_code(z, formats.depth_scale));
        if (!records_.shaded.empty()) made.shaded = Color<float>(records_.shaded[i].color);
        const FramePixel to = frame.at(pixel);
        const bool passes_depth = stages_.depth_passes(surface->draw->depth_func, made.z, *to.depth);
        made.drawn = is_drawn(i, *surface->draw, triangle, made, to);
        const bool writes_depth = stage_ == Stage::merge ? stages_.writes_depth(passes_depth, made.drawn) : made.drawn;
        const Merge merge = stages_.merge_state(surface->draw->merge);
        if (merge.depth_mask && writes_depth) *to.depth = made.z;
        if (made.drawn) write_color(stages_, merge, made.shaded, formats.color_scale, to);
      }
      recorder_.fragment(made);
    }
    if (stage_ < Stage::visibility) return;
    copy_planes(finished(scene_.frame, frame), scene_.frame, made_.planes);
  }

  SurfaceAttributes<float> recorded_attributes(std::size_t i, const Surface& surface) const {
    SurfaceAttributes<float> out{Color<float>(records_.attributes[i].color), {}, {}};
    for (const Varying v : surface.carried) out[v] = Color<float>(records_.varyings[v].fragments[i]);
    if (surface.texture)
      out.texel = {Color<float>(records_.texels[i].color), static_cast<float>(records_.texels[i].lod)};
    return out;
  }

  // Whether fragment `i` is drawn. Visibility tests it. Merge takes records.drawn, else planes.id, else tests it.
  bool is_drawn(std::size_t i, const Draw& draw, const WindowTriangle& triangle, const Fragment& f,
                const FramePixel& at) const {
    const auto passes = [&](const Draw& by) {
      const bool passes_depth = stages_.depth_passes(by.depth_func, f.z, *at.depth);
      return passes_tests(stages_, by, {triangle.front, passes_depth, {f.shaded}, at.stencil},
                          formats_of(scene_.frame).color_scale);
    };
    if (stage_ == Stage::visibility) return passes(draw);
    if (!records_.drawn.empty()) return records_.drawn[i].drawn;
    if (in_.planes.id.empty()) return passes(draw);
    // The winner's first fragment at the pixel passes the depth test, whatever is stored; a later one, of another
    // triangle of a cut primitive, is tested.
    const auto primitive = static_cast<std::int32_t>(triangle.primitive);
    if (in_.planes.id(f.pixel.x, f.pixel.y) != primitive) return false;
    Draw known = draw;
    known.stencil.reset();  // the stored stencil value is not known
    if (made_.planes.id(f.pixel.x, f.pixel.y) == kBackground) known.depth_func = DepthFunc::always;
    return passes(known);
  }

  const Scene& scene_;
  const Stage stage_;
  const Stages& stages_;
  const Capture& in_;
  const Records<double>& records_;
  Capture made_;
  const Request request_;
  Recorder recorder_;
  const DrawIndex draws_;
  std::vector<LightSource<float>> lights_;
};

}  // namespace

void run_stage(const Scene& scene, Stage stage, const Stages& stages, const Capture& in, Capture& out) {
  require_fitting(scene, stage, in);
  OneStage(scene, stage, stages, in).run(out);
}

}  // namespace plumbline::pipeline
