#include "pipeline/pipeline_renderer.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "pipeline/clip.h"
#include "pipeline/convert.h"
#include "pipeline/input.h"
#include "pipeline/painter.h"
#include "scene/draw_of.h"

namespace plumbline::pipeline {

namespace {

Planes planes_of_frame(const Frame& frame, const Formats& formats) {
  Planes out;
  const auto as_color = [&](const auto& codes) {
    Plane<glm::vec4> color(codes.width(), codes.height());
    for (std::size_t i = 0; i < codes.size(); ++i) {
      color.values()[i] = glm::vec4(codes.values()[i]) / formats.color_scale;
    }
    return color;
  };
  out.color = !frame.color_rgba8.empty()    ? as_color(frame.color_rgba8)
              : !frame.color_rgba12.empty() ? as_color(frame.color_rgba12)
              : !frame.color_rgba16.empty() ? as_color(frame.color_rgba16)
                                            : frame.color_rgba32f;
  out.depth = Plane<double>(out.color.width(), out.color.height());
  for (std::size_t i = 0; i < out.depth.size(); ++i) {
    out.depth.values()[i] = frame.depth_z32f.empty() ? frame.depth_code.values()[i] / formats.depth_scale
                                                     : static_cast<double>(frame.depth_z32f.values()[i]);
  }
  out.stencil = frame.stencil;
  return out;
}

// The other way round, of colours alone.
Frame frame_of_colors(const FrameFormat& format, const Plane<glm::vec4>& color) {
  FrameFormat of_pass = format;
  of_pass.width = color.width();
  of_pass.height = color.height();
  Frame frame(of_pass);
  const auto scale = static_cast<float>(color_scale(format.color));
  const auto codes = [&](auto& to, std::size_t i) {
    if (!to.empty()) to.values()[i] = glm::round(color.values()[i] * scale);
  };
  for (std::size_t i = 0; i < color.size(); ++i) {
    codes(frame.color_rgba8, i);
    codes(frame.color_rgba12, i);
    codes(frame.color_rgba16, i);
  }
  if (scale == 0.0f) frame.color_rgba32f = color;
  return frame;
}

// Which draw a window triangle is of.
class DrawOfTriangle {
 public:
  DrawOfTriangle(const Scene& scene, const std::vector<WindowTriangle<double>>& triangles)
      : scene_(scene), triangles_(triangles), ranges_(draw_ranges(scene)) {}
  std::size_t index(std::uint32_t triangle) const {
    const std::uint32_t primitive = triangles_.at(triangle).primitive;
    return draw_of(ranges_, primitive).value();
  }
  const Draw& operator()(std::uint32_t triangle) const { return scene_.draws[index(triangle)]; }

 private:
  const Scene& scene_;
  const std::vector<WindowTriangle<double>>& triangles_;
  std::vector<DrawRange> ranges_;
};

class PipelineRenderer : public Renderer {
 public:
  PipelineRenderer(const Stages& stages, bool paints) : stages_(stages), paints_(paints) {}

  RendererInfo info() const override {
    RendererInfo info{.name = "ours", .version = PLUMBLINE_VERSION, .stages = {}};
    for (Ability& ability : info.stages) ability = {true, true, ""};
    if (!paints_) return info;
    for (const SimdTarget& target : simd_targets()) info.painters.emplace_back(target.name);
    return info;
  }

  Capture capture(const Scene& scene, const Request& request) override {
    require_budget(scene, plane_bytes(scene), request.memory_budget);
    Capture out = empty_capture(scene);
    if (request.planes == WantedPlanes::picture && !request.records.any()) {
      out.planes = planes_of_frame(picture(scene, request.painter), formats_of(scene.frame));
      return out;
    }
    if (scene.frame.antialias.kind != Antialias::Kind::none) {
      std::vector<Frame> passes;
      for (const Scene& pass : passes_of(scene)) passes.push_back(render(pass, stages_));
      out.planes = planes_of_frame(resolve(stages_.resolve, scene.frame, passes), formats_of(scene.frame));
      for (const Frame& pass : passes) out.samples.push_back(planes_of_frame(pass, formats_of(scene.frame)).color);
      return out;
    }
    const Geometry geometry = run_geometry(scene, stages_.geometry);
    const std::size_t bytes = plane_bytes(scene) + widened_bytes(geometry.records, request);
    require_budget(scene, bytes, request.memory_budget);
    Frame frame(scene.frame);
    CaptureTap tap(scene, request, bytes);
    const std::vector<Surface> surfaces = surfaces_of(scene, geometry.records);
    stages_.fragment.draw_tapped(
        {geometry.records.triangles, geometry.first_triangle, scene.draws, surfaces, scene.depth_clamp}, scene.frame,
        frame, tap);
    out.planes = planes_of_frame(frame, formats_of(scene.frame));
    tap.hand_out(geometry.records.triangles, out);
    widen_geometry(geometry.records, request, out.records);
    return out;
  }

