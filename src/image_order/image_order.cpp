#include "image_order/image_order.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "image_order/crossing.h"
#include "image_order/hierarchy.h"

namespace plumbline::image_order {

namespace {

glm::dmat4 placed(const glm::dmat4& m, const Translate& t) { return glm::translate(m, t.by); }
glm::dmat4 placed(const glm::dmat4& m, const Rotate& r) { return glm::rotate(m, glm::radians(r.degrees), r.axis); }
glm::dmat4 placed(const glm::dmat4& m, const Scale& s) { return glm::scale(m, s.by); }

/// Triangles of a scene in world space, indexed by primitive.
struct World {
  std::vector<std::array<glm::dvec3, 3>> triangles;
  std::vector<std::uint32_t> draw;  ///< number of each triangle's draw
};

World world_of(const Scene& scene) {
  World out;
  for (std::uint32_t d = 0; d < scene.draws.size(); ++d) {
    const Draw& draw = scene.draws[d];
    glm::dmat4 to_world(1);
    for (const Transform& transform : draw.transforms) {
      to_world = std::visit([&](const auto& t) { return placed(to_world, t); }, transform);
    }
    const Mesh& mesh = scene.meshes[draw.mesh];
    std::vector<glm::dvec3> p_world;
    for (const glm::vec3& p : mesh.positions) p_world.emplace_back(to_world * glm::dvec4(p, 1));
    for (const glm::uvec3& t : mesh.triangles) {
      out.triangles.push_back({p_world[t.x], p_world[t.y], p_world[t.z]});
      out.draw.push_back(d);
    }
  }
  return out;
}

/// Window z as the frame's depth format holds it.
double in_format(DepthFormat format, double z_win) {
  const double scale = depth_scale(format);
  if (scale == 0) return static_cast<double>(static_cast<float>(z_win));
  return (format == DepthFormat::z8 ? std::floor(z_win * scale + 0.5) : std::nearbyint(z_win * scale)) / scale;
}

bool passes(DepthFunc func, double incoming, double stored) {
  switch (func) {
    case DepthFunc::never: return false;
    case DepthFunc::less: return incoming < stored;
    case DepthFunc::equal: return incoming == stored;
    case DepthFunc::less_equal: return incoming <= stored;
    case DepthFunc::greater: return incoming > stored;
    case DepthFunc::not_equal: return incoming != stored;
    case DepthFunc::greater_equal: return incoming >= stored;
    case DepthFunc::always: return true;
  }
  return false;
}

/// Winner and depth of a pixel.
struct Answer {
  std::int32_t id;
  double depth;
};

/// Casts rays into a scene, one at a time.
class Caster {
 public:
  explicit Caster(const Scene& scene)
      : scene_(scene), world_(world_of(scene)), hierarchy_(world_.triangles), view_(scene) {
    const bool depths_grow = scene.dialect == Dialect::gl || scene.dialect == Dialect::gzrender;  // with the distance
    nearest_alone_ = depths_grow && std::all_of(scene.draws.begin(), scene.draws.end(), [](const Draw& draw) {
                       const bool by_distance =
                           draw.depth_func == DepthFunc::less || draw.depth_func == DepthFunc::less_equal;
                       return by_distance && draw.merge.depth_mask && draw.depth_range == DepthRange{};
                     });
  }

  Answer at(int x, int y) {
    find_hits(view_.ray(x, y), x, y);
    std::sort(hits_.begin(), hits_.end(), [](const Hit& a, const Hit& b) { return a.primitive < b.primitive; });
    Answer out{kBackground, in_format(scene_.frame.depth, scene_.frame.clear_depth)};
    for (const Hit& hit : hits_) {
      const Draw& draw = draw_of(hit.primitive);
      if (!passes(draw.depth_func, hit.depth, out.depth)) continue;
      out = {static_cast<std::int32_t>(hit.primitive), draw.merge.depth_mask ? hit.depth : out.depth};
    }
    return out;
  }

 private:
  struct Hit {
    std::uint32_t primitive;
    double depth;
  };

