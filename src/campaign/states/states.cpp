#include "campaign/states/states.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "scene/names.h"

namespace plumbline::campaign {

namespace {

// Test of a scene for each state; the order of the tests numbers the states.
class StateFinder {
 public:
  StateFinder(const Scene& scene, const Capture& drawn, const std::function<void(const std::string&, bool)>& tell)
      : scene_(scene), records_(drawn.records), planes_(drawn.planes), tell_(tell) {}

  void all() {
    frame();
    view_and_light();
    geometry();
    surface();
    textures();
    fragments();
    outcomes_of_vertices();
    outcomes_of_fragments();
    outcomes_of_the_frame();
  }

 private:
  void tell(const std::string& name, bool is) { tell_(name, is); }
  bool any(const std::function<bool(const Draw&)>& holds) const { return std::ranges::any_of(scene_.draws, holds); }
  bool any_light(const std::function<bool(const Light&)>& holds) const {
    return std::ranges::any_of(scene_.lights, holds);
  }
  template <class E>
  void each(const std::string& key, const std::function<bool(E)>& is) {
    for (std::size_t i = 0; i < kNamesOf<E>.size(); ++i) {
      tell(fmt::format("{} {}", key, kNamesOf<E>[i]), is(static_cast<E>(i)));
    }
  }
  template <class E, class Of>
  void each_of_draws(const std::string& key, Of of) {
    each<E>(key, [&](E value) { return any([&](const Draw& d) { return of(d) == value; }); });
  }
  void tell_draws(const std::string& name, const std::function<bool(const Draw&)>& holds) { tell(name, any(holds)); }

  void frame() {
    const FrameFormat& f = scene_.frame;
    each<Dialect>("dialect", [&](Dialect d) { return scene_.dialect == d; });
    each<ColorFormat>("color", [&](ColorFormat c) { return f.color == c; });
    each<DepthFormat>("depth", [&](DepthFormat d) { return f.depth == d; });
    each<StencilFormat>("stencil", [&](StencilFormat s) { return f.stencil == s; });
    for (const auto& [name, kind] : {std::pair("none", Antialias::Kind::none),
                                     {"samples", Antialias::Kind::multisample},
                                     {"supersample", Antialias::Kind::supersample},
                                     {"taps", Antialias::Kind::taps}}) {
      tell(fmt::format("antialias {}", name), f.antialias.kind == kind);
    }
    tell("clear_depth not the usual", f.clear_depth != 1 && f.clear_depth != 0);
  }

  void view_and_light() {
    constexpr const char* kProjections[] = {"perspective", "orthographic", "frustum", "x_pi", "pinhole"};
    for (std::size_t i = 0; i < std::size(kProjections); ++i) {
      tell(fmt::format("projection {}", kProjections[i]), scene_.projection.index() == i);
    }
    tell("no light", scene_.lights.empty());
    tell("several lights", scene_.lights.size() > 1);
    tell("light directional", any_light([](const Light& l) { return l.kind == Light::Kind::directional; }));
    tell("light point", any_light([](const Light& l) { return l.kind == Light::Kind::point; }));
    tell("light attenuated", any_light([](const Light& l) { return l.attenuation != glm::vec3(1, 0, 0); }));
    tell("light spot", any_light([](const Light& l) { return l.spot.has_value(); }));
    const LightModel& m = scene_.light_model;
    tell("local_viewer", m.local_viewer);
    tell("separate_specular", m.separate_specular);
    each<LightModel::Specular>("specular", [&](LightModel::Specular s) { return m.specular == s; });
    each<LightModel::Sides>("sides", [&](LightModel::Sides s) { return m.sides == s; });
  }

  void geometry() {
    each_of_draws<Topology>("topology", [&](const Draw& d) { return scene_.meshes[d.mesh].topology; });
    each_of_draws<Cull>("cull", [](const Draw& d) { return d.cull; });
    each_of_draws<PolygonMode>("front_mode", [](const Draw& d) { return d.front_mode; });
    each_of_draws<PolygonMode>("back_mode", [](const Draw& d) { return d.back_mode; });
    each_of_draws<Normals>("normals", [](const Draw& d) { return d.normals; });
    tell_draws("line_width over 1", [](const Draw& d) { return d.line_width > 1; });
    tell_draws("point_size over 1", [](const Draw& d) { return d.point_size > 1; });
    tell_draws("transforms", [](const Draw& d) { return !d.transforms.empty(); });
    tell_draws("polygon_offset", [](const Draw& d) { return !(d.polygon_offset == PolygonOffset{}); });
    tell_draws("mesh with colors", [&](const Draw& d) { return !scene_.meshes[d.mesh].colors.empty(); });
    tell("several draws", scene_.draws.size() > 1);
  }

