#include "pipeline/capture_tap.h"

#include <algorithm>
#include <tuple>

#include "pipeline/tiles.h"

namespace plumbline::pipeline {

CaptureTap::CaptureTap(const Scene& scene, const Request& request, std::size_t bytes)
    : scene_(scene),
      request_(request),
      bytes_(bytes),
      keep_(request.records.has(Stage::coverage) || request.records.has(Stage::depth) ||
            request.records.has(Stage::attributes) || request.records.has(Stage::texture) ||
            request.records.has(Stage::shade) || request.records.has(Stage::visibility)) {
  carried_ = carried(scene);
  std::erase_if(carried_, is_back);
  const int w = scene.frame.width, h = scene.frame.height;
  if (!request.pixels.empty()) pixels_ = Plane<std::uint8_t>(w, h);
  for (const glm::ivec2 p : request.pixels)
    if (p.x >= 0 && p.y >= 0 && p.x < w && p.y < h) pixels_(p.x, p.y) = 1;
  planes_.count = Plane<std::uint32_t>(w, h);
  planes_.id_sum = Plane<std::uint64_t>(w, h);
  planes_.id = Plane<std::int32_t>(w, h, kBackground);
  planes_.shaded = Plane<glm::vec4>(w, h, scene.frame.clear_color);
  if (textured(scene)) planes_.texel = Plane<glm::vec4>(w, h, glm::vec4(0));
}

bool CaptureTap::wanted(std::uint32_t primitive) const {
  const auto& primitives = request_.primitives;
  return primitives.empty() || std::binary_search(primitives.begin(), primitives.end(), primitive);
}

void CaptureTap::keep_budget() const {
  // The sorted records stand beside the fragments for a while.
  constexpr std::size_t kBytes = sizeof(Fragment) + sizeof(Covered) + sizeof(double) + sizeof(Attributes<double>) +
                                 sizeof(Shaded<double>) + sizeof(Drawn);
  const std::size_t fours = carried_.empty()
                                ? 0
                                : sizeof(Fours) + carried_.size() * sizeof(Vec4<double>) +
                                      (planes_.texel.empty() ? 0 : sizeof(Texel<float>) + sizeof(Texel<double>));
  require_budget(scene_, bytes_ + fragments_.size() * (kBytes + fours), request_.memory_budget);
}

void CaptureTap::add(Fragment f) {
  // Blocks reach over the frame's edge; a triangle that covers pixels there is a fault, but no reason to crash.
  if (f.x < 0 || f.y < 0 || f.x >= planes_.id.width() || f.y >= planes_.id.height()) return;
  ++planes_.count(f.x, f.y);
  planes_.id_sum(f.x, f.y) += id_weight(f.primitive);
  if (f.drawn) {
    planes_.id(f.x, f.y) = static_cast<std::int32_t>(f.primitive);
    planes_.shaded(f.x, f.y) = f.shaded;
    if (!planes_.texel.empty()) planes_.texel(f.x, f.y) = next_texel_.color;
  }
  if (!keep_ || (!pixels_.empty() && pixels_(f.x, f.y) == 0) || !wanted(f.primitive)) return;
  if (!carried_.empty()) {
    f.fours = static_cast<std::uint32_t>(fours_.size());
    fours_.push_back(next_);
    if (!planes_.texel.empty()) texels_.push_back(next_texel_);
  }
  fragments_.push_back(f);
  if (fragments_.size() % 65536 == 0) keep_budget();
}

void CaptureTap::hand_out(std::span<const WindowTriangle<float>> triangles, Capture& capture) {
  keep_budget();
  // A triangle's number among those handed out.
  std::vector<std::uint32_t> number(triangles.size());
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) number[i] = wanted(triangles[i].primitive) ? next++ : next;
  // Stable: a faulty triangle may cover a pixel twice, and which fragment was first decides.
  std::stable_sort(fragments_.begin(), fragments_.end(), [](const Fragment& a, const Fragment& b) {
    return std::tie(a.triangle, a.y, a.x) < std::tie(b.triangle, b.y, b.x);
  });
  const double scale = formats_of(scene_.frame).depth_scale;
  Records<double>& r = capture.records;
  for (const Fragment& f : fragments_) {
    if (request_.records.has(Stage::coverage))
      r.covered.push_back({number[f.triangle], static_cast<std::uint16_t>(f.x), static_cast<std::uint16_t>(f.y)});
    if (request_.records.has(Stage::depth)) r.depth.push_back(scale == 0.0 ? f.z : f.z / scale);
    if (request_.records.has(Stage::attributes)) {
      r.attributes.push_back({f.attributes});
      for (const Varying v : carried_) {
        r.varyings[v].fragments.push_back(Vec4<double>(fours_[f.fours][static_cast<std::size_t>(v)]));
      }
    }
    if (request_.records.has(Stage::texture) && !texels_.empty()) {
      const Texel<float>& texel = texels_[f.fours];
      r.texels.push_back({Vec4<double>(texel.color), texel.lod});
    }
    if (request_.records.has(Stage::shade)) r.shaded.push_back({f.shaded});
    if (request_.records.has(Stage::visibility)) r.drawn.push_back({f.drawn});
  }
  Planes& out = capture.planes;
  out.count = std::move(planes_.count);
  out.id_sum = std::move(planes_.id_sum);
  out.id = std::move(planes_.id);
  out.shaded = std::move(planes_.shaded);
  out.texel = std::move(planes_.texel);
}

}  // namespace plumbline::pipeline
