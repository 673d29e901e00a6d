#include "tables/reader_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <exception>
#include <fstream>
#include <new>

#include "tables/message_line.hpp"

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

/// The sink on the reader's side.
class FarSink : public TableSink {
 public:
  explicit FarSink(const MessageLine& line) : line_(line) {}

  std::vector<std::size_t> begin(const TableHead& head) override {
    say(TableWord::begin, bytes_of(head));
    std::uint64_t count = 0;
    if (line_.receive(&count, sizeof count, -1.0) != MessageLine::Got::all) _exit(1);
    std::vector<std::uint64_t> wanted(count);
    if (line_.receive(wanted.data(), 8 * count, -1.0) != MessageLine::Got::all) _exit(1);
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
  const MessageLine& line_;
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

}  // namespace

void serve_reader(const TableReaderRow& reader, const std::filesystem::path& path,
                  const TableRequest& request, int end) {
  for (const int one : {SIGINT, SIGTERM, SIGSEGV, SIGBUS, SIGABRT, SIGFPE}) {
    std::signal(one, SIG_DFL);
  }
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // the program may be ended while this goes round in a circle
  bound_process(request.limits);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  const MessageLine line(end);
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

}  // namespace flexspline::data