  Capture run_stage(const Scene& scene, Stage stage, const Capture& in) override {
    if (!info()[stage].runs) return Renderer::run_stage(scene, stage, in);
    if (stage == Stage::resolve) return resolved(scene, in.samples);
    require_fitting(scene, stage, in);
    Capture out = empty_capture(scene);
    if (stage <= Stage::window) {
      run_geometry_stage(scene, stage, narrow(in.records), out);
    } else if (stage == Stage::coverage) {
      run_coverage(scene, narrow(in.records), out);
    } else if (stage <= Stage::shade) {
      run_fragment_stage(scene, stage, in.records, out);
    } else {
      run_planes(scene, stage, in, out);
    }
    return out;
  }

 private:
  static Capture empty_capture(const Scene& scene) {
    Capture out;
    out.renderer = "ours";
    out.version = PLUMBLINE_VERSION;
    out.width = scene.frame.width;
    out.height = scene.frame.height;
    return out;
  }

  Capture resolved(const Scene& scene, const std::vector<Plane<glm::vec4>>& samples) {
    require_samples(scene, samples);
    std::vector<Frame> passes;
    for (const Plane<glm::vec4>& color : samples) passes.push_back(frame_of_colors(scene.frame, color));
    Capture out = empty_capture(scene);
    out.planes.color = planes_of_frame(resolve(stages_.resolve, scene.frame, passes), formats_of(scene.frame)).color;
    return out;
  }

  void run_geometry_stage(const Scene& scene, Stage stage, const Records<float>& in, Capture& out) {
    Records<float> made;
    GeometryRun run;
    run.begin(scene, stages_.geometry);
    for (std::size_t d = 0; d < run.draws(); ++d) run.run(d, stage, in, made);
    widen_geometry(made, {StageSet{stage}, false, {}, {}}, out.records);
  }

  void run_coverage(const Scene& scene, const Records<float>& in, Capture& out) {
    const std::vector<std::uint32_t> first_triangle = triangles_of_draws(scene, in.triangles);
    Frame frame(scene.frame);
    const Request request{StageSet{Stage::coverage}, false, {}, {}};
    CaptureTap tap(scene, request, 0);
    stages_.fragment.draw_tapped({in.triangles, first_triangle, scene.draws, {}, scene.depth_clamp}, scene.frame, frame,
                                 tap);
    Capture all;
    tap.hand_out(in.triangles, all);
    out.records.covered = std::move(all.records.covered);
    out.planes.count = std::move(all.planes.count);
    out.planes.id_sum = std::move(all.planes.id_sum);
  }

  void run_fragment_stage(const Scene& scene, Stage stage, const Records<double>& in, Capture& out) {
    switch (stage) {
      case Stage::depth: return run_depth(scene, in, out);
      case Stage::attributes: return run_attributes(scene, in, out);
      case Stage::texture: return run_texture(scene, in, out);
      default: return run_shade(scene, in, out);
    }
  }

  // visit(fragment's number, its pixel, its triangle's set-up) for each; `corners`: a varying in the colours' place.
  void each_fragment(const Scene& scene, const Records<double>& in,
                     const std::vector<std::array<Vec4<double>, 3>>* corners, auto visit) {
    const DrawOfTriangle draw_of(scene, in.triangles);
    TriangleSetup<> setup{};
    setup.triangle = ~0u;
    int setup_x = 0, setup_y = 0;
    for (std::size_t i = 0; i < in.covered.size(); ++i) {
      const Covered& c = in.covered[i];
      const int tile_x = c.x / kTile * kTile, tile_y = c.y / kTile * kTile;
      if (setup.triangle != c.triangle || tile_x != setup_x || tile_y != setup_y) {
        WindowTriangle<double> triangle = in.triangles.at(c.triangle);
        for (std::size_t k = 0; corners != nullptr && k < 3; ++k) triangle.v[k].color = corners->at(c.triangle)[k];
        const DepthState depth = depth_state(draw_of(c.triangle), scene.frame.depth, scene.depth_clamp);
        setup = stages_.fragment.set_up(narrow(triangle), c.triangle, depth, sample_place(scene.frame), tile_x, tile_y);
        setup_x = tile_x;
        setup_y = tile_y;
      }
      visit(i, Pixels<float>{c.x, c.y, c.x + 0.5, c.y + 0.5}, setup);
    }
  }

