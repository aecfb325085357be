// Made-up rows and verdicts, for the tests of reports.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "check/verdict/verdict.h"

namespace plumbline::report {

/// A row of osmesa's stage clip: 1536 items, of which 17 differ (outcome `different`) or 5 are ambiguous
/// (`ambiguous_only`).
inline check::Comparison compared(check::Outcome outcome, double difference = 0, double tolerance = 0) {
  check::Measurement m;
  m.unit = "u";
  m.items = 1536;
  m.differing = outcome == check::Outcome::different ? 17 : 0;
  m.ambiguous = outcome == check::Outcome::ambiguous_only ? 5 : 0;
  m.max_difference = m.worst.difference = difference;
  m.max_ratio = tolerance > 0 ? difference / tolerance : difference;
  m.worst.place = {12, 34, 56, "p_clip"};
  m.worst.tolerance = tolerance;
  m.worst.candidate = 0.5;
  m.worst.reference = 0.25;
  m.histogram[0] = 1536;
  return {"group/scene", "osmesa", Stage::clip, outcome, m, "exact.clip", ""};
}
/// A row of embree's stage light that was not judged.
inline check::Comparison not_compared(check::Outcome outcome, std::string why) {
  return check::not_judged("group/scene", "embree", Stage::light, outcome, std::move(why));
}
inline check::SceneVerdict verdict_of(std::vector<check::Comparison> comparisons) {
  return {"group/scene", "scenes/group/scene.json", std::move(comparisons), 0.5};
}
inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace plumbline::report
