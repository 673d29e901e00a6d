#include "flexspline/studies/verify.hpp"
#include "fuzzed_file.hpp"

// A study.lock.toml, as status, verify and resumed runs read it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace flexspline;
  (void)studies::read_locked_study(fuzz::write("study.lock.toml", bytes, size), {});
  return 0;
}
