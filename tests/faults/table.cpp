#include "faults/table.h"

#include "tests/thin_pixels.h"

namespace plumbline::faults {

namespace {

// Asks the table for each stage.
struct Tabled : pipeline::FragmentStages {
  FragmentTable f;
  explicit Tabled(const FragmentTable& table) : f(table) {}

  pipeline::AttributeSetup attribute_setup(const WindowTriangle<float>& t, std::uint32_t) const {
    return f.attribute_setup(t);
  }
  pipeline::Places places(glm::ivec2 sample) const { return f.places(sample); }
  pipeline::PixelBounds bounds(const WindowTriangle<float>& t) const { return f.bounds(t); }
  pipeline::Edges edges(const WindowTriangle<float>& t) const { return f.edges(t); }
  void visit_thin_pixels(const WindowTriangle<float>& t, glm::ivec2 origin, int size, auto visit) const {
    for (const glm::ivec2 pixel : f.thin_pixels(t, origin, size)) visit(pixel);
  }
  template <class R>
  bool coverage(const pipeline::TriangleSetup<>& s, const pipeline::Pixels<R>& p) const {
    return f.coverage(s, p);
  }
  template <class R>
  bool scissor(const Scissor& box, const pipeline::Pixels<R>& p) const {
    return f.scissor(box, p);
  }
  pipeline::DepthSetup depth_setup(const WindowTriangle<float>& t, const pipeline::DepthState& state) const {
    return f.depth_setup(t, state);
  }
  template <class R>
  R depth(const pipeline::TriangleSetup<>& s, const pipeline::Pixels<R>& p) const {
    return f.depth(s, p);
  }
  template <class R>
  bool depth_passes(DepthFunc func, R incoming, R stored) const {
    return f.depth_passes(func, incoming, stored);
  }
  template <class R>
  pipeline::Color<R> attributes(const pipeline::TriangleSetup<>& s, const pipeline::AttributeSetup& of,
                                const pipeline::Pixels<R>& p) const {
    return f.attributes(s, of, p);
  }
  template <class R>
  pipeline::Color<R> shade(const pipeline::Color<R>& attributes) const {
    return f.shade(attributes);
  }
  template <class R>
  pipeline::FilteredTexel<R> texture(const pipeline::TextureSetup& t, const pipeline::TexCoords<R>& at,
                                     const pipeline::Gradients<R>& gradients) const {
    return f.texture(t, at, gradients);
  }
  template <class R>
  pipeline::Color<R> shade_surface(const pipeline::Surface& surface, bool front,
                                   const pipeline::SurfaceAttributes<R>& attributes) const {
    return f.shade_surface(surface, front, attributes);
  }
  template <class R>
  bool alpha_passes(const AlphaTest& test, R alpha, float scale) const {
    return f.alpha_passes(test, alpha, scale);
  }
  template <class R>
  bool stencil_test(const StencilFace& face, bool alive, bool nearer, std::uint8_t* at) const {
    return f.stencil_test(face, alive, nearer, at);
  }
  template <class R>
  pipeline::Color<R> merge(const pipeline::Color<R>& color, float scale) const {
    return f.merge(color, scale);
  }
  template <class R>
  pipeline::Color<R> blend(const Blend& state, const pipeline::Color<R>& source, const pipeline::Color<R>& stored,
                           float scale) const {
    return f.blend(state, source, stored, scale);
  }
  template <class R>
  pipeline::Color<R> logic(LogicOp op, const pipeline::Color<R>& source, const pipeline::Color<R>& stored,
                           float scale) const {
    return f.logic(op, source, stored, scale);
  }
  Merge merge_state(const Merge& of_draw) const { return f.merge_state(of_draw); }
};

}  // namespace

Table production() {
  using pipeline::FragmentStages;
  FragmentTable f;
  f.attribute_setup = [](const WindowTriangle<float>& t) { return FragmentStages::attribute_setup(t, 0); };
  f.places = FragmentStages::places;
  f.bounds = FragmentStages::bounds;
  f.edges = FragmentStages::edges;
  f.thin_pixels = plumbline::thin_pixels;
  f.coverage = [](const pipeline::TriangleSetup<>& s, const pipeline::Pixels<float>& p) {
    return FragmentStages::coverage<float>(s, p);
  };
  f.scissor = FragmentStages::scissor<float>;
  f.depth_setup = FragmentStages::depth_setup;
  f.depth = [](const pipeline::TriangleSetup<>& s, const pipeline::Pixels<float>& p) {
    return FragmentStages::depth<float>(s, p);
  };
  f.depth_passes = FragmentStages::depth_passes<float>;
  f.attributes = [](const pipeline::TriangleSetup<>& s, const pipeline::AttributeSetup& of,
                    const pipeline::Pixels<float>& p) { return FragmentStages::attributes<float>(s, of, p); };
  f.texture = FragmentStages::texture<float>;
  f.shade = FragmentStages::shade<float>;
  f.shade_surface = FragmentStages::shade_surface<float>;
  f.alpha_passes = FragmentStages::alpha_passes<float>;
  f.stencil_test = FragmentStages::stencil_test<float>;
  f.merge = FragmentStages::merge<float>;
  f.blend = FragmentStages::blend<float>;
  f.logic = FragmentStages::logic<float>;
  f.merge_state = FragmentStages::merge_state;
  return {pipeline::geometry_stages(), f, {}};
}

pipeline::Stages stages_of(const Table& table) {
  return {table.geometry, pipeline::fragment_functions(Tabled(table.fragment)), table.resolve};
}

}  // namespace plumbline::faults
