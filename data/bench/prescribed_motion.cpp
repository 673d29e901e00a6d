#include "bench/prescribed_motion.hpp"

#include <cmath>
#include <numbers>

namespace flexspline::data {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kRunUp = 0.5;  // cycles

/// Value and derivatives by the fraction of a cycle.
MotionPoint ramp(double fraction) {
  if (fraction >= kRunUp) return {1.0, 0.0, 0.0};
  const double s = fraction / kRunUp;
  const double bell = s * (1.0 - s);
  return {s * s * s * s * (35.0 + s * (-84.0 + s * (70.0 - 20.0 * s))),
          140.0 * bell * bell * bell / kRunUp,
          420.0 * bell * bell * (1.0 - 2.0 * s) / (kRunUp * kRunUp)};
}

}  // namespace

PrescribedMotion::PrescribedMotion(const BenchExcitation& excitation,
                                   std::vector<std::pair<int, std::pair<double, double>>> harmonics)
    : excitation_(excitation), harmonics_(std::move(harmonics)) {}

MotionPoint PrescribedMotion::waveform(double fraction) const {
  const double angle = kTurn * fraction;
  MotionPoint sum{std::sin(angle), kTurn * std::cos(angle), -kTurn * kTurn * std::sin(angle)};
  for (const auto& [order, share_and_phase] : harmonics_) {
    const auto [share, phase] = share_and_phase;
    const double rate = kTurn * order;
    const double a = order * (angle - std::numbers::pi / 2.0) + phase;
    const double c = share * std::cos(a);
    sum.position += c;
    sum.velocity -= rate * share * std::sin(a);
    sum.acceleration -= rate * rate * c;
  }
  return sum;
}

MotionPoint PrescribedMotion::at(CycleInstant instant) const {
  if (instant.cycle < 0) return {};
  const MotionPoint s = waveform(instant.fraction);
  const MotionPoint r = instant.cycle == 0 ? ramp(instant.fraction) : MotionPoint{1.0, 0.0, 0.0};
  const double a = excitation_.amplitude;
  const double f = excitation_.frequency_hz;
  return {a * r.position * s.position, a * f * (r.velocity * s.position + r.position * s.velocity),
          a * f * f *
              (r.acceleration * s.position + 2.0 * r.velocity * s.velocity +
               r.position * s.acceleration)};
}

CycleInstant PrescribedMotion::instant(int sample, double offset, double late_s) const {
  const int n = excitation_.samples_per_cycle;
  const double fraction = (sample % n + offset) / n - late_s * excitation_.frequency_hz;
  const double whole = std::floor(fraction);
  return {sample / n + static_cast<int>(whole), fraction - whole};
}

}  // namespace flexspline::data
