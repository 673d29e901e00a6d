#include "fuzzed_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  flexspline::fuzz::read("matlab", bytes, size);
  return 0;
}
