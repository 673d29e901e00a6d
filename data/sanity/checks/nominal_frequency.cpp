#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sanity/check.hpp"
#include "sanity/evidence.hpp"

namespace flexspline::data {
namespace {

constexpr std::string_view kUnit = "check the unit of the time channel and frequency_hz";
constexpr SanityVerdict kOtherUnits{"check_units", Severity::error, kUnit};
constexpr SanityVerdict kNearly{"check_units", Severity::warning, kUnit};

constexpr double kAlike = 1.08;
constexpr double kMistaken = 1.3;
constexpr double kLeastCycles = 0.05;   // of an excitation that is worth its frequency
constexpr double kLeastPerCycle = 2.0;  // samples of a cycle that is no alias
constexpr double kSine = 0.5;           // of the variance: below it no frequency is read

// Of any excitation: less than a twentieth of a cycle, or more cycles than samples can show. What
// the stamps are off by is then not known, but for its direction.
std::optional<double> told_by_cycles(const Recording& recording) {
  const double duration = recording.time.back() - recording.time.front();
  const double cycles = duration * *recording.frequency_hz;
  const double most = static_cast<double>(recording.time.size()) / kLeastPerCycle;
  if (cycles > kLeastCycles && cycles < most) return std::nullopt;
  return cycles < 1.0 ? 1000.0 : 1e-3;
}

/// The motion's frequency over the stated one.
std::optional<double> told_by(const Observed& o) {
  if (!o.recording->frequency_hz || !o.sine) return std::nullopt;
  if (const auto rough = told_by_cycles(*o.recording)) return rough;
  if (o.recording->excitation != "sine" || o.sine->explained < kSine) return std::nullopt;
  return o.sine->frequency_hz / *o.recording->frequency_hz;
}

SanityFinding finding(const std::string& recording, double factor) {
  const std::string mistake = !is_off(factor / 1000.0, 1.12)   ? " (1000 is s taken for ms)"
                              : !is_off(factor * 1000.0, 1.12) ? " (1/1000 is ms taken for s)"
                                                               : "";
  return (is_off(factor, kMistaken) ? kOtherUnits : kNearly)
      .on(recording,
          fmt::format("the motion's frequency is {:.3g} times the one that dataset.toml states{}",
                      factor, mistake));
}

std::vector<SanityFinding> find(const ObservedSet& all) {
  std::vector<Factor> factors;
  for (const Observed& o : all.recordings) {
    if (const auto told = told_by(o)) factors.push_back({o.recording->id, *told});
  }
  if (factors.empty()) return {};
  const Agreement agreement = agreement_of(factors, kAlike);
  std::vector<SanityFinding> list;
  if (is_off(agreement.common, kAlike)) list.push_back(finding("", agreement.common));
  for (const Factor& other : agreement.others) {
    if (is_off(other.value, kAlike)) list.push_back(finding(other.recording, other.value));
  }
  return list;
}

}  // namespace

SanityRow describe_nominal_frequency() {
  return {"nominal_frequency",
          "the recorded motion against the frequency that the set states",
          {kOtherUnits, kNearly},
          find};
}

}  // namespace flexspline::data
