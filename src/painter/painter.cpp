#include "painter/painter.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <tuple>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "kernels/light_equation.h"
#include "kernels/shade.h"
#include "pipeline/geometry.h"
#include "pipeline/resolve.h"
#include "scene/antialias.h"

namespace plumbline::pipeline {

namespace {

// Whether a draw's vertices go through stages 1, 2 and 4 in lanes; else they go through the definition's.
bool goes_in_lanes(const Scene& scene, const Draw& draw) {
  const Mesh& mesh = scene.meshes[draw.mesh];
  const bool by_color = draw.color_material != ColorMaterial::none && !mesh.colors.empty();
  const bool filled = mesh.topology == Topology::triangles && draw.front_mode == PolygonMode::fill &&
                      draw.back_mode == PolygonMode::fill;
  return (filled || draw.shading != Shading::flat) && !(is_lit_per_vertex(draw) && by_color) &&
         !carries(scene, draw, Varying::back_color) && !carries(scene, draw, Varying::back_secondary);
}

// Whether every facing that is not culled is drawn in this mode.
bool draws_as(const Draw& draw, PolygonMode mode) {
  return (draw.cull == Cull::front || draw.front_mode == mode) && (draw.cull == Cull::back || draw.back_mode == mode);
}

PaintKernel kernel_of(const Mesh& mesh, const Draw& draw, const DepthState& depth, bool has_surface) {
  const bool plain = depth.format == DepthFormat::z24 && depth.low == 0.0 && depth.high == 1.0 &&
                     draw.depth_func == DepthFunc::less && !draw.scissor && !draw.alpha_test && !draw.stencil &&
                     draw.merge.depth_mask;
  if (!plain) return PaintKernel::any;
  const bool triangles = mesh.topology == Topology::triangles;
  // Lines have no polygon offset, even where the draw sets one (depth.cpp).
  if (mesh.topology == Topology::lines || (triangles && draws_as(draw, PolygonMode::line))) {
    return is_opaque(draw.merge) && !has_surface ? PaintKernel::lines : PaintKernel::any;
  }
  if (!triangles || !draws_as(draw, PolygonMode::fill) || depth.offset != PolygonOffset{}) return PaintKernel::any;
  if (!glm::any(draw.merge.color_mask)) return PaintKernel::depth_only;
  if (is_opaque(draw.merge)) return !has_surface ? PaintKernel::replaces : PaintKernel::shades;
  const bool over =
      draw.merge.blend && is_over(*draw.merge.blend) && !draw.merge.logic_op && glm::all(draw.merge.color_mask);
  return over && !has_surface ? PaintKernel::blends_over : PaintKernel::any;
}

// Whether a frame of four samples is drawn in one pass, each tile with all samples. Other antialiased frames are
// resolved from one frame per pass.
bool takes_samples(const FrameFormat& frame) {
  return frame.antialias.kind == Antialias::Kind::multisample && frame.color == ColorFormat::rgba8 &&
         frame.stencil == StencilFormat::none;
}

}  // namespace

// Frames kept from scene to scene, as long as number, size and formats of frames stay the same.
class KeptFrames {
 public:
  std::vector<Frame>& of(const FrameFormat& format, std::size_t count) {
    const auto planes =
        std::tuple(format.width, format.height, format.color, format.depth, format.stencil == StencilFormat::none);
    if (frames_.size() != count || planes_ != planes || frames_[0].empty()) {
      frames_.clear();  // before the assignment, which may throw: no frame of the old format is left
      frames_.assign(count, Frame(format));
      planes_ = planes;
    }
    return frames_;
  }

 private:
  std::vector<Frame> frames_;
  std::tuple<int, int, ColorFormat, DepthFormat, bool> planes_;
};

struct Painter::Memory {
  static constexpr int kMostThreads = 256;
  Memory(int thread_count, const SimdTarget& of)
      : threads(std::clamp(thread_count, 1, kMostThreads)), target(of), arena(threads) {
    if (threads > tbb::info::default_concurrency()) {
      // TBB starts no more workers than processors, unless this limit of the whole process is higher.
      static const tbb::global_control workers(tbb::global_control::max_allowed_parallelism, kMostThreads);
    }
    for (int i = 0; i < threads; ++i) tiles.push_back(std::make_unique_for_overwrite<TileMemory>());
  }

  void draw_pass(const Scene& scene, Frame& to);

  // Calls f(0) to f(count - 1), on the threads, in any order.
  template <class F>
  void each(std::size_t count, F f) {
    if (threads == 1) {
      for (std::size_t i = 0; i < count; ++i) f(i);
      return;
    }
#ifdef __SANITIZE_THREAD__
    // ThreadSanitizer does not see how TBB synchronises its threads, and would report races everywhere.
    std::atomic<std::size_t> next{0};
    std::vector<std::jthread> workers;
    for (int t = 0; t < threads; ++t) {
      workers.emplace_back([&] {
        for (std::size_t i = next++; i < count; i = next++) f(i);
      });
    }
#else
    arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, f, tbb::simple_partitioner()); });
