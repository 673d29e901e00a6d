#include "flexspline/studies/conceal.hpp"
#include "fuzzed_file.hpp"

// A bench file: what conceal hides.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace flexspline;
  const auto reading = studies::read_conceal_plan(fuzz::write("bench.toml", bytes, size));
  if (reading && reading->plan.has_value() != reading->errors.empty()) std::abort();
  return 0;
}
