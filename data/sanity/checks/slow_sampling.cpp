#include <fmt/format.h>

#include "sanity/check.hpp"

namespace flexspline::data {
namespace {

constexpr SanityVerdict kSlow{"check_channel", Severity::warning,
                              "sample 50 times a cycle or more: rates are not known from fewer"};

constexpr double kFewest = 20.0;  // samples a cycle: rates by differences are off by 2 %
constexpr double kSine = 0.5;     // of the variance

std::vector<SanityFinding> find(const ObservedSet& all) {
  std::vector<SanityFinding> list;
  for (const Observed& o : all.recordings) {
    if (!o.sine || o.sine->explained < kSine) continue;
    const auto& time = o.recording->time;
    const double rate = static_cast<double>(time.size() - 1) / (time.back() - time.front());
    const double a_cycle = rate / o.sine->frequency_hz;
    if (a_cycle > kFewest) continue;
    list.push_back(kSlow.on(o.recording->id, fmt::format("{:.3g} samples a cycle of {:.3g} Hz",
                                                         a_cycle, o.sine->frequency_hz)));
  }
  return list;
}

}  // namespace

SanityRow describe_slow_sampling() {
  return {"slow_sampling", "too few samples a cycle of the excitation", {kSlow}, find};
}

}  // namespace flexspline::data
