// The tolerance ledger: every tolerance that is not zero, with its derivation. See ledger.cpp, the hand-written file.
#pragma once

#include <span>
#include <string_view>

namespace plumbline::check {

/// A tolerance is `factor` times a magnitude that its formula names. The largest difference seen over the suite must
/// reach a quarter of it, or `loose_because` says why no scene can.
struct Tolerance {
  std::string_view name;  ///< reference.stage, and what of it
  double factor;
  std::string_view unit;
  std::string_view derivation;
  std::string_view loose_because = "";
};

std::span<const Tolerance> ledger();
/// The row of that name. Throws std::logic_error if there is none.
const Tolerance& tolerance(std::string_view name);

}  // namespace plumbline::check
