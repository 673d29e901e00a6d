#include "fuzzed_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  flexspline::fuzz::read("rosbag2", bytes, size);
  return 0;
}