  void run_depth(const Scene& scene, const Records<double>& in, Capture& out) {
    const double scale = formats_of(scene.frame).depth_scale;
    each_fragment(scene, in, nullptr, [&](std::size_t, const Pixels<float>& p, const TriangleSetup<>& setup) {
      const double z = stages_.fragment.depth(setup, p);
      out.records.depth.push_back(scale == 0.0 ? z : z / scale);
    });
  }

  void run_attributes(const Scene& scene, const Records<double>& in, Capture& out) {
    each_fragment(scene, in, nullptr, [&](std::size_t, const Pixels<float>& p, const TriangleSetup<>& setup) {
      out.records.attributes.push_back({widen(stages_.fragment.attributes(setup, p))});
    });
    const DrawOfTriangle draw_of(scene, in.triangles);
    for (const Varying v : carried(scene)) {
      if (is_back(v)) continue;
      each_fragment(scene, in, &in.varyings[v].triangles,
                    [&](std::size_t, const Pixels<float>& p, const TriangleSetup<>& setup) {
                      const bool wanted = carries(scene, draw_of(setup.triangle), v);
                      out.records.varyings[v].fragments.push_back(wanted ? widen(stages_.fragment.attributes(setup, p))
                                                                         : Vec4<double>(0));
                    });
    }
  }

  void run_texture(const Scene& scene, const Records<double>& in, Capture& out) {
    if (!textured(scene)) return;
    const std::vector<Surface> surfaces = surfaces_of(scene, {});
    const DrawOfTriangle draw_of(scene, in.triangles);
    const VaryingColumns<double>& st = in.varyings[Varying::texture];
    each_fragment(scene, in, nullptr, [&](std::size_t i, const Pixels<float>& p, const TriangleSetup<>& setup) {
      Texel<double>& to = out.records.texels.emplace_back();
      const auto& of_draw = surfaces[draw_of.index(setup.triangle)].texture;
      if (!of_draw) return;
      const auto& corners = st.triangles.at(setup.triangle);
      const GradientSetup gradient =
          gradient_setup(narrow(in.triangles.at(setup.triangle)),
                         {Vec4<float>(corners[0]), Vec4<float>(corners[1]), Vec4<float>(corners[2])}, setup.planes);
      const Color<float> at = color_of(st.fragments.at(i));
      const Offset<float> offset = from_anchor<float>(setup.planes, p);
      const FilteredTexel<float> texel = stages_.fragment.texture(
          *of_draw, {at.r, at.g}, gradients<float>(gradient, offset, value_at<float>(setup.perspective.sum, offset)));
      to = {widen(texel.color), texel.lod};
    });
  }

  void run_shade(const Scene& scene, const Records<double>& in, Capture& out) {
    Records<float> lights;
    lights.lights = narrow(in.lights);
    const std::vector<Surface> surfaces = surfaces_of(scene, lights);
    const DrawOfTriangle draw_of(scene, in.triangles);
    for (std::size_t i = 0; i < in.covered.size(); ++i) {
      const std::uint32_t triangle = in.covered[i].triangle;
      const Surface& surface = surfaces[draw_of.index(triangle)];
      const Color<float> color = color_of(in.attributes.at(i).color);
      if (surface.plain()) {
        out.records.shaded.push_back({widen(stages_.fragment.shade(color))});
        continue;
      }
      SurfaceAttributes<float> attributes{color, {}, {}};
      if (surface.texture) {
        const Texel<double>& texel = in.texels.at(i);
        attributes.texel = {color_of(texel.color), static_cast<float>(texel.lod)};
      }
      for (const Varying v : surface.carried) attributes[v] = color_of(in.varyings[v].fragments.at(i));
      const bool front = in.triangles.at(triangle).front;
      out.records.shaded.push_back({widen(stages_.fragment.shade_surface(surface, front, attributes))});
    }
  }

