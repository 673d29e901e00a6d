#include "flexspline/core/remembered.hpp"

#include <bit>
#include <cstring>

namespace flexspline {
namespace {

// The finaliser of SplitMix64: every bit of a number reaches every bit of the sum.
std::uint64_t mixed(std::uint64_t sum, double number) {
  sum = (sum ^ std::bit_cast<std::uint64_t>(number)) * 0xbf58476d1ce4e5b9U;
  return (sum ^ (sum >> 31U)) * 0x94d049bb133111ebU;
}

}  // namespace

void Content::add(std::span<const double> series) {
  numbers.push_back(static_cast<double>(series.size()));
  numbers.insert(numbers.end(), series.begin(), series.end());
}

bool Content::same_as(const Content& other) const {
  return numbers.size() == other.numbers.size() &&
         std::memcmp(numbers.data(), other.numbers.data(), numbers.size() * sizeof(double)) == 0;
}

std::uint64_t Content::hash() const {
  std::uint64_t sum = 1;
  for (const double number : numbers) sum = mixed(sum, number);
  return sum;
}

std::size_t Content::bytes() const { return sizeof(Content) + sizeof(double) * numbers.size(); }

Content content_of(const TorsionRecord& record) {
  Content content{{record.travels ? 1.0 : 0.0, record.frequency_hz.value_or(0.0)}};
  for (const auto* series : {&record.time, &record.motion, &record.effort}) content.add(*series);
  return content;
}

}  // namespace flexspline
