// The fields of a verdict, for a byte archive (base/byte_archive.h), without the pixels that differ
// (Measurement::differing_at, disputed_at): these are read only while a scene is judged and its page is drawn.
#pragma once

#include "base/byte_archive.h"
#include "check/verdict/verdict.h"

namespace plumbline::check {

template <class Archive>
void visit(Archive& archive, Worst& w) {
  visit_all(archive, w.place.x, w.place.y, w.place.record, w.place.of_primitive);
  archive.word(w.place.field);
  visit_all(archive, w.candidate, w.reference, w.difference, w.tolerance);
}
template <class Archive>
void visit(Archive& archive, Measurement& m) {
  visit_all(archive, m.unit, m.items, m.differing, m.ambiguous, m.disputed, m.max_difference, m.max_ratio, m.worst,
            m.dispute, m.reason, m.mismatch);
  for (std::uint64_t& n : m.histogram) archive(n);
}
template <class Archive>
void visit(Archive& archive, Comparison& c) {
  visit_all(archive, c.scene, c.judge.reference, c.judge.kind, c.stage, c.outcome, c.measurement, c.ledger_row, c.note);
}
template <class Archive>
void visit(Archive& archive, SceneVerdict& v) {
  visit_all(archive, v.scene, v.path, v.comparisons, v.seconds, v.empty_holds, v.knows_no_color, v.failure, v.repeat,
            v.causes);
}

}  // namespace plumbline::check
