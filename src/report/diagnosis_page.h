// A diagnosis as a page for people: the stage table, the findings, and a picture of every stage.
#pragma once

#include <string_view>

#include "check/diagnose.h"
#include "report/page.h"
#include "scene/scene.h"
#include "stages/capture.h"

namespace plumbline::report {

/// A folder (page.h) with index.html and <stage's picture>-{ours,expected,differences}.png. `expected`: the same
/// records and planes as they should have been. Where a picture is there of both sides, a slider lays one over the
/// other. Throws OutputError.
void write_diagnosis_page(PageFolder& folder, const Scene& scene, const check::Diagnosis& diagnosis,
                          const Capture& mine, const Capture& expected, std::string_view more = "");

}  // namespace plumbline::report