  // Visibility and merge: the recorded fragments, in draw order, through the depth test into the planes.
  void run_planes(const Scene& scene, Stage stage, const Capture& capture, Capture& out) {
    const Records<double>& in = capture.records;
    const bool told = stage == Stage::merge && !in.drawn.empty();
    const bool winners_known = stage == Stage::merge && !told && !capture.planes.id.empty();
    const Formats formats = formats_of(scene.frame);
    const std::vector<DrawRange> ranges = draw_ranges(scene);
    Tile cleared{};
    clear(cleared, scene.frame, formats);
    const int w = scene.frame.width, h = scene.frame.height;
    Plane<float> depth(w, h, cleared.depth[0]);
    const bool has_stencil = scene.frame.stencil != StencilFormat::none;
    Plane<std::uint8_t> stencil(has_stencil ? w : 0, has_stencil ? h : 0, cleared.stencil[0]);
    Plane<std::int32_t> id(w, h, kBackground);
    Plane<glm::vec4> color(w, h, {cleared.color[0][0], cleared.color[1][0], cleared.color[2][0], cleared.color[3][0]});
    std::size_t draw = 0;
    for (std::size_t i = 0; i < in.covered.size(); ++i) {
      const Covered& c = in.covered[i];
      const WindowTriangle<double>& triangle = in.triangles.at(c.triangle);
      const std::uint32_t primitive = triangle.primitive;
      while (primitive >= ranges[draw].first_primitive + ranges[draw].primitive_count) ++draw;
      const double z = in.depth.at(i);
      const auto incoming = static_cast<float>(formats.depth_scale == 0.0 ? z : depth_code(z, formats.depth_scale));
      const Color<float> shaded = in.shaded.empty() ? Color<float>{} : color_of(in.shaded.at(i).color);
      glm::vec4& to = color(c.x, c.y);
      const Stored stored{&depth(c.x, c.y), {&to.r, &to.g, &to.b, &to.a}, has_stencil ? &stencil(c.x, c.y) : nullptr};
      const auto passes = [&](const Draw& by) {
        return stages_.fragment.passes(by, triangle.front, incoming, shaded, formats.color_scale, stored);
      };
      bool drawn = false;
      if (told) {
        drawn = in.drawn[i].drawn;
      } else if (winners_known) {  // the winner itself passes; a cut primitive may have two triangles at a pixel
        Draw known = scene.draws[draw];
        known.stencil.reset();  // what was held is not known
        if (id(c.x, c.y) == kBackground) known.depth_func = DepthFunc::always;
        drawn = capture.planes.id(c.x, c.y) == static_cast<std::int32_t>(primitive) && passes(known);
      } else {
        drawn = passes(scene.draws[draw]);
      }
      if (stage == Stage::visibility) out.records.drawn.push_back({drawn});
      if (!drawn) continue;
      id(c.x, c.y) = static_cast<std::int32_t>(primitive);
      stages_.fragment.write(scene.draws[draw].merge, incoming, shaded, formats.color_scale, stored);
    }
    if (stage == Stage::visibility) {
      out.planes.id = std::move(id);
      out.planes.stencil = std::move(stencil);
      return;
    }
    out.planes.depth = Plane<double>(w, h);
    for (std::size_t i = 0; i < depth.size(); ++i) {
      const double z = depth.values()[i];
      out.planes.depth.values()[i] = formats.depth_scale == 0.0 ? z : z / formats.depth_scale;
      if (formats.color_scale != 0.0f) color.values()[i] /= formats.color_scale;
    }
    out.planes.color = std::move(color);
  }

  Frame picture(const Scene& scene, std::string_view painter) const {
    if (!paints_) return render(scene, stages_);
    const auto targets = simd_targets();
    const auto target =
        painter.empty() ? std::prev(targets.end()) : std::ranges::find(targets, painter, &SimdTarget::name);
    if (target == targets.end()) throw std::invalid_argument(fmt::format("no painter is named {}", painter));
    return std::move(Painter(1, *target).draw(scene));
  }

  Stages stages_;
  bool paints_;
};

}  // namespace

std::unique_ptr<Renderer> make_pipeline() { return std::make_unique<PipelineRenderer>(production_stages(), true); }

std::unique_ptr<Renderer> make_pipeline(const Stages& stages) {
  return std::make_unique<PipelineRenderer>(stages, false);
}

}  // namespace plumbline::pipeline
