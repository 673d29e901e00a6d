#include "tables/contained.hpp"

#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <fmt/format.h>

#include "tables/message_line.hpp"
#include "tables/reader_process.hpp"

namespace flexspline::data {
namespace {

constexpr std::uint64_t kLongestMessage = std::uint64_t{1} << 28U;
constexpr int kPatienceMs = 20;

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
    pid_t gone = ::waitpid(id_, &status, WNOHANG);
    for (int ms = 0; gone == 0 && ms < kPatienceMs; ++ms) {  // a crash is told before it is reaped
      ::usleep(1000);
      gone = ::waitpid(id_, &status, WNOHANG);
    }
    if (gone == 0) {
      ::kill(id_, SIGKILL);
      ::waitpid(id_, &status, 0);
      status = 0;
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
  NearSide(const MessageLine& line, const TableLimits& limits, TableSink& sink)
      : line_(line), limits_(limits), sink_(sink) {}

  /// Empty: done. Otherwise what is wrong.
  std::string listen(bool& crashed) {
    while (true) {
      MessageHead head{};
      const auto got = line_.receive(&head, sizeof head, limits_.silence_s);
      if (got == MessageLine::Got::late)
        return fmt::format("takes longer than {:g} s", limits_.silence_s);
      std::string bytes;
      if (got == MessageLine::Got::all && head.bytes <= kLongestMessage) {
        bytes.resize(head.bytes);
        crashed =
            line_.receive(bytes.data(), bytes.size(), limits_.silence_s) != MessageLine::Got::all;
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

  const MessageLine& line_;
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
    serve_reader(reader, path, request, ends[1]);
  }
  ::close(ends[1]);
  const MessageLine line(ends[0]);
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
