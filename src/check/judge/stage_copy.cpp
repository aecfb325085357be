#include "check/judge/stage_copy.h"

#include <cmath>
#include <type_traits>

#include "capture/capture_columns.h"
#include "capture/fragment_outcomes.h"
#include "check/bounds/units.h"

namespace plumbline::check {

namespace {

struct Copy {
  Stage stage;
  void group(Handed group, const auto&, const auto& from, auto& to) const {
    if (group.stage == stage) to = from;
  }
  void plane(Handed of, const auto& from, auto& to) const {
    if (of.stage == stage) to = from;
  }
};

// A real number is rounded to float; an entry of a matrix below 1e-12 becomes 0, as stages.h has it.
template <class T>
void round(T& value) {
  if constexpr (std::is_floating_point_v<T>) value = to_float(value);
}
template <glm::length_t n>
void round(glm::vec<n, double>& v) {
  for (glm::length_t c = 0; c < n; ++c) round(v[c]);
}
template <glm::length_t n>
void round(glm::mat<n, n, double>& m) {
  for (glm::length_t column = 0; column < n; ++column) {
    for (glm::length_t row = 0; row < n; ++row) {
      double& entry = m[column][row];
      entry = std::abs(entry) < 1e-12 ? 0 : to_float(entry);
    }
  }
}

struct Rounding {
  Stage stage;
  void group(Handed group, const auto& columns, auto& records) const {
    if (group.stage != stage) return;
    columns.each([&](const auto& column) {
      for (auto& record : records) {
        for (std::size_t k = 0; k < kPerRecord<decltype(column)>; ++k) round(column.at(record, k));
      }
    });
  }
  void plane(Handed, auto&) const {}
};

double to_code(double value, double scale) {
  return scale == 0 ? to_float(value) : std::nearbyint(value * scale) / scale;
}

}  // namespace

void copy_stage(Stage stage, const Capture& from, Capture& to) {
  visit_capture(Copy{stage}, from, to);
  if (stage == Stage::texture) to.legal.texels = from.legal.texels;
  if (stage == Stage::resolve) to.planes.color = from.planes.color;
}

void clear_stages_after(Stage stage, Capture& capture) {
  for (const Stage later : kAllStages) {
    if (later > stage && later <= Stage::merge) copy_stage(later, {}, capture);
  }
}

void round_to_formats(const Scene& scene, Stage stage, Capture& capture) {
  if (stage == Stage::depth) {
    for (double& z : capture.records.depth) z = depth_in_format(scene.frame.depth, z);
  } else if (stage >= Stage::merge) {
    for (glm::vec4& color : capture.planes.color.values()) {
      for (int c = 0; c < 4; ++c) color[c] = static_cast<float>(to_code(color[c], color_scale(scene.frame.color)));
    }
  } else {
    visit_capture(Rounding{stage}, capture);
  }
}

}  // namespace plumbline::check
