// The tolerance ledger: every tolerance that is not zero, with its derivation. See ledger.cpp, the hand-written file.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "capture/profile.h"
#include "capture/stages.h"

namespace plumbline::check {

/// Tolerance: `factor` times a magnitude that its formula names. The largest difference seen over the suite must reach
/// a quarter of the tolerance, or `loose_because` says why no scene can make it so large.
struct Tolerance {
  Profile profile;        ///< of the reference
  Stage stage;            ///< that is compared
  std::string_view part;  ///< of the stage; empty: all of it
  double factor;
  std::string_view unit;
  std::string_view derivation;
  std::string_view loose_because = "";
};

std::span<const Tolerance> ledger();
/// Name for people: profile.stage or profile.stage.part.
std::string name_of(const Tolerance& row);
/// The row of that key. Throws std::logic_error if there is none.
const Tolerance& tolerance(Profile profile, Stage stage, std::string_view part = "");

}  // namespace plumbline::check
