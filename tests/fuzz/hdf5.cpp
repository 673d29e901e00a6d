#include "fuzzed_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  flexspline::fuzz::read("hdf5", bytes, size);
  return 0;
}
