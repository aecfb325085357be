// diagnose(): every stage that is wrong is named, a second fault behind a first one too, and nothing where nothing is.
#include "check/diagnose.h"

#include "check_judge.h"
#include "faults/faults.h"
#include "scene/scene_file.h"

namespace plumbline::check {
namespace {

std::unique_ptr<Renderer> with_fault(std::string_view name) {
  for (const faults::Fault& f : faults::all()) {
    if (f.name == name) return pipeline::make_pipeline(f.stages());
  }
  throw std::invalid_argument("no such fault");
}

struct Diagnose : testing::Test {
  Diagnosis of(Renderer& candidate) {
    const Reference references[] = {{"exact", exact.get()}};
    return diagnose(scene, candidate, references);
  }
  Scene scene = two_draws();
  std::unique_ptr<Renderer> exact = exact::make_exact();
};

TEST_F(Diagnose, NothingIsWrongWithTheProductionPipeline) {
  const auto ours = pipeline::make_pipeline();
  const Diagnosis d = of(*ours);
  EXPECT_EQ(d.first, std::nullopt);
  EXPECT_TRUE(d.wrong.empty());
  EXPECT_TRUE(d.findings.empty());
  EXPECT_FALSE(d.verdict.comparisons.empty());
}

TEST_F(Diagnose, NamesTheOneStageOfAFault) {
  const auto candidate = with_fault("attributes.affine");
  const Diagnosis d = of(*candidate);
  EXPECT_EQ(d.first, Stage::attributes);
  EXPECT_EQ(d.wrong, std::vector{Stage::attributes});
  ASSERT_EQ(d.findings.size(), 1u);
  EXPECT_EQ(d.findings[0].reference, "exact from its records");
  EXPECT_FALSE(d.findings[0].numbers.empty());
}

}  // namespace
}  // namespace plumbline::check