  const Draw& draw_of(std::uint32_t primitive) const { return scene_.draws[world_.draw[primitive]]; }
  double depth_of(const DepthRange& range, double along) const {
    const double near = range.near, far = range.far;
    return in_format(scene_.frame.depth, near + (far - near) * view_.window_z(along));
  }

  void find_hits(const Ray& ray, int x, int y) {
    hits_.clear();
    double nearest = 2;  // window z
    // By the depth that is compared, which never falls as the distance grows (nearest_alone_).
    const auto too_far = [&](double along) {
      return along > view_.far() || (nearest_alone_ && depth_of({}, std::max(along, view_.near())) > nearest);
    };
    hierarchy_.walk(ray, view_.near(), too_far, [&](std::uint32_t primitive) {
      const std::optional<Crossing> at = crossing(ray, world_.triangles[primitive]);
      if (!at || at->along < view_.near() || at->along > view_.far()) return;
      const Draw& draw = draw_of(primitive);
      if (draw.scissor && !draw.scissor->holds(x, y)) return;
      const Cull cull = draw.cull;
      if (cull != Cull::none && at->front == (cull == Cull::front)) return;
      hits_.push_back({primitive, depth_of(draw.depth_range, at->along)});
      nearest = std::min(nearest, hits_.back().depth);
    });
  }

  const Scene& scene_;
  World world_;
  Hierarchy hierarchy_;
  View view_;
  bool nearest_alone_;  ///< a hit of greater depth than another neither wins nor changes the winner
  std::vector<Hit> hits_;
};

class ImageOrderRenderer final : public Renderer {
 public:
  RendererInfo info() const override {
    RendererInfo info{.name = "image_order", .version = PLUMBLINE_VERSION, .stages = {}, .profile = Profile::opengl};
    for (Ability& ability : info.stages) ability.reason = "a ray finds what is visible, and nothing else is drawn";
    info[Stage::depth].reason = "handed out, but through corners that were never rounded: a matter of legal answers";
    info[Stage::visibility] = {true, false, ""};
    info[Stage::resolve].reason = "it finds what is visible, not its colour";
    return info;
  }

  Capture capture(const Scene& scene, const Request& request) override {
    if (antialiased(scene)) throw Unsupported("it finds what is visible, not its colour");
    if (may_draw(scene, Topology::lines) || may_draw(scene, Topology::points)) {
      throw Unsupported("no ray meets a line or a point");
    }
    for (const Draw& draw : scene.draws) {
      if (draw.alpha_test || draw.stencil || draw.polygon_offset != PolygonOffset{}) {
        throw Unsupported("a ray here knows no alpha, no stencil value and no slope");
      }
    }
    std::size_t triangles = 0;
    for (const DrawRange& range : draw_ranges(scene)) triangles += range.primitive_count;
    constexpr std::size_t kTriangle = sizeof(std::array<glm::dvec3, 3>) + 2 * sizeof(std::uint32_t) + 64;  // and a box
    require_budget(scene, plane_bytes(scene) + triangles * kTriangle, request.memory_budget);

    Caster caster(scene);
    Capture out;
    out.renderer = info().name;
    out.version = info().version;
    out.width = scene.frame.width;
    out.height = scene.frame.height;
    out.planes.id = Plane<std::int32_t>(out.width, out.height);
    out.planes.depth = Plane<double>(out.width, out.height);
    if (scene.frame.stencil != StencilFormat::none) {  // no draw asks for it, so it stays as it was cleared
      out.planes.stencil = Plane<std::uint8_t>(out.width, out.height, scene.frame.clear_stencil);
    }
    for (int y = 0; y < out.height; ++y) {
      for (int x = 0; x < out.width; ++x) {
        const Answer answer = caster.at(x, y);
        out.planes.id(x, y) = answer.id;
        out.planes.depth(x, y) = answer.depth;
      }
    }
    return out;
  }
};

}  // namespace

std::unique_ptr<Renderer> make_image_order() { return std::make_unique<ImageOrderRenderer>(); }

}  // namespace plumbline::image_order
