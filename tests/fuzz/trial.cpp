#include "flexspline/studies/trial.hpp"
#include "fuzzed_file.hpp"

// A trial file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace flexspline;
  const auto reading = studies::read_trial(fuzz::write("trial.toml", bytes, size), {});
  if (reading && reading->trial.has_value() != reading->errors.empty()) std::abort();
  return 0;
}