  void surface() {
    tell_draws("lit", [](const Draw& d) { return d.lit; });
    tell_draws("unlit", [](const Draw& d) { return !d.lit; });
    tell_draws("back_material", [](const Draw& d) { return d.back_material.has_value(); });
    tell_draws("shininess", [](const Draw& d) { return d.material.shininess > 0; });
    tell_draws("emission", [](const Draw& d) { return glm::vec3(d.material.emission) != glm::vec3(0); });
    each_of_draws<Shading>("shading", [](const Draw& d) { return d.shading; });
    each_of_draws<ColorMaterial>("color_material", [](const Draw& d) { return d.color_material; });
    each<Fog::Mode>("fog", [&](Fog::Mode m) { return any([&](const Draw& d) { return d.fog && d.fog->mode == m; }); });
  }

  void textures() {
    const auto of_draws = [&](const std::function<bool(const Texture&)>& holds) {
      return any([&](const Draw& d) { return d.texture && holds(scene_.textures[d.texture->texture]); });
    };
    tell_draws("untextured", [](const Draw& d) { return !d.texture; });
    each<TextureEnvironment>("environment", [&](TextureEnvironment e) {
      return any([&](const Draw& d) { return d.texture && d.texture->environment == e; });
    });
    each<TextureFormat>("format",
                        [&](TextureFormat f) { return of_draws([&](const Texture& t) { return t.format == f; }); });
    each<TexelType>("texels", [&](TexelType y) { return of_draws([&](const Texture& t) { return t.type == y; }); });
    each<MinFilter>("min", [&](MinFilter f) { return of_draws([&](const Texture& t) { return t.sampler.min == f; }); });
    each<MagFilter>("mag", [&](MagFilter f) { return of_draws([&](const Texture& t) { return t.sampler.mag == f; }); });
    each<Wrap>("wrap_s", [&](Wrap w) { return of_draws([&](const Texture& t) { return t.sampler.wrap_s == w; }); });
    each<Wrap>("wrap_t", [&](Wrap w) { return of_draws([&](const Texture& t) { return t.sampler.wrap_t == w; }); });
    tell("lod_bias", of_draws([](const Texture& t) { return t.sampler.lod_bias != 0; }));
  }

  void fragments() {
    each_of_draws<CompareFunc>("depth_func", [](const Draw& d) { return d.depth_func; });
    tell_draws("depth_range", [](const Draw& d) { return !(d.depth_range == DepthRange{}); });
    tell_draws("depth_mask off", [](const Draw& d) { return !d.merge.depth_mask; });
    tell_draws("color_mask", [](const Draw& d) { return !glm::all(d.merge.color_mask); });
    tell_draws("scissor", [](const Draw& d) { return d.scissor.has_value(); });
    each<CompareFunc>("alpha_test", [&](CompareFunc f) {
      return any([&](const Draw& d) { return d.alpha_test && d.alpha_test->func == f; });
    });
    each<CompareFunc>("stencil func", [&](CompareFunc f) {
      return any([&](const Draw& d) { return d.stencil && (d.stencil->front.func == f || d.stencil->back.func == f); });
    });
    for (const auto& [when, op] : {std::pair("fail", &StencilFace::fail),
                                   {"depth_fail", &StencilFace::depth_fail},
                                   {"pass", &StencilFace::pass}}) {
      each<StencilOp>(fmt::format("stencil {}", when), [&, of = op](StencilOp o) {
        return any([&](const Draw& d) { return d.stencil && (d.stencil->front.*of == o || d.stencil->back.*of == o); });
      });
    }
    each<BlendFactor>("blend source", [&](BlendFactor f) {
      return any([&](const Draw& d) { return d.merge.blend && d.merge.blend->rgb.source == f; });
    });
    for (const Name name : kNamesOf<BlendFactor>) {
      if (name == name_of(BlendFactor::source_alpha_saturate)) continue;  // of a source alone
      tell_draws(fmt::format("blend destination {}", name),
                 [&](const Draw& d) { return d.merge.blend && name_of(d.merge.blend->rgb.destination) == name; });
    }
    each<BlendEquation>("blend", [&](BlendEquation e) {
      return any([&](const Draw& d) { return d.merge.blend && d.merge.blend->rgb.equation == e; });
    });
    tell_draws("blend with alpha's own terms",
               [](const Draw& d) { return d.merge.blend && !(d.merge.blend->alpha == d.merge.blend->rgb); });
    each<LogicOp>("logic_op", [&](LogicOp o) { return any([&](const Draw& d) { return d.merge.logic_op == o; }); });
  }

