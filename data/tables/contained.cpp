#include "tables/contained.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>

#include <fmt/format.h>

#include "tables/table_message.hpp"

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define FLEXSPLINE_SANITIZED 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define FLEXSPLINE_SANITIZED 1
#endif

namespace flexspline::data {
namespace {

constexpr std::uint64_t kLongestMessage = std::uint64_t{1} << 28U;

struct MessageHead {
  TableWord word;
  std::uint32_t unused = 0;
  std::uint64_t bytes;
};

/// One end of the socket between the two.
class Line {
 public:
  explicit Line(int end) : end_(end) {}
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  ~Line() { ::close(end_); }

  bool send(const void* from, std::size_t count) const {
    const auto* at = static_cast<const char*>(from);
    while (count > 0) {
      const ssize_t sent = ::send(end_, at, count, MSG_NOSIGNAL);
      if (sent < 0 && errno == EINTR) continue;
      if (sent <= 0) return false;
      at += sent;
      count -= static_cast<std::size_t>(sent);
    }
    return true;
  }

  enum class Got { all, ended, late };

  /// patience_s < 0: for as long as it takes.
  Got receive(void* to, std::size_t count, double patience_s) const {
    auto* at = static_cast<char*>(to);
    while (count > 0) {
      if (!wait(patience_s)) return Got::late;
      const ssize_t got = ::recv(end_, at, count, 0);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return Got::ended;
      at += got;
      count -= static_cast<std::size_t>(got);
    }
    return Got::all;
  }

 private:
  bool wait(double patience_s) const {
    pollfd watched{end_, POLLIN, 0};
    const int milliseconds = patience_s < 0.0 ? -1 : static_cast<int>(1000.0 * patience_s);
    int ready = 0;
    do {
      ready = ::poll(&watched, 1, milliseconds);
    } while (ready < 0 && errno == EINTR);
    return ready > 0;
  }

  int end_;
};

/// The sink on the reader's side.
class FarSink : public TableSink {
 public:
  explicit FarSink(const Line& line) : line_(line) {}

  std::vector<std::size_t> begin(const TableHead& head) override {
    say(TableWord::begin, bytes_of(head));
    std::uint64_t count = 0;
    if (line_.receive(&count, sizeof count, -1.0) != Line::Got::all) _exit(1);
    std::vector<std::uint64_t> wanted(count);
    if (line_.receive(wanted.data(), 8 * count, -1.0) != Line::Got::all) _exit(1);
    return {wanted.begin(), wanted.end()};
  }

  void rows(std::span<const std::vector<double>> columns) override {
    MessageWriter to;
    to.number(columns.size());
    for (const auto& column : columns) to.reals(column);
    say(TableWord::rows, to.bytes());
  }

  void note(const std::string& text) override { say(TableWord::note, text); }

  void say(TableWord word, std::string_view bytes) const {
    const MessageHead head{word, 0, bytes.size()};
    if (!line_.send(&head, sizeof head) || !line_.send(bytes.data(), bytes.size())) _exit(1);
  }

 private:
  const Line& line_;
};

void bound(int resource, rlim_t most) {
  const rlimit limit{most, most};
  ::setrlimit(resource, &limit);
}

/// What it may take: so much memory beyond what the program has, no file of its own, no core.
void bound_process(const TableLimits& limits) {
  bound(RLIMIT_CORE, 0);
  bound(RLIMIT_FSIZE, 0);
#ifndef FLEXSPLINE_SANITIZED
  std::ifstream sizes("/proc/self/statm");
  std::size_t pages = 0;
  if (sizes >> pages) {
    bound(RLIMIT_AS,
          pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + limits.memory_bytes);
  }
#else
  (void)limits;
#endif
}

[[noreturn]] void serve(const TableReaderRow& reader, const std::filesystem::path& path,
                        const TableRequest& request, int end) {
  for (const int one : {SIGINT, SIGTERM, SIGSEGV, SIGBUS, SIGABRT, SIGFPE}) {
    std::signal(one, SIG_DFL);
  }
  bound_process(request.limits);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  const Line line(end);
  FarSink sink(line);
  try {
    const auto done = reader.read(path, request, sink);
    if (done) {
      sink.say(TableWord::done, "");
    } else {
      sink.say(TableWord::failed, done.error().message());
    }
  } catch (const std::bad_alloc&) {
    sink.say(TableWord::failed, path.string() + ": it asks for more memory than it may have");
  } catch (const std::exception& error) {
    sink.say(TableWord::failed, path.string() + ": " + error.what());
  }
  _exit(0);
}

/// The reader's process, ended at the latest with this.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() { end(); }

