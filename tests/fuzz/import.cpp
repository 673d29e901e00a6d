#include "flexspline/data/import.hpp"
#include "fuzzed_file.hpp"

// A bench's text, all the way to a data set.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace flexspline;
  data::ImportWish wish;
  wish.files = {fuzz::write("bench.csv", bytes, size)};
  wish.constants["gear_ratio"] = 50.0;
  wish.name = "fuzzed";
  wish.split_s = size % 2 == 0 ? std::nullopt : std::optional(1.0);
  const auto plan = data::plan_import(wish);
  if (plan && plan->open.empty()) (void)data::write_import(*plan, fuzz::folder() / "set");
  return 0;
}
