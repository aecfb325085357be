#include "check/worst_record.h"

#include <fmt/format.h>

namespace plumbline::check {

std::vector<std::string> worst_record(const Evidence&, const Measurement& m) {
  if (!m.mismatch.empty()) return {m.mismatch};
  return {fmt::format("{}: {:.9g}, expected {:.9g}, {:.4g} {} apart, tolerance {:.4g}", to_string(m.worst.place),
                      m.worst.candidate, m.worst.reference, m.worst.difference, m.unit, m.worst.tolerance)};
}

std::string coverage_picture(const Evidence&) { return ""; }

}  // namespace plumbline::check
