#include <numbers>

#include <fmt/format.h>

#include "sanity/check.hpp"
#include "sanity/evidence.hpp"

namespace flexspline::data {
namespace {

constexpr SanityVerdict kNoSine{"check_channel", Severity::warning,
                                "check which file this is, and state what was done"};

constexpr double kSine = 0.75;       // of the variance: a sine that swells and fades has as much
constexpr double kHarmonics = 0.09;  // of its amplitude: those of a triangle are 0.12
constexpr int kHighest = 7;

/// Root of the sum of squares of the harmonics over the fundamental, of what the bench moves.
double distortion(const ObservedSet& all, const Observed& o) {
  const Eigen::ArrayXd& held = all.set.rig == Rig::specimen ? o.motion
                               : all.set.rig == Rig::locked ? o.motor_angle
                                                            : o.load_angle;
  if (held.size() == 0) return 0.0;
  std::vector<Eigen::ArrayXd> columns = {Eigen::ArrayXd::Ones(held.size())};
  for (int k = 1; k <= kHighest; ++k) {
    const Eigen::ArrayXd phase = 2.0 * std::numbers::pi * k * o.sine->frequency_hz * o.time;
    columns.emplace_back(phase.cos()), columns.emplace_back(phase.sin());
  }
  const auto a = regression(columns, held, o.usable).coefficient;
  return a.tail(2 * kHighest - 2).norm() / a.segment(1, 2).norm();
}

std::vector<SanityFinding> find(const ObservedSet& all) {
  std::vector<SanityFinding> list;
  for (const Observed& o : all.recordings) {
    if (o.recording->excitation != "sine" || !o.sine) continue;
    const double harmonics = distortion(all, o);
    if (o.sine->explained > kSine && harmonics < kHarmonics) continue;
    list.push_back(
        kNoSine.on(o.recording->id,
                   fmt::format("its excitation is said to be a sine, but a sine explains {:.0f} % "
                               "of the motion's variance, and harmonics are {:.0f} % of it",
                               100.0 * o.sine->explained, 100.0 * harmonics)));
  }
  return list;
}

}  // namespace

SanityRow describe_not_a_sine() { return {"not_a_sine", "a sine that is none", {kNoSine}, find}; }

}  // namespace flexspline::data
