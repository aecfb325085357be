// A diagnosis as a page for people: the stage table, the findings, and pictures of every stage.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "capture/capture.h"
#include "check/diagnose/diagnose.h"
#include "report/page/page.h"
#include "scene/scene.h"

namespace plumbline::report {

/// Captures that a page shows pictures of: a scene's frame, or one of its passes.
struct Pictured {
  std::string title;
  Scene scene;
  Capture mine, expected;  ///< the same records and planes as they should have been
};

/// A folder (page.h) with index.html, which holds all numbers that it shows. `more`: text to stand below the findings.
/// Throws OutputError.
void write_diagnosis_page(PageFolder& folder, const Scene& scene, const check::Diagnosis& diagnosis,
                          std::span<const Pictured> pictured, std::string_view more = "");

}  // namespace plumbline::report