  /// The signal that ended it; 0: it ended by itself.
  int end() {
    if (id_ < 0) return 0;
    int status = 0;
    if (::waitpid(id_, &status, WNOHANG) == 0) {
      ::usleep(20000);  // a crash is told before it is reaped
      if (::waitpid(id_, &status, WNOHANG) == 0) {
        ::kill(id_, SIGKILL);
        ::waitpid(id_, &status, 0);
        status = 0;
      }
    }
    id_ = -1;
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  }

 private:
  pid_t id_;
};

/// What the reader says, passed on to the sink, and checked.
class NearSide {
 public:
  NearSide(const Line& line, const TableLimits& limits, TableSink& sink)
      : line_(line), limits_(limits), sink_(sink) {}

  /// Empty: done. Otherwise what is wrong.
  std::string listen(bool& crashed) {
    while (true) {
      MessageHead head{};
      const auto got = line_.receive(&head, sizeof head, limits_.silence_s);
      if (got == Line::Got::late) return fmt::format("takes longer than {:g} s", limits_.silence_s);
      std::string bytes;
      if (got == Line::Got::all && head.bytes <= kLongestMessage) {
        bytes.resize(head.bytes);
        crashed = line_.receive(bytes.data(), bytes.size(), limits_.silence_s) != Line::Got::all;
      } else {
        crashed = true;
      }
      if (crashed) return "ended before it was done";
      if (head.word == TableWord::done) return {};
      if (head.word == TableWord::failed) return bytes;
      if (!take(head.word, bytes)) return "said what it may not";
    }
  }

 private:
  bool take(TableWord word, const std::string& bytes) {
    switch (word) {
      case TableWord::begin:
        return begin(bytes);
      case TableWord::rows:
        return rows(bytes);
      case TableWord::note:
        sink_.note(bytes);
        return true;
      default:
        return false;
    }
  }

  bool begin(const std::string& bytes) {
    const auto head = table_head(bytes, limits_);
    if (!head || ++tables_ > limits_.tables) return false;
    const std::vector<std::size_t> wanted = sink_.begin(*head);
    wanted_ = wanted.size();
    rows_ = 0;
    const std::vector<std::uint64_t> answer(wanted.begin(), wanted.end());
    const std::uint64_t count = answer.size();
    return line_.send(&count, sizeof count) && line_.send(answer.data(), 8 * answer.size());
  }

  bool rows(const std::string& bytes) {
    MessageReader from(bytes);
    if (from.number() != wanted_ || wanted_ == 0) return false;
    std::vector<std::vector<double>> columns;
    for (std::size_t i = 0; i < wanted_; ++i) {
      auto values = from.reals();
      if (!values || (i > 0 && values->size() != columns[0].size())) return false;
      columns.push_back(*std::move(values));
    }
    rows_ += columns[0].size();
    if (rows_ > limits_.rows) return false;
    sink_.rows(columns);
    return from.ended();
  }

  const Line& line_;
  const TableLimits& limits_;
  TableSink& sink_;
  std::size_t tables_ = 0;
  std::size_t wanted_ = 0;
  std::size_t rows_ = 0;
};

}  // namespace

Result<void> read_contained(const TableReaderRow& reader, const std::filesystem::path& path,
                            const TableRequest& request, TableSink& sink) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    return failure(ErrorCode::defect,
                   "no socket for a reader: " + std::string(std::strerror(errno)));
  }
  const pid_t id = ::fork();
  if (id == 0) {
    ::close(ends[0]);
    serve(reader, path, request, ends[1]);
  }
  ::close(ends[1]);
  const Line line(ends[0]);
  if (id < 0) {
    return failure(ErrorCode::defect,
                   "no process for a reader: " + std::string(std::strerror(errno)));
  }
  Child child(id);
  bool crashed = false;
  const std::string problem = NearSide(line, request.limits, sink).listen(crashed);
  if (problem.empty()) return {};
  const int signal = crashed ? child.end() : 0;
  const std::string remedy = "the file may be damaged; write it again, or export it as CSV";
  if (crashed) {
    return failure(ErrorCode::bad_data,
                   fmt::format("{}: the reader '{}' ended on it{}", path.string(), reader.id,
                               signal == 0 ? "" : fmt::format(" by signal {}", signal)),
                   remedy);
  }
  const bool named = problem.starts_with(path.string());
  return failure(
      ErrorCode::bad_data,
      named ? problem : fmt::format("{}: the reader '{}' {}", path.string(), reader.id, problem),
      named ? "" : remedy);
}

}  // namespace flexspline::data
