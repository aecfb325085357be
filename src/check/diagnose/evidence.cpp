#include "check/diagnose/evidence.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "check/bounds/bounds.h"
#include "check/judge/stage_copy.h"

namespace plumbline::check {

namespace {

// The frame that the referee makes of a capture's records up to `stage`.
Planes finished(const Scene& scene, Renderer& referee, Stage stage, Capture of) {
  clear_stages_after(stage, of);  // made of other records
  for (const Stage next : stages_of(scene)) {
    if (next <= stage) continue;
    copy_stage(next, referee.run_stage(scene, next, of), of);
    round_to_formats(scene, next, of);
  }
  return std::move(of.planes);
}

// True: x and y differ by more than `most`. Equal infinities do not differ, nor do two NaNs.
bool is_apart(double x, double y, double most) {
  const bool is_same = x == y || (std::isnan(x) && std::isnan(y));
  return !is_same && !(std::abs(x - y) <= most);
}

bool differs(const Scene& scene, const Planes& a, const Planes& b, std::size_t i) {
  const glm::vec4 &c = a.color.values()[i], &d = b.color.values()[i];
  const double z = a.depth.values()[i];
  if (is_apart(z, b.depth.values()[i], 1.001 * depth_step(scene.frame.depth, z))) return true;
  for (int k = 0; k < 4; ++k) {
    if (is_apart(c[k], d[k], 1.001 / 255)) return true;
  }
  return false;
}

}  // namespace

std::size_t pixels_explained(const Evidence& e) {
  if (e.referee == nullptr || e.stage > Stage::merge) return 0;
  try {
    Capture right = e.candidate;
    copy_stage(e.stage, e.expected, right);
    round_to_formats(e.scene, e.stage, right);
    const Planes a = finished(e.scene, *e.referee, e.stage, e.candidate),
                 b = finished(e.scene, *e.referee, e.stage, std::move(right));
    if (a.color.size() != b.color.size() || a.depth.size() != a.color.size() || b.depth.size() != a.color.size())
      return 0;
    std::size_t n = 0;
    for (std::size_t i = 0; i < a.color.size(); ++i) n += differs(e.scene, a, b, i) ? 1 : 0;
    return n;
  } catch (const std::exception&) {
    return 0;
  }
}

}  // namespace plumbline::check
