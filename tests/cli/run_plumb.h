// Runs plumb as a user does.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string>

#include "base/temporary_path.h"
#include "cli/options/renderers.h"
#include "tests/suite.h"
#include "tests/text_file.h"

namespace plumbline {

namespace fs = std::filesystem;

struct Outcome {
  int code;          // exit code, of the shell by shell(); -1: a signal ended it
  std::string text;  // stdout and stderr
  bool says(const std::string& part) const { return text.find(part) != std::string::npos; }
};

// Runs a line by /bin/sh, and waits for it.
inline Outcome shell(const std::string& line) {
  FILE* pipe = popen(("{ " + line + "\n} 2>&1").c_str(), "r");
  Outcome run{-1, ""};
  std::array<char, 4096> buffer;
  while (std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe)) run.text.append(buffer.data(), n);
  const int status = pclose(pipe);
  if (WIFEXITED(status)) run.code = WEXITSTATUS(status);
  return run;
}

/// Runs plumb with arguments quoted as for a shell. plumb_main() runs in a fork of this process, which saves loading
/// the libraries (a quarter of a second). Arguments that need a shell (pipes, redirections, variables, wildcards) or
/// that may start more processes (egl, softpipe, --program, list) go to the program itself, by shell(); under
/// AddressSanitizer all do. Throws std::runtime_error where there is no pipe.
Outcome plumb(const std::string& arguments);

/// The OpenGL reference that is asked where none is named: osmesa, in a build without it egl.
inline const std::string kOpenGl = cli::reference_names().front();

inline const std::string kScenes = suite_folder() / "";  // ends in "/"
inline const std::string kSharedEdges = kScenes + "coverage/shared_edges.json";

// A folder of its own for each test, gone afterwards.
class Cli : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        temporary_files() / ("plumb-cli-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
                             "-" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  std::string scene_file(const std::string& json) const {
    test::write_text(folder_ / "scene.json", json);
    return at("scene.json");
  }
  // The names of all that is in the folder, hidden ones and those in folders included.
  std::set<std::string> entries() const {
    std::set<std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      out.insert(entry.path().lexically_relative(folder_).string());
    }
    return out;
  }

  fs::path folder_;
};

}  // namespace plumbline
