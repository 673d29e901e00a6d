#pragma once

#include <array>
#include <cstdio>

#include <sys/wait.h>

#include <gtest/gtest.h>

#include "study_file.hpp"

namespace flexspline::studies {

/// A call of the program that has ended.
struct Finished {
  int code = -1;
  std::string output;  ///< stdout, then stderr
  std::string result;  ///< stdout alone
};

/// Calls the program, which lies beside the tests, with a folder to work in.
class CommandLine : public testing::Test {
 protected:
  void SetUp() override {
    program_ = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "flexspline";
    if (!exists(program_)) GTEST_SKIP() << program_ << " is not built";
  }
  Finished call(const std::string& arguments) const {
    const std::string said = (folder_.path() / "stderr.txt").string();
    const std::string line = program_.string() + " " + arguments + " 2>" + said;
    Finished finished;
    FILE* pipe = popen(line.c_str(), "r");
    std::array<char, 4096> buffer{};
    while (const std::size_t size = fread(buffer.data(), 1, buffer.size(), pipe)) {
      finished.result.append(buffer.data(), size);
    }
    finished.code = WEXITSTATUS(pclose(pipe));
    finished.output = finished.result + read_text(said);
    return finished;
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  ScratchFolder folder_;
  std::filesystem::path program_;
};

}  // namespace flexspline::studies
