#include "cli/scene_judge.h"

#include <algorithm>
#include <iterator>

#include "check/golden.h"
#include "check/judge.h"
#include "cli/check_failures.h"
#include "cli/renderers.h"

namespace plumbline::cli {

SceneJudge::SceneJudge(const CheckRules& rules)
    : rules_(&rules),
      candidate_(make_candidate(rules.options.fault)),
      references_(make_references(rules.options.against, rules.options.scene_arguments.assets)) {}

JudgedScene SceneJudge::judge(const Scene& scene) {
  const CheckOptions& o = rules_->options;
  JudgedScene out;
  check::Drawn drawn;
  out.verdict = check::judge(scene, *candidate_, references_.list, rules_->page ? &drawn : nullptr);
  check::SceneVerdict& verdict = out.verdict;
  if (rules_->goldens)
    std::ranges::move(check::golden_rows(scene, *candidate_, *rules_->goldens),
                      std::back_inserter(verdict.comparisons));
  out.settled = settle(verdict, o, rules_->expectations, rules_->today);
  out.failure = verdict.failure;
  if (!verdict.failure.empty() && !o.failures.empty()) {
    out.failure += leave_report(o.failures, scene, verdict, *candidate_, references_.list);
  }
  if (rules_->page) {
    out.drawing = rules_->page->draw(verdict, references_.list, drawn, scene, verdict.failure, verdict.repeat);
  }
  return out;
}

}  // namespace plumbline::cli
