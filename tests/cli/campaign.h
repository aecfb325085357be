// plumb campaign in a folder of the test.
#pragma once

#include <string>

#include <fmt/format.h>

#include "tests/cli/run_plumb.h"

namespace plumbline {

class Campaign : public Cli {
 protected:
  Outcome campaign(const std::string& folder, const std::string& options) const {
    return shell(fmt::format("{} campaign {} {}", PLUMBLINE_PLUMB, at(folder), options));
  }
  std::string results(const std::string& folder) const { return test::text_of(folder_ / folder / "results.json"); }
};

}  // namespace plumbline
