#pragma once

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "study_file.hpp"

namespace flexspline::studies {

/// How a program ended.
struct Ended {
  int code = -1;          ///< exit code; -1: a signal ended it
  int signal = 0;         ///< that signal
  bool stopped = false;   ///< it was asked to stop at its time limit
  double stopping = 0.0;  ///< s from then to its end
  double seconds = 0.0;
  std::string result;  ///< stdout
  std::string said;    ///< stderr
};

/// What becomes of a stream of the program.
enum class Stream { kept, closed, full };

/// How a program is run.
struct Call {
  std::vector<std::string> arguments;
  Stream out = Stream::kept;
  Stream err = Stream::kept;
  double limit = 120.0;  ///< s until it is asked to stop, from when it listens and is ready
  int stop_signal = SIGTERM;
  std::function<bool()> ready{};  ///< what it must have come to before that time runs
  std::filesystem::path folder{};  ///< to run in; empty: that of the tests
};

/// The executable beside the tests, or the one that FLEXSPLINE_PROGRAM names.
inline std::filesystem::path program_path() {
  if (const char* named = std::getenv("FLEXSPLINE_PROGRAM")) return named;
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "flexspline";
}

/// Runs the program in a child process and watches over it.
class ChildProgram {
 public:
  explicit ChildProgram(Call call) : call_(std::move(call)) {}

  Ended operator()() {
    start();
    int status = 0;
    while (waitpid(child_, &status, WNOHANG) == 0) {
      watch();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ended_.seconds = elapsed();
    if (ended_.stopped) ended_.stopping = ended_.seconds - asked_;
    if (WIFEXITED(status)) ended_.code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) ended_.signal = WTERMSIG(status);
    ended_.result = read_text(folder_.path() / "stdout");
    ended_.said = read_text(folder_.path() / "stderr");
    return ended_;
  }

 private:
  void direct(posix_spawn_file_actions_t& actions, int stream, Stream how, const char* name) {
    if (how == Stream::closed) posix_spawn_file_actions_addclose(&actions, stream);
    if (how == Stream::full) {
      posix_spawn_file_actions_addopen(&actions, stream, "/dev/full", O_WRONLY, 0);
    }
    if (how == Stream::kept) {
      posix_spawn_file_actions_addopen(&actions, stream, (folder_.path() / name).c_str(),
                                       O_WRONLY | O_CREAT | O_TRUNC, 0600);
    }
  }

  void start() {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    direct(actions, STDOUT_FILENO, call_.out, "stdout");
    direct(actions, STDERR_FILENO, call_.err, "stderr");
    if (!call_.folder.empty()) {
      posix_spawn_file_actions_addchdir_np(&actions, call_.folder.c_str());
    }
    std::string program = program_path().string();
    std::vector<char*> words = {program.data()};
    for (std::string& word : call_.arguments) words.push_back(word.data());
    words.push_back(nullptr);
    begun_ = std::chrono::steady_clock::now();
    if (posix_spawn(&child_, program.c_str(), &actions, nullptr, words.data(), environ) != 0) {
      throw std::runtime_error(program + " cannot be started");
    }
    posix_spawn_file_actions_destroy(&actions);
  }

  void watch() {
    constexpr double kPatience = 30.0;  // for one that does not stop: then it is ended
    if (ready_ < 0.0 && listens() && (!call_.ready || call_.ready())) ready_ = elapsed();
    if (!ended_.stopped && ready_ >= 0.0 && elapsed() - ready_ > call_.limit) {
      ended_.stopped = true;
      asked_ = elapsed();
      kill(child_, call_.stop_signal);
    }
    if (ended_.stopped && elapsed() - asked_ > kPatience) kill(child_, SIGKILL);
  }

  /// Whether it has come so far as to catch the signal: until then, which takes a second on a busy
  /// machine, the signal ends any program. SIGKILL cannot be caught.
  bool listens() const {
    if (call_.stop_signal == SIGKILL) return true;
    std::ifstream status("/proc/" + std::to_string(child_) + "/status");
    for (std::string line; std::getline(status, line);) {
      if (!line.starts_with("SigCgt:")) continue;
      return (std::stoull(line.substr(7), nullptr, 16) >> (call_.stop_signal - 1) & 1U) != 0;
    }
    return false;
  }

  double elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
  }

  Call call_;
  ScratchFolder folder_;
  Ended ended_;
  pid_t child_ = -1;
  std::chrono::steady_clock::time_point begun_;
  double ready_ = -1.0;
  double asked_ = 0.0;
};

inline Ended run_program(Call call) { return ChildProgram(std::move(call))(); }

inline Ended run_program(std::vector<std::string> arguments) {
  return run_program(Call{std::move(arguments)});
}

}  // namespace flexspline::studies
