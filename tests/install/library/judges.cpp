// A scene file, drawn by plumbline's renderer and judged by the exact reference.
#include <cstdio>

#include <plumbline/check/diagnose/diagnose.h>
#include <plumbline/reference/exact/exact.h>
#include <plumbline/renderers/pipeline_renderer.h>
#include <plumbline/report/text/diagnosis_text.h>
#include <plumbline/scene/file/scene_file.h>

int main(int, char** argv) {
  const plumbline::Scene scene = plumbline::load_scene(argv[1]);
  const auto candidate = plumbline::pipeline::make_pipeline();
  const auto exact = plumbline::exact::make_exact();
  const plumbline::check::Reference references[] = {{"exact", exact.get()}};
  const auto diagnosis = plumbline::check::diagnose(scene, *candidate, references);
  std::fputs(plumbline::report::diagnosis_text(diagnosis).c_str(), stdout);
  return diagnosis.first ? 1 : 0;
}
