#include "flexspline/studies/study_config.hpp"
#include "fuzzed_file.hpp"

// A study file, whose data sets and models may be there or not.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace flexspline;
  const auto reading = studies::read_study(fuzz::write("study.toml", bytes, size));
  if (reading && reading->study.has_value() != reading->errors.empty()) std::abort();
  return 0;
}
