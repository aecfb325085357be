// Hashes of what is drawn and of what it is drawn from: 128 bits of XXH3 (the library xxhash), of numbers in
// little-endian order, bit for bit, so that -0 is not 0 and a NaN is itself.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "capture/renderer.h"
#include "scene/scene.h"

struct XXH3_state_s;

namespace plumbline::check {

struct Hash {
  std::uint64_t high = 0, low = 0;
  bool operator==(const Hash&) const = default;
};
/// 32 hexadecimal digits.
std::string to_string(const Hash& hash);
/// The hash of such a text; none if it is something else.
std::optional<Hash> parse_hash(std::string_view text);

class Hasher {
 public:
  Hasher();
  void add(const void* bytes, std::size_t size);
  /// A number, or a struct of numbers without gaps.
  template <class T>
  void add_value(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    add(&value, sizeof value);
  }
  /// Length and bytes.
  void add_text(std::string_view text) {
    add_value(std::uint64_t{text.size()});
    add(text.data(), text.size());
  }
  Hash done() const;

 private:
  struct Free {
    void operator()(XXH3_state_s* state) const;
  };
  std::unique_ptr<XXH3_state_s, Free> state_;
};
Hash hash_of(std::string_view bytes);

/// The scene, and everything that it draws from: the bytes of its JSON files and of those they include, meshes,
/// materials that came with them, texels. Any change of the files changes it, of a description too. Throws
/// std::runtime_error where a file is there no longer.
Hash scene_hash(const Scene& scene);

/// One hash per stage, of the records and planes that the renderer hands on there, name by name (capture_columns.h),
/// all but matrices.light. None: the stage hands on nothing, such as texture without a textured draw, or resolve of a
/// scene of one sample a pixel. Where the whole capture exceeds the memory budget, which is the same on every machine,
/// only planes and the records of stages 0 to 4 are hashed.
using StageHashes = std::array<std::optional<Hash>, kStageNames.size()>;

/// A scene as it is compared with its golden.
struct Fingerprint {
  StageHashes stages;      ///< of an antialiased scene: of its passes, one after the other, and `resolve` of the frame
  Plane<glm::vec4> color;  ///< of the frame, drawn once more without records
  Plane<double> depth;
};
/// Throws what Renderer::capture does.
Fingerprint fingerprint(const Scene& scene, Renderer& renderer);

}  // namespace plumbline::check
