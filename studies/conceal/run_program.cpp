#include "conceal/run_program.hpp"

#include <array>
#include <cstdio>
#include <cstring>
#include <memory>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

extern char** environ;

namespace flexspline::studies {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// A file without a name that is gone with its last user.
File scratch() { return {std::tmpfile(), &std::fclose}; }

std::string text_of(std::FILE* file) {
  std::string text;
  std::array<char, 4096> part{};
  std::rewind(file);
  while (const std::size_t count = std::fread(part.data(), 1, part.size(), file)) {
    text.append(part.data(), count);
  }
  return text;
}

/// The line that says what went wrong: the first that names an error, else the last.
std::string telling_line(const std::string& text) {
  std::string last;
  std::size_t start = 0;
  while (start < text.size()) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::string line = text.substr(start, end - start);
    if (line.find("Error") != std::string::npos) return line;
    if (!line.empty()) last = line;
    start = end + 1;
  }
  return last;
}

/// The status it ended with, or none with errno set.
int run(const std::vector<std::string>& words, std::FILE* out, std::FILE* err) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(out), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(err), STDERR_FILENO);
  pid_t child = 0;
  errno = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (errno != 0) return -1;
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return -1;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

}  // namespace

Result<std::string> run_program(const std::vector<std::string>& words) {
  expects(!words.empty(), "a program has a name");
  const File out = scratch();
  const File err = scratch();
  if (!out || !err) return failure(ErrorCode::cannot_write, "no temporary file", "free some space");
  const int status = run(words, out.get(), err.get());
  if (status < 0) {
    return failure(ErrorCode::input_missing,
                   fmt::format("'{}' cannot be started: {}", words[0], std::strerror(errno)),
                   fmt::format("install {} or leave out what needs it", words[0]));
  }
  if (status != 0) {
    return failure(ErrorCode::numerics, fmt::format("'{}' ended with status {}: {}", words[0],
                                                    status, telling_line(text_of(err.get()))));
  }
  return text_of(out.get());
}

}  // namespace flexspline::studies
