// Generated scenes against all references: what a finding says and leaves.
#pragma once

#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "check/judge/judge.h"
#include "reference/embree/embree.h"
#include "reference/exact/exact.h"
#include "reference/osmesa/osmesa.h"
#include "renderers/pipeline_renderer.h"
#include "scene/file/scene_file.h"
#include "tests/suite.h"
#include "tests/text_file.h"

namespace plumbline::test {

/// Folder of findings; scripts/test empties it as it starts.
inline std::filesystem::path findings_folder() {
  return std::filesystem::path(PLUMBLINE_SUITE).parent_path() / "failures";
}

/// Assets of the build, and the suite's images, which the ordinary scenes name.
inline SceneFileOptions with_suite_images() {
  SceneFileOptions options;
  options.asset_folders.push_back(suite_folder() / "texture");
  return options;
}

/// The rows that fail, a line for each.
inline std::string failures(const check::SceneVerdict& verdict) {
  std::string out;
  for (const check::Comparison& c : verdict.comparisons) {
    if (!is_failure(c.outcome)) continue;
    const check::Measurement& m = c.measurement;
    out += fmt::format("{} {} {}: {} of {}, {}, ours {}, theirs {}, {} > {} {} {}\n", title_of(c.judge),
                       name_of(c.stage), name_of(c.outcome), m.differing, m.items, to_string(m.worst.place),
                       m.worst.candidate, m.worst.reference, m.worst.difference, m.worst.tolerance, m.unit, c.note);
  }
  return out;
}

inline check::SceneVerdict judge_by_all(const Scene& scene) {
  static const auto ours = pipeline::make_pipeline();
  static const auto osmesa = make_opengl();
  static const auto embree = embree::make_embree();
  static const auto exact = exact::make_exact();
  const check::Reference references[] = {{"osmesa", osmesa.get()}, {"embree", embree.get()}, {"exact", exact.get()}};
  return check::judge(scene, *ours, references);
}

/// A test failure where any row fails, which names the scene's file. The file is there before the scene is judged, so
/// that a crash leaves it, too. `name`: of the scene, a path.
inline void expect_holds(const Scene& scene, const std::string& name, const std::string& text) {
  const std::filesystem::path file = findings_folder() / (name + ".json");
  test::write_text(file, text);
  const std::string failed = failures(judge_by_all(scene));
  if (failed.empty()) {
    std::filesystem::remove(file);
    return;
  }
  ADD_FAILURE() << name << ": plumb check " << file.string() << " --assets tests/scenes/texture\n" << failed;
}

}  // namespace plumbline::test