#endif
  }

  void prepare(const Scene& scene);
  void run_vertices(const Scene& scene);
  void run_others(const Scene& scene);
  void run_triangles();
  void run_tiles(Frame& to);

  const int threads;
  const SimdTarget target;
  tbb::task_arena arena;
  std::vector<std::unique_ptr<TileMemory>> tiles;

  Painting painting{};
  std::vector<DrawRange> ranges;
  std::vector<Surface> surfaces;
  std::vector<PaintDraw> draws;
  Illumination illumination;
  std::vector<VertexWork> vertex_work;
  struct Share {
    std::size_t draw, from, to;
    std::uint8_t outside;
  };
  std::vector<Share> shares;
  std::vector<AssemblyWork> assembly;
  OtherTriangles others;
  ScalarGeometry scalar_geometry;
  std::vector<Chunk> chunks;
  std::vector<PaintVertex> vertices;
  std::vector<glm::ivec2> snapped;
  std::vector<std::uint8_t> outside;
  std::vector<Varying> carried_varyings;  // of any draw's fragments
  std::array<std::vector<Vec4<float>>, kVaryings> varyings;
  std::size_t vertex_count = 0;

  KeptFrames frame, passes;
  Scene pass;
};

void Painter::Memory::prepare(const Scene& scene) {
  painting.format = scene.frame;
  painting.formats = formats_of(scene.frame);
  painting.samples = takes_samples(scene.frame) ? std::span<const glm::ivec2>(kSamples)
                                                : std::span<const glm::ivec2>(&painting.formats.sample, 1);
  painting.columns = (scene.frame.width + kTile - 1) / kTile;
  painting.rows = (scene.frame.height + kTile - 1) / kTile;
  draw_ranges(scene, ranges);
  surfaces.clear();
  const auto lights = light_sources(scene);
  for (const Draw& draw : scene.draws) surfaces.push_back(surface_of(scene, draw, {lights.begin(), lights.end()}));
  draws.clear();
  for (std::size_t d = 0; d < scene.draws.size(); ++d) {
    const Draw& draw = scene.draws[d];
    const DepthState depth = depth_state(draw, scene.frame.depth, scene.depth_clamp);
    const bool plain = is_plain(scene, draw);
    const PaintKernel kernel = kernel_of(scene.meshes[draw.mesh], draw, depth, !plain);
    const bool colors = !plain && kernel != PaintKernel::depth_only;  // depth_only shades no fragment
    draws.push_back({&draw, depth, colors ? &surfaces[d] : nullptr, kernel});
  }
  painting.draws = draws;
}

// Stages 0, 1, 2 and 4.
void Painter::Memory::run_vertices(const Scene& scene) {
  illumination = pipeline::illumination(scene, light_sources(scene));
  vertex_work.clear();
  shares.clear();
  assembly.clear();
  vertex_count = ranges.empty() ? 0 : ranges.back().first_vertex + ranges.back().vertex_count;
  PaintVertex* to = room_for(vertex_count, vertices);
  glm::ivec2* snapped_to = room_for(vertex_count, snapped);
  std::uint8_t* outside_of = room_for(vertex_count, outside);
  carried(scene, carried_varyings);
  std::erase_if(carried_varyings, is_back);
  for (const Varying v : carried_varyings) room_for(vertex_count, varyings[index_of(v)]);
  constexpr std::size_t kShare = 2048;
  for (std::size_t d = 0; d < scene.draws.size(); ++d) {
    const Draw& draw = scene.draws[d];
    const Mesh& mesh = scene.meshes[draw.mesh];
    const DrawRange& range = ranges[d];
    const unsigned planes = scene.depth_clamp ? 0xfu : 0x3fu;
    const bool in_lanes = goes_in_lanes(scene, draw);
    assembly.push_back({&draw, &mesh, range, static_cast<std::uint8_t>(planes),
                        in_lanes ? outside_of + range.first_vertex : nullptr, 0});
    VertexWork work{};
    work.mesh = &mesh;
    work.matrices = matrices(scene, draw);
    work.to_clip = clip_matrix(work.matrices);
    work.normalizes = draw.normals == Normals::normalize;
    work.normal_divisor = draw.normals == Normals::rescale ? length(work.matrices.normal[2]) : 1.0f;
    if (is_lit_per_vertex(draw)) {
      work.illumination = &illumination;
      work.reflectance = reflectance<float>(scene, {lit_material(scene, draw, {}, nullptr)}, {});
      work.secondary = reflectance<float>(scene, {lit_material(scene, draw, {false, true}, nullptr)}, {});
    }
    work.color = glm::clamp(draw.material.diffuse, 0.0f, 1.0f);
    work.wants_normals = is_lit_per_vertex(draw) || carries(scene, draw, Varying::normal);
    work.out = to + range.first_vertex;
    work.snapped = snapped_to + range.first_vertex;
    work.outside = outside_of + range.first_vertex;
    for (const Varying v : kAllVaryings) {
      const auto i = index_of(v);
      if (!is_back(v) && carries(scene, draw, v)) work.varyings[i] = varyings[i].data() + range.first_vertex;
    }
    vertex_work.push_back(work);
    for (std::size_t from = 0; in_lanes && from < range.vertex_count; from += kShare) {
      shares.push_back({d, from, std::min<std::size_t>(from + kShare, range.vertex_count), 0});
    }
  }
  each(shares.size(), [&](std::size_t i) {
    Share& share = shares[i];
    share.outside = target.vertices(vertex_work[share.draw], share.from, share.to);
  });
  for (const Share& share : shares) assembly[share.draw].any_outside |= share.outside;
}

