// The folder for temporary files.
#include "base/temporary_path.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "tests/test_folder.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

class TemporaryFiles : public TestFolder {};

// Each in a process of its own: what the environment says is for one.
TEST_F(TemporaryFiles, LieWhereTmpdirSays) {
  EXPECT_EXIT(
      {
        setenv("TMPDIR", root_.c_str(), 1);
        _exit(temporary_files() == root_ ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
  EXPECT_EXIT(
      {
        setenv("TMPDIR", (root_ / "none").c_str(), 1);
        try {
          temporary_files();
        } catch (const std::runtime_error& error) {
          fputs(error.what(), stderr);
          _exit(2);
        }
        _exit(0);
      },
      testing::ExitedWithCode(2), "TMPDIR: .*/none: expected a folder for temporary files: ");
}

TEST_F(TemporaryFiles, LieInMemoryThatIsFreeOrElseInTmp) {
  const bool is_free = fs::is_directory("/dev/shm") && fs::space("/dev/shm").available >= std::uintmax_t{2} << 30;
  EXPECT_EXIT(
      {
        for (const char* name : {"TMPDIR", "TMP", "TEMP", "TEMPDIR"}) unsetenv(name);
        _exit(temporary_files() == fs::path(is_free ? "/dev/shm" : "/tmp") ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace plumbline
