#include "signals/remembered.hpp"

#include <bit>
#include <cstring>

namespace flexspline {
namespace {

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

// The finaliser of SplitMix64: every bit of a sample reaches every bit of the sum.
std::uint64_t mixed(std::uint64_t sum, double sample) {
  sum = (sum ^ std::bit_cast<std::uint64_t>(sample)) * 0xbf58476d1ce4e5b9U;
  return (sum ^ (sum >> 31U)) * 0x94d049bb133111ebU;
}

}  // namespace

bool RecordContent::same_as(const RecordContent& other) const {
  return same_bits(time, other.time) && same_bits(motion, other.motion) &&
         same_bits(effort, other.effort) && frequency_hz == other.frequency_hz &&
         travels == other.travels;
}

std::uint64_t RecordContent::hash() const {
  std::uint64_t sum = mixed(travels ? 2 : 1, frequency_hz);
  for (const std::vector<double>* series : {&time, &motion, &effort}) {
    for (const double sample : *series) sum = mixed(sum, sample);
  }
  return sum;
}

std::size_t RecordContent::bytes() const {
  return sizeof(RecordContent) + sizeof(double) * (time.size() + motion.size() + effort.size());
}

}  // namespace flexspline