// Stages 0 to 4 by the definition, of primitives that do not go in lanes. Their vertices follow all others in
// `vertices`.
void Painter::Memory::run_others(const Scene& scene) {
  const std::span<const ShadedTriangle> triangles = scalar_geometry.run(scene, assembly);
  others = {triangles, static_cast<std::uint32_t>(vertex_count)};
  if (triangles.empty()) return;
  const std::size_t all = vertex_count + 3 * triangles.size();
  room_for(all, vertices), room_for(all, snapped);
  for (const Varying v : carried_varyings) room_for(all, varyings[index_of(v)]);
  for (std::size_t to = vertex_count, i = 0; to < all; ++to, ++i) {
    const ShadedTriangle& t = triangles[i / 3];
    const WindowVertex& v = t.v[i % 3];
    vertices[to] = {v.p_win, v.inv_w, t.attributes[i % 3].color()};
    snapped[to] = v.snapped;
    for (const Varying a : carried_varyings) varyings[static_cast<std::size_t>(a)][to] = t.attributes[i % 3][a];
  }
}

// Stages 3 and 4, in chunks.
void Painter::Memory::run_triangles() {
  painting.vertices = vertices.data();
  painting.snapped = snapped.data();
  for (std::size_t i = 0; i < kVaryings; ++i) painting.varyings[i] = varyings[i].data();
  const std::uint32_t primitives = ranges.empty() ? 0 : ranges.back().first_primitive + ranges.back().primitive_count;
  constexpr std::uint32_t kFewest = 4096;
  const std::uint32_t most = threads == 1 ? 1 : 4 * static_cast<std::uint32_t>(threads);
  const std::uint32_t count = std::clamp(primitives / kFewest, 1u, most);
  chunks.resize(std::max<std::size_t>(chunks.size(), count));
  each(count, [&](std::size_t i) {
    chunks[i].first_primitive = static_cast<std::uint32_t>(std::uint64_t{primitives} * i / count);
    chunks[i].end_primitive = static_cast<std::uint32_t>(std::uint64_t{primitives} * (i + 1) / count);
    assemble(chunks[i], assembly, others, painting, target.cull);
  });
  painting.chunks = std::span(chunks).first(count);
  painting.any_long_edge =
      std::any_of(painting.chunks.begin(), painting.chunks.end(), [](const Chunk& c) { return c.any_long_edge; });
}

void Painter::Memory::run_tiles(Frame& to) {
  // Reserved for all threads at once: a thread that first gets a tile in a later frame allocates nothing then.
  std::size_t runs = 0;
  for (const Chunk& chunk : painting.chunks) runs += chunk.draws.size();
  for (const auto& memory : tiles) memory->runs.reserve(runs);
  TileCounter counter(painting.columns * painting.rows, threads);
  each(static_cast<std::size_t>(threads),
       [&](std::size_t worker) { target.tiles(painting, counter, *tiles[worker], to); });
}

void Painter::Memory::draw_pass(const Scene& scene, Frame& to) {
  prepare(scene);
  run_vertices(scene);
  run_others(scene);
  run_triangles();
  run_tiles(to);
}

Painter::Painter(int threads, const SimdTarget& target) : memory_(std::make_unique<Memory>(threads, target)) {}
Painter::~Painter() = default;

Frame& Painter::draw(const Scene& scene) {
  Frame& frame = memory_->frame.of(scene.frame, 1)[0];
  if (!antialiased(scene) || takes_samples(scene.frame)) {
    memory_->draw_pass(scene, frame);
    return frame;
  }
  Scene& pass = memory_->pass;
  pass_of(scene, 0, pass);
  std::vector<Frame>& passes = memory_->passes.of(pass.frame, pass_count(scene.frame.antialias));
  for (std::size_t i = 0; i < passes.size(); ++i) {
    pass.frame.pass = state_of_pass(scene.frame, i);
    memory_->draw_pass(pass, passes[i]);
  }
  resolve({}, scene.frame, passes, frame);
  return frame;
}

Frame paint(const Scene& scene) { return std::move(Painter().draw(scene)); }

}  // namespace plumbline::pipeline
