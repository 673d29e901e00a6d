#include "flexspline/core/effect_dependence.hpp"

#include <algorithm>
#include <vector>

namespace flexspline {
namespace {

Instant<Complex> nowhere_zero() {
  Instant<Complex> x;
  double next = 0.37;
  for (auto member :
       {&Instant<Complex>::time, &Instant<Complex>::motor_angle, &Instant<Complex>::motor_speed,
        &Instant<Complex>::motor_acceleration, &Instant<Complex>::load_angle,
        &Instant<Complex>::load_speed, &Instant<Complex>::load_acceleration,
        &Instant<Complex>::torsion_rate, &Instant<Complex>::torsion_acceleration,
        &Instant<Complex>::transmitted_torque, &Instant<Complex>::transmitted_torque_rate,
        &Instant<Complex>::motor_torque, &Instant<Complex>::motor_torque_rate}) {
    x.*member = Complex(next += 0.23);
  }
  x.torsion = 1e-3;
  return x;
}

}  // namespace

bool depends_on(const EffectRow& row, std::span<const double> values,
                Complex Instant<Complex>::*variable) {
  Instant<Complex> x = nowhere_zero();
  x.*variable += Complex(0.0, 1e-20);
  const std::vector<Complex> p(values.begin(), values.end());
  const std::vector<Complex> memory(state_count(row, p.size()), Complex(1e-4));
  if (row.complex.term(x, p, memory).imag() != 0.0) return true;
  if (row.complex.rate == nullptr) return false;
  std::vector<Complex> rates(memory.size());
  row.complex.rate(x, p, memory, rates);
  return std::ranges::any_of(rates, [](const Complex& rate) { return rate.imag() != 0.0; });
}

}  // namespace flexspline