  void outcomes_of_vertices() {
    const auto any_vertex = [&](auto holds) {
      return std::ranges::any_of(records_.vertices, [&](const auto& v) { return holds(v.p_clip); });
    };
    tell("clip: a vertex behind the eye", any_vertex([](const auto& p) { return p.w < 0; }));
    tell("clip: a vertex beside the eye", any_vertex([](const auto& p) { return std::abs(p.w) < 1e-5; }));
    tell("clip: a vertex beyond near", any_vertex([](const auto& p) { return p.z < -p.w; }));
    tell("clip: a vertex beyond far", any_vertex([](const auto& p) { return p.z > p.w; }));
    tell("clip: a vertex beyond a side",
         any_vertex([](const auto& p) { return std::abs(p.x) > p.w || std::abs(p.y) > p.w; }));
    tell("clip: a vertex on a plane", any_vertex([](const auto& p) {
           return std::abs(p.z) == p.w || std::abs(p.x) == p.w || std::abs(p.y) == p.w;
         }));
    for (const std::uint32_t corners : {3u, 4u, 5u, 6u, 7u}) {
      tell(fmt::format("clip: a polygon of {} corners{}", corners, corners == 7 ? " or more" : ""),
           std::ranges::any_of(records_.polygons.polygons, [&](const ClipPolygon& p) {
             return p.count == corners || (corners == 7 && p.count > 7);
           }));
    }
    std::size_t primitives = 0;
    for (const Draw& d : scene_.draws) primitives += scene_.meshes[d.mesh].triangles.size();
    tell("clip: a primitive is gone",
         !records_.polygons.vertices.empty() && records_.polygons.polygons.size() < primitives);
    const auto any_triangle = [&](auto holds) { return std::ranges::any_of(records_.triangles, holds); };
    tell("window: a front face", any_triangle([](const auto& t) { return t.front; }));
    tell("window: a back face", any_triangle([](const auto& t) { return !t.front; }));
    tell("window: a corner on a pixel's centre", any_triangle([](const auto& t) {
           return std::ranges::any_of(t.v,
                                      [](const auto& v) { return v.snapped.x % 256 == 0 && v.snapped.y % 256 == 0; });
         }));
  }

  void outcomes_of_fragments() {
    std::vector<std::size_t> covered(records_.triangles.size());
    for (const Covered& c : records_.covered) {
      if (c.triangle < covered.size()) ++covered[c.triangle];  // a capture may have fragments, no triangles
    }
    tell("coverage: a triangle without a fragment", std::ranges::count(covered, 0u) > 0);
    tell("coverage: a triangle of one fragment", std::ranges::count(covered, 1u) > 0);
    tell("coverage: a triangle of 1000 fragments or more",
         std::ranges::any_of(covered, [](std::size_t n) { return n >= 1000; }));
    tell("depth: at 0", std::ranges::count(records_.depth, 0.0) > 0);
    tell("depth: at 1", std::ranges::count(records_.depth, 1.0) > 0);
    const auto any_drawn = [&](bool drawn) {
      return std::ranges::any_of(records_.drawn, [&](const Drawn& d) { return d.drawn == drawn; });
    };
    tell("visibility: a fragment passes", any_drawn(true));
    tell("visibility: a fragment is dropped", any_drawn(false));
    const auto any_color = [&](auto holds) {
      return std::ranges::any_of(records_.shaded, [&](const auto& s) { return holds(s.color); });
    };
    tell("shade: transparent", any_color([](const auto& c) { return c.a < 1; }));
    tell("shade: brightest", any_color([](const auto& c) { return c.r >= 1; }));
    tell("shade: black", any_color([](const auto& c) { return c.r == 0 && c.g == 0 && c.b == 0; }));
  }

  void outcomes_of_the_frame() {
    const auto any_count = [&](std::uint32_t from, std::uint32_t to) {
      return std::ranges::any_of(planes_.count.values(), [&](std::uint32_t n) { return n >= from && n <= to; });
    };
    tell("a pixel without a fragment", any_count(0, 0));
    tell("a pixel of one fragment", any_count(1, 1));
    tell("a pixel of 2 to 7 fragments", any_count(2, 7));
    tell("a pixel of 8 fragments or more", any_count(8, ~0u));
    const auto any_held = [&](std::uint8_t from, std::uint8_t to) {
      return std::ranges::any_of(planes_.stencil.values(), [&](std::uint8_t s) { return s >= from && s <= to; });
    };
    tell("stencil: 0 is held", any_held(0, 0));
    tell("stencil: 255 is held", any_held(255, 255));
    tell("stencil: another is held", any_held(1, 254));
  }

  const Scene& scene_;
  const Records<double>& records_;
  const Planes& planes_;
  const std::function<void(const std::string&, bool)>& tell_;
};

}  // namespace

const std::vector<std::string>& state_names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> out;
    const std::function<void(const std::string&, bool)> take = [&](const std::string& name, bool) {
      out.push_back(name);
    };
    const Scene none;
    const Capture nothing;
    StateFinder(none, nothing, take).all();
    return out;
  }();
  return kNames;
}

StateBits states_of(const Scene& scene, const Capture& drawn) {
  StateBits out((state_names().size() + 7) / 8, '\0');
  std::size_t state = 0;
  const std::function<void(const std::string&, bool)> take = [&](const std::string&, bool is) {
    if (is) out[state / 8] = static_cast<char>(out[state / 8] | (1 << (state % 8)));
    ++state;
  };
  StateFinder(scene, drawn, take).all();
  return out;
}

}  // namespace plumbline::campaign
