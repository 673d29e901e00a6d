#include "flexspline/data/manifest.hpp"
#include "fuzzed_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  flexspline::fuzz::write("manifest.json", bytes, size);
  (void)flexspline::data::read_manifest(flexspline::fuzz::folder());
  return 0;
}
