// Interface of a renderer (scene in, capture out): our pipeline, each reference, a program in another process.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "capture/capture.h"
#include "capture/conventions.h"
#include "capture/profile.h"
#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline {

/// Stages of a scene from `first` to `last`, in order: without texture where no draw is textured.
std::vector<Stage> stages_of(const Scene& scene, Stage first = Stage::matrices, Stage last = Stage::merge);

/// Planes that the caller needs. A renderer may hand out more.
enum class WantedPlanes {
  all,
  picture,  ///< color and depth are enough: drawn as it ships, nothing is watched
  none      ///< records and legal answers are enough
};

/// Request of a capture: the records, planes and legal answers that the caller needs.
struct Request {
  StageSet records = {};  ///< stages whose records are wanted
  bool legal = false;     ///< an oracle's legal answers; of `pixels` at least
  std::vector<std::uint32_t> primitives =
      {};                               ///< only these primitives' records, ascending; empty: all. Planes show all.
  std::vector<glm::ivec2> pixels = {};  ///< only these pixels' fragments (stages 5 to 10); empty: all
  std::size_t memory_budget = std::size_t{512} << 20;  ///< bytes a capture may take
  WantedPlanes planes = WantedPlanes::all;
  std::string painter = {};      ///< one of info().painters, where planes is `picture`; empty: the one that ships
  Conventions conventions = {};  ///< whose legal answers are asked for
};

/// What a renderer is able to show of one stage.
struct Ability {
  bool shows = false;         ///< capture() hands the stage's records or planes out
  bool runs = false;          ///< run_stage() serves the stage
  std::string reason = {};    ///< why not, where neither
  bool planes_alone = false;  ///< the capture holds planes of the stage, and no records
  bool given = false;         ///< --from: the records are the export's, not the renderer's, and are not judged
  bool contradicted = false;  ///< other arrays contradict the stage's arrays (`reason`): outcome `failed`
};

struct RendererInfo {
  std::string name;
  std::string version;
  std::array<Ability, kStageNames.size()> stages;
  bool legal = false;  ///< capture() hands legal answers out
  Profile profile = Profile::foreign;
  Conventions conventions = {};  ///< conventions that the renderer draws by
  /// Names of the code paths that draw pictures alone (WantedPlanes::picture), the default path last. Each must draw
  /// the bits of the recorded frame. Empty: the recorded path draws pictures, too.
  std::vector<std::string> painters = {};
  const Ability& operator[](Stage s) const { return stages[static_cast<std::size_t>(s)]; }
  Ability& operator[](Stage s) { return stages[static_cast<std::size_t>(s)]; }
};

/// Whether the renderer judges single stages of others' records.
bool is_referee(const RendererInfo& info);

/// The renderer cannot do what was asked: outcome `unsupported`.
struct Unsupported : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// The renderer crashed, hung, or broke the protocol: outcome `failed`.
struct RendererFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// A capture would not fit its memory budget.
struct OverBudget : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Renderer {
 public:
  virtual ~Renderer() = default;

  /// Abilities and conventions. A program's are those of its last capture(), other renderers' are constant.
  virtual RendererInfo info() const = 0;

  /// Draws the scene. Hands out every plane it is able to show, and of the records those that the request names and
  /// it is able to show. Of an antialiased scene: its samples, planes.color and planes.depth, and no more; the rest is
  /// handed out for its passes (scene/antialias.h). Throws OverBudget, RendererFailed.
  virtual Capture capture(const Scene& scene, const Request& request) = 0;

  /// Runs one stage alone on what `in` holds of the stages before it: records, for merge planes.id as well (made of the
  /// records where it is empty), for visibility and merge the frame's clear values: the returned capture holds that
  /// stage's records or planes, nothing else. Coverage hands out records.covered and the planes count and id_sum;
  /// visibility planes.id and planes.stencil; merge planes.color and planes.depth; resolve planes.color, of in.samples.
  /// `conventions`: read by exact alone, and of them only those that no change of the scene or of `in` expresses
  /// (offset_unit, float_offset_unit, texture_bits, level_of_detail, magnified, half_way_level, and rows, by which 2 x
  /// 2 squares of pixels are counted). Throws Unsupported where info()[stage].runs is false.
  virtual Capture run_stage(const Scene& scene, Stage stage, const Capture& in, const Conventions& conventions = {});
};

/// Throws std::invalid_argument where the samples are not those of the scene's passes, in number and size.
void require_samples(const Scene& scene, const std::vector<Plane<glm::vec4>>& samples);

/// Memory of a capture's planes and of the bounds and samples that make their colours [bytes], for require_budget().
std::size_t plane_bytes(const Scene& scene);
/// Memory of one fragment's records of these stages [bytes].
std::size_t fragment_bytes(const Scene& scene, StageSet stages);
/// Throws OverBudget where `bytes` exceeds `budget` [bytes], naming the scene and both numbers.
void require_budget(const Scene& scene, std::size_t bytes, std::size_t budget);

}  // namespace plumbline
