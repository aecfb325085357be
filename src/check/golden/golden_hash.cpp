#include "check/golden/golden_hash.h"

#include <charconv>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <xxhash.h>

#include "capture/capture_columns.h"
#include "scene/antialias.h"

namespace plumbline::check {

std::string to_string(const Hash& hash) { return fmt::format("{:016x}{:016x}", hash.high, hash.low); }

std::optional<Hash> parse_hash(std::string_view text) {
  Hash out;
  const auto half = [&](std::size_t from, std::uint64_t& to) {
    const char* end = text.data() + from + 16;
    return std::from_chars(text.data() + from, end, to, 16).ptr == end;
  };
  if (text.size() != 32 || !half(0, out.high) || !half(16, out.low) || to_string(out) != text) return std::nullopt;
  return out;
}

void Hasher::Free::operator()(XXH3_state_s* state) const { XXH3_freeState(state); }
Hasher::Hasher() : state_(XXH3_createState()) { XXH3_128bits_reset(state_.get()); }
void Hasher::add(const void* bytes, std::size_t size) {
  if (size > 0) XXH3_128bits_update(state_.get(), bytes, size);
}
Hash Hasher::done() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
  return {hash.high64, hash.low64};
}
Hash hash_of(std::string_view bytes) {
  Hasher hasher;
  hasher.add(bytes.data(), bytes.size());
  return hasher.done();
}

namespace {

template <class T>
void add_array(Hasher& hasher, const std::vector<T>& values) {
  hasher.add_value(std::uint64_t{values.size()});
  hasher.add(values.data(), values.size() * sizeof(T));
}

void add_material(Hasher& hasher, const Material& m) {
  for (const glm::vec4& color : {m.ambient, m.diffuse, m.specular, m.emission}) hasher.add_value(color);
  hasher.add_value(m.shininess);
}

// The stage that an array is hashed with. Winners' texels and colours follow from visibility: beside fragment records
// they are hashed with it.
Stage hashed_with(Handed of, bool fragments) {
  const bool of_winners = of.name == "planes.texel" || of.name == "planes.shaded";
  return of_winners && fragments ? Stage::visibility : of.stage;
}

// Lights in eye space, recorded since goldens have been kept: the lit colours that they make are hashed.
constexpr std::string_view kNotHashed = "matrices.light";

class StageHashers {
 public:
  /// Whether a capture holds the records of all fragments.
  void next(const Capture& capture) { fragments_ = !capture.records.shaded.empty(); }
  template <class Record>
  void group(Handed group, const auto& columns, const std::vector<Record>& records) {
    if (group.name == kNotHashed || records.empty()) return;
    columns.each([&](const auto& c) { column(group, records, c); });
  }
  template <class T>
  void plane(Handed of, const Plane<T>& plane) {
    if (!plane.empty()) array(hashed_with(of, fragments_), of.name, plane.values().data(), plane.size() * sizeof(T));
  }
  void array(Stage stage, std::string_view name, const void* bytes, std::size_t size) {
    const auto i = static_cast<std::size_t>(stage);
    if (!hashers_[i]) hashers_[i].emplace();
    hashers_[i]->add_text(name);
    hashers_[i]->add_text({static_cast<const char*>(bytes), size});
  }
  StageHashes done() const {
    StageHashes out;
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (hashers_[i]) out[i] = hashers_[i]->done();
    }
    return out;
  }

 private:
  template <class Record, class C>
  void column(Handed group, const std::vector<Record>& records, const C& column) {
    const std::vector<char> bytes = packed(records, column);
    array(group.stage, fmt::format("{}.{}", group.name, column.name), bytes.data(), bytes.size());
  }

  bool fragments_ = false;
  std::array<std::optional<Hasher>, kStageNames.size()> hashers_;
};

Capture all_that_fits(const Scene& scene, Renderer& renderer) {
  Request request{.records = StageSet::all()};
  try {
    return renderer.capture(scene, request);
  } catch (const OverBudget&) {
    request.records = kGeometryStages;
    return renderer.capture(scene, request);
  }
}

}  // namespace

Hash scene_hash(const Scene& scene) {
  Hasher hasher;
  for (const std::string& file : scene.files) {
    std::ifstream in(file, std::ios::binary);
    std::stringstream text;
    if (!(text << in.rdbuf())) throw std::runtime_error(fmt::format("{}: cannot be read once more", file));
    hasher.add_text(text.str());
  }
  for (const Mesh& mesh : scene.meshes) {
    add_array(hasher, mesh.positions);
    add_array(hasher, mesh.normals);
    add_array(hasher, mesh.colors);
    add_array(hasher, mesh.triangles);
    add_array(hasher, mesh.texcoords);
  }
  for (const Draw& draw : scene.draws) add_material(hasher, draw.material);
  for (const Texture& texture : scene.textures) {
    hasher.add_value(texture.format);
    for (const TextureLevel& level : texture.levels) {
      hasher.add_value(glm::ivec2(level.width, level.height));
      add_array(hasher, level.texels);
    }
  }
  return hasher.done();
}

Fingerprint fingerprint(const Scene& scene, Renderer& renderer) {
  StageHashers hashers;
  for (const Scene& pass : passes_of(scene)) {
    const Capture all = all_that_fits(pass, renderer);
    hashers.next(all);
    visit_capture(hashers, all);
  }
  if (antialiased(scene)) {
    const Planes resolved = renderer.capture(scene, Request{}).planes;
    hashers.array(Stage::resolve, "color", resolved.color.values().data(), resolved.color.size() * sizeof(glm::vec4));
    hashers.array(Stage::resolve, "depth", resolved.depth.values().data(), resolved.depth.size() * sizeof(double));
  }
  Request request;
  request.planes = WantedPlanes::picture;
  Planes picture = renderer.capture(scene, request).planes;
  return {hashers.done(), std::move(picture.color), std::move(picture.depth)};
}

}  // namespace plumbline::check
