// Two lists of records in draw order, walked together.
#pragma once

#include <algorithm>
#include <span>

namespace plumbline::check {

/// Calls visit(run of `a`, run of `b`) for each primitive in either list, ascending. Run: a list's records of that
/// primitive, possibly none. Precondition: both lists are sorted by `primitive`.
template <class Record, class Visit>
void matched_by_primitive(std::span<const Record> a, std::span<const Record> b, Visit visit) {
  const auto take_run = [](std::span<const Record>& list, auto primitive) {
    const auto end = std::ranges::find_if(list, [&](const Record& r) { return r.primitive != primitive; });
    const std::span<const Record> run(list.begin(), end);
    list = list.subspan(run.size());
    return run;
  };
  while (!a.empty() || !b.empty()) {
    const bool a_first = b.empty() || (!a.empty() && a.front().primitive <= b.front().primitive);
    const auto primitive = a_first ? a.front().primitive : b.front().primitive;
    const auto mine = take_run(a, primitive), theirs = take_run(b, primitive);
    visit(mine, theirs);
  }
}

}  // namespace plumbline::check
