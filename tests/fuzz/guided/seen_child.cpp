// Compiled without counters of its own: the instrumentation owns the names of their section.
#include "seen_child.hpp"

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <unistd.h>

#include <sanitizer/common_interface_defs.h>

extern "C" {
extern unsigned char __start___sancov_cntrs[];
extern unsigned char __stop___sancov_cntrs[];

/// A library that asks for more than there is gets nothing, as in the program. What C++ asks for
/// with new is still found.
int LLVMFuzzerTestOneInput(const unsigned char*, std::size_t);
const char* __asan_default_options() { return "allocator_may_return_null=1"; }
}

namespace flexspline::fuzz {
namespace {

volatile char* found = nullptr;
/// What the sanitizers say in a child, whose own output is closed.
int said[2] = {-1, -1};

void* shared(std::size_t bytes) {
  void* memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) std::abort();
  return memory;
}

/// Whole pages of them: on those at either end there may be something else.
void share_counters() {
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const auto from =
      (reinterpret_cast<std::uintptr_t>(__start___sancov_cntrs) + page - 1) / page * page;
  const auto to = reinterpret_cast<std::uintptr_t>(__stop___sancov_cntrs) / page * page;
  if (to <= from) return;
  void* copy = shared(to - from);
  std::memcpy(copy, reinterpret_cast<void*>(from), to - from);
  if (::mremap(copy, to - from, to - from, MREMAP_MAYMOVE | MREMAP_FIXED,
               reinterpret_cast<void*>(from)) == MAP_FAILED) {
    std::abort();
  }
}

bool is_in_target(const Dl_info& in) {
  Dl_info target;
  return ::dladdr(reinterpret_cast<void*>(&LLVMFuzzerTestOneInput), &target) != 0 &&
         target.dli_fbase == in.dli_fbase;
}

/// The sanitizers' own code lies in front of the target's, in the same file.
bool is_sanitizers(void* frame, const Dl_info& in) {
  return is_in_target(in) && frame < reinterpret_cast<void*>(&LLVMFuzzerTestOneInput);
}

/// Whether what a sanitizer complains of was done by a library behind the readers: they are not
/// instrumented, but what they call is (memcpy and its like). What the C library or zlib did, was
/// done by who called them.
bool is_librarys() {
  void* frames[64];
  const int count = ::backtrace(frames, 64);
  // From the top: the sanitizer's backtrace, this file, the sanitizer that complains, who called
  // it.
  int changes = 0;
  bool before = true;
  for (int i = 0; i < count; ++i) {
    Dl_info in;
    if (::dladdr(frames[i], &in) == 0) return false;
    const bool sanitizers = is_sanitizers(frames[i], in);
    changes += sanitizers == before ? 0 : 1;
    before = sanitizers;
    if (changes < 3) continue;
    if (!sanitizers && is_in_target(in)) return false;
    const std::string_view file = in.dli_fname;
    if (file.find("libhdf5") != file.npos || file.find("libnetcdf") != file.npos ||
        file.find("libmatio") != file.npos) {
      return true;
    }
  }
  return false;
}

void tell_parent() {
  if (is_librarys()) return;
  *found = 1;
  void* frames[64];
  ::backtrace_symbols_fd(frames, ::backtrace(frames, 64), said[1]);
}

/// Never waits, and leaves room for the next child's words.
std::string take_said() {
  std::string all;
  char part[4096];
  while (true) {
    const ssize_t count = ::read(said[0], part, sizeof part);
    if (count <= 0) return all;
    all.append(part, static_cast<std::size_t>(count));
  }
}

}  // namespace

void see_children() {
  static const bool once = [] {
    found = static_cast<volatile char*>(shared(1));
    if (::pipe2(said, O_CLOEXEC | O_NONBLOCK) != 0) std::abort();
    share_counters();
    (void)is_librarys();  // what unwinding loads, it loads here
    pthread_atfork(nullptr, nullptr, [] {
      __sanitizer_set_report_fd(reinterpret_cast<void*>(static_cast<std::intptr_t>(said[1])));
      __sanitizer_set_death_callback(tell_parent);
    });
    return true;
  }();
  (void)once;
}

void check_children() {
  const std::string words = take_said();
  if (*found == 0) return;
  (void)!::write(STDERR_FILENO, words.data(), words.size());
  std::abort();
}

}  // namespace flexspline::fuzz
