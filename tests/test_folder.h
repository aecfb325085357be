// A folder of its own for each test, gone afterwards.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <string>

#include "base/temporary_path.h"
#include "tests/text_file.h"

namespace plumbline {

class TestFolder : public testing::Test {
 protected:
  TestFolder() {
    std::string name = temporary_files() / "plumbline-XXXXXX";
    root_ = mkdtemp(name.data());
    std::filesystem::permissions(root_, std::filesystem::perms(0755));  // as folders usually are
  }
  ~TestFolder() override { std::filesystem::remove_all(root_); }

  std::filesystem::path root_;
};

}  // namespace plumbline
